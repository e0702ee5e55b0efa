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

namespace
{
std::string_view idOf (const std::shared_ptr<const NodeType>& type) noexcept { return type->info.id; }
}   // namespace

Catalogue::Catalogue (Types all)
{
    std::ranges::sort (all, {}, idOf);
    if (const auto twice = std::ranges::adjacent_find (all, {}, idOf); twice != all.end())
        throw std::invalid_argument ("two nodes have the id " + std::string (idOf (*twice)));
    types = std::make_shared<const Types> (std::move (all));
}

Catalogue::Catalogue (std::vector<NodeType> all, std::vector<NodeType> more)
{
    Types shared;
    for (auto* list : { &all, &more })
        for (auto& type : *list)
            shared.push_back (std::make_shared<const NodeType> (std::move (type)));
    *this = Catalogue { std::move (shared) };
}

Catalogue Catalogue::with (std::vector<NodeType> more) const
{
    Types all = types ? *types : Types {};
    for (auto& type : more)
    {
        std::erase_if (all, [&] (const auto& old) { return old->info.id == type.info.id; });
        all.push_back (std::make_shared<const NodeType> (std::move (type)));
    }
    return Catalogue { std::move (all) };
}

const NodeType* Catalogue::find (std::string_view id) const noexcept
{
    if (! types) return nullptr;
    const auto at = std::ranges::lower_bound (*types, id, {}, idOf);
    return at != types->end() && idOf (*at) == id ? at->get() : nullptr;
}

}   // namespace tactus
