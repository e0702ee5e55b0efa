// SPDX-License-Identifier: GPL-3.0-or-later
#include "take.hpp"

#include <host/assets/nearest_by_embree.hpp>
#include <host/platform/private_folder.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
constexpr auto slice = std::chrono::milliseconds (10);   // of each call
constexpr std::uint64_t ticks_at_once = 64;
}   // namespace

Take::Take (Playback& p) : playback (p) {}

Take::Recording::~Recording()
{
    std::error_code ignored;
    if (! file.empty()) std::filesystem::remove_all (file.parent_path(), ignored);
}

void Take::restore (std::shared_ptr<Recording> r)
{
    stop();
    reader.reset();
    done = nullptr;
    current = std::move (r);
    now = current ? State::ready : State::empty;
}

void Take::record()
{
    playback.endPreview();
    restore (std::make_shared<Recording>());
    const auto folder = privateFolder ("tactus-take-");
    current->file = (folder.empty() ? temporaryFolder() / "tactus-take-without-a-folder" : folder) / "take.jsonl";   // the log says why it cannot be written
    playback.run().logNextTo (current->file, program);
    playback.startAgain();
    began = std::chrono::steady_clock::now();
    now = State::recording;
}

void Take::stop()
{
    if (now == State::recording) playback.run().stopLogging();
}

double Take::seconds() const noexcept
{
    if (now != State::recording) return current ? current->length_s : 0.0;
    return std::chrono::duration<double> (std::chrono::steady_clock::now() - began).count();
}

void Take::read (StretchReader::Options options, std::function<void (Result<Stretch>)> then)
{
    if (now != State::ready && now != State::reading) return;
    options.assets = &assets;
    options.services.nearest_triangle = nearestByEmbree;
    options.program = program;
    auto opened = StretchReader::open (current->file.string(), options);
    if (! opened) return then (std::move (opened).error());
    reader = std::move (*opened);
    done = std::move (then);
    now = State::reading;
}

void Take::poll()
{
    if (now == State::recording)
    {
        if (seconds() > longest_s) stop();
        if (playback.run().isLogging()) return;
        std::error_code failed;
        const bool is_there = std::filesystem::file_size (current->file, failed) > 0 && ! failed;
        current->length_s = seconds();
        current->hand = playback.run().handRole();
        now = is_there ? State::ready : State::empty;
        if (is_there && onRecorded) onRecorded();
    }
    else if (now == State::reading && ! readOn())
    {
        now = State::ready;
        const auto ended = std::exchange (reader, nullptr);
        const auto then = std::exchange (done, nullptr);
        auto stretch = ended->take();
        then (std::move (stretch));
    }
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
