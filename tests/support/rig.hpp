// SPDX-License-Identifier: MIT
#pragma once

#include <framework/catalogue.hpp>

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

/// A node of any type on the test bench: driven as the engine would drive it, by the names in its datasheet.
///
///     Rig rig { "signal.mix" };
///     rig.set ("inputs", 3.0).param ("gain", 0.5, 2);     // settings first; gain[2] = 0.5
///     rig.prepare();
///     rig.input ("in", 1.0, 2);                           // in[2] = 1
///     rig.tick();
///     CHECK (rig.out ("out") == 0.5);
///
/// A device node is bound to `*device`. Of a node with peek(), the outputs of a tick are those it gave before it. A test
/// fails at once on a name that the node does not have.
class Rig
{
public:
    /// One number among a node's inputs or outputs: the component of a vector, or the entry of a list.
    struct Component
    {
        const tactus::PortSheet* port;
        int index;   ///< within the port
    };

    explicit Rig (const tactus::NodeType&, double rate_hz = 4000.0);
    explicit Rig (std::string_view type_id, double rate_hz = 4000.0);

    Rig& set (std::string_view setting, const tactus::SettingValue&);   ///< before prepare
    Rig& param (std::string_view id, double value, int index = 0);      ///< index: component or entry
    Rig& choose (std::string_view choice, std::string_view alternative);
    std::string problem() const;

    void prepare();   ///< bind, prepare, update
    void adopt (const Rig& old);

    Rig& input (std::string_view id, double value, int index = 0);
    Rig& input (std::string_view id, const tactus::Vec3&);
    void tick() noexcept;   ///< update if a param moved, peek, tick

    double out (std::string_view id, int index = 0) const;
    tactus::Vec3 vector (std::string_view id) const;

    tactus::Claims claims() const;   ///< none if the node claims nothing
    tactus::Effort effort() const noexcept;

    //==========================================================================
    // By number, for tests that know nothing of the node.

    const tactus::NodeType& type() const noexcept { return sheet; }
    std::vector<double> in;                   ///< what the inputs read; default values after prepare
    std::vector<Component> inputs, outputs;   ///< what each number stands for; after prepare
    double out (std::size_t output) const noexcept;
    std::vector<double> outs() const;
    double& paramAt (const tactus::PortSheet&, int index) noexcept;   ///< not for choices; call moved() afterwards
    void moved() noexcept { params_moved = true; }
    int entries() const noexcept { return list_size; }   ///< how many a list of this node has

    std::unique_ptr<tactus::DeviceState> device = std::make_unique<tactus::DeviceState>();   ///< its role, for a device node

private:
    const tactus::NodeType& sheet;
    tactus::Setup setup;
    std::shared_ptr<void> node;
    std::unique_ptr<std::byte[]> results;
    std::vector<const double*> sources;
    int list_size = 0;
    bool params_moved = false;
};
