// SPDX-License-Identifier: MIT
#include "players.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::check
{

namespace
{
/// By node: true if a device reaches it, by more than hits.
std::vector<bool> followers (const plan::Flat& flat)
{
    std::vector<bool> follows (flat.nodes.size(), false), is_struck (flat.nodes.size(), false);
    for (std::size_t n = 0; n < follows.size(); ++n)
    {
        follows[n] = flat.nodes[n].type->bind != nullptr;
        is_struck[n] = isStruck (flat, static_cast<int> (n));
    }
    for (bool changes = true; changes;)
    {
        changes = false;
        for (const auto& w : flat.wires)
            if (w.from && follows[at (w.from->node)] && ! follows[at (w.to.node)] && (w.to.role == Role::param || ! is_struck[at (w.to.node)]))
                follows[at (w.to.node)] = changes = true;
    }
    return follows;
}

/// By node: true if a device reaches it by wires to its params, as an envelope of the contact that turns a clip up, but not by its inputs.
std::vector<bool> modulated (const plan::Flat& flat, const std::vector<bool>& follows)
{
    std::vector<bool> is_modulated = follows;
    for (std::size_t n = 0; n < follows.size(); ++n)
        if (flat.nodes[n].type->bind != nullptr) is_modulated[n] = false;
    for (const auto& w : flat.wires)
        if (w.from && follows[at (w.from->node)] && w.to.role == Role::input && ! isStruck (flat, w.to.node)) is_modulated[at (w.to.node)] = false;
    return is_modulated;
}

/// A node that a device reaches by its params only, while the hands stay where they are. It plays by itself if its outputs still change then.
struct HeldWatch
{
    std::size_t node;
    std::vector<const double*> outputs;
    double largest = 0.0;
    std::vector<double> low {}, high {};   // late

    void poll (bool is_late)
    {
        for (const auto* v : outputs)
            largest = std::max (largest, std::abs (*v));
        if (! is_late) return;
        low.resize (outputs.size(), inf);
        high.resize (outputs.size(), -inf);
        for (std::size_t i = 0; i < outputs.size(); ++i)
        {
            low[i] = std::min (low[i], *outputs[i]);
            high[i] = std::max (high[i], *outputs[i]);
        }
    }

    bool plays() const
    {
        constexpr double settled = 1e-3;   // part of the largest value: an envelope or a speed need not have come to its end
        for (std::size_t i = 0; i < low.size(); ++i)
            if (high[i] - low[i] > settled * largest) return true;
        return false;
    }
};

/// The same motion until the largest force in its first half; there, the hands stay.
HandMotion held (HandMotion motion, const Forces& forces)
{
    std::size_t place = 0;
    double most = 0.0;
    for (std::size_t k = 0; 2 * k < motion.ticks; ++k)
    {
        double sum = 0.0;
        for (const auto& of_role : forces)
            sum += of_role[k].norm();
        if (sum > most) most = sum, place = k;
    }
    for (auto& r : motion.roles)
        for (std::size_t k = place + 1; k < r.readings.size(); ++k)
            r.readings[k] = r.readings[place];
    return motion;
}

/// The values of all outputs of a node but lists.
std::vector<const double*> outputsOf (const Plan& plan, std::size_t node)
{
    std::vector<const double*> all;
    const auto& instance = plan.instances()[node];
    if (instance.outputs == nullptr) return all;
    for (const auto& row : plan.flat().nodes[node].type->outputs)
        for (int i = 0; i < row.width && ! row.list; ++i)
            all.push_back (instance.output (row.offset + sizeof (double) * at (i)));
    return all;
}
}   // namespace

bool isStruck (const plan::Flat& flat, int n)
{
    const auto& inputs = flat.node (n).type->inputs;
    const auto isFollowed = [&] (const plan::FlatWire& w) { return w.to.node == n && w.to.role == Role::input && ! plan::takesHits (inputs[at (w.to.port)]); };
    return flat.node (n).runs() && std::ranges::any_of (inputs, plan::takesHits) && std::ranges::none_of (flat.wires, isFollowed);
}

std::vector<std::size_t> strikers (const plan::Flat& flat)
{
    const auto follows = followers (flat);
    std::vector<std::size_t> all;
    for (const auto& w : flat.wires)
        if (w.from && follows[at (w.from->node)] && w.to.role == Role::input && isStruck (flat, w.to.node)) all.push_back (at (w.from->node));
    return all;
}

void PlayerSearch::begin (const Plan& running)
{
    const auto& flat = running.flat();
    const auto follows = followers (flat);
    for (std::size_t n = 0; n < follows.size(); ++n)
        if (! follows[n] && flat.nodes[n].runs())
            if (auto outputs = outputsOf (running, n); ! outputs.empty()) free.push_back ({ .node = n, .outputs = std::move (outputs) });
}

void PlayerSearch::poll (const Plan& running)
{
    if (tick == 0) begin (running);
    for (auto& node : free)
        node.poll (2 * tick >= ticks);
    if (++tick < ticks) return;
    for (const auto& node : free)
        if (node.hasPlayed()) found_nodes.push_back (node.node);
}

void PlayerSearch::Free::poll (bool is_second_half)
{
    if (plays) return;
    auto& before = is_second_half ? middle : first;
    for (std::size_t i = 0; i < before.size(); ++i)
        if (*outputs[i] != before[i]) (is_second_half ? plays : changes) = true;
    if (before.empty())
        for (const auto* v : outputs)
            before.push_back (*v);
}

bool PlayerSearch::Free::hasPlayed() const
{
    return plays || (changes && std::ranges::all_of (outputs, [] (const double* v) { return *v == 0.0; }));
}

std::vector<std::size_t> modulatedPlayers (const Subject& subject, const plan::Flat& flat, const HandMotion& motion, const Forces& forces)
{
    const auto is_modulated = modulated (flat, followers (flat));
    std::vector<std::size_t> players;
    if (std::ranges::count (is_modulated, true) == 0) return players;
    std::vector<HeldWatch> watches;
    std::size_t tick = 0;
    forcesAlong (subject, held (motion, forces), strikers (flat), [&] (const Plan& running) {
        for (std::size_t n = 0; n < is_modulated.size() && tick == 0; ++n)
            if (is_modulated[n] && running.flat().nodes[n].runs()) watches.push_back ({ .node = n, .outputs = outputsOf (running, n) });
        for (auto& w : watches)
            w.poll (4 * tick >= 3 * motion.ticks);
        ++tick;
    });
    for (const auto& w : watches)
        if (w.plays()) players.push_back (w.node);
    return players;
}

}   // namespace tactus::check
