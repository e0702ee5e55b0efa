// SPDX-License-Identifier: MIT
#include "ramps.hpp"

#include <cmath>

namespace tactus::plan
{

void Ramps::prepare (std::span<const Instance> all, double rate_hz)
{
    instances = all;
    moving.reserve (all.size());
    ticks = std::max (1, static_cast<int> (std::lround (ramp_s * rate_hz)));
}

void Ramps::look (Journal* journal) noexcept
{
    for (std::size_t i = 0; i < instances.size(); ++i)
    {
        auto* knobs = instances[i].knobs.get();
        if (knobs == nullptr || ! knobs->touched.load (std::memory_order_relaxed) || ! knobs->touched.exchange (false, std::memory_order_acquire)) continue;
        for (std::size_t k = 0; k < knobs->all.size(); ++k)
        {
            auto& knob = knobs->all[k];
            const auto turns = knob.turns.load (std::memory_order_acquire);
            if (turns == knob.heeded) continue;
            knob.heeded = turns;
            const double target = knob.target.load (std::memory_order_relaxed);
            head (i, k, target);
            if (journal) journal->turned (i, k, target);
        }
        strike (i, instances[i], journal);
    }
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

void Ramps::goOn() noexcept
{
    for (std::size_t i = 0; i < instances.size(); ++i)
        if (const auto* knobs = instances[i].knobs.get(); knobs != nullptr && knobs->ramping) moving.push_back (i);
}

void Ramps::head (std::size_t i, std::size_t k, double to, bool at_once) noexcept
{
    const auto& instance = instances[i];
    auto& knobs = *instance.knobs;
    auto& knob = knobs.all[k];
    knob.to = to;
    if (at_once || ! knobs.started || isChoice (knobs.type, k))
    {
        knob.left = 0;
        knob.value = to;
        if (instance.isDriven (k)) return;
        instance.write (k, to);
        if (knobs.type.update) knobs.type.update (instance.node.get());
        return;
    }
    knob.left = ticks;
    if (knobs.ramping) return;
    knobs.ramping = true;
    moving.push_back (i);
}

void Ramps::step() noexcept
{
    for (std::size_t m = 0; m < moving.size();)
    {
        const auto& instance = instances[moving[m]];
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

void Ramps::startAll() noexcept
{
    for (const auto& instance : instances)
        if (instance.knobs) instance.knobs->started = true;
}

}   // namespace tactus::plan
