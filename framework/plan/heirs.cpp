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

/// Chains in terms of what copies were made from.
class Descent
{
public:
    Descent (const Flat& a, const Flat& b) : flats { &a, &b } {}

    Chain operator() (const Chain& chain) const
    {
        Chain all;
        for (const auto id : chain)
            add (id, all);
        return all;
    }

private:
    void add (graph::Id id, Chain& to) const
    {
        for (const auto* flat : flats)
            if (const auto copy = flat->origins.find (id); copy != flat->origins.end())
            {
                for (const auto from : copy->second)
                    add (from, to);
                return;
            }
        to.push_back (id);
    }

    const Flat* flats[2];
};

std::unordered_set<graph::Id> idsOf (const Flat& flat, const Descent& descent)
{
    std::unordered_set<graph::Id> ids;
    const auto add = [&] (const Chain& chain)
    {
        const auto all = descent (chain);
        ids.insert (all.begin(), all.end());
    };
    for (const auto& n : flat.nodes)
        add (n.chain);
    for (const auto& w : flat.wires)
        add (w.chain);
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

    const Descent descent { now, before };
    pair (here, there, found, descent);
    if (! anyLeft (here) || ! anyLeft (there)) return found;

    const auto ids = idsOf (now, descent), ids_before = idsOf (before, descent);
    const auto inBoth = [&] (graph::Id id)
    { return ids.contains (id) && ids_before.contains (id); };
    pair (here, there, found, [&] (const Chain& c)
          {
              const auto all = descent (c);
              if (! inBoth (all.back())) return all;
              Chain common;
              std::ranges::copy_if (all, std::back_inserter (common), inBoth);
              return common; });
    pair (here, there, found, [&] (const Chain& c)
          { return Chain { descent (c).back() }; });
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
