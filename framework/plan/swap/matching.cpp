// SPDX-License-Identifier: MIT
#include "matching.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <unordered_set>

namespace tactus::plan
{

namespace
{
/// The subgraph nodes that enclose a node or wire, outermost first, then the node or wire itself.
using Chain = std::vector<graph::Ancestor>;

/// Identifies a wire that is one of several between instances: by its chain or identity (Name), and by the nodes at its ends.
template <typename Name>
struct Key
{
    Name name;
    std::pair<int, int> ends;

    bool operator== (const Key&) const = default;
};

struct Hash
{
    static std::size_t mixed (std::size_t h, std::uint64_t v) noexcept
    {
        h = (h ^ static_cast<std::size_t> (v)) * 0x9e3779b97f4a7c15ull;
        return h ^ (h >> 32);
    }
    static std::size_t mixed (std::size_t h, int v) noexcept { return mixed (h, static_cast<std::uint64_t> (v)); }

    std::size_t operator() (const graph::Ancestor& a) const noexcept { return mixed (a.id, a.instance); }
    std::size_t operator() (const Identity& i) const noexcept { return mixed (mixed (static_cast<std::size_t> (i.scope), i.id), i.instance); }
    std::size_t operator() (const Chain& chain) const noexcept
    {
        std::size_t h = 0;
        for (const auto& a : chain)
            h = mixed (h, (*this) (a));
        return h;
    }
    template <typename Name>
    std::size_t operator() (const Key<Name>& k) const noexcept
    {
        return mixed (mixed ((*this) (k.name), k.ends.first), k.ends.second);
    }
};

/// A node or wire without a match so far.
struct One
{
    int number;
    Identity identity;
    std::pair<int, int> ends;   ///< for a wire: numbers of the nodes at its ends, in the previous graph
};
using Unmatched = std::vector<One>;

/// Matches items with the same key, if the key is unique on both sides.
template <typename Key, typename KeyNow, typename KeyBefore>
void pair (Unmatched& now, Unmatched& before, std::vector<int>& found, KeyNow keyNow, KeyBefore keyBefore)
{
    constexpr int several = -2;
    const auto list = [] (const Unmatched& rest, auto key) {
        std::unordered_map<Key, int, Hash> by_key;
        by_key.reserve (rest.size());
        for (const auto& x : rest)
            if (const auto [entry, fresh] = by_key.try_emplace (key (x), x.number); ! fresh) entry->second = several;
        return by_key;
    };
    const auto here = list (now, keyNow);
    auto there = list (before, keyBefore);
    Unmatched left;
    std::unordered_set<int> taken;
    for (const auto& x : now)
    {
        const auto key = keyNow (x);
        const auto other = there.find (key);
        if (other == there.end() || other->second == several || here.at (key) == several)
        {
            left.push_back (x);
            continue;
        }
        found[at (x.number)] = other->second;
        taken.insert (other->second);
    }
    now = std::move (left);
    std::erase_if (before, [&] (const One& x) { return taken.contains (x.number); });
}

/// Chains in which copies are replaced by their originals.
class Origins
{
public:
    Origins (const Flat& a, const Flat& b) : flats { &a, &b } {}

    Chain chainOf (const Flat& flat, Identity i) const
    {
        Chain chain;   // innermost first
        for (;; i = flat.scopes[at (i.scope)])
        {
            const auto* origin = originOf (i.id);
            if (origin && (i.instance == 0 || origin->back().instance == 0))
            {
                chain.push_back ({ origin->back().id, origin->back().instance + i.instance });
                chain.insert (chain.end(), origin->rbegin() + 1, origin->rend());
            }
            else
                chain.push_back ({ i.id, i.instance });
            if (i.scope == 0) break;
        }
        std::ranges::reverse (chain);
        return chain;
    }

private:
    const std::vector<graph::Ancestor>* originOf (graph::Id id) const
    {
        for (const auto* flat : flats)
            if (const auto copy = flat->origins.find (id); copy != flat->origins.end()) return &copy->second;
        return nullptr;
    }

    const Flat* flats[2];
};

/// For each scope: the previous scope with the same enclosing subgraph nodes, or -2 if there is none.
std::vector<int> scopesBefore (const Flat& now, const Flat& before)
{
    constexpr int no_scope = -2;
    std::unordered_map<Identity, int, Hash> numbers;
    for (std::size_t i = 0; i < before.scopes.size(); ++i)
        numbers.emplace (before.scopes[i], static_cast<int> (i));
    std::vector<int> all;
    for (const auto& [around, id, instance] : now.scopes)
    {
        const auto known = numbers.find ({ around < 0 ? around : all[at (around)], id, instance });
        all.push_back (known == numbers.end() ? no_scope : known->second);
    }
    return all;
}

/// For each node or wire: the number of its match in the previous graph, or -1.
std::vector<int> match (Unmatched here, Unmatched there, const Flat& now, const Flat& before, const std::vector<int>& scopes, std::size_t size)
{
    std::vector<int> found (size, -1);
    const auto by = [&]<typename Name> (Name*, auto nameNow, auto nameBefore) {
        const auto alone = [] (auto nameOf) { return [nameOf] (const One& x) { return nameOf (x.identity); }; };
        const auto withEnds = [] (auto nameOf) { return [nameOf] (const One& x) { return Key<Name> { nameOf (x.identity), x.ends }; }; };
        if (! here.empty() && ! there.empty()) pair<Name> (here, there, found, alone (nameNow), alone (nameBefore));
        if (! here.empty() && ! there.empty()) pair<Key<Name>> (here, there, found, withEnds (nameNow), withEnds (nameBefore));
    };

    by (
        static_cast<Identity*> (nullptr), [&] (const Identity& i) { return Identity { scopes[at (i.scope)], i.id, i.instance }; },
        [] (const Identity& i) { return i; });
    if (here.empty() || there.empty()) return found;

    const Origins origins { now, before };
    const auto chains = [&] (const Flat& flat, auto shorten) {
        return [&, shorten] (const Identity& i) { return shorten (origins.chainOf (flat, i)); };
    };
    const auto byChain = [&] (auto shorten) { by (static_cast<Chain*> (nullptr), chains (now, shorten), chains (before, shorten)); };

    const auto unchanged = [] (Chain c) { return c; };
    byChain (unchanged);
    if (here.empty() || there.empty()) return found;

    // By the last link of a chain: all links of the chains that end in that link, in this graph and in the previous one.
    std::unordered_map<graph::Ancestor, std::unordered_set<graph::Ancestor, Hash>, Hash> around, around_before;
    const auto note = [] (const Unmatched& rest, auto chainOf, auto& all) {
        for (const auto& x : rest)
        {
            const auto chain = chainOf (x.identity);
            all[chain.back()].insert (chain.begin(), chain.end());
        }
    };
    note (here, chains (now, unchanged), around);
    note (there, chains (before, unchanged), around_before);
    byChain ([&] (Chain c) {
        const auto end = c.back();
        const auto a = around.find (end), b = around_before.find (end);
        if (a == around.end() || b == around_before.end()) return c;
        std::erase_if (c, [&] (const graph::Ancestor& x) { return ! a->second.contains (x) || ! b->second.contains (x); });
        return c;
    });
    byChain ([] (const Chain& c) { return Chain { c.back() }; });
    return found;
}

std::vector<int> matchNodes (const Flat& now, const Flat& before, const std::vector<int>& scopes)
{
    const auto all = [] (const Flat& flat) {
        Unmatched unmatched;
        for (std::size_t i = 0; i < flat.nodes.size(); ++i)
            unmatched.push_back ({ static_cast<int> (i), flat.nodes[i].identity, {} });
        return unmatched;
    };
    return match (all (now), all (before), now, before, scopes, now.nodes.size());
}

std::vector<int> matchWires (const Flat& now, const Flat& before, const std::vector<int>& scopes, const std::vector<int>& nodes)
{
    constexpr int new_node = -2;
    const auto all = [] (const Flat& flat, auto numberOf) {
        Unmatched unmatched;
        for (std::size_t i = 0; i < flat.wires.size(); ++i)
            if (const auto& w = flat.wires[i]; w.delay > 0 || w.crosses)
                unmatched.push_back ({ static_cast<int> (i), w.identity, { w.from ? numberOf (w.from->node) : -1, numberOf (w.to.node) } });
        return unmatched;
    };
    const auto numberBefore = [&] (int node) { return nodes[at (node)] >= 0 ? nodes[at (node)] : new_node; };
    return match (all (now, numberBefore), all (before, std::identity()), now, before, scopes, now.wires.size());
}
}   // namespace

Matching matchGraphs (const Flat& now, const Flat& before)
{
    const auto scopes = scopesBefore (now, before);
    auto nodes = matchNodes (now, before, scopes);
    auto wires = matchWires (now, before, scopes, nodes);
    return { std::move (nodes), std::move (wires) };
}

}   // namespace tactus::plan
