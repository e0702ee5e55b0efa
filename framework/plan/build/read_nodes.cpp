// SPDX-License-Identifier: MIT
#include "read_nodes.hpp"

namespace tactus::plan
{

std::vector<bool> readNodes (const Flat& flat, const Outside& outside)
{
    std::vector<bool> all (flat.nodes.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = flat.nodes[i].section != 0;
    for (const auto& w : flat.wires)
        if (w.from) all[static_cast<std::size_t> (w.from->node)] = true;
    for (const auto& read : outside.records)
        if (read.port && read.port->role == Role::output) all[static_cast<std::size_t> (read.port->node)] = true;
    return all;
}

}   // namespace tactus::plan
