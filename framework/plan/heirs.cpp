// SPDX-License-Identifier: MIT
#include "heirs.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

namespace tactus::plan
{

namespace
{
/// The ids of the subgraph nodes around something, the outermost first, then its own.
using Chain = std::vector<graph::Id>;

struct Hash
{
    static std::size_t mixed (std::size_t h, std::uint64_t v) noexcept
    {
        h = (h ^ static_cast<std::size_t> (v)) * 0x9e3779b97f4a7c15ull;
        return h ^ (h >> 32);
    }

    std::size_t operator() (const Identity& i) const noexcept { return mixed (static_cast<std::size_t> (i.scope), i.id); }
    std::size_t operator() (const Chain& chain) const noexcept
    {
        std::size_t h = 0;
        for (const auto id : chain)
            h = mixed (h, id);
        return h;
    }
};

/// What is still to be paired up: its number and identity.
using Rest = std::vector<std::pair<int, Identity>>;

/// Pairs up what has the same key, where that is the only one of its side to have it.
template <typename Key, typename KeyNow, typename KeyBefore>
void pair (Rest& now, Rest& before, std::vector<int>& found, KeyNow keyNow, KeyBefore keyBefore)
{
    constexpr int several = -2;
    const auto list = [] (const Rest& rest, auto key)
    {
        std::unordered_map<Key, int, Hash> by_key;
        by_key.reserve (rest.size());
        for (const auto& [number, identity] : rest)
            if (const auto [entry, fresh] = by_key.try_emplace (key (identity), number); ! fresh) entry->second = several;
        return by_key;
    };
    const auto here = list (now, keyNow);
    auto there = list (before, keyBefore);
    Rest left;
    std::unordered_set<int> taken;
    for (const auto& [number, identity] : now)
    {
        const auto key = keyNow (identity);
        const auto other = there.find (key);
        if (other == there.end() || other->second == several || here.at (key) == several)
        {
            left.emplace_back (number, identity);
            continue;
        }
        found[static_cast<std::size_t> (number)] = other->second;
        taken.insert (other->second);
    }
    now = std::move (left);
    std::erase_if (before, [&] (const auto& x)
                   { return taken.contains (x.first); });
}

/// Chains in terms of what copies were made from.
class Descent
{
public:
    Descent (const Flat& a, const Flat& b) : flats { &a, &b } {}

    Chain chainOf (const Flat& flat, Identity i) const
    {
        Chain chain;   // the innermost first
        for (;; i = flat.scopes[static_cast<std::size_t> (i.scope)])
        {
            if (const auto* origin = originOf (i.id))
                chain.insert (chain.end(), origin->rbegin(), origin->rend());
            else
                chain.push_back (i.id);
            if (i.scope == 0) break;
        }
        std::ranges::reverse (chain);
        return chain;
    }

private:
    const Chain* originOf (graph::Id id) const
    {
        for (const auto* flat : flats)
            if (const auto copy = flat->origins.find (id); copy != flat->origins.end()) return &copy->second;
        return nullptr;
    }

    const Flat* flats[2];
};

/// For each scope the one before with the same subgraph nodes around; or one that does not exist.
std::vector<int> scopesBefore (const Flat& now, const Flat& before)
{
    constexpr int none = -2;
    std::unordered_map<Identity, int, Hash> numbers;
    for (std::size_t i = 0; i < before.scopes.size(); ++i)
        numbers.emplace (before.scopes[i], static_cast<int> (i));
    std::vector<int> all;
    for (const auto& [around, id] : now.scopes)
    {
        const auto at = numbers.find ({ around < 0 ? around : all[static_cast<std::size_t> (around)], id });
        all.push_back (at == numbers.end() ? none : at->second);
    }
    return all;
}

template <typename List, typename Takes>
std::vector<int> match (const Flat& now, const Flat& before, const std::vector<int>& scopes, List Flat::*list, Takes takes)
{
    const auto all = [&] (const Flat& flat)
    {
        Rest rest;
        for (std::size_t i = 0; i < (flat.*list).size(); ++i)
            if (const auto& x = (flat.*list)[i]; takes (x)) rest.emplace_back (static_cast<int> (i), x.identity);
        return rest;
    };
    auto here = all (now), there = all (before);
    std::vector<int> found ((now.*list).size(), -1);

    pair<Identity> (
        here, there, found, [&] (const Identity& i)
        { return Identity { scopes[static_cast<std::size_t> (i.scope)], i.id }; },
        [] (const Identity& i)
        { return i; });
    if (here.empty() || there.empty()) return found;

    const Descent descent { now, before };
    const auto chains = [&] (const Flat& flat, auto shorten)
    {
        return [&, shorten] (const Identity& i)
        { return shorten (descent.chainOf (flat, i)); };
    };
    const auto by = [&] (auto shorten)
    { pair<Chain> (here, there, found, chains (now, shorten), chains (before, shorten)); };

    const auto as_it_is = [] (Chain c)
    { return c; };
    by (as_it_is);
    if (here.empty() || there.empty()) return found;

    // Of what stands at the end, the ids around it that either side has.
    std::unordered_map<graph::Id, std::unordered_set<graph::Id>> around, around_before;
    const auto note = [] (const Rest& rest, auto chainOf, auto& ids)
    {
        for (const auto& [number, identity] : rest)
        {
            const auto chain = chainOf (identity);
            ids[chain.back()].insert (chain.begin(), chain.end());
        }
    };
    note (here, chains (now, as_it_is), around);
    note (there, chains (before, as_it_is), around_before);
    by ([&] (Chain c)
        {
            const auto end = c.back();
            const auto a = around.find (end), b = around_before.find (end);
            if (a == around.end() || b == around_before.end()) return c;
            std::erase_if (c, [&] (graph::Id id)
                           { return ! a->second.contains (id) || ! b->second.contains (id); });
            return c; });
    by ([] (const Chain& c)
        { return Chain { c.back() }; });
    return found;
}
}   // namespace

Heirs findHeirs (const Flat& now, const Flat& before)
{
    const auto scopes = scopesBefore (now, before);
    return { match (now, before, scopes, &Flat::nodes, [] (const FlatNode&)
                    { return true; }),
             match (now, before, scopes, &Flat::wires, [] (const FlatWire& w)
                    { return w.delay > 0; }) };
}

}   // namespace tactus::plan
