// SPDX-License-Identifier: GPL-3.0-or-later
// The Take tab in the whole window, with a mouse.
#include "host/app/support/window_rig.hpp"

#include <host/app/take/take_panel.hpp>
#include <host/base/assets/file_assets.hpp>
#include <tactus/run/log/stretch.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::latestStep;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

TEST_CASE ("a take shows its curve while it records, Stop ends the take and not the graph, and what is saved can be used at once", "[app][take]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    setenv ("TACTUS_GRAPHS", w.home.path().c_str(), 1);
    auto& run = w.view->run();
    auto& panel = w.view->part<TakePanel>();
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
    w.key ("ctrl + z");   // the previous hand moves the tool again, and the take stays
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

TEST_CASE ("a take that begins while the tool is held in a surface gives no knock: the tool stays where it is, and its force fades over", "[app][take]")
{
    const auto* graph = GENERATE ("templates/press.json", "dry_wood.json", "granite_wall.json");
    CAPTURE (graph);
    WindowRig w (graph, 1280, 720, false);
    auto& run = w.view->run();
    REQUIRE (waitFor ([&] { return run.tool().has_value(); }));
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    w.stage->move (w.middleOf (*surface));
    w.stage->press();
    REQUIRE (waitFor ([&] { return run.hand() == LiveRun::Hand::pointer() && run.tool() && run.tool()->force.norm() > 0.02; }));
    w.key ("h");
    w.stage->release();
    w.click ("Take");
    int steady = 0;
    REQUIRE (waitFor ([&] {   // until the guard has let all of the force through and the tool rests, which takes longer on a busy computer
        const double now = run.tool()->force.norm();
        WindowRig::settle (250);
        steady = run.tool()->force.norm() == Approx (now).epsilon (0.01) ? steady + 1 : 0;
        return steady >= 3;
    }));
    const auto before = *run.tool();
    REQUIRE (before.force.norm() > 0.02);
    const auto ticks = [&] { return run.status() ? run.status()->ticks : 0; };
    const auto ticks_before = ticks();
    w.click ("Record");
    double most = 0.0, least = 1e3, farthest = 0.0;
    bool has_begun_again = false;
    auto seen = run.tool();
    seen.reset();
    for (int i = 0; i < 1500 && ! (has_begun_again && ticks() > 8000); ++i)   // for 2 s; a take ends after 60 s
    {
        WindowRig::settle (1);
        has_begun_again = has_begun_again || ticks() < ticks_before;
        // The guard counts time and the simulation ticks, so a computer that was too busy for a tick makes the tool jump. Such a take is not judged.
        const bool is_on_time = has_begun_again && run.status() && run.status()->misses == 0;
        if (seen && is_on_time)   // a tick that is late shows only after the tool of that tick, so the tool of the last time is judged
        {
            most = std::max (most, seen->force.norm());
            least = std::min (least, seen->force.norm());
            farthest = std::max (farthest, (seen->position - before.position).norm());
        }
        seen = has_begun_again ? run.tool() : std::nullopt;
    }
    CHECK (has_begun_again);
    CHECK (run.isLogged());
    CHECK (most < 1.1 * before.force.norm());
    CHECK (farthest < 2e-3);
    CHECK (waitFor ([&] { return run.tool() && run.tool()->force.norm() == Approx (before.force.norm()).epsilon (0.1); }));
    w.view->run().letGo();
}

namespace
{
/// A window that records a take of the running graph.
struct Recorder
{
    WindowRig w { "dry_wood.json", 1280, 720, false };
    LiveRun& run { w.view->run() };
    TakePanel& panel { w.view->part<TakePanel>() };
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

TEST_CASE ("a press on the surface during a take takes the tool: the take begins again, and the one before stays in the list", "[app][take]")
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

TEST_CASE ("a take that ends with the run says so, and has the length of what it holds", "[app][take]")
{
    Recorder r;
    SECTION ("STOP") { r.w.click ("STOP"); }
    SECTION ("another graph") { r.w.view->open (TACTUS_SOURCE_DIR "/graphs/soft_pad.json"); }
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.w.view->statusText().contains ("ended with the run"));
    CHECK (r.take.seconds() == r.panel.plot().length());
    CHECK (r.panel.unsaved().size() == 1);
}

TEST_CASE ("a take can be undone, which brings back the one before", "[app][take]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& panel = w.view->part<TakePanel>();
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

TEST_CASE ("a signal or a crash loses no take: the next start offers it", "[app][take][recovery]")
{
    Recorder r;
    const bool is_crash = GENERATE (false, true), is_complete = GENERATE (false, true);
    INFO ((is_crash ? "crash, " : "signal, ") << (is_complete ? "complete" : "recording"));
    if (is_complete)
    {
        r.w.click ("Stop");
        REQUIRE (waitFor ([&] { return r.isReady(); }));
    }
    REQUIRE (waitFor ([&] { return std::filesystem::file_size (r.take.log()) > 10000; }));
    const auto sessions = r.w.home / "sessions";
    const auto own = std::filesystem::directory_iterator (sessions)->path();
    if (is_crash)   // what is on the disk now
        std::filesystem::copy (own, sessions / "crashed", std::filesystem::copy_options::recursive);
    else
        r.w.view->closeSuddenly();
    const auto left = r.take.log();
    r.w.view.reset();
    CHECK (std::filesystem::exists (left) == ! is_crash);
    if (is_crash) std::filesystem::remove_all (own);

    auto& w = r.w;
    w.view = std::make_unique<MainView> (catalogue());
    w.stage->fill (*w.view);
    w.view->begin ({ .home = w.home.path() });
    WindowRig::settle();
    REQUIRE (w.view->asked().isOpen());
    CHECK (w.view->asked().getDescription().contains ("A take was not saved."));
    w.click ("Recover without running");
    auto& panel = w.view->part<TakePanel>();
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready && panel.plot().length() > 0.05; }));
    CHECK (panel.unsaved() == std::vector { panel.take().recorded() });
    CHECK (panel.port() == "motor.force");
    CHECK_FALSE (std::filesystem::exists (sessions / "crashed"));
    CHECK_FALSE (std::filesystem::exists (left));
    CHECK (lowest (panel.take().log(), panel.take().program).z() < 0.01);
    w.view->chooseFile = [&] (bool, const std::filesystem::path&, const std::function<void (const std::filesystem::path&)>& chosen) {
        chosen (w.home / "gesture.csv");
    };
    w.click ("Take");
    w.click ("Make a gesture...");   // as of any other take
    REQUIRE (waitFor ([&] { return w.view->asked().isOpen(); }));
}

TEST_CASE ("a take that was saved as a gesture raises no question after a crash", "[app][take][recovery]")
{
    Recorder r;
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    r.w.view->chooseFile = [&] (bool, const std::filesystem::path&, const std::function<void (const std::filesystem::path&)>& chosen) {
        chosen (r.w.home / "gesture.csv");
    };
    r.w.click ("Make a gesture...");
    REQUIRE (waitFor ([&] { return r.w.view->asked().isOpen(); }));
    const auto sessions = r.w.home / "sessions";
    const auto own = std::filesystem::directory_iterator (sessions)->path();
    std::filesystem::copy (own, sessions / "crashed", std::filesystem::copy_options::recursive);
    r.w.view.reset();
    std::filesystem::remove_all (own);
    r.w.view = std::make_unique<MainView> (catalogue());
    r.w.stage->fill (*r.w.view);
    r.w.view->begin ({ .home = r.w.home.path() });
    WindowRig::settle();
    CHECK_FALSE (r.w.view->asked().getDescription().contains ("take"));
}

TEST_CASE ("a take is saved from the list, and opened again, also with another graph", "[app][take]")
{
    Recorder r;
    bool saves = false;
    auto file = r.w.home / "wood.jsonl";
    r.w.view->chooseFile = [&] (bool to_save, const std::filesystem::path& begin, const std::function<void (const std::filesystem::path&)>& chosen) {
        saves = to_save;
        CHECK (begin.filename() == "take.jsonl");
        chosen (file);
    };
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    const double length = r.panel.plot().length();
    const auto port = r.panel.port();
    r.choose (2);
    CHECK (saves);
    REQUIRE (std::filesystem::exists (file));
    CHECK (r.panel.unsaved().empty());

    r.w.view->open (TACTUS_SOURCE_DIR "/graphs/layered_cloth.json");
    r.choose (3);
    CHECK_FALSE (saves);
    REQUIRE (waitFor ([&] { return r.isReady() && r.take.log() == file; }));
    CHECK (r.panel.plot().length() == length);
    CHECK (r.take.seconds() == length);
    CHECK (r.panel.port() == port);
    CHECK (r.take.role() == "stylus");
    CHECK (r.panel.unsaved().empty());

    file = r.w.home / "broken.jsonl";
    r.w.home.write ("broken.jsonl", "{}\n");
    r.choose (4);
    REQUIRE (r.w.view->asked().isOpen());
    CHECK (r.w.view->asked().title() == "Cannot open broken.jsonl");
    CHECK (r.w.view->asked().getDescription().contains ("broken.jsonl:1"));
    r.w.click ("Close");
    CHECK (r.take.log() != file);
    CHECK (r.isReady());
    r.w.view.reset();
    CHECK (std::filesystem::exists (r.w.home / "wood.jsonl"));   // the file of the user
}
