// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/run/playback.hpp>
#include <tactus/run/log/stretch.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// Records everything that enters a run of the window, from its first tick until stop(), and reads stretches from the recording. If the run begins
/// again meanwhile, as with another hand, so does the recording, and the part so far is a recording of its own. To read, it replays the recording
/// without devices, a part on each call of poll(), so the window stays responsive. [main thread]
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

    /// The folder in which recordings are kept until they go, and where a crash leaves them; empty: a temporary one.
    std::filesystem::path home;

    /// A recording, in a log that is removed with this object, unless it stays.
    struct Recording
    {
        Recording() = default;
        ~Recording();
        Recording (const Recording&) = delete;
        Recording& operator= (const Recording&) = delete;

        std::filesystem::path file;
        std::string hand;        ///< the role of the hand; empty if it has none
        double length_s = 0.0;   ///< what a replay plays; until the first one, it may be some milliseconds short
        bool is_saved = false;   ///< as a whole
        bool is_used = false;    ///< something was made of a part of it, so closing need not ask about it; a crash must not lose it
        bool stays = false;      ///< the log is a file of the user, or is left for the next start
    };

    void record();   ///< starts the run again, and records it; what a person has stopped begins with its start
    void stop();     ///< ends the recording; the run goes on

    State state() const noexcept { return now; }
    double seconds() const noexcept { return current ? current->length_s : 0.0; }   ///< the length so far, or of the complete recording

    /// Replays the recording, and passes on a stretch, or the reason why this failed. Replaces any earlier request.
    void read (StretchReader::Options, std::function<void (Result<Stretch>)>);

    void poll();   ///< call many times a second

    /// The reason why a recording is complete.
    enum class End
    {
        asked,            ///< by stop(), or because it is as long as it may be
        with_run,         ///< the run has ended, as by STOP
        run_began_again   ///< the next recording has begun
    };

    std::function<void (const std::shared_ptr<Recording>&, End)> onRecorded;   ///< called when a recording is complete; null if nothing was recorded

    /// The recording, complete or not; null if there is none.
    const std::shared_ptr<Recording>& recorded() const noexcept { return current; }

    /// Goes back to an earlier recording, which is complete, or to none.
    void restore (std::shared_ptr<Recording>);

    /// Goes to a recording in a log, and returns the graph that it begins with. The log stays where it is, or is copied to become an unsaved recording,
    /// as one that a crash left. Ids: those of Replay and copyRunLog.
    Result<graph::Graph> open (const std::filesystem::path& log, bool copies);

    /// The role of the hand in the recording; empty if it has none.
    std::string role() const { return current ? current->hand : std::string(); }

    /// The log of the recording; empty if there is none.
    std::filesystem::path log() const { return current ? current->file : std::filesystem::path(); }

private:
    bool readOn();
    StretchReader::Options optionsFor (StretchReader::Options);
    std::shared_ptr<Recording> newRecording();
    std::shared_ptr<Recording> logNext();
    void runRestarts();
    void noteLength();
    void pollRecording();
    void finish (End);

    Playback& playback;
    FileAssets assets;
    State now = State::empty;
    std::shared_ptr<Recording> current;
    std::vector<std::shared_ptr<Recording>> following;   // of the runs that have begun again since, or will once the forces are zero
    std::size_t made = 0;                                // folders in `home`
    bool is_asked = false;                               // stop() was called
    bool reads_all = false;
    std::unique_ptr<StretchReader> reader;
    std::function<void (Result<Stretch>)> done;
};

}   // namespace tactus::host
