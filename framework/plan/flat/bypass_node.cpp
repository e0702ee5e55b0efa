// SPDX-License-Identifier: MIT
#include "bypass_node.hpp"
#include <tactus/plan/values.hpp>

#include <algorithm>

namespace tactus::plan
{

void addBypassNode (const Scope& scope, const graph::Node& node, Origin here, bool muted, Scope& inside, int instance, Flat& flat)
{
    NodeType type {};
    type.info = { .id = "subgraph", .name = "Bypassed subgraph", .summary = "", .source = "" };
    std::size_t offset = 0;
    int list_size = 0;
    for (const auto& x : inside.exposed)
    {
        if (x.to.empty()) continue;
        const auto& to = x.to.front();
        auto row = flat.sheet (to);
        row.role = x.role;
        row.id = flat.made_names.emplace_back (x.name);
        if (row.unit.kind != UnitRule::Kind::fixed) row.unit = each_its_unit;
        row.width = flat.widthOf (to);
        row.list = row.list && to.index < 0;
        if (row.list) list_size = std::max (list_size, flat.node (to).list_size);
        if (x.role == Role::output)
        {
            row.offset = offset;
            offset += sizeof (double) * at (row.list ? list_capacity : row.width);
        }
        auto& params_or_outputs = x.role == Role::param ? type.params : type.outputs;
        (x.role == Role::input ? type.inputs : params_or_outputs).push_back (row);
    }
    type.outputs_size = std::max (offset, sizeof (double));
    type.outputs_align = alignof (double);
    flat.made_types.push_back (std::move (type));

    inside.stand_in = flat.nodeCount();
    auto& made = flat.nodes.emplace_back (FlatNode { .path = inside.prefix.substr (0, inside.prefix.size() - 1),
                                                     .identity = { scope.number, node.id, instance },
                                                     .type = &flat.made_types.back(),
                                                     .origin = here,
                                                     .bypass = true,
                                                     .muted = muted,
                                                     .section = scope.section });
    made.list_size = list_size;
    addValues (made, flat);
}

}   // namespace tactus::plan
