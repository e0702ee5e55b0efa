// SPDX-License-Identifier: GPL-3.0-or-later
// The hand that moves the tool, from one graph to the next and into a take: the mouse, a gesture, or a device and its clutch. Presses that last.
#include "host/app/support/board_bench.hpp"
#include "host/app/support/film_steps.hpp"
#include "host/app/support/follows_mouse.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/devices_panel/devices_panel.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/gestures.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::BoardBench;
using tactus::host::test::followsMouse;
using tactus::host::test::mentions;
using tactus::host::test::showsText;
using tactus::host::test::stepsChecked;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
constexpr const char* with_simulated_stylus = R"({ "format": "tactus-session", "version": 1,
    "roles": { "stylus": { "driver": "gesture", "path": "tap" } } })";
constexpr const char* with_sound_card = R"({ "format": "tactus-session", "version": 1, "roles": { "stylus": { "driver": "audio" } } })";

struct Bench final : BoardBench<WindowRig>
{
    explicit Bench (const char* preset = "dry_wood.json", std::string of = "stylus") : BoardBench (preset, std::move (of))
    {
        showPanel();
        bind();
    }
    ~Bench() override { view->run().letGo(); }

    DevicesPanel& panel() override { return view->part<DevicesPanel>(); }
    LiveRun& run() override { return view->run(); }
    void showPanel() override { click ("Devices"); }
    SceneView& scene() { return view->part<HandPanel>().scene(); }

    void start()
    {
        view->canvas().grabKeyboardFocus();
        key ("F5");
        REQUIRE (isPushing());
    }
};
}   // namespace

TEST_CASE ("the mouse or the gesture that the user has chosen moves the next preset's tool, too, until the user chooses otherwise", "[app][hand]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& run = w.view->run();
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
    const auto list = [&] { return dynamic_cast<juce::ComboBox*> (w.titled ("What moves the tool")); };
    const auto choose = [&] (const char* key, const char* shown) {
        REQUIRE (list() != nullptr);
        list()->grabKeyboardFocus();
        w.key (key);
        CHECK (list()->getText() == shown);
    };
    const auto open = [&] (const char* preset) {
        w.key ("ctrl + f");
        w.stage->type (preset);
        WindowRig::settle();
        w.key ("return");
        REQUIRE (w.graph().name == preset);
        REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
        WindowRig::settle (100);
    };
    open ("Liver");
    CHECK (run.hand() == LiveRun::Hand {});

    choose ("cursor down", "Mouse or pen");
    open ("Soft pad");
    CHECK (run.hand() == LiveRun::Hand::pointer());
    CHECK (list()->getText() == "Mouse or pen");
    CHECK (followsMouse (w, run));
    open ("Velvet");
    CHECK (run.hand() == LiveRun::Hand::pointer());

    choose ("cursor down", ("Gesture: " + std::string (gestures()[0].id)).c_str());
    open ("Liver");
    CHECK (run.hand() == LiveRun::Hand { LiveRun::Hand::Kind::path, std::string (gestures()[0].id) });

    choose ("cursor up", "Mouse or pen");
    choose ("cursor up", "Its own device");
    open ("Soft pad");
    CHECK (run.hand() == LiveRun::Hand {});
    CHECK (followsMouse (w, run));   // a press takes the tool for this graph only
    CHECK (run.hand() == LiveRun::Hand::pointer());
    open ("Velvet");
    CHECK (run.hand() == LiveRun::Hand {});
    run.letGo();
}

TEST_CASE ("after a person has stopped a device of the session, a preset that is opened waits for START", "[app][sessions][safety]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false, with_simulated_stylus);
    auto& run = w.view->run();
    const auto open = [&] (const char* name) {
        w.key ("ctrl + f");
        w.stage->type (name);
        w.key ("return");
        REQUIRE (waitFor ([&] { return w.graph().name == name; }));
    };
    REQUIRE (waitFor ([&] { return run.isRunning(); }));
    open ("Oak board");
    CHECK (waitFor ([&] { return run.isRunning() && run.isOfOpenGraph(); }));   // the device was not stopped
    w.key ("escape");
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    open ("Granite wall");
    WindowRig::settle();
    CHECK_FALSE (run.isWanted());
    CHECK (waitFor ([&] { return mentions (*w.view, "Not running. Press START"); }));
    w.key ("F5");
    CHECK (waitFor ([&] { return run.isRunning() && run.isOfOpenGraph(); }));
    open ("Oak board");
    CHECK (waitFor ([&] { return run.isRunning() && run.isOfOpenGraph(); }));   // it was started again
    run.letGo();
}

TEST_CASE ("the welcome page promises the mouse only if no device of the user moves tools", "[app][welcome][sessions]")
{
    for (const auto& [session, has_device] : { std::pair { "", false }, { with_sound_card, false }, { with_simulated_stylus, true } })
    {
        WindowRig w ({}, 1280, 720, false, session);
        REQUIRE (w.view->part<WelcomePage>().isVisible());
        CHECK (waitFor ([&, device = has_device] { return mentions (*w.view, "moved by the device that you chose for it") == device; }));
        CHECK (mentions (*w.view, "with the mouse as your hand") != has_device);
        REQUIRE (w.view->part<WelcomePage>().cards().front().name == "Dry wood");
        auto& welcome = w.view->part<WelcomePage>();
        w.stage->click (w.middleOf (*welcome.getChildComponent (3)));
        auto& run = w.view->run();
        REQUIRE (waitFor ([&] { return ! w.view->part<WelcomePage>().isVisible(); }));
        CHECK ((run.hand() == LiveRun::Hand::pointer()) != has_device);
        CHECK (w.view->statusText().contains ("The device chosen in the Devices panel moves the tool") == has_device);
        run.letGo();
    }
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
    // While the force rises, the friction holds less, so the tool slides towards the hand. It is pressed as before.
    CHECK (waitFor ([&] { return run.tool() && run.tool()->force.z() == Approx (before.force.z()).epsilon (0.1); }));
    w.view->run().letGo();
}

TEST_CASE ("a tool that H holds is let go at a stop, so that the next start does not press, and when another graph opens", "[app][hand]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& run = w.view->run();
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    w.stage->move (w.middleOf (*surface));
    w.stage->press();
    REQUIRE (waitFor ([&] { return run.tool() && run.tool()->position.z() < 0.0; }));
    w.key ("h");
    w.stage->release();
    WindowRig::settle();
    REQUIRE (w.view->part<HandPanel>().view().isHeld());

    w.key ("escape");
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    REQUIRE (waitFor ([&] { return ! w.view->part<HandPanel>().view().isHeld(); }));
    w.key ("F5");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
    for (int i = 0; i < 20; ++i)
    {
        WindowRig::settle (10);
        REQUIRE (run.tool());
        CHECK (run.tool()->position.z() > 0.0);
    }
    w.stage->press();
    REQUIRE (waitFor ([&] { return run.tool() && run.tool()->position.z() < 0.0; }));
    w.key ("h");
    w.stage->release();
    WindowRig::settle();
    REQUIRE (w.view->part<HandPanel>().view().isHeld());
    w.view->document().open (loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph, {}, "open Bronze bell");
    CHECK (waitFor ([&] { return ! w.view->part<HandPanel>().view().isHeld(); }));
    run.letGo();
}

TEST_CASE ("pressing the surface before there is a graph starts nothing", "[app][mouse]")
{
    WindowRig w ({}, 1280, 720, false);
    REQUIRE (w.view->part<WelcomePage>().isVisible());
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto at = w.middleOf (*surface);
    w.stage->drag (at, at.translated (30.0f, 0.0f));
    WindowRig::settle (100);
    CHECK_FALSE (w.view->run().isWanted());
    CHECK (w.view->part<WelcomePage>().isVisible());
    CHECK (showsText (*w.titled ("Hand"), "Nothing to feel yet: choose a preset, or add a node."));

    w.click ("Dry wood");
    w.stage->drag (at, at.translated (30.0f, 0.0f));
    WindowRig::settle();
    CHECK (w.view->run().isWanted());
    w.view->run().letGo();
}

TEST_CASE ("Esc during a drag puts the node back, and stops the forces", "[app][mouse][safety]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& run = w.view->run();
    REQUIRE (run.isWanted());
    const auto node = [&]() -> const SceneNode& { return w.node ("grain"); };
    const auto place = node().at;
    const auto steps = w.view->document().history().position();
    const auto at = w.onStage (place + juce::Point<float> (40.0f, 14.0f));
    w.stage->hold();
    w.stage->move (at);
    w.stage->press();
    w.stage->move (at.translated (30.0f, 20.0f));
    w.stage->move (at.translated (60.0f, 40.0f));
    REQUIRE (node().at != place);
    w.key ("escape");
    CHECK (node().at == place);
    CHECK (w.view->document().history().position() == steps);
    CHECK_FALSE (run.isWanted());
    w.stage->move (at.translated (90.0f, 60.0f));
    w.stage->release();
    CHECK (node().at == place);
    run.letGo();
}

TEST_CASE ("a drag ends when another program gets the keyboard, because the window may not hear of the release", "[app][mouse][hand]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& run = w.view->run();
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto at = w.middleOf (*surface);
    w.stage->move (at);
    w.stage->press();
    w.stage->move (at.translated (5.0f, 0.0f));
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool() && run.tool()->position.z() < 0.0; }));
    w.stage->loseKeyboard();
    WindowRig::settle();
    CHECK (waitFor ([&] { return run.tool() && run.tool()->position.z() > 0.0; }));

    // Nor does a drag on the canvas go on.
    w.stage->release();
    w.stage->regainKeyboard();
    const auto board = w.node ("board").bounds();
    const auto header = w.onStage (board.getCentre().withY (board.getY() + 8.0f));
    w.stage->move (header);
    w.stage->press();
    w.stage->loseKeyboard();
    WindowRig::settle();
    const auto before = w.view->document().history().position();
    w.stage->move (header.translated (40.0f, 40.0f));
    CHECK (w.view->document().history().position() == before);
    w.stage->release();
}

TEST_CASE ("S moves the workspace with the hand while it is held, and the force does not step", "[app][sessions][safety]")
{
    Bench w;
    w.start();
    w.view->canvas().grabKeyboardFocus();
    const auto hold = [&] {   // a key that is held is repeated
        w.stage->key ("s");
        WindowRig::settle (10);
        w.stage->keyUp();   // as some systems do between two repetitions
        w.stage->key ("s");
    };
    REQUIRE (w.until ([&] {
        hold();
        return w.force() == 0.0;
    }));
    CHECK (w.view->statusText().contains ("until you release S"));
    const auto& strip = w.view->part<SafetyStrip>();
    CHECK (w.until ([&] {
        hold();
        return strip.guardText().contains ("its workspace is being moved");
    }));
    CHECK_FALSE (strip.isAlarmed());   // it is what the person wants
    const auto after = [&] (std::uint64_t more) {
        return w.until ([&, from = w.ticks()] {
            hold();
            return w.ticks() > from + more;
        });
    };
    REQUIRE (after (10));
    const auto place = w.view->run().tool()->position;
    for (int i = 0; i < 10; ++i)
    {
        REQUIRE (after (100));
        CHECK (w.force() == 0.0);
        CHECK (w.view->run().tool()->position == place);   // the circle goes on, but not in the graph
    }
    w.stage->keyUp();
    CHECK (w.until ([&] { return w.force() > 0.0 && ! strip.guardText().contains ("being moved"); }));
    CHECK (w.origin().norm() > 1e-4);
    CHECK (stepsChecked (w.view->run()) == 0);   // nor does the tool jump
    CHECK_FALSE (w.workspace().contains ("offset"));

    SECTION ("in the scene, too, until something else gets the keyboard")
    {
        w.scene().grabKeyboardFocus();
        w.stage->key ("s");
        REQUIRE (w.until ([&] { return w.force() == 0.0; }));
        auto& field = w.field ("scale");
        w.stage->click (w.middleOf (field));
        CHECK (w.until ([&] { return w.force() > 0.0; }));
        w.stage->key ("s");   // is text now
        CHECK (field.getText() == "s");
        CHECK_FALSE (w.view->statusText().contains ("until you release S"));
        w.key ("escape");
    }
    SECTION ("but not without a device of the session")
    {
        w.panel().bindings().bind ("stylus", "as in the graph");
        REQUIRE (w.until ([&] { return w.view->run().isRunning() && w.force() > 0.0; }));
        w.view->canvas().grabKeyboardFocus();
        w.stage->key ("s");
        CHECK (w.view->statusText().contains ("bind one"));
        WindowRig::settle (100);
        CHECK (w.until ([&] { return w.force() > 0.0; }));   // the stroke presses again
    }
    SECTION ("and a STOP stops")
    {
        w.stage->key ("s");
        w.key ("shift + escape");
        w.stage->keyUp();
        REQUIRE (w.until ([&] { return w.view->run().isStoppedForGood() && w.force() == 0.0; }));
        WindowRig::settle (200);
        CHECK (w.force() == 0.0);
    }
}

TEST_CASE ("the help lists the key of the clutch", "[app][sessions]")
{
    WindowRig w ("dry_wood.json");
    w.view->canvas().grabKeyboardFocus();
    w.key ("F1");
    auto& help = w.view->part<HelpPanel>();
    REQUIRE (help.isOpen());
    help.setArea (help.getBounds().withHeight (10'000));   // however many keys panels have, no line is scrolled away
    CHECK (mentions (help, "S, held"));
}
