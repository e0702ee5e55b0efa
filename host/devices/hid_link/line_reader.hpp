// SPDX-License-Identifier: MIT
#pragma once

#include <host/base/platform/wire_file.hpp>
#include <host/devices/hid/report/framing.hpp>

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>
#include <vector>

namespace tactus::host::hid
{

/// Reads reports from a serial line, from either end. Neither allocates nor throws after construction. [one thread]
class LineReader
{
public:
    using Clock = WireFile::Clock;
    using Outcome = WireFile::Outcome;

    /// A pause longer than `pause` ends a report.
    LineReader (Framing framing, std::vector<FrameReader::Shape> shapes, std::chrono::milliseconds pause = SerialWire().pause)
        : frames (framing, std::move (shapes)), pause_within (pause)
    {
    }

    /// The next whole report, as ReportFile::read.
    Outcome read (WireFile& file, std::span<std::uint8_t> into, Clock::time_point until) noexcept
    {
        for (;;)
        {
            if (const auto report = frames.next())
            {
                const auto size = std::min (report->size(), into.size());
                std::copy_n (report->begin(), size, into.begin());
                return { .what = Outcome::Kind::report, .size = size };
            }
            const bool within = frames.isWithin();
            const auto got = file.read (frames.room(), within ? std::min (until, heard + pause_within) : until);
            if (got.what == Outcome::Kind::failure) return got;
            const auto now = Clock::now();
            if (got.what == Outcome::Kind::report)
            {
                frames.arrived (got.size - (loses && got.size > 1 ? 1 : 0));
                heard = now;
                continue;
            }
            if (within && now >= heard + pause_within)
            {
                frames.pause();
                if (frames.isWithin()) continue;   // a whole report that the pause has confirmed
            }
            if (now >= until) return {};
        }
    }

    void reset() noexcept { frames.reset(); }

    /// For fakes: from now on, the last byte of whatever comes at once is lost, or is not.
    void lose (bool on) noexcept { loses = on; }

    const FrameReader::Counts& counts() const noexcept { return frames.counts(); }

private:
    FrameReader frames;
    const std::chrono::milliseconds pause_within;
    bool loses = false;
    Clock::time_point heard;
};

}   // namespace tactus::host::hid
