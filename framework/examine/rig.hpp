// SPDX-License-Identifier: MIT
#pragma once

#include "stage.hpp"

#include <tactus/node/catalogue.hpp>

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

namespace tactus::examine
{

/// A node of any type on the test bench. It is driven as the engine would drive it, by the names in its datasheet.
///
///     Rig rig { "signal.mix" };
///     rig.set ("inputs", 3.0).param ("gain", 0.5, 2);     // settings first; gain[2] = 0.5
///     rig.prepare();
///     rig.input ("in", 1.0, 2);                           // in[2] = 1
///     rig.tick();
///     CHECK (rig.out ("out") == 0.5);
///
/// A device node is bound to `*device`. If a node has peek(), its outputs do not depend on the inputs of the same tick. A name that
/// the node does not have throws std::invalid_argument.
class Rig
{
public:
    /// One number of a node's inputs or outputs: a component of a vector, or an entry of a list.
    struct Component
    {
        const PortSheet* port;
        int index;   ///< position of the number within the port
    };

    explicit Rig (const NodeType&, double rate_hz = 4000.0);
    explicit Rig (std::string_view type_id, double rate_hz = 4000.0);

    Rig& set (std::string_view setting, const SettingValue&);        ///< call before prepare
    Rig& param (std::string_view id, double value, int index = 0);   ///< index: component of a vector, or entry of a list
    Rig& choose (std::string_view choice, std::string_view alternative);
    std::string problem() const;

    void prepare();   ///< calls the node's bind, prepare and update
    void wire();      ///< from now on, a wire drives the params; the node also gets the values of file and knobs, which stay as they are now
    void adopt (const Rig& old);

    Rig& input (std::string_view id, double value, int index = 0);
    Rig& input (std::string_view id, const Vec3&);
    void tick() noexcept;   ///< calls the node's update if a param has moved, then peek and tick

    double out (std::string_view id, int index = 0) const;
    Vec3 vector (std::string_view id) const;

    Claims claims() const;   ///< empty if the node has no claims
    Effort effort() const noexcept;

    //==========================================================================
    // Access by index, for tests that know nothing about the node.

    const NodeType& type() const noexcept { return sheet; }
    std::vector<double> in;                   ///< the values that the inputs read; default values after prepare
    std::vector<Component> inputs, outputs;   ///< what each entry of `in` and of outs() belongs to; valid after prepare
    double out (std::size_t output) const noexcept;
    std::vector<double> outs() const;
    bool wroteTooFar() const noexcept;                        ///< true if the node has written past the end of its outputs
    double& paramAt (const PortSheet&, int index) noexcept;   ///< not for choices; call moved() after changing it
    void moved() noexcept { params_moved = true; }
    int entries() const noexcept { return list_size; }   ///< size of this node's lists

    std::unique_ptr<DeviceState> device = std::make_unique<DeviceState>();   ///< the state of its role that a device node is bound to

private:
    const NodeType& sheet;
    Setup setup;
    std::shared_ptr<void> node;
    std::unique_ptr<std::byte[]> results;
    std::vector<const double*> sources;
    std::vector<std::byte> stored;   // the params of file and knobs, if wires drive params
    int list_size = 0;
    bool params_moved = false;
};

}   // namespace tactus::examine
