// SPDX-License-Identifier: MIT
#include "make_node.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace tactus::plan
{

std::shared_ptr<void> makeNode (const Flat& flat, int number)
{
    const auto& n = flat.node (number);
    if (! n.type->make) return nullptr;
    auto node = n.type->make();
    for (std::size_t p = 0; p < n.type->params.size(); ++p)
    {
        const auto values = flat.param (number, p);
        auto* target = static_cast<std::byte*> (n.type->paramsOf (node.get())) + n.type->params[p].offset;
        if (n.type->params[p].choices.empty())
            std::ranges::copy (values, reinterpret_cast<double*> (target));
        else
        {
            const int chosen = static_cast<int> (values[0]);
            std::memcpy (target, &chosen, sizeof chosen);
        }
    }
    for (std::size_t i = 0; i < n.settings.size(); ++i)
        n.type->settings[i].set (node.get(), n.settings[i]);
    return node;
}

}   // namespace tactus::plan
