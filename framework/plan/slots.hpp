// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

namespace tactus::plan
{

/// Numbers everything that wires and feeds can drive: first the components of all inputs, node by node in the order of
/// their datasheets, then the components of all params, in the order of Flat::values.
class Slots
{
public:
    explicit Slots (const Flat&);

    std::size_t firstInput (int node) const noexcept { return inputs[at (node)]; }
    std::size_t firstParam (int node) const noexcept { return inputs.back() + flat->node (node).values; }

    /// The slot of this component of an input or param; -1 means the first component. Ignores the component in the reference.
    std::size_t operator() (const PortRef&, int component) const noexcept;

    std::size_t inputCount() const noexcept { return inputs.back(); }
    std::size_t count() const noexcept { return inputs.back() + flat->values.size(); }

private:
    const Flat* flat;
    std::vector<std::size_t> inputs;   // first slot of each node, then the end
};

/// Number of a component among the slots of its port.
inline int slotWithin (const PortRef& r, int component, int width) noexcept { return std::max (r.index, 0) * width + std::max (component, 0); }

}   // namespace tactus::plan
