// SPDX-License-Identifier: MIT
#include "heirs.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <unordered_set>

namespace tactus::plan
{

namespace
{
struct Hash
{
    std::size_t operator() (const Chain& chain) const noexcept
    {
        std::size_t h = 0;
        for (const auto id : chain)
            h = (h ^ static_cast<std::size_t> (id)) * 0x9e3779b97f4a7c15ull;
        return h ^ (h >> 32);
    }
};

using Chains = std::vector<const Chain*>;   ///< null: takes no part, or has found its like

/// Pairs up what has the same key, where that is the only one of its side to have it.
template <typename Key>
void pair (Chains& now, Chains& before, std::vector<int>& found, Key key)
{
    constexpr int several = -2;
    std::unordered_map<Chain, int, Hash> here, there;
    const auto list = [&] (const Chains& chains, auto& by_key)
    {
        for (std::size_t i = 0; i < chains.size(); ++i)
            if (chains[i])
            {
                const auto [entry, fresh] = by_key.try_emplace (key (*chains[i]), static_cast<int> (i));
                if (! fresh) entry->second = several;
            }
    };
    list (now, here);
    list (before, there);
    for (const auto& [k, i] : here)
    {
        const auto other = there.find (k);
        if (i == several || other == there.end() || other->second == several) continue;
        found[static_cast<std::size_t> (i)] = other->second;
        now[static_cast<std::size_t> (i)] = before[static_cast<std::size_t> (other->second)] = nullptr;
    }
}

std::unordered_set<graph::Id> idsOf (const Flat& flat)
{
    std::unordered_set<graph::Id> ids;
    for (const auto& n : flat.nodes)
        ids.insert (n.chain.begin(), n.chain.end());
    for (const auto& w : flat.wires)
        ids.insert (w.chain.begin(), w.chain.end());
    return ids;
}

bool anyLeft (const Chains& chains)
{
    return std::ranges::any_of (chains, [] (const Chain* c)
                                { return c != nullptr; });
}

template <typename List, typename Takes>
std::vector<int> match (const Flat& now, const Flat& before, List Flat::*list, Takes takes)
{
    const auto chainsOf = [&] (const Flat& flat)
    {
        Chains chains;
        chains.reserve ((flat.*list).size());
        for (const auto& x : flat.*list)
            chains.push_back (takes (x) ? &x.chain : nullptr);
        return chains;
    };
    auto here = chainsOf (now), there = chainsOf (before);
    std::vector<int> found (here.size(), -1);

    pair (here, there, found, [] (const Chain& c) -> const Chain&
          { return c; });
    if (! anyLeft (here) || ! anyLeft (there)) return found;

    const auto ids = idsOf (now), ids_before = idsOf (before);
    const auto inBoth = [&] (graph::Id id)
    { return ids.contains (id) && ids_before.contains (id); };
    pair (here, there, found, [&] (const Chain& c)
          {
              if (! inBoth (c.back())) return c;
              Chain common;
              std::ranges::copy_if (c, std::back_inserter (common), inBoth);
              return common; });
    pair (here, there, found, [] (const Chain& c)
          { return Chain { c.back() }; });
    return found;
}
}   // namespace

Heirs findHeirs (const Flat& now, const Flat& before)
{
    return { match (now, before, &Flat::nodes, [] (const FlatNode&)
                    { return true; }),
             match (now, before, &Flat::wires, [] (const FlatWire& w)
                    { return w.delay > 0; }) };
}

}   // namespace tactus::plan
