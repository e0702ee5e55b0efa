// SPDX-License-Identifier: GPL-3.0-or-later
#include "port_feed.hpp"

#include <tactus/run/probe_ring.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double forgets_in_s = 6.0;   // time constant in which the loudest value of a component is forgotten

/// The value that counts as nothing, in SI: less can neither be felt nor seen.
double floorOf (Quantity q)
{
    switch (q)
    {
    case Quantity::length:
        return 2e-5;
    case Quantity::force:
        return 5e-3;
    case Quantity::torque:
        return 1e-4;
    case Quantity::energy:
        return 1e-7;
    case Quantity::speed:
    case Quantity::hit:
    case Quantity::angle:
    case Quantity::gain:
        return 1e-3;
    default:
        return 1e-6;
    }
}

bool countsByChange (Quantity q) { return q == Quantity::length || q == Quantity::angle; }
}   // namespace

void PortFeed::Component::add (double value) noexcept
{
    recent[seen++ % window] = value;
    loudest = std::max (activity(), loudest * (1.0 - 1.0 / (forgets_in_s * frames_per_second)));
}

double PortFeed::Component::activity() const noexcept
{
    double low = recent[0], high = recent[0], most_value = 0.0;
    for (std::size_t i = 0; i < std::min (seen, window); ++i)
    {
        if (! std::isfinite (recent[i])) return 0.0;
        low = std::min (low, recent[i]);
        high = std::max (high, recent[i]);
        most_value = std::max (most_value, std::abs (recent[i]));
    }
    return countsByChange (quantity) ? high - low : most_value;
}

void PortFeed::follow (const std::string& port)
{
    if (port == followed_port) return;
    followed_port = port;
    followNow();
}

/// Tells the tick thread which taps of the latest plan to follow.
void PortFeed::followNow()
{
    columns_now.clear();
    std::array<std::uint16_t, 3> chosen { no_tap, no_tap, no_tap };
    const auto parts = followed_port.empty() ? std::vector<const Component*> {} : partsOf (followed_port);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i]->tap < no_tap) chosen[i] = static_cast<std::uint16_t> (parts[i]->tap);
    followed.store (packed (chosen, ++requests), std::memory_order_relaxed);
}

std::uint64_t PortFeed::packed (const std::array<std::uint16_t, 3>& taps, std::uint16_t number) noexcept
{
    std::uint64_t word = number;
    for (const auto tap : taps)
        word = word << 16 | tap;
    return word;
}

/// The components of a port; of the first instance, if there are several.
std::vector<const PortFeed::Component*> PortFeed::partsOf (const std::string& port) const
{
    std::vector<const Component*> parts;
    const auto stem = [] (const std::string& name) {
        const auto dot = name.rfind ('.');
        return dot != std::string::npos && name.size() == dot + 2 && name[dot + 1] >= 'x' && name[dot + 1] <= 'z' ? name.substr (0, dot) : name;
    };
    for (const auto& c : components)
        if (isPartOf (c.name, port) && parts.size() < 3 && (parts.empty() || stem (parts.front()->name) == stem (c.name))) parts.push_back (&c);
    return parts;
}

void PortFeed::planComes (const Plan& plan)
{
    constexpr std::size_t most_plans = 16;
    std::vector<Component> next;
    planned = ports();
    for (const auto& port : planned)
        for (std::size_t i = 0; i < plan.taps().size() && next.size() < most; ++i)
        {
            const auto& tap = plan.taps()[i];
            if (! isPartOf (tap.name, port) || std::ranges::count (next, tap.name, &Component::name) > 0) continue;
            const auto old = std::ranges::find_if (components, [&] (const Component& c) { return c.name == tap.name && c.unit == tap.unit; });
            next.push_back (old != components.end() ? *old : Component { tap.name, tap.quantity, tap.unit, i });
            next.back().tap = i;
        }
    const auto interval = static_cast<std::uint32_t> (std::max (1.0, std::round (plan.rateHz() / frames_per_second)));
    per_second = plan.rateHz() / interval;
    const auto isSame = [] (const Component& a, const Component& b) { return a.tap == b.tap && a.name == b.name; };
    if (! std::ranges::equal (next, components, isSame))
    {
        collect();   // the frames so far belong to the previous plan
        serials.clear();
        components = std::move (next);
        for (std::size_t i = 0; i < components.size(); ++i)
            taps[i].store (components[i].tap, std::memory_order_relaxed);
        count.store (components.size(), std::memory_order_release);
        followNow();
    }
    serials.push_back (plan.serial());
    if (serials.size() > most_plans) serials.erase (serials.begin());
    every.store (components.empty() ? 0 : interval, std::memory_order_relaxed);
}

/// Widens the current column by the values of this tick.
void PortFeed::accumulate (const Plan& plan) noexcept
{
    const auto now = followed.load (std::memory_order_relaxed);
    if (now != following) is_whole = false;
    if (now != following || plan.serial() != plan_before)
    {
        following = now;
        plan_before = plan.serial();
        is_begun = false;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
        const auto tap = static_cast<std::uint16_t> (following >> (16 * (2 - i)));
        if (tap == no_tap || tap >= plan.taps().size()) continue;
        const double value = *plan.taps()[tap].value;
        extremes.low[i] = is_begun ? std::min (extremes.low[i], value) : value;
        extremes.high[i] = is_begun ? std::max (extremes.high[i], value) : value;
    }
    is_begun = true;
}

void PortFeed::after (const Plan& plan, std::uint64_t tick, bool) noexcept
{
    const auto interval = every.load (std::memory_order_relaxed);
    if (interval == 0) return;
    accumulate (plan);
    if (tick % interval != 0) return;
    if (const auto slot = frames.claim(); ! slot.empty())
    {
        auto& frame = slot.front();
        frame.plan = plan.serial();
        frame.followed = is_whole ? following : 0;
        frame.size = count.load (std::memory_order_acquire);
        for (std::size_t i = 0; i < frame.size; ++i)   // until the new plan takes over, these are other values, and refresh() ignores the frames
            if (const auto tap = taps[i].load (std::memory_order_relaxed); tap < plan.taps().size()) frame.values[i] = *plan.taps()[tap].value;
        frame.column = extremes;
    }
    frames.commit();
    is_begun = false;
    is_whole = true;
}

void PortFeed::refresh()
{
    collect();
    if (auto now = ports(); now != planned)
    {
        planned = std::move (now);
        if (onWanted) onWanted();
    }
}

void PortFeed::collect()
{
    const auto wanted_course = followed.load (std::memory_order_relaxed);
    frames.drain ([&] (std::span<const Frame> slot) {
        const auto& frame = slot.front();
        if (std::ranges::count (serials, frame.plan) == 0 || frame.size != components.size()) return;
        for (std::size_t i = 0; i < frame.size; ++i)
            components[i].add (frame.values[i]);
        if (frame.followed != wanted_course || followed_port.empty()) return;
        columns_now.push_back (frame.column);
        if (columns_now.size() > columns) columns_now.pop_front();
    });
}

void PortFeed::clear()
{
    for (auto& c : components)
        c.seen = 0;
    columns_now.clear();
}

std::optional<PortFeed::Reading> PortFeed::of (const std::string& port) const
{
    Reading reading;
    for (const auto* part : partsOf (port))
    {
        if (part->seen == 0) return std::nullopt;
        reading.values.push_back (part->recent[(part->seen - 1) % Component::window]);
        reading.quantity = part->quantity;
        reading.unit = part->unit;
    }
    return reading.values.empty() ? std::nullopt : std::optional (std::move (reading));
}

double PortFeed::level (const std::string& port) const
{
    double most_level = 0.0;
    for (const auto& c : components)
    {
        if (c.seen == 0 || ! isPartOf (c.name, port)) continue;
        const double floor = floorOf (c.quantity), now = c.activity();
        if (now > floor) most_level = std::max (most_level, std::sqrt (now / std::max (c.loudest, 4.0 * floor)));
    }
    return std::min (1.0, most_level);
}

}   // namespace tactus::host
