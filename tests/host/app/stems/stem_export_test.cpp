// SPDX-License-Identifier: GPL-3.0-or-later
// Stems that the window exports, compared with those that `tactus render --stems` is made of.
#include "host/app/support/desk_rig.hpp"
#include "host/app/support/window_rig.hpp"

#include "support/waiting.hpp"

#include <host/app/stems/stem_export.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/base/files/wav.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;
using tactus::host::test::WindowRig;

namespace
{
bool until (const std::function<bool()>& isSo)
{
    return tactus::test::eventually ({}, [&] {
        WindowRig::settle (5);
        return isSo();
    });
}
}   // namespace

TEST_CASE ("the window exports the stems of the open graph, and they add up to its mix", "[app][stems]")
{
    const TemporaryFolder folder;
    WindowRig w ("bronze_bell.json");
    std::filesystem::path proposed;
    w.view->chooseFile = [&] (bool saves, const std::filesystem::path& begin, const std::function<void (const std::filesystem::path&)>& chosen) {
        CHECK (saves);
        proposed = begin.filename();
        chosen (folder / "bell");
    };
    w.key ("ctrl + k");
    w.stage->type ("export stems");
    w.key ("return");
    WindowRig::settle();
    REQUIRE (w.view->asked().isOpen());
    CHECK (w.view->asked().title() == "Export the stems of Bronze bell");
    w.view->asked().answer (4);   // floats
    CHECK (proposed == "Bronze bell stems");
    REQUIRE (until ([&] { return ! w.view->asked().isOpen(); }));
    INFO (w.view->statusText());
    CHECK (w.view->statusText().contains ("files are in"));

    const auto mix = readWav (folder / "bell" / "mix.wav"), wall = readWav (folder / "bell" / "not_mixed_wall_force.wav");
    REQUIRE (mix);
    REQUIRE (wall);
    REQUIRE (mix->channels.size() == 3);
    std::vector<double> sum = wall->channels.at (2);
    int layers = 0;
    for (const auto& entry : std::filesystem::directory_iterator (folder / "bell"))
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

TEST_CASE ("the window exports a clip of each layer in each format", "[app][stems]")
{
    const TemporaryFolder folder;
    WindowRig w ("bronze_bell.json");
    w.view->chooseFile = [&] (bool, const std::filesystem::path&, const std::function<void (const std::filesystem::path&)>& chosen) {
        chosen (folder / "bell");
    };
    w.key ("ctrl + k");
    w.stage->type ("export stems");
    w.key ("return");
    WindowRig::settle();
    REQUIRE (w.view->asked().isOpen());
    w.view->asked().answer (3);
    REQUIRE (until ([&] { return ! w.view->asked().isOpen(); }));
    INFO (w.view->statusText());
    std::map<std::string, std::set<std::string>> endings;
    for (const auto& entry : std::filesystem::directory_iterator (folder / "bell"))
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
