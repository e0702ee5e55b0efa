// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/flat/flat.hpp>

#include <span>
#include <vector>

namespace tactus::plan
{

/// Numbers everything that wires and feeds can drive: first the components of all inputs, node by node and within a node in the order
/// of its datasheet, then the components of all params, in the order of Flat::values.
class Slots
{
public:
    explicit Slots (const Flat&);

    /// The nodes get their slots in this order, each node once, so that what lies side by side runs one after another.
    Slots (const Flat&, std::span<const int> order);

    std::size_t firstInput (int node) const noexcept { return inputs[at (node)]; }
    std::size_t firstParam (int node) const noexcept { return input_count + flat->node (node).values; }
    static std::size_t inputsOf (const FlatNode&) noexcept;   ///< number of slots of the inputs of a node

    /// The slot of this component of an input or param; -1 means the first component. Ignores the component in the reference.
    std::size_t operator() (const PortRef&, int component) const noexcept;

    std::size_t inputCount() const noexcept { return input_count; }
    std::size_t count() const noexcept { return input_count + flat->values.size(); }

private:
    const Flat* flat;
    std::vector<std::size_t> inputs;   // first slot of each node
    std::size_t input_count = 0;
};

/// Number of a component among the slots of its port.
inline int slotWithin (const PortRef& r, int component, int width) noexcept { return std::max (r.index, 0) * width + std::max (component, 0); }

}   // namespace tactus::plan
