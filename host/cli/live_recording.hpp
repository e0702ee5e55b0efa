// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "recorder.hpp"
#include "session.hpp"

#include <host/runtime/frame_ring.hpp>
#include <host/runtime/runner.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// A session that is recorded while it runs: all of its ticks but those of the halt. The tick thread never waits for the
/// files, and a disk that is full ends a recording, but not the run.
class LiveRecording final : public TickHooks
{
public:
    /// The files are created, and none is there before commit(). [main thread]
    LiveRecording (Session&, const std::vector<std::string>& files);

    void before (std::uint64_t tick) noexcept override { session.before (tick); }   // [tick thread]
    void after (std::uint64_t tick, bool halts) noexcept override;                  // [tick thread]

    /// Writes down what there is; to be called many times a second. Says on stderr which files it gives up. [main thread]
    void drain();

    /// What is left, and then the files. Says on stderr if ticks are missing. Returns why the first of the files is missing that
    /// is, if one is. [main thread, after the run]
    std::optional<Error> commit();

private:
    void giveUp (std::vector<Error>);

    Session& session;
    Recorder recorder;
    std::optional<Error> failure;
    FrameRing ring;   // a tick, and what was noted then
};

}   // namespace tactus::host
