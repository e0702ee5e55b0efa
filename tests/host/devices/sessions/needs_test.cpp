// SPDX-License-Identifier: MIT
// The needs of a graph's roles, whether the bound devices meet them, and the choice of the clock.

#include "host/devices/hid_link/fake_board.hpp"

#include <host/devices/sessions/choose_clock.hpp>
#include <host/devices/sessions/role_fits.hpp>
#include <tactus/plan/rules/missing_parts.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// A graph that uses every part of its device.
test::Sketch greedy()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("motor", "device.force").node ("press", "device.pressure").node ("gain", "signal.gain");
    s.node ("grip", "device.axis", Json::object(), { { "axis", "grip" } }).node ("pull", "device.effort", Json::object(), { { "axis", "grip" } });
    s.node ("held", "device.button", Json::object(), { { "button", "fire" } })
        .node ("coil", "device.signal_out", Json::object(), { { "channel", 3 } })
        .node ("pickup", "device.signal_in", Json::object(), { { "channel", 2 } });
    s.wire ("hand.position -> motor.force").wire ("hand.rotation -> motor.torque").wire ("press.force -> gain.in");
    return s;
}

LoadedSession bound (const std::string& role, Json description)
{
    LoadedSession s { {}, "session.json" };
    s.session.bind (role, std::move (description));
    return s;
}

std::optional<double> nothing (const Described&, bool) { return std::nullopt; }
}   // namespace

TEST_CASE ("a graph needs exactly the wired parts of its nodes", "[sessions]")
{
    test::Sketch s;
    s.node ("hand", "device.position")
        .node ("wall", "deform.plane")
        .node ("motor", "device.force")
        .wire ("hand.position -> wall.position")
        .wire ("wall.force -> motor.force");
    auto needs = needsOf (*s.compile().plan);
    REQUIRE (needs.size() == 1);
    CHECK (needs.front().role == "stylus");
    CHECK (describe (needs.front().parts) == "position, force");

    test::Sketch parts;
    parts.node ("grip", "device.axis", Json::object(), { { "axis", "grip" } })
        .node ("again", "device.axis", Json::object(), { { "axis", "grip" } })
        .node ("held", "device.button", Json::object(), { { "button", "fire" } })
        .node ("coil", "device.signal_out", Json::object(), { { "channel", 3 } })
        .node ("less", "device.signal_out", Json::object(), { { "channel", 1 } })
        .node ("pull", "device.effort", Json::object(), { { "axis", "grip" } })
        .node ("truth", "device.truth")
        .node ("brake", "device.brake");
    needs = needsOf (*parts.compile().plan);
    REQUIRE (needs.size() == 1);
    CHECK (describe (needs.front().parts) == "brake, truth, axis 'grip', effort 'grip', button 'fire', signal outputs 1 to 3");

    for (auto& n : parts.graph.root.nodes)
        n.bypass = n.name != "grip";
    needs = needsOf (*parts.compile().plan);
    REQUIRE (needs.size() == 1);
    CHECK (describe (needs.front().parts) == "axis 'grip'");
}

TEST_CASE ("the parts that a device lacks according to its description match the messages of the nodes", "[sessions]")
{
    test::Sketch s;
    s.node ("grip", "device.axis", Json::object(), { { "axis", "grip" } })
        .node ("pull", "device.effort", Json::object(), { { "axis", "triger" } })
        .node ("held", "device.button", Json::object(), { { "button", "fire" } })
        .node ("coil", "device.signal_out", Json::object(), { { "channel", 3 } })
        .node ("pickup", "device.signal_in", Json::object(), { { "channel", 2 } })
        .node ("brake", "device.brake");
    const auto plan = s.compile().plan;
    const auto needed = needsOf (*plan).front().parts;
    for (const DeviceLayout& has :
         { DeviceLayout {}, DeviceLayout { .axes = { "grap" }, .efforts = { "trigger" }, .buttons = { "a", "b" }, .signal_inputs = 1, .signal_outputs = 3 },
           DeviceLayout { .axes = { "grip" }, .efforts = { "triger" }, .buttons = { "fire" }, .signal_inputs = 2, .signal_outputs = 3, .brake = 5.0 } })
    {
        plan->roles().front().state->layout = has;
        const auto said = missingParts (*plan);
        const auto lacking = lackingOf (needed, { .brake = has.brake > 0.0, .others = has });
        CHECK (lacking.size() == said.size());
        for (const auto& m : said)
            CHECK (std::ranges::any_of (lacking, [&] (const std::string& l) { return m.text.find (l) != std::string::npos; }));
    }
}

TEST_CASE ("missing parts refer to the device in the session, or else in the graph", "[sessions][hid]")
{
    const hid::LoadedProfiles profiles { .profiles = { test::BoardProfile {}.make() }, .messages = {} };
    test::FakeBoard board;
    auto s = greedy();
    s.graph.root.wires.erase (s.graph.root.wires.begin());   // removes the two wires with units that do not fit, so that the graph compiles
    s.graph.root.wires.erase (s.graph.root.wires.begin());
    const auto plan = s.compile().plan;
    REQUIRE (plan);

    auto fit = fitsOf (needsOf (*plan), s.graph, {}, profiles, {}).front();
    CHECK (fit.from == RoleFit::From::none);
    CHECK_FALSE (fit.fits());

    s.graph.devices = { { "stylus", { { "driver", "sim" }, { "axes", { { "grip", Json::object() } } }, { "signal_outputs", 3 } } } };
    fit = fitsOf (needsOf (*plan), s.graph, {}, profiles, {}).front();
    CHECK (fit.from == RoleFit::From::graph);
    CHECK (fit.lacking.size() == 2);   // the button and the signal input

    const auto there = board.connected();
    fit = fitsOf (needsOf (*plan), s.graph, bound ("stylus", { { "driver", "hid" }, { "profile", "board" }, { "workspace", { { "scale", 3 } } } }), profiles,
                  there)
              .front();
    CHECK (fit.from == RoleFit::From::session);
    CHECK (fit.connected == true);
    CHECK (fit.workspace.scale == 3.0);
    CHECK (fit.messages.empty());
    CHECK (std::ranges::count (fit.lacking, "no pressure") == 1);
    CHECK (std::ranges::count (fit.lacking, "no position") == 0);

    fit = fitsOf (needsOf (*plan), s.graph, bound ("stylus", { { "driver", "hid" } }), profiles, {}).front();
    CHECK (fit.connected == false);
    CHECK_FALSE (fit.there);   // any HID device might be plugged in, so its layout is not known
    CHECK (fitsOf (needsOf (*plan), s.graph, bound ("stylus", { { "driver", "hid" } }), profiles, there).front().there);

    const Json sound { { "driver", "audio" },
                       { "outputs", { Json::object(), Json::object(), Json::object() } },
                       { "inputs", Json::array ({ Json::object() }) } };
    fit = fitsOf (needsOf (*plan), s.graph, bound ("stylus", sound), profiles, {}).front();
    REQUIRE (fit.there);
    CHECK (fit.there->others.signal_outputs == 3);
    CHECK (std::ranges::count (fit.lacking, "no signal input 2; it has 1") == 1);
    CHECK (hasErrors (fitsOf (needsOf (*plan), s.graph, bound ("stylus", { { "driver", "sim" }, { "mass", "1 N" } }), profiles, {}).front().messages));
}

TEST_CASE ("a missing part of the tool gives a warning, and named parts are left to their nodes", "[sessions]")
{
    const DeviceParts needed { .position = true, .force = true, .torque = true, .others = { .axes = { "grip" } } };
    const auto messages = missingTools ({ "stylus", needed }, { .position = true, .torque = true });
    REQUIRE (messages.size() == 1);
    CHECK (messages.front().id == "device/missing_tool");
    CHECK (messages.front().text == "the device of the role 'stylus' has no force");
    CHECK_FALSE (hasErrors (messages));
    CHECK (missingTools ({ "stylus", needed }, needed).empty());
}

TEST_CASE ("a binding has a short name", "[sessions]")
{
    CHECK (nameOf ({ { "driver", "hid" }, { "profile", "board" }, { "serial", "B7" } }) == "hid board, serial B7");
    CHECK (nameOf ({ { "driver", "gesture" }, { "path", "stroke" } }) == "gesture stroke");
    CHECK (nameOf ({ { "driver", "sim" }, { "hand", { { "path", "tap" } } } }) == "sim with a hand that follows tap");
    CHECK (nameOf (Json::object()) == "nothing");
    CHECK (nameOf ({ { "driver", 3 } }) == "nothing");
}

TEST_CASE ("the clock option takes precedence over the session, which takes precedence over the first device that can tick", "[sessions]")
{
    const std::vector<Described> devices { { "pen", { { "driver", "sim" } } }, { "stylus", { { "driver", "hid" } } }, { "thumb", { { "driver", "hid" } } } };
    const TickRate rates = [] (const Described& d, bool may_wait) -> std::optional<double> {
        if (d.first == "stylus") return may_wait ? std::optional (500.0) : std::nullopt;   // not available yet
        return d.first == "thumb" ? std::optional (1000.0) : std::nullopt;
    };
    const auto choose = [&] (const std::string& option, const std::string& session,
                             std::optional<double> rate = {}) { return chooseClock ({ option, session, rate }, devices, rates); };
    const auto idOf = [] (const ClockChoice& c) { return c.messages.empty() ? std::string() : c.messages.front().id; };

    CHECK (choose ("", "").role == "thumb");
    CHECK (choose ("", "").rate_hz == 1000.0);
    CHECK (choose ("", "", 1000.0).role.empty());
    CHECK (choose ("", "stylus").role == "stylus");
    CHECK (choose ("", "stylus").rate_hz == 500.0);
    CHECK (choose ("thumb", "stylus").role == "thumb");
    CHECK (choose ("timer", "stylus").role.empty());
    CHECK (choose ("timer", "stylus").messages.empty());
    CHECK (choose ("thumb", "timer").role == "thumb");
    CHECK (choose ("", "timer").role.empty());
    CHECK (choose ("", "timer").messages.empty());
    CHECK (choose ("", "stylus", 500.0).role == "stylus");

    CHECK (idOf (choose ("pen", "stylus")) == "run/no_clock");
    CHECK (idOf (choose ("missing", "")) == "run/no_clock");
    CHECK (idOf (choose ("thumb", "", 4000.0)) == "run/two_rates");
    CHECK (hasErrors (choose ("thumb", "", 4000.0).messages));

    // A session serves any graph, so a role that this graph lacks gives only a warning.
    for (const auto& choice : { choose ("", "pen"), choose ("", "elsewhere"), choose ("", "stylus", 4000.0) })
    {
        CHECK (idOf (choice) == "session/clock");
        CHECK_FALSE (hasErrors (choice.messages));
    }
    CHECK (choose ("", "elsewhere").role == "thumb");
    CHECK (choose ("", "pen").role.empty());
    CHECK (chooseClock ({}, devices, nothing).role.empty());

    const std::vector<Described> of_plugin { { "stylus", { { "driver", "serial_arm" } } } };
    for (const auto& wish : { ClockRequest { "stylus", "", {} }, ClockRequest { "", "stylus", {} } })
    {
        const auto choice = chooseClock (wish, of_plugin, nothing);
        CHECK (choice.role.empty());
        REQUIRE (choice.messages.size() == 1);
        CHECK (choice.messages[0].text.find ("devices of such drivers cannot tick a run") != std::string::npos);
    }
}

TEST_CASE ("the roles of a graph are the roles of its nodes, including nodes in subgraphs and mappings", "[sessions]")
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("finger", "graph:finger");
    s.add (s.subgraph ("finger"), "tip", "device.force");
    s.graph.root.nodes[1].roles = { { "stylus", { "thumb", "index" } }, { "base", "palm" } };
    CHECK (rolesNamed (s.graph) == std::vector<std::string> { "index", "palm", "stylus", "thumb" });
}
