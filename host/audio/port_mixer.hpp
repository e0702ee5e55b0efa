// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "audio_settings.hpp"
#include "high_pass.hpp"

#include <framework/plan/plan.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus::host::audio
{

/// What routes make of the ports of a plan: samples for the channels of a card. Ports are found by name, so that routes go on
/// through edits; one that is gone is silent until it is back.
///
/// Routes come after no guard. So they have a gate of their own: it shuts within 5 ms while the run halts, after an emergency
/// stop, and where a port gives what is no number, and opens within 0.2 s.
class PortMixer
{
public:
    static constexpr double shut_s = 0.005, open_s = 0.2;
    static constexpr double most_sample = 8.0;      ///< full scales; more would only ring in what follows
    static constexpr std::size_t most_parts = 16;   ///< components of a port that are added up

    /// Each route with so many samples a tick. [main thread]
    PortMixer (std::vector<Route>, const std::vector<int>& samples_per_tick, double tick_rate_hz);

    /// After a tick. [tick thread]
    void look (const Plan&, bool shut) noexcept;

    /// Adds sample `i` of the tick of those routes that have `per_tick`, by channel. In order. [tick thread]
    void addTo (std::span<double> channels, int i, int per_tick) noexcept;

    std::uint64_t notNumbers() const noexcept { return broken.load (std::memory_order_relaxed); }   ///< samples that were none [any thread]

    /// How many samples a tick a route's port has; the largest of its parts. 0 if it is not there. [main thread]
    static int samplesOf (const Plan&, const Route&);

private:
    struct Sent
    {
        Route route;
        int per_tick;
        HighPass high_pass;
        std::array<std::uint32_t, most_parts> taps {};
        std::size_t parts = 0;
    };

    void find (const Plan&) noexcept;

    std::vector<Sent> all;
    const double shuts, opens;   // a tick
    std::atomic<std::uint64_t> broken = 0;

    // Of the tick thread.
    const Plan* plan = nullptr;   // of this tick
    std::uint64_t serial = 0;
    bool knows = false;
    double gate = 0.0, gate_before = 0.0;
    bool has_broken = false;
};

}   // namespace tactus::host::audio
