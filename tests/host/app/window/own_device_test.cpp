// SPDX-License-Identifier: GPL-3.0-or-later
// What moves a tool if the user has a device for it and also a mouse, and what the window says about that.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
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

juce::ComboBox& listTitled (WindowRig& w, const char* title)
{
    auto* list = dynamic_cast<juce::ComboBox*> (w.titled (title));
    REQUIRE (list != nullptr);
    return *list;
}
}   // namespace

TEST_CASE ("a card of the devices panel says that the mouse moves the tool, and a device that is chosen there takes it", "[app][hand][sessions]")
{
    WindowRig w ("dry_wood.json", 1280, 900, false);
    auto& run = w.view->run();
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
    w.click ("Devices");
    CHECK (waitFor ([&] { return reads (w, "The device described in the graph is used"); }));
    CHECK_FALSE (reads (w, "Not in use"));

    listTitled (w, "What moves the tool").grabKeyboardFocus();
    w.key ("cursor down");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand::pointer(); }));
    CHECK (waitFor ([&] { return reads (w, "Not in use: the mouse or pen"); }));
    CHECK_FALSE (reads (w, "The device described in the graph is used"));
    CHECK (reads (w, "Hand."));   // the card has grown with its text

    listTitled (w, "device").grabKeyboardFocus();
    w.key ("cursor down");
    CHECK (listTitled (w, "device").getText() == "simulated tool");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand {}; }));
    CHECK (waitFor ([&] { return ! reads (w, "Not in use"); }));
    CHECK (waitFor ([&] { return listTitled (w, "What moves the tool").getText() == "Its own device"; }));
    CHECK (w.view->statusText().contains ("The device of stylus moves its tool from now on"));
    CHECK (w.view->part<HandPanel>().chosen() == LiveRun::Hand {});   // also in the next graph

    w.key ("ctrl + z");   // takes back the device, and what moved the tool
    CHECK (listTitled (w, "device").getText() == "as in the graph");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand::pointer(); }));
    CHECK (w.view->part<HandPanel>().chosen() == LiveRun::Hand::pointer());
    w.key ("ctrl + y");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand {}; }));
    CHECK (listTitled (w, "device").getText() == "simulated tool");
    // A hand that was chosen since then stays.
    REQUIRE (waitFor ([&] { return listTitled (w, "What moves the tool").getText() == "Its own device"; }));
    listTitled (w, "What moves the tool").grabKeyboardFocus();
    w.key ("cursor down");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand::pointer(); }));
    w.key ("cursor down");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand().kind == LiveRun::Hand::Kind::path; }));
    w.key ("ctrl + z");
    CHECK (listTitled (w, "device").getText() == "as in the graph");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::path);
    w.key ("ctrl + y");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::path);

    REQUIRE (waitFor ([&] { return run.isRunning(); }));
    listTitled (w, "What moves the tool").grabKeyboardFocus();
    w.key ("cursor up");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand::pointer(); }));
    run.stop();   // a stopped graph stays stopped
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    listTitled (w, "device").grabKeyboardFocus();
    w.key ("cursor up");
    CHECK (listTitled (w, "device").getText() == "as in the graph");
    CHECK (run.hand() == LiveRun::Hand {});
    CHECK_FALSE (run.isWanted());
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
        w.stage->click (w.stage->getLocalPoint (&w.view->part<WelcomePage>(), w.view->part<WelcomePage>().getChildComponent (3)->getBounds().getCentre()).toFloat());
        auto& run = w.view->run();
        REQUIRE (waitFor ([&] { return ! w.view->part<WelcomePage>().isVisible(); }));
        CHECK ((run.hand() == LiveRun::Hand::pointer()) != has_device);
        CHECK (w.view->statusText().contains ("The device chosen in the Devices panel moves the tool") == has_device);
        run.letGo();
    }
}
