// SPDX-License-Identifier: GPL-3.0-or-later
// Files that settings name, in the whole window: a saved graph finds them again, and a missing one is chosen where it is missed.
#include "host/app/support/window_rig.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <fstream>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;
namespace fs = std::filesystem;

namespace
{
const fs::path heart = TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic", clip_template = TACTUS_SOURCE_DIR "/graphs/templates/clip.json";

bool isDialogOpen() { return juce::Component::getNumCurrentlyModalComponents() > 0; }

/// Where a node is on the screen.
juce::Point<float> placeOf (WindowRig& w, const std::string& name)
{
    auto& canvas = w.view->canvas();
    const auto node = std::ranges::find (canvas.scene().nodes(), name, &SceneNode::name);
    REQUIRE (node != canvas.scene().nodes().end());
    return w.stage->getLocalPoint (&canvas, canvas.view().toPixels (node->bounds().getCentre()));
}

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
    w.stage->drop (file.string(), placeOf (w, "clip"));
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
}   // namespace

TEST_CASE ("a graph that is saved elsewhere finds its clip again, also one that was chosen since", "[app][files]")
{
    const TemporaryFolder mine;
    setenv ("TACTUS_GRAPHS", mine.path().c_str(), 1);
    {
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
    unsetenv ("TACTUS_GRAPHS");
}

TEST_CASE ("an unsaved graph that is recovered finds its clip again", "[app][files][recovery]")
{
    const TemporaryFolder folder, home;
    {
        juce::ScopedJuceInitialiser_GUI gui;
        Document document { graph::Graph {} };
        Question question;
        Settings settings;
        Files::Callbacks callbacks {};
        callbacks.notify = [] (const juce::String&) {};
        callbacks.stop = callbacks.onSettings = [] {};
        callbacks.run = [] (bool) {};
        callbacks.isRunning = callbacks.isByPointer = [] { return false; };
        Files files { document, question, settings, std::move (callbacks) };
        files.beginSession (home.path());
        files.open (heart);   // a graph that plays it, without a file
        REQUIRE (document.perform (graph::SetHeader { .name = "Mine" }));
        files.finishAutosave();
        files.endSuddenly();
    }
    auto crashed = findCrashedSessions (home.path());
    REQUIRE (crashed.size() == 1);
    const auto restored = restore (crashed.front().document()).graph;
    FileAssets assets;
    CHECK (compile (restored, catalogue(), { .assets = &assets }).plan != nullptr);
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
