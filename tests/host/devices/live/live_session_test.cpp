// SPDX-License-Identifier: MIT
// Live sessions in C++, on simulated devices: edits, sessions of the user, and stops.
#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <host/devices/live/live_session.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using test::Sketch;

namespace
{
/// Two springs that the tool leans on.
graph::Graph spring()
{
    Sketch s;
    s.node ("hand", "device.position").node ("wall", "deform.plane").node ("motor", "device.force").node ("more", "deform.plane");
    for (auto& n : s.graph.root.nodes)
        if (n.type.starts_with ("device.")) n.role = "stylus";
    s.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force").wire ("hand.position -> more.position").wire ("more.force -> motor.force");
    return s.graph;
}

struct Offline
{
    explicit Offline (LiveSession::Options options = {}) : session (catalogue(), Hardware {}, std::move (options)) {}

    LiveSession session;
};

LiveSession::Options tickedByHand()
{
    LiveSession::Options options;
    options.queries = Run::Queries::within_tick;
    return options;
}
}   // namespace

TEST_CASE ("an edit with errors is refused or shown, as the caller wishes, and the previous graph keeps running", "[live]")
{
    Offline o { tickedByHand() };
    const auto graph = spring();
    REQUIRE_FALSE (hasErrors (o.session.load (graph)));
    static_cast<void> (o.session.openDevices());
    auto broken = graph;
    broken.root.nodes.push_back (Sketch::makeNode ("what", "no.such_node"));
    const auto refused = o.session.edit (broken, LiveSession::EditPolicy::no_errors);
    CHECK_FALSE (refused.is_taken_over);
    CHECK (hasErrors (refused.messages));
    CHECK (o.session.graph().root.nodes.size() == graph.root.nodes.size());
    CHECK (o.session.edit (broken, LiveSession::EditPolicy::errors).is_taken_over);
    CHECK (o.session.hasPlaceholders());
}

TEST_CASE ("a role gets the device that is given for it, else that of the graph, else a tool at rest, with a warning", "[live]")
{
    auto options = tickedByHand();
    options.devices.given = { { "stylus", { { "driver", "gesture" }, { "path", "circle" } }, {} } };
    Offline given { std::move (options) };
    REQUIRE_FALSE (hasErrors (given.session.load (spring())));
    CHECK_FALSE (hasErrors (given.session.openDevices()));
    CHECK (given.session.run().devices().front().second.device->duration() > 0.0);

    Offline none { tickedByHand() };
    REQUIRE_FALSE (hasErrors (none.session.load (spring())));
    CHECK (test::has (none.session.openDevices(), "device/undescribed"));
    CHECK_FALSE (none.session.drivesDevice());
}

TEST_CASE ("a session without hardware refuses real devices, and a graph never chooses one", "[live][safety]")
{
    auto options = tickedByHand();
    options.devices.given = { { "stylus", { { "driver", "hid" }, { "profile", "tactus_board" } }, {} } };
    Offline given { std::move (options) };
    REQUIRE_FALSE (hasErrors (given.session.load (spring())));
    CHECK (test::has (given.session.openDevices(), "device/real"));

    auto graph = spring();
    graph.devices = { { "stylus", { { "driver", "hid" }, { "profile", "pid" }, { "calibration", { { "full_force", "0.001 N" } } } } } };
    Offline by_graph { tickedByHand() };
    REQUIRE_FALSE (hasErrors (by_graph.session.load (graph)));
    CHECK (test::has (by_graph.session.openDevices(), "device/not_by_graph"));
    CHECK_FALSE (by_graph.session.drivesDevice());
}

TEST_CASE ("a press before the first tick, or a session that begins stopped, has no force until a rearm that comes late enough", "[live][safety]")
{
    StopSwitch stops;
    auto options = tickedByHand();
    options.devices.given = { { "stylus", { { "driver", "sim" }, { "position", { 0, 0, "-1 mm" } } }, {} } };
    options.stops = &stops;
    const bool begins_stopped = GENERATE (false, true);
    options.is_stopped = begins_stopped;
    Offline o { std::move (options) };
    REQUIRE_FALSE (hasErrors (o.session.load (spring())));
    CHECK_FALSE (hasErrors (o.session.openDevices()));
    const auto before = test::fromNow ({});
    if (! begins_stopped) stops.emergencyStop (By::person);
    const auto& applied = o.session.engine().guardOf ("stylus");
    for (int k = 0; k < 1000; ++k)
        o.session.run().tick();
    CHECK (applied.stop() != Guard::Stop::none);
    if (! begins_stopped) CHECK_FALSE (o.session.rearm (before + StopSwitch::pause / 2));
    CHECK (o.session.rearm (test::fromNow (StopSwitch::pause)));
    for (int k = 0; k < 1000; ++k)
        o.session.run().tick();
    CHECK (applied.stop() == Guard::Stop::none);
}
