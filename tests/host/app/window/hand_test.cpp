// SPDX-License-Identifier: GPL-3.0-or-later
// The hand that moves the tool, from one graph to the next and into a take: the mouse, a gesture or a device.
#include "host/app/support/follows_mouse.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <tactus/run/device/gestures.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::followsMouse;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
constexpr const char* with_simulated_stylus = R"({ "format": "tactus-session", "version": 1,
    "roles": { "stylus": { "driver": "gesture", "path": "tap" } } })";
constexpr const char* with_sound_card = R"({ "format": "tactus-session", "version": 1, "roles": { "stylus": { "driver": "audio" } } })";

bool reads (WindowRig& w, const char* text)
{
    const auto texts = tactus::host::test::readTexts (*w.view);
    return std::ranges::any_of (texts, [&] (const auto& t) { return t.text.contains (text); });
}
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

TEST_CASE ("the welcome page promises the mouse only if no device of the user moves tools", "[app][welcome][sessions]")
{
    for (const auto& [session, has_device] : { std::pair { "", false }, { with_sound_card, false }, { with_simulated_stylus, true } })
    {
        WindowRig w ({}, 1280, 720, false, session);
        REQUIRE (w.view->part<WelcomePage>().isVisible());
        CHECK (waitFor ([&, device = has_device] { return reads (w, "moved by the device that you chose for it") == device; }));
        CHECK (reads (w, "with the mouse as your hand") != has_device);
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
    CHECK (waitFor ([&] { return run.tool() && run.tool()->force.norm() == Approx (before.force.norm()).epsilon (0.1); }));
    w.view->run().letGo();
}
