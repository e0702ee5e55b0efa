// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_recording.hpp"

#include <cstdio>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double room_s = 1.0;   // of frames that wait to be written
}   // namespace

LiveRecording::LiveRecording (Session& s, const std::vector<std::string>& files)
    : session (s), recorder (files, s.recorded(), s.rate(), false), ring (recorder.width() + 1, static_cast<std::size_t> (room_s * s.rate()) + 1)
{
}

void LiveRecording::after (std::uint64_t tick, bool halts) noexcept
{
    session.after (tick, halts);
    if (halts) return;
    const auto frame = ring.next();
    if (frame.empty()) return;
    frame[0] = static_cast<double> (tick);
    recorder.note (session.engine().plan().taps, frame.subspan (1));
    ring.push();
}

void LiveRecording::giveUp (std::vector<Error> failed)
{
    for (auto& error : failed)
    {
        std::fprintf (stderr, "%s: warning: %s; it is not recorded, and the run goes on [%s]\n", error.where.c_str(), error.what.c_str(), error.id.c_str());
        if (! failure) failure = std::move (error);
    }
}

void LiveRecording::drain()
{
    ring.drain ([this] (std::span<const double> frame)
                { giveUp (recorder.frame (static_cast<std::uint64_t> (frame[0]), frame.subspan (1))); });
}

std::optional<Error> LiveRecording::commit()
{
    drain();
    if (ring.lost() > 0) std::fprintf (stderr, "warning: %zu ticks were not recorded, because writing could not keep up\n", ring.lost());
    giveUp (recorder.commit());
    return failure;
}

}   // namespace tactus::host
