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

    /// This program and its version, as logs state it.
    std::string program = "tactus";

    /// What was recorded, in a log that is removed with this object.
    struct Recording
    {
        Recording() = default;
        ~Recording();
        Recording (const Recording&) = delete;
        Recording& operator= (const Recording&) = delete;

        std::filesystem::path file;
        std::string hand;   ///< the role of the hand; empty if it has none
        double length_s = 0.0;
        bool is_saved = false;   ///< it was saved, or something was made of it
    };

    void record();   ///< starts the run again, and records it
    void stop();     ///< ends the recording; the run goes on

    State state() const noexcept { return now; }
    double seconds() const noexcept;   ///< the length so far, or of the complete recording

    /// Replays the recording, and passes on a stretch, or the reason why this failed. Replaces any earlier request.
    void read (StretchReader::Options, std::function<void (Result<Stretch>)>);

    void poll();   ///< call many times a second

    std::function<void()> onRecorded;   ///< called when a recording is complete

    /// The recording, complete or not; null if there is none.
    const std::shared_ptr<Recording>& recorded() const noexcept { return current; }

    /// Goes back to an earlier recording, which is complete, or to none.
    void restore (std::shared_ptr<Recording>);

    /// The role of the hand in the recording; empty if it has none.
    std::string role() const { return current ? current->hand : std::string(); }

    /// The log of the recording; empty if there is none.
    std::filesystem::path log() const { return current ? current->file : std::filesystem::path(); }

private:
    bool readOn();

    Playback& playback;
    FileAssets assets;
    State now = State::empty;
    std::shared_ptr<Recording> current;
    std::chrono::steady_clock::time_point began;
    std::unique_ptr<StretchReader> reader;
    std::function<void (Result<Stretch>)> done;
};

}   // namespace tactus::host
