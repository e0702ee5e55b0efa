// SPDX-License-Identifier: GPL-3.0-or-later
// Stems that the host exports, compared with those that `tactus render --stems` is made of.
#include "host/app/support/desk_rig.hpp"
#include "host/app/support/environment.hpp"
#include "host/app/support/wait_for.hpp"

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/stems/stem_export.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/base/files/wav.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;
using tactus::host::test::Environment;

namespace
{
bool until (const std::function<bool()>& isSo)
{
    return tactus::test::eventually ({}, [&] {
        tactus::host::test::settle (5);
        return isSo();
    });
}

/// Exports the stems of a bell. Returns the name that was proposed for their folder.
std::filesystem::path exportBell (DeskRig& r, std::size_t choice)
{
    StemExport stems (r.desk);
    std::filesystem::path proposed;
    r.desk.chooseFile = [&] (bool saves, const std::filesystem::path& begin, const auto& chosen) {
        CHECK (saves);
        proposed = begin.filename();
        chosen (r.home / "bell");
    };
    stems.ask();
    REQUIRE (r.question.isOpen());
    CHECK (r.question.title() == "Export the stems of Bronze bell");
    r.question.answer (choice);
    REQUIRE (until ([&] {
        stems.attend();
        return ! stems.isRunning();
    }));
    const bool has_clips = choice == 3;   // whose losses it tells
    REQUIRE (r.question.isOpen() == has_clips);
    const auto said = has_clips ? r.question.title() : r.said;
    INFO (said);
    CHECK (said.contains ("files are in"));
    if (has_clips) CHECK (r.question.text().contains ("a force that is held"));
    r.question.cancel();
    return proposed;
}
}   // namespace

TEST_CASE ("the stems of the open graph are exported, and they add up to its mix", "[app][stems]")
{
    DeskRig r ("bronze_bell.json");
    CHECK (exportBell (r, 4) == "Bronze bell stems");   // floats

    const auto mix = readWav (r.home / "bell" / "mix.wav"), wall = readWav (r.home / "bell" / "not_mixed_wall_force.wav");
    REQUIRE (mix);
    REQUIRE (wall);
    REQUIRE (mix->channels.size() == 3);
    std::vector<double> sum = wall->channels.at (2);
    int layers = 0;
    for (const auto& entry : std::filesystem::directory_iterator (r.home / "bell"))
    {
        if (! entry.path().filename().string().starts_with ("layer_")) continue;
        const auto layer = readWav (entry.path());
        REQUIRE (layer);
        ++layers;
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += layer->channels.at (0).at (k);
    }
    CHECK (layers == 3);
    double worst = 0.0, peak = 0.0;
    for (std::size_t k = 0; k < sum.size(); ++k)
    {
        worst = std::max (worst, std::abs (sum[k] - mix->channels[2][k]));
        peak = std::max (peak, std::abs (sum[k]));
    }
    CHECK (peak > 0.05);
    CHECK (worst < 1e-5 * (1.0 + peak));
}

TEST_CASE ("a second export proposes another folder, so that no stems are replaced unless the user says so", "[app][stems]")
{
    const TemporaryFolder own;
    const Environment own_is { "TACTUS_GRAPHS", own.path() };
    std::vector<std::filesystem::path> proposed;
    for (int i = 0; i < 3; ++i)
    {
        DeskRig r ("bronze_bell.json");
        StemExport stems (r.desk);
        r.desk.chooseFile = [&] (bool, const std::filesystem::path& begin, const auto&) { proposed.push_back (begin); };
        stems.ask();
        r.question.answer (0);
        std::filesystem::create_directories (proposed.back());   // as an export does
    }
    CHECK (proposed == std::vector { own / "Bronze bell stems", own / "Bronze bell stems 2", own / "Bronze bell stems 3" });
}

TEST_CASE ("stems are proposed beside the user's graph, and a preset's among the own files", "[app][stems]")
{
    const TemporaryFolder own;
    const Environment own_is { "TACTUS_GRAPHS", own.path() };
    DeskRig r ("bronze_bell.json");
    const auto proposed = [&r] {
        std::filesystem::path folder;
        r.desk.chooseFile = [&folder] (bool, const std::filesystem::path& begin, const auto&) { folder = begin.parent_path(); };
        StemExport stems (r.desk);
        stems.ask();
        r.question.answer (0);
        return folder;
    };
    CHECK (proposed() == own.path());
    r.document.open (r.document.graph(), { .file = r.home / "bell.json" }, "open");
    CHECK (proposed() == r.home.path());
    r.document.open (r.document.graph(), { .file = presetFolder() / "bronze_bell.json" }, "open");
    CHECK (proposed() == own.path());
}

TEST_CASE ("the question before an export names the motion that is rendered", "[app][stems]")
{
    DeskRig r ("bronze_bell.json");
    StemExport stems (r.desk);
    stems.ask();
    CHECK (r.question.text().contains ("Motion: clapper: "));
    for (const char* odd : { "%1", "..", "N*s" })
        CHECK_FALSE (r.question.text().contains (odd));
}

TEST_CASE ("stems follow the gesture or the recording that moves the tool now", "[app][stems]")
{
    DeskRig r ("dry_wood.json");
    StemExport stems (r.desk);
    r.playback.changeHand ({ LiveRun::Hand::Kind::path, "circle" });
    stems.ask();
    CHECK (r.question.text().contains ("circle"));
    CHECK_FALSE (r.question.text().contains ("stroke"));
    r.question.cancel();

    const auto file = r.home / "pushed.csv";
    std::ofstream rows (file);
    rows << "t,x,y,z\n";
    for (int k = 0; k < 250; ++k)
        rows << 0.01 * k << ',' << 1e-4 * k << ",0,-0.001\n";
    rows.close();
    r.playback.changeHand ({ LiveRun::Hand::Kind::path, file.string() });
    r.desk.chooseFile = [&] (bool, const auto&, const auto& chosen) { chosen (r.home / "wood"); };
    stems.ask();
    CHECK (r.question.text().contains ("pushed.csv"));
    r.question.answer (4);
    REQUIRE (until ([&] {
        stems.attend();
        return ! stems.isRunning();
    }));
    const auto mix = readWav (r.home / "wood" / "mix.wav");
    REQUIRE (mix);
    CHECK (static_cast<double> (mix->channels.at (0).size()) / mix->rate_hz == Approx (2.5).margin (0.01));   // as long as the recording
}

TEST_CASE ("a clip of each layer is exported in each format", "[app][stems]")
{
    DeskRig r ("bronze_bell.json");
    exportBell (r, 3);
    std::map<std::string, std::set<std::string>> endings;
    for (const auto& entry : std::filesystem::directory_iterator (r.home / "bell"))
        if (isClipExtension (entry.path()) && entry.path().extension() != ".wav")
        {
            INFO (entry.path());
            const auto clip = loadClip (entry.path());
            REQUIRE (clip);
            CHECK (clip->clip.lastEvent() > 1.0);
            endings[entry.path().stem().string()].insert (entry.path().extension().string());
        }
    CHECK (endings.size() == 4);   // three layers, and the wall
    for (const auto& [name, all] : endings)
        CHECK (all == std::set<std::string> { ".ahap", ".haptic", ".hjif" });
}

TEST_CASE ("a user who cancels the export gets no folder, and a refused folder is named", "[app][stems]")
{
    DeskRig r ("bronze_bell.json");
    std::optional<StemExport> stems;
    const auto begin = [&] {
        stems.emplace (r.desk);
        stems->ask();
        REQUIRE (r.question.isOpen());
        r.question.answer (0);
        REQUIRE (stems->isRunning());
        REQUIRE (r.question.isOpen());   // it offers to cancel
    };
    r.chosen = r.home / "bell";
    begin();
    r.question.cancel();
    CHECK_FALSE (r.question.isOpen());
    stems.reset();   // waits until the thread has ended
    CHECK_FALSE (std::filesystem::exists (r.chosen));

    r.chosen = r.home / "full";
    std::filesystem::create_directories (r.chosen);
    r.home.write ("full/mine.txt", "mine");
    begin();
    REQUIRE (until ([&] {
        stems->attend();
        return ! stems->isRunning();
    }));
    CHECK_FALSE (r.question.isOpen());
    CHECK (r.said.contains ("not empty"));
}
