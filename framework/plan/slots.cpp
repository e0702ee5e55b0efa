// SPDX-License-Identifier: MIT
#include "slots.hpp"

namespace tactus::plan
{

Slots::Slots (const Flat& f) : flat (&f)
{
    inputs.reserve (f.nodes.size() + 1);
    std::size_t next = 0;
    for (const auto& n : f.nodes)
    {
        inputs.push_back (next);
        for (const auto& row : n.type->inputs)
            next += at (n.slots (row));
    }
    inputs.push_back (next);
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
