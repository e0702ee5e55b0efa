// SPDX-License-Identifier: MIT
#include "catalogue.hpp"

#include <algorithm>

namespace tactus
{

Catalogue::Catalogue (std::vector<NodeType> all) : types (std::move (all))
{
    std::ranges::sort (types, {}, [] (const NodeType& t) { return t.info.id; });
}

const NodeType* Catalogue::find (std::string_view id) const noexcept
{
    const auto at = std::ranges::lower_bound (types, id, {}, [] (const NodeType& t) { return t.info.id; });
    return at != types.end() && at->info.id == id ? &*at : nullptr;
}

}   // namespace tactus
