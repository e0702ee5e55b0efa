// SPDX-License-Identifier: MIT
#include <host/base/files/clip_io.hpp>

#include "support/temporary_folder.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/files/wav.hpp>
#include <tactus/file/clips/clip_signal.hpp>
#include <tactus/text/budget.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
void writeWav (const fs::path& file, const std::vector<std::vector<double>>& channels, double rate_hz)
{
    auto wav = WavWriter::create (file, rate_hz, channels.size());
    REQUIRE (wav);
    std::vector<double> frame (channels.size());
    for (std::size_t k = 0; k < channels.front().size(); ++k)
    {
        for (std::size_t c = 0; c < frame.size(); ++c)
            frame[c] = channels[c][k];
        REQUIRE (wav->frame (frame));
    }
    REQUIRE (wav->commit());
}

std::vector<fs::path> clipsOfOthers()
{
    std::vector<fs::path> files;
    const fs::path data = TACTUS_SHARED_DATA;
    if (fs::exists (data))
        for (const auto& entry : fs::recursive_directory_iterator (data))
            if (const auto e = entry.path().extension(); (e == ".haptic" || e == ".ahap") && entry.path().string().find ("/haptic_") != std::string::npos)
                files.push_back (entry.path());
    if (files.empty()) WARN ("skipped: there are no clips in " << data.string());
    return files;
}
}   // namespace

TEST_CASE ("every clip from other programs, saved in any format, reads back within 1 %, or the loss report says by how much it differs", "[clips][data]")
{
    const TemporaryFolder folder;
    for (const auto& path : clipsOfOthers())
    {
        INFO (path.string());
        const auto read = loadClip (path);
        if (! read) continue;   // the tests of the readers say which ones are broken
        for (const auto* name : { "a.haptic", "a.ahap", "a.hjif", "a.json", "a.csv" })
        {
            INFO (name);
            const auto saved = saveClip (read->clip, folder / name);
            REQUIRE (saved);
            const auto back = loadClip (folder / name);
            if (std::string (name) == "a.csv" && ! back) continue;   // an empty table
            REQUIRE (back);
            const auto report = differenceReport (*saved);
            for (const auto& d : readers::compareClips (read->clip, back->clip, saved->is_mixed))
                if (d.part() > 0.01)
                    CHECK (std::ranges::any_of (report, [] (const std::string& s) { return s.find ("the envelope differs by") != s.npos; }));
        }
    }
}

TEST_CASE ("what is known about a clip, and a file has no place for, is named by its own word", "[clips]")
{
    const TemporaryFolder folder;
    folder.write ("clip.json", R"({ "format": "tactus-clip", "version": 1, "notes": { "room": "the lab" },
        "tracks": [ { "channel": 1, "amplitude": [[0.0, 0.0], [0.04, 1.0], [0.15, 0.0]] } ] })");
    const auto read = loadClip (folder / "clip.json");
    REQUIRE (read);
    for (const auto* name : { "a.haptic", "a.ahap", "a.hjif", "a.csv", "a.wav" })
    {
        INFO (name);
        const auto saved = saveClip (read->clip, folder / name);
        REQUIRE (saved);
        const auto report = lossReport (*saved);
        CHECK (std::ranges::count_if (report, [] (const std::string& s) { return s.starts_with ("notes/room: the room of the clip is left out: "); }) == 1);
    }
}

TEST_CASE ("a clip node plays a recording: each sample becomes a point, and each channel a wave", "[clips]")
{
    const TemporaryFolder folder;
    std::vector<double> tone, noise;
    for (int k = 0; k < 500; ++k)
    {
        tone.push_back (0.5 * std::sin (0.1 * k));
        noise.push_back (0.25 * std::cos (0.7 * k * k));
    }
    writeWav (folder / "two.wav", { tone, noise }, 2000.0);
    host::FileAssets assets;
    const auto table = assets.table ((folder / "two.wav").string());
    REQUIRE (table);
    const auto made = clipOf (**table);
    CHECK (made.problem == "");
    REQUIRE (made.clip.tracks.size() == 2);
    CHECK (made.clip.tracks[1].channel == 2);
    CHECK (made.clip.tracks[1].is_wave);
    REQUIRE (made.clip.tracks[1].amplitude.size() == 501);
    for (std::size_t k = 0; k < 500; ++k)
    {
        REQUIRE (made.clip.tracks[0].amplitude[k].time == static_cast<double> (k) / 2000.0);
        REQUIRE (made.clip.tracks[0].amplitude[k].value == Approx (tone[k]).margin (1e-7));
        REQUIRE (made.clip.tracks[1].amplitude[k].value == Approx (noise[k]).margin (1e-7));
    }
}

TEST_CASE ("a recording that a clip cannot hold is refused, with a remedy", "[clips]")
{
    const TemporaryFolder folder;
    host::FileAssets assets;
    writeWav (folder / "loud.wav", { { 0.0, 1.5, -2.0 } }, 8000.0);
    const auto loud = assets.table ((folder / "loud.wav").string());
    REQUIRE (! loud);
    CHECK (loud.error().id == "clip/range");
    CHECK (loud.error().remedy.find ("tactus convert") != std::string::npos);
    CHECK (! assets.table ((folder / "none.wav").string()));
    CHECK (loadClip (folder / "x.hmpg").error().remedy.find (".hjif") != std::string::npos);
}

TEST_CASE ("samples that are not finite become 0 in a clip, and a warning says how many and where", "[clips]")
{
    const double inf = std::numeric_limits<double>::infinity();
    Messages notes;
    const auto clip = readers::clipOfSignal ({ .rate_hz = 1000.0, .channels = { { 0.5, 0.25 }, { 0.5, std::nan (""), -inf } } }, notes);
    REQUIRE (notes.size() == 1);
    CHECK (notes.front().id == "clip/not_finite");
    CHECK (notes.front().where == "channel 2");
    CHECK (notes.front().text.starts_with ("2 samples"));
    CHECK (notes.front().text.find ("0.001 s") != std::string::npos);
    for (const auto& t : clip.tracks)
        for (const auto& p : t.amplitude)
            CHECK (std::isfinite (p.value));
    CHECK (clip.tracks[1].amplitude[0].value == 0.5);
}
