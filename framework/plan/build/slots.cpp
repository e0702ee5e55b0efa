// SPDX-License-Identifier: MIT
#include "slots.hpp"

namespace tactus::plan
{

Slots::Slots (const Flat& f) : flat (&f)
{
    inputs.reserve (f.nodes.size());
    for (const auto& n : f.nodes)
    {
        inputs.push_back (input_count);
        input_count += inputsOf (n);
    }
}

Slots::Slots (const Flat& f, std::span<const int> order) : flat (&f), inputs (f.nodes.size())
{
    for (const int n : order)
    {
        inputs[at (n)] = input_count;
        input_count += inputsOf (f.node (n));
    }
}

std::size_t Slots::inputsOf (const FlatNode& n) noexcept
{
    std::size_t count = 0;
    for (const auto& row : n.type->inputs)
        count += at (n.slots (row));
    return count;
}

std::size_t Slots::operator() (const PortRef& r, int component) const noexcept
{
    const auto& n = flat->node (r);
    const auto& rows = n.ports (r.role);
    auto slot = r.role == Role::input ? firstInput (r.node) : firstParam (r.node);
    for (int p = 0; p < r.port; ++p)
        slot += at (n.slots (rows[at (p)]));
    return slot + at (slotWithin (r, component, rows[at (r.port)].width));
}

}   // namespace tactus::plan
