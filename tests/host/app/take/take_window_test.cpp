// SPDX-License-Identifier: GPL-3.0-or-later
// The Take tab in the whole window, with a mouse.
#include "host/app/support/wait_for.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

TEST_CASE ("a take shows its curve while it records\\, and Stop ends the take and not the graph; what is saved can be used now", "[app][take]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    setenv ("TACTUS_GRAPHS", w.home.path().c_str(), 1);
    auto& run = w.view->run();
    auto& panel = w.view->takePanel();
    w.view->chooseFile = [&] (bool, const std::filesystem::path& begin, const std::function<void (const std::filesystem::path&)>& chosen) {
        chosen (w.home / begin.filename().string());
    };
    const auto ticks = [&] { return run.status() ? run.status()->ticks : 0; };
    w.click ("Take");
    w.click ("Record");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::recording && panel.plot().length() > 0.05; }));
    w.click ("Stop");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready; }));
    CHECK (run.isRunning());
    const auto before = ticks();
    CHECK (waitFor ([&] { return ticks() > before + 400; }));
    CHECK (panel.plot().length() > 0.05);

    w.click ("Make a gesture...");
    REQUIRE (waitFor ([&] { return w.view->asked().isOpen(); }));
    w.click ("Use now");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::path);
    CHECK (run.hand().path == (w.home / "gesture.csv").string());
    w.key ("ctrl + z");   // the hand of before moves the tool again; the take stays
    CHECK (run.hand().kind == LiveRun::Hand::Kind::described);
    WindowRig::settle (200);
    CHECK_FALSE (w.view->asked().isOpen());
    CHECK (panel.take().state() == Take::State::ready);
    CHECK (panel.plot().length() > 0.05);
    w.key ("ctrl + z");   // and then the take
    CHECK (panel.take().state() == Take::State::empty);
    WindowRig::settle (200);
    CHECK_FALSE (w.view->asked().isOpen());
    w.key ("ctrl + y");
    w.key ("ctrl + y");
    CHECK (run.hand().path == (w.home / "gesture.csv").string());
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready && panel.plot().length() > 0.05; }));

    w.click ("Make a test...");
    REQUIRE (waitFor ([&] { return w.view->asked().isOpen(); }));
    w.click ("Use now");
    REQUIRE (waitFor ([&] { return w.view->asked().isOpen(); }));
    CHECK (w.view->asked().getTitle().contains ("passes"));
    w.click ("Close");

    w.click ("Make a clip...");
    REQUIRE (waitFor ([&] { return w.view->asked().isOpen(); }));
    const auto named = w.view->asked().getDescription().fromFirstOccurrenceOf ("set the gain of signal.clip to ", false, false);
    w.click ("Use now");
    const auto clip = std::ranges::find (w.graph().root.nodes, "signal.clip", &graph::Node::type);
    REQUIRE (clip != w.graph().root.nodes.end());
    CHECK (clip->settings.at ("clip").asString().ends_with ("take.wav"));
    const auto gain = clip->params.at ("gain").asString();   // as strong as it was recorded
    INFO (gain << " | " << named);
    CHECK (gain.ends_with (" N"));
    CHECK ((named.isEmpty() ? gain == "1 N" : named.startsWith (juce::String (gain).dropLastCharacters (2))));
    run.letGo();
    unsetenv ("TACTUS_GRAPHS");
}

TEST_CASE ("a take can be undone\\, which brings back the one before", "[app][take]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& panel = w.view->takePanel();
    w.click ("Take");
    const auto record = [&] (double seconds) {
        w.click ("Record");
        REQUIRE (waitFor ([&] { return std::filesystem::exists (panel.take().log()); }));   // the run has begun again
        REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::recording && panel.plot().length() > seconds; }));
        w.click ("Stop");
        REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready; }));
        return std::pair (panel.take().log(), panel.plot().length());
    };
    const auto shows = [&] (const std::pair<std::filesystem::path, double>& take) {
        return waitFor ([&] { return panel.take().state() == Take::State::ready && panel.plot().length() == take.second; }) && panel.take().log() == take.first
               && std::filesystem::exists (take.first);
    };
    const auto first = record (0.05), second = record (0.05);
    CHECK (first.first != second.first);
    const auto graph = &w.graph();
    w.view->document().undo();
    CHECK (shows (first));
    CHECK (&w.graph() == graph);
    w.view->document().undo();
    CHECK (panel.take().state() == Take::State::empty);
    CHECK (panel.plot().length() == 0.0);
    w.view->document().goTo (w.view->document().history().names().size());
    CHECK (shows (second));
    w.view->document().undo();
    CHECK (shows (first));
    const auto third = record (0.05);   // in place of the second one, whose log goes with its step
    CHECK (shows (third));
    CHECK_FALSE (std::filesystem::exists (second.first));
    CHECK (std::filesystem::exists (first.first));
    w.view->run().letGo();
    w.view.reset();
    CHECK_FALSE (std::filesystem::exists (third.first));
    CHECK_FALSE (std::filesystem::exists (first.first));
}
