// SPDX-License-Identifier: MIT
#include "plan_addresses.hpp"

#include <iterator>

namespace tactus::host
{

namespace
{
const std::byte* bytes (const void* p) { return static_cast<const std::byte*> (p); }
}   // namespace

PlanAddresses::PlanAddresses (const Plan& p) : plan (p)
{
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& type = *plan.flat().nodes[i].type;
        const auto& instance = plan.instances()[i];
        if (type.outputs_size > 0) outputs.emplace (bytes (instance.outputs), i);
        if (instance.node && type.params_size > 0) params.emplace (bytes (type.paramsOf (instance.node.get())), i);
    }
}

std::optional<PlanAddresses::Found> PlanAddresses::find (const double* value, const Starts& starts, std::vector<PortSheet> NodeType::*rows,
                                                         std::size_t NodeType::*size) const
{
    const auto next = starts.upper_bound (bytes (value));
    if (next == starts.begin()) return std::nullopt;
    const auto [start, instance] = *std::prev (next);
    const auto& type = *plan.flat().nodes[instance].type;
    const auto offset = static_cast<std::size_t> (bytes (value) - start);
    if (offset >= type.*size) return std::nullopt;
    for (const auto& row : type.*rows)
    {
        const auto end = row.offset + sizeof (double) * at (row.list ? list_capacity * row.width : row.width);
        if (row.choices.empty() && offset >= row.offset && offset < end)
            return Found { instance, &row, static_cast<int> ((offset - row.offset) / sizeof (double)) };
    }
    return std::nullopt;
}

std::optional<PlanAddresses::Found> PlanAddresses::outputAt (const double* value) const
{
    return find (value, outputs, &NodeType::outputs, &NodeType::outputs_size);
}

std::optional<PlanAddresses::Found> PlanAddresses::paramAt (const double* value) const
{
    return find (value, params, &NodeType::params, &NodeType::params_size);
}

}   // namespace tactus::host
