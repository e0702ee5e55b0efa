// SPDX-License-Identifier: MIT
#include "inside.hpp"

namespace tactus::graph
{

Inside insideOf (const Graph& owner, const Node& node)
{
    if (node.type.starts_with ("graph:"))
    {
        const auto* patch = owner.find (std::string_view (node.type).substr (6));
        return patch == nullptr ? Inside {} : Inside { &owner, patch };
    }
    const auto file = node.type.starts_with ("file:") ? owner.files.find (node.type.substr (5)) : owner.files.end();
    return file == owner.files.end() ? Inside {} : Inside { file->second.get(), &file->second->root };
}

}   // namespace tactus::graph
