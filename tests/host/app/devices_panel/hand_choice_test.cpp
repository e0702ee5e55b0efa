// SPDX-License-Identifier: GPL-3.0-or-later
// The hand of a tool for which the user has a device and also a mouse, and the words of the panels about it.
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/devices_panel/devices_panel.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::mentions;
using tactus::host::test::waitFor;

namespace
{
juce::ComboBox& listTitled (DeskStage& w, const char* title)
{
    auto* list = dynamic_cast<juce::ComboBox*> (w.titled (title));
    REQUIRE (list != nullptr);
    return *list;
}
}   // namespace

TEST_CASE ("a card of the devices panel says that the mouse moves the tool, and a device that is chosen there takes it", "[app][hand][sessions]")
{
    DeskStage w ("dry_wood.json", 1280, 900);
    w.show<DevicesPanel> (devicesPanel);
    auto& hand = w.showHand();
    auto& run = w.playback.run();
    REQUIRE (w.start());
    CHECK (waitFor ([&] { return mentions (*w.stage, "The device described in the graph is used"); }));
    CHECK_FALSE (mentions (*w.stage, "Not in use"));

    listTitled (w, "What moves the tool").grabKeyboardFocus();
    w.key ("cursor down");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand::pointer(); }));
    CHECK (waitFor ([&] { return mentions (*w.stage, "Not in use: the mouse or pen"); }));
    CHECK_FALSE (mentions (*w.stage, "The device described in the graph is used"));
    CHECK (mentions (*w.stage, "Hand."));   // the card has grown with its text

    listTitled (w, "device").grabKeyboardFocus();
    w.key ("cursor down");
    CHECK (listTitled (w, "device").getText() == "simulated tool");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand {}; }));
    CHECK (waitFor ([&] { return ! mentions (*w.stage, "Not in use"); }));
    CHECK (waitFor ([&] { return listTitled (w, "What moves the tool").getText() == "Its own device"; }));
    CHECK (w.status.text().contains ("The device of stylus moves its tool from now on"));
    CHECK (hand.chosen() == LiveRun::Hand {});   // also in the next graph

    w.key ("ctrl + z");   // takes back the device, and what moved the tool
    CHECK (listTitled (w, "device").getText() == "as in the graph");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.hand() == LiveRun::Hand::pointer(); }));
    CHECK (hand.chosen() == LiveRun::Hand::pointer());
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
