// SPDX-License-Identifier: GPL-3.0-or-later
// What a run or a graph leaves must not reach the next one.
#include "host/app/support/wait_for.hpp"
#include "host/app/support/window_rig.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::waitFor;
using host::test::WindowRig;

TEST_CASE ("a new graph shows no curve of the graph before, even for a port with the same name", "[app][window]")
{
    WindowRig w ("dry_wood.json");
    auto& run = w.view->run();
    const auto hasTrace = [&] { return ! run.traces().of ("motor.force").empty(); };
    if (! run.isWanted()) w.key ("F5");
    REQUIRE (waitFor (hasTrace));
    w.key ("escape");
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    WindowRig::settle();
    CHECK (hasTrace());   // a run that has stopped can be looked at
    w.key ("ctrl + n");
    WindowRig::settle();
    REQUIRE (w.graph().root.nodes.empty());
    CHECK_FALSE (hasTrace());
}

TEST_CASE ("a tool that H holds is let go at a stop, and the next start does not press", "[app][window]")
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
    run.letGo();
}
