// SPDX-License-Identifier: GPL-3.0-or-later
// Files in the whole window: those that settings name, which a saved graph finds again; large ones, which are loaded on another thread; shared ones; and
// recordings.
#include "host/app/support/environment.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/fit_panel/fit_panel.hpp>
#include <host/app/problems/problem_list.hpp>
#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::Environment;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;
namespace fs = std::filesystem;

namespace
{
const fs::path heart = TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic", clip_template = TACTUS_SOURCE_DIR "/graphs/templates/clip.json";

bool isDialogOpen() { return juce::Component::getNumCurrentlyModalComponents() > 0; }

void saveAs (WindowRig& w, const fs::path& file)
{
    w.key ("ctrl + shift + s");
    REQUIRE (isDialogOpen());
    w.stage->type (file.stem().string());
    w.key ("return");
    REQUIRE (waitFor ([&] { return fs::exists (file); }));
}

std::string clipOf (const graph::Graph& g)
{
    const auto* node = g.root.find ("clip");
    REQUIRE (node != nullptr);
    return node->settings["clip"].get<std::string>();
}

/// JUCE delivers what was dropped in a message of its own.
void dropOnClip (WindowRig& w, const fs::path& file)
{
    const auto before = clipOf (w.graph());
    w.stage->drop (file.string(), w.onStage (w.node ("clip").bounds().getCentre()));
    REQUIRE (waitFor ([&] { return clipOf (w.graph()) != before; }));
}

/// Loads a saved graph as another program does. Returns the path of its clip.
std::string clipIn (const fs::path& file)
{
    const auto loaded = loadGraph (file);
    FileAssets assets;
    const auto compiled = compile (loaded.graph, catalogue(), { .assets = &assets });
    for (const auto& m : compiled.messages)
        if (m.severity == Message::Severity::error) UNSCOPED_INFO (m.text);
    CHECK (compiled.plan != nullptr);
    return clipOf (loaded.graph);
}

/// A graph with a bumpy plate of 2 n n triangles. Its file is large.
void writePlate (const TemporaryFolder& folder, int n)
{
    std::string mesh;
    for (int line = 0; line < 20'000; ++line)
        mesh += "# " + std::string (60, '-') + "\n";
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            mesh += "v " + std::to_string (0.1 * i / n) + " " + std::to_string (0.1 * j / n) + " " + std::to_string (1e-3 * ((i + j) % 3)) + "\n";
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const int a = j * (n + 1) + i + 1;
            mesh += "f " + std::to_string (a) + " " + std::to_string (a + 1) + " " + std::to_string (a + n + 2) + "\n";
            mesh += "f " + std::to_string (a) + " " + std::to_string (a + n + 2) + " " + std::to_string (a + n + 1) + "\n";
        }
    folder.write ("plate.obj", mesh);
    folder.write ("plate.json", R"({ "format": "tactus-graph", "version": 1, "name": "Plate", "rate_hz": 1000, "devices": { "stylus": { "driver": "sim" } },
        "nodes": { "hand": { "type": "device.position", "role": "stylus" },
            "plate": { "type": "deform.surface", "settings": { "surface": { "mesh": "plate.obj",
                "curves": [[{ "power": [300, 1] }, { "power": [300, 1] }, { "power": [300, 1] }]],
                "mu": 0.1 }, "search_ticks": 8 } },
            "motor": { "type": "device.force", "role": "stylus" } },
        "wires": ["hand.position -> plate.position", "plate.force -> motor.force"] })");
}

fs::path writeStrokes (const TemporaryFolder& folder)
{
    auto file = folder / "strokes.csv";
    std::ofstream out (file);
    out << "Time,Velocity,Normal,Friction\n";
    double d = 0.0;
    for (int i = 0; i < 1200; ++i)
    {
        const double v = i % 400 < 200 ? 5e-3 : -5e-3;
        d = std::clamp (d + 1e-3 * v, -1e-4, 1e-4);
        out << 1e-3 * i << ',' << v << ",2," << -0.8 * d / 1e-4 + 0.002 * std::sin (7.0 * i) << '\n';
    }
    return file;
}
}   // namespace

TEST_CASE ("a graph that is saved elsewhere finds its clip again, also one that was chosen since", "[app][files]")
{
    const TemporaryFolder mine;
    const Environment own_is { "TACTUS_GRAPHS", mine.path() };
    fs::copy_file (heart, mine / "heart.haptic");
    WindowRig w;
    w.key ("ctrl + n");
    w.click ("Clip");
    dropOnClip (w, mine / "heart.haptic");
    CHECK (clipOf (w.graph()) != "heart.haptic");   // relative to the folder of the template
    saveAs (w, mine / "one.json");
    CHECK (clipIn (mine / "one.json") == "heart.haptic");
    CHECK_FALSE (w.view->document().isChanged());

    w.key ("ctrl + z");   // to the clip of the template; saving is no step
    CHECK (clipOf (w.graph()) == "assets/pulse.haptic");
    CHECK (w.graph().name == "One");   // undo keeps the name of the file
    w.key ("ctrl + s");
    w.key ("return");
    CHECK (clipIn (mine / "one.json") == "assets/pulse.haptic");   // a copy
    CHECK (fs::exists (mine / "assets/pulse.haptic"));

    dropOnClip (w, mine / "heart.haptic");
    w.key ("ctrl + s");
    CHECK (clipIn (mine / "one.json") == "heart.haptic");
    w.view->open (mine / "one.json");
    CHECK_FALSE (hasErrors (w.view->run().messages()));

    fs::create_directories (mine / "deeper");   // from a file of the user to another folder
    setenv ("TACTUS_GRAPHS", (mine / "deeper").c_str(), 1);
    w.view->chooseFile = [&] (bool, const fs::path&, const std::function<void (const fs::path&)>& chosen) { chosen (mine / "deeper/two.json"); };
    w.key ("ctrl + shift + s");
    w.click ("Copy");
    CHECK (clipIn (mine / "deeper/two.json") == "heart.haptic");
    CHECK (fs::exists (mine / "deeper/heart.haptic"));
}

TEST_CASE ("a file that is missing is chosen from the problem, with one Return on its path", "[app][files][problems]")
{
    const TemporaryFolder folder;
    auto g = loadGraph (clip_template).graph;
    for (auto& n : g.root.nodes)
        if (n.name == "clip") n.settings["clip"] = "gone/away.haptic";
    REQUIRE (saveGraph (g, folder / "lost.json"));
    WindowRig w ((folder / "lost.json").string());
    CHECK (hasErrors (w.view->run().messages()));
    REQUIRE (waitFor ([&] { return WindowRig::tabIn (*w.view, *w.stage, "Problems 1").has_value(); }));
    w.click ("Problems 1");
    const auto ask = [&] {
        w.click ("Choose file ...");
        REQUIRE (isDialogOpen());
        REQUIRE (dynamic_cast<juce::TextEditor*> (WindowRig::focused()) != nullptr);
    };
    ask();
    w.key ("escape");
    REQUIRE (waitFor ([] { return ! isDialogOpen(); }));
    CHECK (clipOf (w.graph()) == "gone/away.haptic");

    ask();
    w.stage->type (juce::String (heart.string()));
    w.key ("return");
    REQUIRE (waitFor ([&] { return clipOf (w.graph()) != "gone/away.haptic"; }));
    CHECK_FALSE (isDialogOpen());
    CHECK (fs::equivalent (folder / clipOf (w.graph()), heart));
    CHECK_FALSE (hasErrors (w.view->run().messages()));
    w.key ("ctrl + z");
    CHECK (clipOf (w.graph()) == "gone/away.haptic");
}

TEST_CASE ("a graph with a large mesh opens when its files are there, and the open graph goes on until then", "[app][files]")
{
    const TemporaryFolder folder;
    writePlate (folder, 50);
    WindowRig w ("dry_wood.json", 1280, 720, false);
    REQUIRE (waitFor ([&] { return w.view->run().isRunning(); }));
    w.view->open (folder / "plate.json");
    REQUIRE (w.view->asked().isOpen());
    CHECK (w.view->asked().title() == "Opening Plate");
    CHECK (w.graph().name == "Dry wood");
    CHECK (w.view->run().isRunning());
    REQUIRE (waitFor ([&] { return ! w.view->asked().isOpen(); }));
    CHECK (w.graph().name == "Plate");
    CHECK (w.view->document().file() == folder / "plate.json");
    CHECK (waitFor ([&] { return w.view->run().isRunning(); }));
}

TEST_CASE ("a user who cancels the loading of a large mesh keeps the open graph", "[app][files]")
{
    const TemporaryFolder folder;
    writePlate (folder, 50);
    WindowRig w ("dry_wood.json");
    w.view->open (folder / "plate.json");
    REQUIRE (w.view->asked().isOpen());
    w.view->asked().cancel();
    WindowRig::settle (100);
    CHECK_FALSE (w.view->asked().isOpen());
    CHECK (w.graph().name == "Dry wood");
    w.view->open (folder / "plate.json");   // and can open it later
    REQUIRE (waitFor ([&] { return w.graph().name == "Plate"; }));
}

TEST_CASE ("the window shares the open graph, and opens such a file as a copy", "[app][share]")
{
    const TemporaryFolder folder;
    WindowRig w ("heartbeat.json");
    fs::path proposed;
    w.view->chooseFile = [&] (bool saves, const fs::path& begin, const std::function<void (const fs::path&)>& chosen) {
        CHECK (saves);
        proposed = begin.filename();
        chosen (folder / "beat.tactus");
    };
    w.key ("ctrl + k");
    w.stage->type ("share as one file");
    w.key ("return");
    WindowRig::settle();
    CHECK (proposed == "Heartbeat.tactus");
    INFO (w.view->statusText());
    REQUIRE (fs::exists (folder / "beat.tactus"));

    w.key ("ctrl + n");
    REQUIRE (w.graph().name != "Heartbeat");
    w.view->open (folder / "beat.tactus");
    WindowRig::settle();
    CHECK (w.graph().name == "Heartbeat");
    CHECK (w.view->document().file().empty());
    CHECK (w.view->part<ProblemList>().messages().empty());

    folder.write ("bad.tactus", "no archive");
    w.view->open (folder / "bad.tactus");
    WindowRig::settle();
    CHECK (w.view->asked().isOpen());
    w.view->asked().cancel();
    CHECK (w.graph().name == "Heartbeat");
}

TEST_CASE ("fit panel: Cancel at the question about unsaved changes keeps the fit", "[app][fit]")
{
    WindowRig w ("dry_wood.json");
    REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    const auto* before = w.view->document().identity();
    const auto file = writeStrokes (w.home);
    auto& panel = w.view->part<FitPanel>();
    w.view->desk().fitRecording (file);
    REQUIRE (waitFor ([&] { return panel.fitted().has_value(); }, 5));
    w.click ("Open as new graph");
    REQUIRE (w.view->asked().isOpen());
    w.key ("escape");
    CHECK_FALSE (w.view->asked().isOpen());
    CHECK (panel.isOpen());
    CHECK (panel.fitted());
    CHECK (w.view->document().identity() == before);

    w.click ("Open as new graph");
    w.click ("Don't save");
    CHECK_FALSE (panel.isOpen());
    CHECK (w.view->document().identity() != before);
    CHECK (w.graph().root.find ("drag")->params.at ("mu").get<double>() == Approx (0.4).epsilon (0.05));

    // The fit has no file yet, so nothing throws it away without a question.
    const auto* fitted = w.view->document().identity();
    bool is_closed = false;
    const std::vector<std::function<void()>> acts { [&] { w.key ("ctrl + n"); },
                                                    [&] { w.view->open (TACTUS_SOURCE_DIR "/graphs/soft_pad.json"); },
                                                    [&] { w.view->closeWhenSaved ([&] { is_closed = true; }); } };
    for (const auto& act : acts)
    {
        act();
        REQUIRE (w.view->asked().isOpen());
        w.key ("escape");
        CHECK (w.view->document().identity() == fitted);
    }
    CHECK_FALSE (is_closed);
}

TEST_CASE ("fit panel: a CSV file that is dropped on the window opens the panel, other files do not", "[app][fit]")
{
    WindowRig w;
    const auto file = juce::String (writeStrokes (w.home).string());
    CHECK (w.view->isInterestedInFileDrag ({ file }));
    CHECK_FALSE (w.view->isInterestedInFileDrag ({ "picture.png" }));
    CHECK_FALSE (w.view->isInterestedInFileDrag ({ file, file }));
    auto& panel = w.view->part<FitPanel>();
    w.view->filesDropped ({ file }, 600, 300);
    CHECK (panel.isOpen());
    CHECK (waitFor ([&] { return panel.fitted().has_value(); }, 5));
    panel.close();
    w.view->open (file.toStdString());   // as named on the command line
    CHECK (panel.isOpen());
}
