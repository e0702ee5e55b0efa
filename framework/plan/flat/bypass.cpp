// SPDX-License-Identifier: MIT
#include "bypass.hpp"

#include <cstring>
#include <vector>

namespace tactus::plan
{

namespace
{
/// The sources that are summed to one component of the value that a bypassed input passes on. The sources of the input begin at
/// `first`.
std::vector<std::size_t> passedOn (const FlatNode& n, const PortSheet& in, int component, std::size_t first, const std::function<bool (std::size_t)>& is_driven)
{
    std::vector<std::size_t> passed;
    for (int k = component; k < n.slots (in); k += in.width)
        if (! in.list || is_driven (first + at (k))) passed.push_back (first + at (k));
    return passed;
}
}   // namespace

Bypass bypassOf (const FlatNode& n, std::byte* outputs, const std::function<bool (std::size_t)>& is_driven)
{
    Bypass bypass;
    std::memset (outputs, 0, n.type->outputs_size);
    for (const auto& out : n.type->outputs)
    {
        auto* to = reinterpret_cast<double*> (outputs + out.offset);
        std::size_t first = 0;
        for (const auto& in : n.type->inputs)
        {
            if (in.width == out.width && ! out.list && (in.id == out.id || (in.id == "in" && out.id == "out")))
                for (int c = 0; c < out.width; ++c)
                    bypass.copies.push_back ({ to + c, passedOn (n, in, c, first, is_driven) });
            first += at (n.slots (in));
        }
        const bool is_factor =
            out.width == 1 && out.unit.kind == UnitRule::Kind::fixed && out.unit.unit.quantity == Quantity::gain;   // a vector is a direction, not a factor
        if (is_factor) *to = 1.0;
    }
    return bypass;
}

}   // namespace tactus::plan
