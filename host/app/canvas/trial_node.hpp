// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/face.hpp>
#include <host/app/model/patch.hpp>

#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A node with the values that a graph gives one of its nodes, but outside every plan: to see how it answers. [main thread]
class TrialNode
{
public:
    /// Empty if the node reads files or a device, has lists, or refuses its values.
    static std::optional<TrialNode> make (const graph::Graph&, const SeenPatch& patch, const graph::Node&, const Face&);

    void set (std::string_view input, const Vec3&);   ///< of a scalar input: x
    void tick() noexcept;
    double output (std::string_view id, std::size_t component = 0) const noexcept;

    /// The value of a param; `fallback` if there is no such param.
    double param (std::string_view id, double fallback) const noexcept;

private:
    explicit TrialNode (const NodeType&);

    struct AlignedDelete
    {
        std::align_val_t align;
        void operator() (std::byte* p) const noexcept { ::operator delete (p, align); }
    };

    const NodeType* type;
    std::shared_ptr<void> node;
    std::vector<double> inputs;   // all components, in the order of the datasheet
    std::vector<const double*> sources;
    std::unique_ptr<std::byte, AlignedDelete> outputs;
};

}   // namespace tactus::host
