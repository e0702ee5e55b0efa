// SPDX-License-Identifier: GPL-3.0-or-later
// What helps to begin: templates, the tour, and the list of nodes.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/browser/browser.hpp>
#include <host/app/node_list/node_list.hpp>
#include <host/app/problems/unfelt.hpp>
#include <host/app/storage/settings.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::mentions;
using tactus::host::test::showsText;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
const std::filesystem::path templates = TACTUS_SOURCE_DIR "/graphs/templates";
}   // namespace

TEST_CASE ("an empty graph offers five templates, each of which can be felt at once", "[app][beginnings]")
{
    WindowRig w;
    w.key ("ctrl + n");
    auto& row = w.view->part<TemplateRow>();
    REQUIRE (row.isShowing());
    std::vector<std::string> names;
    for (const auto& t : row.all())
        names.push_back (t.name);
    CHECK (names == std::vector<std::string> { "Press", "Stroke", "Tap", "Cut", "Clip" });
    for (const auto& p : w.view->part<PresetBrowser>().shipped())
        CHECK (std::ranges::count (names, p.name) == 0);   // they are no presets

    const auto name = GENERATE (as<juce::String>(), "Press", "Stroke", "Tap", "Cut", "Clip");
    INFO (name);
    w.click (name);
    CHECK (w.graph().name == name.toStdString());
    CHECK (w.view->document().file().empty());   // it has to be saved elsewhere
    CHECK_FALSE (w.view->document().isChanged());
    CHECK_FALSE (row.isShowing());
    CHECK_FALSE (hasErrors (w.view->run().messages()));
    for (const auto& m : unfelt (w.graph(), catalogue()))
        FAIL_CHECK (m.text);
    w.key ("ctrl + z");
    CHECK (w.graph().root.nodes.empty());
    CHECK (row.isShowing());
}

TEST_CASE ("the search opens every preset from the first page, not only those with a card", "[app][beginnings]")
{
    WindowRig w;
    REQUIRE (w.view->part<WelcomePage>().isShowing());
    w.key ("ctrl + k");
    w.stage->type ("canvas weave");
    WindowRig::settle();
    w.key ("return");
    WindowRig::settle();
    CHECK (w.graph().name == "Canvas weave");
    CHECK_FALSE (w.view->part<WelcomePage>().isShowing());
}

TEST_CASE ("each template gives a force or a vibration when its own hand moves", "[app][beginnings]")
{
    for (const auto& entry : std::filesystem::directory_iterator (templates))
    {
        if (entry.path().extension() != ".json") continue;
        INFO (entry.path().filename().string());
        WindowRig w;
        w.key ("ctrl + n");
        w.view->open (entry.path());
        w.key ("f5");
        double most = 0.0;
        CHECK (waitFor ([&] {
            if (const auto tool = w.view->run().tool()) most = std::max (most, tool->force.norm());
            return most > 0.1;
        }));
        w.view->run().letGo();
    }
}

TEST_CASE ("a template is chosen by keys in the palette, where the name of a node comes first", "[app][beginnings]")
{
    WindowRig w;
    w.key ("ctrl + n");
    w.key ("spacebar");
    WindowRig::settle();
    CHECK_FALSE (mentions (*w.view, TACTUS_SOURCE_DIR));
    w.stage->type ("strok");
    w.key ("return");
    CHECK (w.graph().name == "Stroke");

    w.key ("ctrl + n");
    w.key ("spacebar");
    w.stage->type ("clip");
    w.key ("return");
    REQUIRE (w.graph().root.nodes.size() == 1);
    CHECK (w.graph().root.nodes[0].type == "signal.clip");
    w.key ("spacebar");   // no longer empty: no templates
    w.stage->type ("strok");
    CHECK_FALSE (showsText (*w.view, "Stroke"));
    w.key ("escape");
}

TEST_CASE ("the tour has five steps on parts of the window, goes on by keys, and is offered until it was seen", "[app][beginnings]")
{
    WindowRig w;
    auto& tour = w.view->part<Tour>();
    w.click ("Show me around");
    REQUIRE (tour.isOpen());
    CHECK (w.graph().name == "Dry wood");   // something to feel
    CHECK (tour.hasKeyboardFocus (true));
    std::set<juce::String> titles;
    for (std::size_t i = 0; i < 5; ++i)
    {
        REQUIRE (tour.isOpen());
        CHECK (tour.step() == i);
        titles.insert (tour.getDescription());
        i % 2 == 0 ? w.key ("return") : w.click (i == 4 ? "Done" : "Next");
    }
    CHECK (titles.size() == 5);
    CHECK_FALSE (tour.isOpen());
    CHECK (w.view->canvas().hasKeyboardFocus (true));

    WindowRig::settle (1500);   // the settings are saved a little later
    CHECK (loadSettings (w.home.path()).settings.toured);

    w.key ("shift + F1");   // again
    REQUIRE (tour.isOpen());
    w.key ("cursor right");
    w.key ("cursor left");
    CHECK (tour.step() == 0);
    const auto node = w.view->canvas().scene().nodes().front().bounds().getCentre();   // the window stays usable
    w.stage->click (w.onStage (node));
    CHECK (w.view->canvas().selection().size() == 1);
    CHECK (tour.isOpen());
    w.key ("escape");
    CHECK_FALSE (tour.isOpen());
    CHECK (w.view->canvas().selection().size() == 1);
}

TEST_CASE ("the tour that was seen is not offered at the next start", "[app][beginnings]")
{
    const TemporaryFolder home;
    Settings seen;
    seen.toured = true;
    REQUIRE (saveSettings (seen, home.path()));
    WindowRig w;
    CHECK (WindowRig::buttonIn (*w.view, "Show me around") != nullptr);
    MainView other (catalogue());
    w.stage->fill (other);
    other.begin ({ .home = home.path(), .safe = true });
    CHECK (other.part<WelcomePage>().isShowing());
    CHECK (WindowRig::buttonIn (other, "Show me around") == nullptr);
    CHECK (WindowRig::buttonIn (other, "New empty graph") != nullptr);
}
