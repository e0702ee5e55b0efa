// SPDX-License-Identifier: MIT
#include "port_mixer.hpp"

#include <tactus/run/probe_ring.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host::audio
{

PortMixer::PortMixer (std::vector<Route> routes, const std::vector<int>& samples_per_tick, double tick_rate_hz)
    : shuts (1.0 / (shut_s * tick_rate_hz)), opens (1.0 / (open_s * tick_rate_hz))
{
    for (std::size_t i = 0; i < routes.size(); ++i)
    {
        const int per_tick = std::max (1, samples_per_tick[i]);
        const double cutoff = routes[i].high_pass_hz;
        all.push_back ({ .route = std::move (routes[i]), .per_tick = per_tick, .high_pass = HighPass (cutoff, tick_rate_hz * per_tick) });
    }
}

int PortMixer::samplesOf (const Plan& plan, const Route& route)
{
    int most = 0;
    for (const auto& tap : plan.taps())
        if (isPartOf (tap.name, route.port)) most = std::max (most, tap.per_tick);
    return most;
}

/// Compares names and allocates nothing. Takes a few microseconds, once per edit.
void PortMixer::find (const Plan& p) noexcept
{
    for (auto& sent : all)
    {
        sent.parts = 0;
        for (std::size_t i = 0; i < p.taps().size() && sent.parts < most_parts; ++i)
        {
            const auto seen = std::span (sent.taps).first (sent.parts);
            const bool again = std::ranges::any_of (seen, [&] (std::uint32_t j) { return p.taps()[j].name == p.taps()[i].name; });
            if (! again && isPartOf (p.taps()[i].name, sent.route.port)) sent.taps[sent.parts++] = static_cast<std::uint32_t> (i);
        }
    }
}

void PortMixer::poll (const Plan& p, bool shut) noexcept
{
    plan = &p;
    if (! knows || serial != p.serial()) find (p);
    knows = true;
    serial = p.serial();
    gate_before = gate;
    gate = shut || std::exchange (has_broken, false) ? std::max (0.0, gate - shuts) : std::min (1.0, gate + opens);
}

void PortMixer::addTo (std::span<double> channels, int i, int per_tick) noexcept
{
    const double open = gate_before + (gate - gate_before) * (i + 1) / per_tick;
    for (auto& sent : all)
    {
        if (sent.per_tick != per_tick) continue;
        double sum = 0.0;
        for (std::size_t part = 0; part < sent.parts; ++part)
            sum += plan->taps()[sent.taps[part]].sample (i, per_tick);
        const auto& use = sent.route;
        double sample = use.gain * sum / use.full_scale.value;
        if (! isFinite (sample))
        {
            sample = 0.0;
            has_broken = true;
            broken.fetch_add (1, std::memory_order_relaxed);
        }
        sample = open * sent.high_pass (std::clamp (sample, -most_sample, most_sample));
        if (const auto at = static_cast<std::size_t> (use.channel - 1); at < channels.size()) channels[at] += sample;
    }
}

}   // namespace tactus::host::audio
