// SPDX-License-Identifier: MIT
#include "ramps.hpp"

#include <tactus/kit/state_archive.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace tactus::plan
{

KnobIndex::KnobIndex (const std::vector<Instance>& instances)
{
    const auto before = [] (const Entry& e, const KnobBoard* b) { return std::less<const KnobBoard*> {}(e.board.get(), b); };
    for (std::uint32_t i = 0; const auto& instance : instances)
    {
        if (const auto* knobs = instance.knobs.get())
        {
            const auto* board = knobs->board.get();
            auto entry = ! all.empty() && all.back().board.get() == board ? std::prev (all.end()) : std::lower_bound (all.begin(), all.end(), board, before);
            if (entry == all.end() || entry->board.get() != board) entry = all.insert (entry, { knobs->board, std::vector (board->size(), none) });
            entry->nodes[knobs->place] = i;
        }
        ++i;
    }
}

std::uint32_t KnobIndex::operator[] (const Knobs& knobs) const noexcept
{
    const auto entry = std::ranges::lower_bound (all, knobs.board.get(), std::less<const KnobBoard*> {}, [] (const Entry& e) { return e.board.get(); });
    return entry != all.end() && entry->board == knobs.board ? entry->nodes[knobs.place] : none;
}

void Ramps::prepare (const std::vector<Instance>& all, std::shared_ptr<const KnobIndex> i, double rate_hz)
{
    instances = &all;
    index = std::move (i);
    moving.reserve (all.size());
    ticks = std::max (1, static_cast<int> (std::lround (ramp_s * rate_hz)));
}

void Ramps::poll (Journal* journal) noexcept
{
    if (index == nullptr) return;
    for (const auto& [board, all] : index->boards())
    {
        const auto& nodes = all;   // before version 16, clang cannot capture structured bindings
        board->take ([&] (std::uint32_t place) { return nodes[place] != KnobIndex::none; }, [&] (std::uint32_t place) { turn (nodes[place], journal); });
    }
}

void Ramps::turn (std::size_t i, Journal* journal) noexcept
{
    const auto& instance = (*instances)[i];
    auto& knobs = *instance.knobs;
    for (std::size_t k = 0; k < knobs.all.size(); ++k)
    {
        auto& knob = knobs.all[k];
        const auto turns = knob.turns.load (std::memory_order_acquire);
        if (turns == knob.heeded) continue;
        knob.heeded = turns;
        const double target = knob.target.load (std::memory_order_relaxed);
        head (i, k, target);
        if (journal) journal->turned (i, k, target);
    }
    strike (i, instance, journal);
}

/// A hit on a node that does not run is dropped.
void Ramps::strike (std::size_t i, const Instance& instance, Journal* journal) noexcept
{
    auto& pulses = instance.knobs->pulses;
    for (std::size_t p = 0; p < pulses.size(); ++p)
    {
        if (pulses[p].asked.load (std::memory_order_relaxed) == 0.0) continue;
        const double speed = pulses[p].asked.exchange (0.0, std::memory_order_acquire);
        if (! instance.is_struck) continue;
        pulses[p].pending += speed;
        if (journal) journal->struck (i, p, speed);
    }
}

void Ramps::goOn (const Ramps& before) noexcept
{
    for (const auto old : before.moving)
        if (const auto i = (*index)[*(*before.instances)[old].knobs]; i != KnobIndex::none) moving.push_back (i);
}

void Ramps::inherit (std::size_t i, const Knobs& old) noexcept
{
    auto& knobs = *(*instances)[i].knobs;
    knobs.continues = old.hasStarted();
    knobs.ramping = old.ramping;
    if (knobs.ramping) moving.push_back (static_cast<std::uint32_t> (i));
}

void Ramps::head (std::size_t i, std::size_t k, double to, bool at_once) noexcept
{
    const auto& instance = (*instances)[i];
    auto& knobs = *instance.knobs;
    auto& knob = knobs.all[k];
    knob.to = to;
    if (at_once || ! knobs.hasStarted() || (! instance.isDriven (k) && jumps (knobs.type, k, knob.value, to)))
    {
        knob.left = 0;
        knob.value = to;
        has_written = true;
        if (instance.isDriven (k)) return;
        instance.write (k, to);
        if (knobs.type.update) knobs.type.update (instance.node.get());
        return;
    }
    knob.left = ticks;
    if (knobs.ramping) return;
    knobs.ramping = true;
    moving.push_back (static_cast<std::uint32_t> (i));
}

void Ramps::move() noexcept
{
    has_written = true;
    for (std::size_t m = 0; m < moving.size();)
    {
        const auto& instance = (*instances)[moving[m]];
        auto& knobs = *instance.knobs;
        bool more = false, moved = false;
        for (std::size_t k = 0; k < knobs.all.size(); ++k)
        {
            auto& knob = knobs.all[k];
            if (knob.left == 0) continue;
            knob.value = knob.left == 1 ? knob.to : knob.value + (knob.to - knob.value) / knob.left;
            more = --knob.left > 0 || more;
            if (instance.isDriven (k)) continue;
            instance.write (k, knob.value);
            moved = true;
        }
        if (moved && knobs.type.update) knobs.type.update (instance.node.get());
        if (more)
            ++m;
        else
        {
            knobs.ramping = false;
            moving[m] = moving.back();
            moving.pop_back();
        }
    }
}

void Ramps::serialize (StateArchive& archive)
{
    if (index == nullptr) return;
    bool started = std::ranges::all_of (index->boards(), [] (const auto& entry) { return entry.board->started; });
    archive (started);
    if (! archive.restores()) return;
    for (const auto& entry : index->boards())
        entry.board->started = started;
    moving.clear();
    for (std::uint32_t i = 0; i < instances->size(); ++i)
        if (auto* knobs = (*instances)[i].knobs.get())
        {
            knobs->ramping = false;
            for (std::size_t k = 0; k < knobs->all.size(); ++k)
                knobs->ramping = knobs->ramping || knobs->all[k].left > 0;
            if (knobs->ramping) moving.push_back (i);
        }
    has_written = true;
}

void Ramps::startAll() noexcept
{
    if (index == nullptr) return;
    for (const auto& entry : index->boards())
        entry.board->started = true;
}

}   // namespace tactus::plan
