// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/desk_rig.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/canvas/paint/paint_nodes.hpp>
#include <host/app/compose/add_preset.hpp>
#include <host/app/inspector/blocks/limit_block.hpp>
#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/limits/limit_light.hpp>
#include <host/app/limits/limit_words.hpp>
#include <host/app/problems/fixes.hpp>
#include <host/app/problems/problem_list.hpp>
#include <host/app/run/device_setup.hpp>
#include <host/app/run/limit_watch.hpp>
#include <host/app/run/views/live_feed.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <limits>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::CanvasRig;
using tactus::host::test::DeskRig;
using tactus::host::test::readTexts;
using tactus::host::test::SeenText;

namespace
{
/// A wall of 1 N/mm at 1 kHz: it needs a damping of sigma T/2 = 0.5 N s/m. The friction stretches by 1 um.
graph::Graph wall (const std::string& device_numbers)
{
    auto read = readGraph (R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
      "devices": { "tip": { "driver": "sim", "mass": "100 g", "hand": { "stiffness": 100, "damping": 2, "path": "stroke" }, )"
                           + device_numbers + R"( } },
      "nodes": { "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" },
        "wall": { "type": "deform.plane", "params": { "stiffness": "1 N/mm", "damping": 0 } } },
      "wires": [ "hand.position -> wall.position", "wall.force -> motor.force" ] })");
    for (const auto& m : read.messages)
        FAIL_CHECK (m.text);
    return std::move (read.graph);
}

LimitList checked (const graph::Graph& g)
{
    FileAssets assets;
    return limitsOf ({ g, 0.0, limitRolesOf (g, {}, {}) }, catalogue(), assets);
}

std::string idsOf (const LimitList& list)
{
    std::string all;
    for (const auto& l : list.limits)
        all += (all.empty() ? "" : " ") + l.id + (l.is_broken ? "!" : "");
    return all;
}

const LimitRole& only (const std::vector<LimitRole>& roles)
{
    REQUIRE (roles.size() == 1);
    return roles.front();
}
}   // namespace

TEST_CASE ("a limit is broken beyond the limit, near within 20 % of it, and not listed below that", "[app][limits]")
{
    const auto [damping, ids] = GENERATE (table<std::string, std::string> ({ { "0.4", "stiffness!" }, { "0.55", "stiffness" }, { "0.7", "" } }));
    const auto list = checked (wall ("\"damping\": " + damping));
    CHECK (list.is_checked);
    CHECK (idsOf (list) == ids);
    CHECK (list.held > 0);
    if (list.limits.empty()) return;
    const auto& limit = list.limits.front();
    CHECK (limit.nodes == std::vector<std::string> { "wall", "motor" });   // the steepest node, and the one that pushes the device
    CHECK (limit.details.find ("limit " + damping) != std::string::npos);
    CHECK (limit.details.find ("0.5") != std::string::npos);
    CHECK (limit.text.starts_with ("The stiffness of wall is "));
    CHECK (limit.remedy.empty() != limit.is_broken);
}

TEST_CASE ("a tool that does not come to rest in trials is not said to be too stiff by the other law, which holds", "[app][limits]")
{
    check::Condition c;
    c.id = "stiffness";
    c.role = "stylus";
    c.node = "rubber/foot";
    c.value = 0.8;
    c.limit = 1.0;
    c.verdict = check::Verdict::unstable;
    c.may_grow = std::numeric_limits<double>::quiet_NaN();
    CHECK (limitSentence (c, c.node, "simulated") == "The tool of stylus (simulated) does not come to rest at rubber/foot");
    c.may_grow = 0.5;
    CHECK (limitSentence (c, c.node, "simulated") == "The stiffness of rubber/foot is 2 times what stylus (simulated) allows");
    c.value = 1.6;   // mostly damping, which is too much alone
    c.damping = 1.2;
    CHECK (limitSentence (c, c.node, "simulated")
           == "The virtual damping of rubber/foot together with its stiffness is 2 times what stylus (simulated) allows");
    c.damping = 0.1;   // the factor is that of both
    CHECK (limitSentence (c, c.node, "simulated") == "The stiffness of rubber/foot together with its damping is 2 times what stylus (simulated) allows");
}

TEST_CASE ("a contact that rests but is not passive is near a limit, and each share says of what", "[app][limits]")
{
    check::Condition c;
    c.id = "stiffness";
    c.role = "stylus";
    c.node = "foot";
    c.value = 0.9;
    c.limit = 1.0;
    c.verdict = check::Verdict::passive;
    CHECK (limitSentence (c, c.node, "simulated") == "The stiffness of foot is at 90 % of what is passive on stylus (simulated)");
    c.verdict = check::Verdict::stable;
    c.may_grow = 1.1;
    CHECK (limitSentence (c, c.node, "simulated") == "The stiffness of foot is at 90 % of what stylus (simulated) allows");
    c.value = 1.4;
    c.may_grow = 1.9;
    CHECK (limitSentence (c, c.node, "simulated") == "The stiffness of foot is not passive on stylus (simulated), but rests with usual hands");

    const auto listOf = [] (const char* preset) { return checked (loadGraph (std::string (TACTUS_SOURCE_DIR "/graphs/") + preset).graph); };
    const auto listed = [&] (const char* preset) { return idsOf (listOf (preset)); };
    for (const auto& l : listOf ("rubber_ball.json").limits)
        CHECK (l.details.find (" left (") == std::string::npos);
    CHECK (listed ("rubber_ball.json").find ("stiffness") != std::string::npos);   // 1.01 of 0.5 N s/m
    CHECK (listed ("rubber_ball.json").find ("stiffness!") == std::string::npos);
    CHECK (listed ("dry_wood.json").find ("stiffness") == std::string::npos);   // its slopes are passive
}

TEST_CASE ("a ceiling is no step of the force", "[app][limits]")
{
    auto wood = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    const auto weave = loadGraph (TACTUS_SOURCE_DIR "/graphs/canvas_weave.json").graph;
    const auto made = compose::addPreset (wood, weave, { .roles = { { "stylus", "stylus" } } }, catalogue());
    REQUIRE (made);
    REQUIRE (graph::apply (wood, made->command));
    for (const auto& layer : made->layers)
        REQUIRE (graph::apply (wood, graph::SetParam { "", layer, "ceiling", Json ("0.5 N") }));
    const auto list = checked (wood);
    CHECK (list.is_checked);
    for (const auto& l : list.limits)
    {
        INFO (l.details);
        CHECK (l.id != "jump");
    }
}

TEST_CASE ("a limit names its node, also inside a subgraph, and its message leads there", "[app][limits]")
{
    const auto read = readGraph (R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
      "devices": { "tip": { "driver": "sim", "quantum": "30 um", "coulomb": "9 N", "damping": 9,
                             "hand": { "stiffness": 100, "damping": 2, "path": "stroke" } } },
      "nodes": { "hand": { "type": "device.position", "role": "tip" }, "wood": { "type": "graph:wood" }, "motor": { "type": "device.force", "role": "tip" } },
      "wires": [ "hand.position -> wood.position", "wood.force -> motor.force" ],
      "graphs": { "wood": { "nodes": { "load": { "type": "signal.constant", "params": { "value": 1 } },
            "drag": { "type": "friction.elasto_plastic", "params": { "d_max": "20 um" } } },
          "wires": [ "load.out -> drag.normal_force" ],
          "expose": { "inputs": { "position": "drag.position" }, "outputs": { "force": "drag.force" } } } } })");
    REQUIRE (read.messages.empty());
    const auto list = checked (read.graph);
    const auto stretch = std::ranges::find (list.limits, "d_max", &Limit::id);
    REQUIRE (stretch != list.limits.end());
    CHECK (stretch->is_broken);
    CHECK (stretch->nodes == std::vector<std::string> { "wood/drag" });
    CHECK (stretch->text == "The position sensor of tip (simulated) is too coarse for wood/drag by a factor of 1.5");
    CHECK (stretch->details.find ("30.0 µm") != std::string::npos);

    const auto messages = list.messages (read.graph);
    const auto told = std::ranges::find (messages, "limit/d_max", &Message::id);
    REQUIRE (told != messages.end());
    CHECK (told->severity == Message::Severity::error);
    CHECK (told->where == "/graphs/wood/nodes/drag");
    CHECK (locationOf (read.graph, *told).node == "drag");
    CHECK_FALSE (fixOf (read.graph, *told));
}

namespace
{
/// A wall with a friction on it, which a late tool strokes.
graph::Graph strokedWall (const std::string& stiffness, const std::string& damping)
{
    const auto read = readGraph (R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
      "devices": { "tip": { "driver": "sim", "mass": "100 g", "damping": 2, "delay": 1,
          "hand": { "stiffness": 100, "damping": 2, "path": "stroke" } } },
      "nodes": { "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" },
        "wall": { "type": "deform.plane", "params": { "stiffness": )"
                                 + stiffness + R"(, "damping": )" + damping + R"( } },
        "drag": { "type": "friction.elasto_plastic" } },
      "wires": [ "hand.position -> wall.position", "hand.position -> drag.position", "wall.resistance -> drag.normal_force",
        "wall.force -> motor.force", "drag.force -> motor.force" ] })");
    REQUIRE (read.messages.empty());
    return read.graph;
}
}   // namespace

TEST_CASE ("each node whose loop swings is listed with its own factor, the weakest first", "[app][limits]")
{
    const auto list = checked (strokedWall ("5000", "5"));
    std::vector<std::string> texts;
    for (const auto& l : list.limits)
        if (l.id == "stiffness") texts.push_back (l.text);
    CHECK (texts
           == std::vector<std::string> { "The stiffness of drag together with its damping is 3 times what tip (simulated) allows",
                                         "The stiffness of wall together with its damping is 1.4 times what tip (simulated) allows" });
    REQUIRE (list.contacts.size() == 2);
    CHECK (list.contacts[0].node == "drag");
    CHECK (list.contacts[1].node == "wall");
    CHECK (list.contacts[1].stable_up_to == Approx (0.724).epsilon (0.01));   // as the wall alone: computed apart from Tactus
}

TEST_CASE ("a node whose loop rests is not said to swing with that of another node in the same contact", "[app][limits]")
{
    const auto list = checked (strokedWall ("2500", "2.5"));
    REQUIRE (list.contacts.size() == 2);
    CHECK (list.contacts[0].node == "drag");
    CHECK (list.contacts[0].swinging.empty());
    CHECK (LimitBlock::textOf (list.contacts[0]).startsWith ("It swings on "));
    CHECK (list.contacts[1].node == "wall");
    CHECK (list.contacts[1].stable_up_to == Approx (1.45).epsilon (0.01));   // twice that of a wall of twice the stiffness and damping
    CHECK (LimitBlock::textOf (list.contacts[1]).startsWith ("drag swings on "));
    CHECK (LimitBlock::partsOf (list.contacts[1]).swings > 1.0);
}

TEST_CASE ("the message of a limit is one short sentence with short numbers, and the first remedy", "[app][limits]")
{
    for (const auto* device : { R"("damping": 0.4)", R"("damping": 0.4, "quantum": "3.21987 um", "coulomb": "1.2345 mN")",
                                R"("damping": 0.51, "guard": { "max_force": "51 mN" })" })
    {
        const auto list = checked (wall (device));
        REQUIRE_FALSE (list.limits.empty());
        for (const auto& l : list.limits)
        {
            INFO (l.id << ": " << l.text << ". " << l.remedy);
            CHECK (l.text.size() <= 110);
            CHECK (l.remedy.size() <= 70);
            CHECK (l.text.find_first_of ("({") == l.text.find ("(simulated)"));   // no law
            for (const auto& text : { l.text, l.remedy })
            {
                int digits = 0;
                for (std::size_t i = 0; i < text.size(); ++i)
                {
                    digits = std::isdigit (static_cast<unsigned char> (text[i])) != 0 ? digits + 1 : 0;
                    CHECK (digits <= 5);
                }
                CHECK (text.find ("e+") == std::string::npos);
                CHECK (text.find ("e-") == std::string::npos);
            }
            if (l.is_broken) CHECK_FALSE (l.remedy.empty());
            CHECK (l.details.size() > l.text.size());   // the numbers and the law are not lost
        }
    }
}

TEST_CASE ("each condition has a subject with an article, and units are as in the fields", "[app][limits]")
{
    auto damped = wall (R"("damping": 0.1, "quantum": "100 um", "coulomb": "1 mN")");
    std::ranges::find (damped.root.nodes, "wall", &graph::Node::name)->params["damping"] = 2.0;
    auto all = checked (damped).limits;
    std::ranges::move (checked (wall (R"("damping": 0.4)")).limits, std::back_inserter (all));
    CHECK (std::ranges::count (all, "blow", &Limit::id) == 1);
    for (const auto& l : all)
    {
        INFO (l.id << ": " << l.text << ". " << l.remedy << "\n"
                   << l.details);
        CHECK (l.text.starts_with ("The "));
        CHECK ((l.remedy + l.details).find ('*') == std::string::npos);
    }
    CHECK (std::ranges::any_of (all, [] (const Limit& l) { return l.details.find ("N\xc2\xb7s/m") != std::string::npos; }));
    CHECK (unitText (UnitRule (unit::damping)) == juce::String::fromUTF8 ("N\xc2\xb7s/m"));   // in the head of a table
}

TEST_CASE ("a graph that does not compile is not checked", "[app][limits]")
{
    auto g = wall ("\"damping\": 1");
    g.root.nodes.front().type = "no.such_node";
    CHECK_FALSE (checked (g).is_checked);
    CHECK (checked (g).limits.empty());
}

TEST_CASE ("a graph whose forces drive the tool away breaks a limit, though no slope can be measured", "[app][limits]")
{
    auto g = wall ("\"damping\": 1");
    REQUIRE (graph::apply (g, graph::SetParam { "", "wall", "stiffness", Json (1e9) }));
    const auto list = checked (g);
    CHECK (list.is_checked);
    CHECK (idsOf (list) == "diverged!");
    const auto said = list.messages (g);
    REQUIRE (said.size() == 1);
    CHECK (said[0].text == "The forces drive the tool of tip away, so nothing else is judged");
    CHECK (list.limits[0].nodes == std::vector<std::string> { "motor" });
    CHECK (said[0].remedy.find ("--") == std::string::npos);   // the window has no options
}

TEST_CASE ("limits are those of the device that the session binds, in the workspace of the graph", "[app][limits]")
{
    const auto g = wall ("\"damping\": 1");
    CHECK (only (limitRolesOf (g, {}, {})).numbers.damping->value == 1.0);

    LoadedSession session;
    session.session.bind ("tip", { { "driver", "sim" }, { "damping", 3.0 }, { "quantum", 1e-5 }, { "coulomb", 2.0 }, { "workspace", { { "scale", 2 } } } });
    const auto role = only (limitRolesOf (g, session, {}));
    CHECK (role.numbers.damping->value == 1.5);
    CHECK (role.numbers.quantum->value == 2e-5);
    CHECK (role.numbers.coulomb->value == 2.0);
    CHECK_FALSE (role.hand);   // the hand of the graph, because this device has none

    session.session.bind ("tip", { { "driver", "gesture" }, { "path", "tap" } });
    const auto tapped = only (limitRolesOf (g, session, {}));
    CHECK (tapped.hand);
    CHECK_FALSE (tapped.numbers.damping);

    FileAssets assets;
    const auto list = limitsOf ({ g, 0.0, { tapped } }, catalogue(), assets);
    CHECK (list.is_checked);
    CHECK (list.limits.empty());
    CHECK (list.unknown > 0);
    CHECK (list.unjudged.size() == list.unknown + list.not_reached);
    for (const auto& m : list.remarks (g))
    {
        INFO (m.text);
        CHECK (m.text.find (" is not judged") != std::string::npos);
        CHECK_FALSE (m.remedy.empty());
    }
}

TEST_CASE ("the lights follow edits, devices and the graph that is open", "[app][limits]")
{
    CanvasRig rig { wall ("\"damping\": 1") };
    DeviceSetup setup;
    LiveRun run { rig.document, catalogue() };
    LimitWatch watch { rig.document, setup, run, catalogue() };
    LiveFeed feed { *rig.canvas, run };
    feed.limits = &watch;
    LimitLight light;
    const auto settled = [&] {
        int looks = 0;
        return tactus::test::eventually (std::chrono::milliseconds (5), [&] {
            watch.poll();
            feed.refresh();
            light.show (watch.list());
            return ++looks > 10 && watch.isUpToDate();
        });
    };
    const auto tooltip = [&] (const char* node) { return rig.canvas->tooltipAt (rig.canvas->view().toPixels (limitLightOf (rig.node (node),
                                                                                                                           1.0f)
                                                                                                                 .getCentre())); };
    CHECK_FALSE (light.isVisible());
    REQUIRE (settled());
    CHECK (light.isVisible());
    CHECK (watch.messages().empty());
    CHECK (tooltip ("motor").isEmpty());

    REQUIRE (rig.document.perform (graph::SetParam { "", "wall", "stiffness", 4000.0 }));   // sigma T/2 = 2 N s/m
    REQUIRE (settled());
    CHECK (idsOf (watch.list()) == "stiffness!");
    CHECK (watch.messages().size() == 1);
    CHECK (tooltip ("motor").contains ("stiffness"));
    CHECK (tooltip ("motor").contains ("Would help: "));
    CHECK (tooltip ("wall") == tooltip ("motor"));
    CHECK (tooltip ("hand").isEmpty());
    CHECK (light.getTooltip().contains ("stiffness"));

    REQUIRE (setup.edit ([] (DeviceSession& s) { s.bind ("tip", { { "driver", "sim" }, { "damping", 9.0 } }); }));   // not saved: the setup has no home
    REQUIRE (settled());
    CHECK (idsOf (watch.list()).empty());
    REQUIRE (setup.edit ([] (DeviceSession& s) { s.unbind ("tip"); }));
    REQUIRE (settled());
    CHECK (watch.list().broken() == 1);

    rig.document.open (wall ("\"damping\": 1"), {}, "open");
    CHECK_FALSE (watch.list().is_checked);   // what was found in the other graph is gone immediately
    CHECK (watch.messages().empty());
}

TEST_CASE ("the steepest contact of a role has its limits, in multiples of what it is", "[app][limits]")
{
    const auto passive = checked (wall ("\"damping\": 2")), stable = checked (wall ("\"damping\": 0.4"));
    REQUIRE (passive.contacts.size() == 1);
    CHECK (passive.contacts[0].node == "wall");
    CHECK (passive.contacts[0].passive_up_to == Approx (2.0 / 0.5).epsilon (0.01));
    REQUIRE (stable.contacts.size() == 1);
    CHECK (stable.contacts[0].passive_up_to == Approx (0.4 / 0.5).epsilon (0.01));
    CHECK (stable.contacts[0].stable_up_to >= stable.contacts[0].passive_up_to);
    CHECK (passive.contacts[0].verdict == check::Verdict::passive);
    CHECK (LimitBlock::textOf (passive.contacts[0]).startsWith ("Passive on "));
    CHECK (stable.contacts[0].verdict == check::Verdict::unstable);
    CHECK (LimitBlock::textOf (stable.contacts[0]).startsWith ("It swings on "));
}

TEST_CASE ("a contact of which something is left out that breaks its own limit is not said to be passive", "[app][limits]")
{
    auto g = wall ("\"damping\": 2");
    SECTION ("a damper that makes a light tool swing")
    {
        for (auto& n : g.root.nodes)
            if (n.name == "wall") n.params["damping"] = 250.0;   // above 2M/T + 4B/3
        CHECK (idsOf (checked (g)).find ("damping!") != std::string::npos);
    }
    SECTION ("a texture that is too steep")
    {
        graph::Node ribs;
        ribs.name = "ribs";
        ribs.type = "texture.grating";
        ribs.params = { { "amplitude", 2.0 }, { "spatial_frequency", 1200.0 } };
        g.root.nodes.push_back (ribs);
        for (const auto* text : { "hand.position -> ribs.position", "ribs.force -> motor.force" })
            g.root.wires.push_back (*graph::parseWire (text));
        CHECK (idsOf (checked (g)).find ("gain!") != std::string::npos);
    }
    CHECK (checked (g).contacts.empty());
}

TEST_CASE ("a check that is stopped finds nothing, and closing does not wait for it", "[app][limits]")
{
    std::stop_source stop;
    stop.request_stop();
    FileAssets assets;
    const auto g = wall ("\"damping\": 0.4");
    CHECK_FALSE (limitsOf ({ g, 0.0, limitRolesOf (g, {}, {}) }, catalogue(), assets, stop.get_token()).is_checked);
}

TEST_CASE ("closing stops a running check, and a series of edits ends with a check of the last one", "[app][limits]")
{
    CanvasRig rig { wall ("\"damping\": 1") };
    DeviceSetup setup;
    LiveRun run { rig.document, catalogue() };
    LimitWatch watch { rig.document, setup, run, catalogue() };
    for (int k = 0; k < 40; ++k)
    {
        rig.document.perform (graph::SetParam { "", "wall", "stiffness", 4000.0 - 50.0 * k });
        watch.poll();
        tactus::test::letPass (std::chrono::milliseconds (5));
        CHECK_FALSE (watch.isUpToDate());
    }
    rig.document.perform (graph::SetParam { "", "wall", "stiffness", 100.0 });
    REQUIRE (tactus::test::eventually (std::chrono::milliseconds (5), [&] {
        watch.poll();
        return watch.isUpToDate();
    }));
    CHECK (watch.list().is_checked);
    CHECK (watch.list().limits.empty());
    rig.document.perform (graph::SetParam { "", "wall", "stiffness", 4000.0 });
}

TEST_CASE ("the title of the Problems tab counts the limits that it lists", "[app][limits][problems]")
{
    DeskRig r (wall ("\"damping\": 0.4"));
    r.make<ProblemList> (problemsPanel);
    const auto comesTo = [&] (const char* text) {
        return tactus::test::eventually (std::chrono::milliseconds (5), [&] {
            r.refresh();
            return r.panel->title().text == text;
        });
    };
    CHECK (comesTo ("Problems 1"));
    r.document.open (wall ("\"damping\": 1"), {}, "open");
    CHECK (comesTo ("Problems"));
}

TEST_CASE ("what is not judged is listed below the problems, and is none", "[app][limits][problems]")
{
    CanvasRig rig { wall ("\"damping\": 1") };
    Look look;
    ProblemList list (rig.document);
    list.setLookAndFeel (&look);
    list.setSize (600, 300);
    list.show ({}, { Message::warning ("limit/damping", {}, "damping of A is not judged", "add it") });
    CHECK (list.messages().empty());
    const auto texts = readTexts (list);
    CHECK (std::ranges::any_of (texts, [] (const SeenText& t) { return t.text.contains ("is not judged"); }));
    CHECK (std::ranges::none_of (texts, [] (const SeenText& t) { return t.text.contains ("No problems"); }));
    list.setLookAndFeel (nullptr);
}
