// SPDX-License-Identifier: GPL-3.0-or-later
// The Take tab in the whole window, with a mouse.
#include "host/app/support/wait_for.hpp"

#include <host/assets/file_assets.hpp>
#include <tactus/run/log/stretch.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::latestStep;
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

namespace
{
/// A window that records a take of the running graph.
struct Recorder
{
    WindowRig w { "dry_wood.json", 1280, 720, false };
    LiveRun& run { w.view->run() };
    TakePanel& panel { w.view->takePanel() };
    Take& take { panel.take() };

    Recorder()
    {
        w.click ("Take");
        record();
    }
    ~Recorder()
    {
        if (w.view) w.view->run().letGo();
    }

    void record()
    {
        w.click ("Record");
        REQUIRE (waitFor ([&] { return run.isLogged() && hasCurve(); }));
    }

    bool hasCurve() { return panel.plot().length() > 0.05; }
    bool isReady() { return take.state() == Take::State::ready && hasCurve(); }

    /// The mouse goes down right of the middle of the surface, and stays down.
    void press()
    {
        auto* surface = w.titled ("Surface");
        REQUIRE (surface != nullptr);
        w.stage->hold();
        w.stage->move (w.middleOf (*surface).translated (60.0f, 0.0f));
        w.stage->press();
    }

    /// Chooses from the list of takes.
    void choose (int steps) { w.choose (w.middleOf (*w.titled ("Takes")), steps, juce::ModifierKeys::leftButtonModifier); }
};

/// Where the hand was when it was lowest.
Vec3 lowest (const std::filesystem::path& log, const std::string& program)
{
    FileAssets assets;
    Messages warnings;
    const auto played = readStretch (log.string(), { .role = "stylus", .assets = &assets, .program = program }, warnings);
    REQUIRE (played);
    REQUIRE (played->ticks() > 0);
    Vec3 place (0.0, 0.0, 1.0);
    for (auto row = played->movement.begin(); row != played->movement.end(); row += static_cast<std::ptrdiff_t> (played->columns.size()))
        if (row[3] < place.z()) place = Vec3 (row[1], row[2], row[3]);
    return place;
}
}   // namespace

TEST_CASE ("who presses the surface during a take takes the tool\\, and the take begins again\\; the one before stays in the list", "[app][take]")
{
    Recorder r;
    REQUIRE (r.run.hand().kind == LiveRun::Hand::Kind::described);
    const auto first = r.take.recorded();
    r.press();
    REQUIRE (waitFor ([&] { return r.take.recorded() != first; }));
    CHECK (r.run.hand().kind == LiveRun::Hand::Kind::pointer);
    CHECK (r.take.state() == Take::State::recording);
    CHECK (r.w.view->statusText().contains ("so does the take"));
    CHECK (first->length_s > 0.05);
    REQUIRE (waitFor ([&] { return r.hasCurve() && r.run.tool() && r.run.tool()->position.z() < -0.1e-3; }));
    const double x = r.run.tool()->position.x();
    CHECK (x > 5e-3);
    r.w.stage->release();
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.run.isRunning());
    CHECK (r.take.seconds() == r.panel.plot().length());
    CHECK (r.panel.unsaved() == std::vector { first, r.take.recorded() });
    const auto place = lowest (r.take.log(), r.take.program);   // what the mouse did
    CHECK (place.z() < -0.1e-3);
    CHECK (place.x() == Approx (x).margin (0.01));

    r.choose (1);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.take.recorded() == first);
    CHECK (r.take.seconds() == r.panel.plot().length());
    CHECK (latestStep (r.w.view->document()) == "record a take");
    r.w.key ("ctrl + z");
    r.w.key ("ctrl + z");
    CHECK (r.take.state() == Take::State::empty);
    CHECK (r.panel.unsaved().size() == 2);
}

TEST_CASE ("Shift+Esc after a press during a take stops the forces for good", "[app][take][safety]")
{
    const int waits = GENERATE (range (0, 5));
    INFO (waits);
    Recorder r;
    r.press();
    for (int n = 0; n < waits; ++n)
        WindowRig::settle (11);
    r.w.key ("shift + escape");
    r.w.stage->release();
    for (int n = 0; n < 30; ++n)
    {
        WindowRig::settle (10);
        CHECK (r.run.isHeld());
        CHECK ((! r.run.isWanted() || r.run.isRunning()));   // it has not begun again since
    }
    CHECK ((! r.run.isRunning() || r.run.isStoppedForGood()));
    CHECK_FALSE (r.panel.unsaved().empty());
}

TEST_CASE ("a take that was undone is not lost by the next edit", "[app][take][undo]")
{
    Recorder r;
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    const auto take = r.take.recorded();
    r.w.key ("ctrl + z");
    CHECK (r.take.state() == Take::State::empty);
    r.w.key ("ctrl + 3");   // stores a snapshot, after which there is nothing to redo
    REQUIRE (r.w.view->document().history().position() == r.w.view->document().history().size());
    r.choose (1);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.take.recorded() == take);
}

TEST_CASE ("an undo during a take keeps what was recorded", "[app][take][undo]")
{
    Recorder r;
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    r.record();
    r.w.key ("ctrl + z");
    CHECK (r.take.state() == Take::State::empty);
    CHECK (r.run.isRunning());
    CHECK (r.w.view->statusText().contains ("list of takes"));
    CHECK (r.panel.unsaved().size() == 2);
    r.choose (2);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.take.recorded() == r.panel.unsaved().back());
}

TEST_CASE ("a take that ends with the run says so\\, and has the length of what it holds", "[app][take]")
{
    Recorder r;
    SECTION ("STOP") { r.w.click ("STOP"); }
    SECTION ("another graph") { r.w.view->open (TACTUS_SOURCE_DIR "/graphs/soft_pad.json"); }
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.w.view->statusText().contains ("ended with the run"));
    CHECK (r.take.seconds() == r.panel.plot().length());
    CHECK (r.panel.unsaved().size() == 1);
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
    const auto third = record (0.05);   // in place of the second one, which stays in the list
    CHECK (shows (third));
    CHECK (std::filesystem::exists (second.first));
    CHECK (std::filesystem::exists (first.first));
    w.view->run().letGo();
    w.view.reset();
    CHECK_FALSE (std::filesystem::exists (third.first));
    CHECK_FALSE (std::filesystem::exists (second.first));
    CHECK_FALSE (std::filesystem::exists (first.first));
}
