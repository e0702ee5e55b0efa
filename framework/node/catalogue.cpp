// SPDX-License-Identifier: MIT
#include "catalogue.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace tactus
{

namespace
{
const NodeLibrary*& newest() noexcept
{
    static const NodeLibrary* library = nullptr;   // in a function, because libraries register before main, in no fixed order
    return library;
}
}   // namespace

NodeLibrary::NodeLibrary (Types t) noexcept : types (t), next (newest()) { newest() = this; }

std::vector<NodeType> NodeLibrary::all()
{
    std::vector<NodeType> all;
    for (const auto* library = newest(); library != nullptr; library = library->next)
        std::ranges::move (library->types(), std::back_inserter (all));
    return all;
}

Catalogue::Catalogue (std::vector<NodeType> all, std::vector<NodeType> more) : types (std::move (all))
{
    std::ranges::move (more, std::back_inserter (types));
    const auto id = [] (const NodeType& t) { return t.info.id; };
    std::ranges::sort (types, {}, id);
    if (const auto twice = std::ranges::adjacent_find (types, {}, id); twice != types.end())
        throw std::invalid_argument ("two nodes have the id " + std::string (twice->info.id));
}

const NodeType* Catalogue::find (std::string_view id) const noexcept
{
    const auto at = std::ranges::lower_bound (types, id, {}, [] (const NodeType& t) { return t.info.id; });
    return at != types.end() && at->info.id == id ? &*at : nullptr;
}

}   // namespace tactus
