// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/run/playback.hpp>
#include <tactus/run/log/stretch.hpp>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace tactus::host
{

/// Records everything that enters a run of the window, from its first tick until stop(), and reads stretches from the recording. To read, it
/// replays the recording without devices, a part on each call of poll(), so the window stays responsive. [main thread]
class Take
{
public:
    enum class State
    {
        empty,
        recording,
        reading,   ///< the recording is being replayed
        ready
    };

    static constexpr double longest_s = 60.0;

    explicit Take (Playback&);
    ~Take();

    /// This program and its version, as logs state it.
    std::string program = "tactus";

    void record();   ///< starts the run again, and records it
    void stop();     ///< ends the recording; the run goes on

    State state() const noexcept { return now; }
    double seconds() const noexcept;   ///< the length so far, or of the complete recording

    /// Replays the recording, and passes on a stretch, or the reason why this failed. Replaces any earlier request.
    void read (StretchReader::Options, std::function<void (Result<Stretch>)>);

    void poll();   ///< call many times a second

    std::function<void()> onRecorded;   ///< called when a recording is complete

    /// The role of the hand in the recording; empty if it has none.
    const std::string& role() const noexcept { return hand; }

    /// The log of the recording; empty if there is none.
    const std::filesystem::path& log() const noexcept { return file; }

private:
    bool readOn();
    void discard();

    Playback& playback;
    FileAssets assets;
    State now = State::empty;
    std::filesystem::path file;
    std::string hand;
    std::chrono::steady_clock::time_point began;
    double length_s = 0.0;
    std::unique_ptr<StretchReader> reader;
    std::function<void (Result<Stretch>)> done;
};

}   // namespace tactus::host
