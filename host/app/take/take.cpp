// SPDX-License-Identifier: GPL-3.0-or-later
#include "take.hpp"

#include <host/base/platform/private_folder.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/log/run_test.hpp>

#include <chrono>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr auto slice = std::chrono::milliseconds (10);   // of each call
constexpr std::uint64_t ticks_at_once = 64;

bool hasBegun (const Take::Recording& r)
{
    std::error_code failed;
    return std::filesystem::exists (r.file, failed);
}
}   // namespace

Take::Take (Playback& p) : playback (p)
{
    playback.run().onRestart = [this] { runRestarts(); };
}

Take::~Take() { playback.run().onRestart = nullptr; }

Take::Recording::~Recording()
{
    std::error_code ignored;
    if (! file.empty() && ! stays) std::filesystem::remove_all (file.parent_path(), ignored);
}

void Take::restore (std::shared_ptr<Recording> r)
{
    stop();
    reader.reset();
    done = nullptr;
    following.clear();
    current = std::move (r);
    now = current ? State::ready : State::empty;
}

void Take::record()
{
    playback.endPreview();
    restore (nullptr);
    current = logNext();
    playback.startAgain();
    is_asked = false;
    now = State::recording;
}

/// In a folder of its own. If there is none, the log says why it cannot be written.
std::shared_ptr<Take::Recording> Take::newRecording()
{
    auto recording = std::make_shared<Recording>();
    auto folder = home.empty() ? privateFolder ("tactus-take-") : home / ("take-" + std::to_string (++made));
    std::error_code failed;
    if (! home.empty()) std::filesystem::create_directory (folder, failed);
    if (folder.empty()) folder = temporaryFolder() / "tactus-take-without-a-folder";
    recording->file = folder / "take.jsonl";
    return recording;
}

/// The next run is recorded.
std::shared_ptr<Take::Recording> Take::logNext()
{
    auto recording = newRecording();
    playback.run().logNextTo (recording->file, program);
    return recording;
}

/// Nothing restarts the run in order to record it again: a stop that comes meanwhile must last.
void Take::runRestarts()
{
    if (now != State::recording) return;
    noteLength();
    if (following.empty() || hasBegun (*following.back())) following.push_back (logNext());
}

void Take::stop()
{
    if (now != State::recording) return;
    is_asked = true;
    noteLength();
    playback.run().stopLogging();
}

/// The length and the hand of the log that is being written.
void Take::noteLength()
{
    auto& run = playback.run();
    const auto status = run.status();
    if (now != State::recording || ! following.empty() || ! run.isLogged() || ! status || status->phase != RunStatus::Phase::running) return;
    current->length_s = static_cast<double> (status->ticks) / run.rate();
    current->hand = run.handRole();
}

Result<graph::Graph> Take::open (const std::filesystem::path& log, bool copies)
{
    auto opened = copies ? newRecording() : std::make_shared<Recording>();
    std::uint64_t ticks = 0;
    if (copies)
    {
        const auto copied = copyRunLog (log.string(), opened->file);
        if (! copied) return copied.error();
        ticks = *copied;
    }
    else
    {
        opened->file = log;
        opened->is_saved = opened->stays = true;
    }
    const auto played = StretchReader::open (opened->file.string(), optionsFor ({}));
    if (! played) return played.error();
    opened->hand = (*played)->firstRole();
    opened->length_s = static_cast<double> (ticks) / (*played)->rate();
    restore (std::move (opened));
    return (*played)->graph();
}

StretchReader::Options Take::optionsFor (StretchReader::Options options)
{
    options.assets = &assets;
    options.services.nearest_triangle = nearestByBoxes;
    options.program = program;
    return options;
}

void Take::read (StretchReader::Options options, std::function<void (Result<Stretch>)> then)
{
    if (now != State::ready && now != State::reading) return;
    const bool is_all = options.from_s <= 0.0 && std::isinf (options.until_s);
    auto opened = StretchReader::open (current->file.string(), optionsFor (std::move (options)));
    if (! opened) return then (std::move (opened).error());
    reader = std::move (*opened);
    done = std::move (then);
    reads_all = is_all;
    now = State::reading;
}

void Take::poll()
{
    if (now == State::recording)
        pollRecording();
    else if (now == State::reading && ! readOn())
    {
        now = State::ready;
        const auto ended = std::exchange (reader, nullptr);
        const auto then = std::exchange (done, nullptr);
        auto stretch = ended->take();
        if (stretch && reads_all) current->length_s = static_cast<double> (stretch->until) / stretch->rate_hz;
        then (std::move (stretch));
    }
}

void Take::pollRecording()
{
    if (! following.empty() && hasBegun (*following.front())) return finish (End::run_began_again);
    noteLength();
    if (current->length_s > longest_s) stop();
    if (playback.run().isLogging()) return;
    following.clear();   // a stop came before that run had begun
    finish (is_asked ? End::asked : End::with_run);
}

void Take::finish (End why)
{
    std::error_code failed;
    const auto size = std::filesystem::file_size (current->file, failed);
    const auto ended = failed || size == 0 ? nullptr : current;
    if (why == End::run_began_again)
    {
        current = following.front();
        following.erase (following.begin());
    }
    else
    {
        current = ended;
        now = ended ? State::ready : State::empty;
    }
    if (onRecorded) onRecorded (ended, why);
}

/// Plays for a moment. Returns false at the end.
bool Take::readOn()
{
    const auto until = std::chrono::steady_clock::now() + slice;
    while (std::chrono::steady_clock::now() < until)
    {
        const auto more = reader->advance (ticks_at_once);
        if (! more)
        {
            now = State::ready;
            reader.reset();
            const auto then = std::exchange (done, nullptr);
            then (more.error());
            return true;
        }
        if (! *more) return false;
    }
    return true;
}

}   // namespace tactus::host
