// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_recording.hpp"

#include <host/cli/report.hpp>
#include <tactus/text/quote.hpp>

#include <cstdio>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double room_s = 1.0;    // capacity for ticks waiting to be written, in s
constexpr double flush_s = 0.5;   // time between two flushes, in s: together with the ticks that wait, less than a second is lost
}   // namespace

LiveRecording::LiveRecording (Run& run, const std::vector<std::string>& files)
    : recorder (files, run.recorded(), run.rate(), false, IfKilled::kept),
      ticks_per_flush (static_cast<std::uint64_t> (flush_s * run.rate())),
      ring (static_cast<std::size_t> (room_s * run.rate()) + 1, recorder.width() + 1)
{
}

void LiveRecording::after (const Plan& plan, std::uint64_t tick, bool halts) noexcept
{
    if (halts) return;
    if (const auto frame = ring.claim(); ! frame.empty())
    {
        frame[0] = static_cast<double> (tick);
        recorder.note (plan.taps(), frame.subspan (1));
    }
    ring.commit();
}

void LiveRecording::giveUp (std::vector<Message> failed)
{
    for (auto& error : failed)
    {
        std::fprintf (stderr, "%s: warning: %s; this file is no longer written, but the run continues [%s]\n",
                      printableName (error.where).c_str(), inOneLine (error.text).c_str(), error.id.c_str());
        if (! failure) failure = std::move (error);
    }
}

void LiveRecording::drain()
{
    ring.drain ([this] (std::span<const double> frame) {
        const auto tick = static_cast<std::uint64_t> (frame[0]);
        giveUp (recorder.frame (tick, frame.subspan (1)));
        drained = tick + 1;
    });
    if (drained - flushed <= ticks_per_flush) return;
    flushed = drained;
    giveUp (recorder.flush());
}

std::optional<Message> LiveRecording::commit()
{
    drain();
    if (ring.lost() > 0) std::fprintf (stderr, "warning: %zu ticks were not recorded because writing the files could not keep up with the run\n", ring.lost());
    giveUp (recorder.commit());
    return failure;
}

}   // namespace tactus::host
