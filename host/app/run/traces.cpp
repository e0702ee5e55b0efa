// SPDX-License-Identifier: GPL-3.0-or-later
#include "traces.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string_view>

namespace tactus::host
{

namespace
{
/// The name of the outermost node, with which the names of all components of a port begin.
std::string_view stemOf (std::string_view port) { return port.substr (0, port.find_first_of ("[/.")); }
}   // namespace

Trace::Trace (const Tap& tap, double rate)
    : tap_name (tap.name), what (tap.quantity), si (tap.unit), rate_hz (rate),
      values (static_cast<std::size_t> (std::max (1.0, seconds * rate)), std::numeric_limits<double>::quiet_NaN())
{
}

void Trace::add (std::uint64_t tick, double value) noexcept
{
    if (first_tick == end_tick || tick < end_tick || tick - end_tick > values.size())
    {
        first_tick = end_tick = tick;
        ++times_begun;
    }
    for (; end_tick < tick; ++end_tick)
        values[end_tick % values.size()] = std::numeric_limits<double>::quiet_NaN();
    values[tick % values.size()] = value;
    end_tick = tick + 1;
}

Traces::Client::~Client()
{
    std::erase (traces.clients, this);
    if (! ports.empty() && traces.onWanted) traces.onWanted();
}

void Traces::Client::want (std::vector<std::string> wanted)
{
    if (wanted == ports) return;
    ports = std::move (wanted);
    if (traces.onWanted) traces.onWanted();
}

std::vector<std::pair<std::string, Traces::Rank>> Traces::requests() const
{
    std::vector<std::pair<std::string, Rank>> all;
    std::set<std::string_view> known;
    for (const auto rank : { Rank::first, Rank::usual, Rank::spare })
        for (const auto* c : clients)
            for (const auto& p : c->ports)
                if (c->rank == rank && known.insert (p).second) all.emplace_back (p, rank);
    return all;
}

std::vector<std::string> Traces::ports() const
{
    std::vector<std::string> all;
    for (auto& [port, rank] : requests())
        all.push_back (std::move (port));
    return all;
}

std::vector<std::shared_ptr<const Trace>> Traces::of (const std::string& port) const
{
    std::vector<std::shared_ptr<const Trace>> found;
    const auto stem = stemOf (port);
    for (auto at = by_name.lower_bound (std::string (stem)); at != by_name.end() && at->first.starts_with (stem); ++at)
        if (isPartOf (at->first, port)) found.push_back (at->second);
    return found;
}

void Traces::planComes (const Plan& plan)
{
    collect();   // the frames so far belong to the previous plan
    ++changes;
    const auto wanted = requests();
    std::map<std::string, std::vector<std::size_t>, std::less<>> by_stem;   // numbers of taps
    for (const auto& [port, rank] : wanted)
        by_stem.try_emplace (std::string (stemOf (port)));
    for (std::size_t i = 0; i < plan.taps().size(); ++i)
        if (const auto stem = by_stem.find (stemOf (plan.taps()[i].name)); stem != by_stem.end()) stem->second.push_back (i);

    std::vector<bool> is_chosen (plan.taps().size());
    std::size_t count = 0;
    too_many.clear();
    for (const auto& [port, rank] : wanted)
    {
        auto parts = by_stem.find (stemOf (port))->second;
        std::erase_if (parts, [&, p = std::string_view (port)] (std::size_t i) { return is_chosen[i] || ! isPartOf (plan.taps()[i].name, p); });
        const auto room = ProbeRing::most - count;
        if (rank == Rank::spare && parts.size() > room) continue;
        for (std::size_t k = room; k < parts.size(); ++k)
            if (std::ranges::count (too_many, plan.taps()[parts[k]].name) == 0) too_many.push_back (plan.taps()[parts[k]].name);
        parts.resize (std::min (parts.size(), room));
        count += parts.size();
        for (const auto i : parts)
            is_chosen[i] = true;
    }

    std::vector<std::size_t> chosen;
    std::vector<std::shared_ptr<Trace>> columns;
    std::map<std::string, std::shared_ptr<Trace>> recorded;
    for (std::size_t i = 0; i < plan.taps().size(); ++i)
    {
        if (! is_chosen[i]) continue;
        const auto& tap = plan.taps()[i];
        auto& trace = recorded[tap.name];
        if (const auto old = by_name.find (tap.name); old != by_name.end() && old->second->unit() == tap.unit) trace = old->second;
        if (! trace) trace = std::make_shared<Trace> (tap, plan.rateHz());
        chosen.push_back (i);
        columns.push_back (trace);
    }
    by_name = std::move (recorded);
    if (chosen != taps || columns != in_frame)
    {
        ring.drain ([] (const ProbeRing::Frame&) {});
        selected.clear();
        taps = std::move (chosen);
        in_frame = std::move (columns);
        ring.select (taps, 1);
    }
    selected.push_back (plan.serial());
    if (selected.size() > most_plans) selected.erase (selected.begin());
}

void Traces::collect()
{
    ring.drain ([this] (const ProbeRing::Frame& frame) {
        if (std::ranges::count (selected, frame.plan) == 0 || frame.size != in_frame.size()) return;
        ++changes;
        for (std::size_t i = 0; i < frame.size; ++i)
            in_frame[i]->add (frame.tick, frame.values[i]);
    });
}

}   // namespace tactus::host
