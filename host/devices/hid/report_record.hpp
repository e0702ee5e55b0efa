// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace tactus::host::hid
{

/// A record of which of the last 32 reports of a device have arrived, one bit each, the newest last. A device whose reports mostly get lost still
/// looks fresh: with one report in 15 at 1 kHz, no reading is older than 15 ms, but the loop runs at 67 Hz and a wall buzzes.
class ReportRecord
{
public:
    static constexpr std::uint64_t window = 32;
    static constexpr int enough = 16;

    /// A report has arrived after `missing` others that have not.
    void arrived (std::uint64_t missing) noexcept { bits = missing < window - 1 ? bits << (missing + 1) | 1u : 1u; }

    /// The device has restarted, so what it sent before no longer counts.
    void restart() noexcept { bits = 0; }

    /// At least half have arrived. A new record counts as complete.
    bool isTrusted() const noexcept { return std::popcount (bits) >= enough; }

    /// The number of missing reports, if this much time has passed since the last one. Bursts do not count as losses: the first report of a burst
    /// counts the others as missing, but they arrive right after it.
    static std::uint64_t missingAfter (double elapsed_s, double rate_hz) noexcept
    {
        const double periods = std::round (elapsed_s * rate_hz);
        return periods > 1.0 ? static_cast<std::uint64_t> (std::fmin (periods, 1e9)) - 1 : 0;
    }

private:
    std::uint32_t bits = ~0u;
};

}   // namespace tactus::host::hid
