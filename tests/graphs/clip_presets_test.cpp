// SPDX-License-Identifier: MIT
// The presets that play clips.

#include "support/sketch.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/check/measure.hpp>
#include <tactus/check/trials/trials.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
const fs::path clip_presets = fs::path (TACTUS_SOURCE_DIR) / "graphs";

graph::Graph withGain (graph::Graph g, const char* node, double gain)
{
    for (auto& n : g.root.nodes)
        if (n.name == node) n.params["gain"] = gain;
    std::erase_if (g.controls, [] (const graph::Control& c) { return c.id == "strength" || c.id == "teeth"; });
    return g;
}

/// The largest stiffness and damping that the graph needs from its device.
std::pair<double, double> slopesOf (const graph::Graph& g)
{
    host::FileAssets assets;
    const check::Subject subject { g, catalogue(), { .assets = &assets } };
    const auto demand = check::measure (subject, check::recordMotion (subject, {}, clip_presets).motion, { .places = 32 });
    double stiffness = 0.0, damping = 0.0;
    for (const auto& slope : demand.roles.at (0).slopes)
    {
        stiffness = std::max (stiffness, slope.stiffness);
        damping = std::max (damping, slope.damping);
    }
    return { stiffness, damping };
}

/// The row `stiffness` of the check of Soft pad, with changes and trials.
check::Condition contactOf (const graph::Graph& pad)
{
    host::FileAssets assets;
    const check::Subject subject { pad, catalogue(), { .assets = &assets } };
    const auto motion = check::recordMotion (subject, {}, clip_presets).motion;
    REQUIRE (motion.ticks > 0);
    const auto& description = *pad.device ("finger");
    const std::vector<check::RoleDevice> devices { { .role = "finger",
                                                     .numbers = check::numbersOf (description, clip_presets).value(),
                                                     .name = "sim",
                                                     .simulated = check::simulationOf (description, clip_presets) } };
    const auto demand = check::measure (subject, motion);
    const auto trials = check::tryLoops (subject, motion, demand, devices);
    const auto conditions = check::judge (demand, devices, { .trials = &trials });
    const auto row = std::ranges::find (conditions, "stiffness", &check::Condition::id);
    REQUIRE (row != conditions.end());
    return *row;
}

/// Soft pad with a clip that its contact hits.
test::Sketch padWithClip (const char* drive)
{
    const auto clip = (clip_presets / "assets" / "heartbeat.haptic").string();
    test::Sketch s { loadGraph (clip_presets / "soft_pad.json").graph };
    s.node ("board", "contact.impact").node ("up", "vector.join");
    s.node ("clip", "signal.clip", { { "drive", drive }, { "repeat", "loop" }, { "gain", "0.3 N" } }, { { "clip", clip } });
    s.wire ("pad.depth -> board.depth").wire ("board.hit -> clip.hit").wire ("clip.value -> up.z").wire ("up.out -> motor.force");
    return s;
}
}   // namespace

TEST_CASE ("a clip that the contact or the hand turns up is named where the tool does not come to rest because of it", "[graphs][check]")
{
    const auto chest = loadGraph (clip_presets / "heartbeat.json").graph;
    REQUIRE_FALSE (contactOf (chest).isBroken());
    const auto modulator = GENERATE (as<std::string> {}, "signal.envelope", "signal.gain", "motion.velocity");
    test::Sketch s { chest };
    std::erase_if (s.graph.controls, [] (const graph::Control& c) { return c.id == "strength"; });
    if (modulator == "motion.velocity")   // and changes all the time while the hand moves
        s.node ("turn", modulator).wire ("hand.position -> turn.position").wire ("turn.speed -> (+) beat.speed");
    else
        s.node ("turn", modulator).wire (modulator == "signal.envelope" ? "touch.gain -> turn.gate" : "touch.gain -> turn.in").wire ("turn.out -> beat.gain");
    s.graph.root.wires.back().gain = modulator == "motion.velocity" ? "1 s/m" : "0.5 N";
    const auto c = contactOf (s.graph);
    INFO (modulator << ": " << check::nameOf (c.verdict) << ", " << c.text);
    CHECK_FALSE (c.isBroken());
    CHECK (c.text.find ("'beat'") != std::string::npos);
}

TEST_CASE ("what the contact drives through a param stays in the loop, however late", "[graphs][check]")
{
    const bool is_late = GENERATE (true, false);   // a spring delayed by 100 ticks; one whose stiffness swings
    test::Sketch s { loadGraph (clip_presets / "soft_pad.json").graph };
    s.node ("spring", is_late ? "signal.constant" : "signal.lfo").node ("up", "vector.join");
    s.wire (is_late ? "pad.depth -> [100] -> spring.value" : "pad.depth -> spring.amplitude").wire ("spring.out -> up.z").wire ("up.out -> motor.force");
    auto& wires = s.graph.root.wires;
    wires[wires.size() - 3].gain = is_late ? "2 N/mm" : "0.3 N/mm";
    const auto c = contactOf (s.graph);
    INFO (check::nameOf (c.verdict) << ", " << c.text);
    CHECK (c.verdict == (is_late ? check::Verdict::unstable : check::Verdict::unknown));
}

TEST_CASE ("a clip that plays over time and that the contact fades in counts neither as stiffness nor as damping", "[graphs][check]")
{
    const auto g = loadGraph (clip_presets / "heartbeat.json").graph;
    const auto with = slopesOf (withGain (g, "beat", 1.0)), without = slopesOf (withGain (g, "beat", 0.0));
    CHECK (without.second > 0.1);   // of the chest
    CHECK (with.first == Approx (without.first).epsilon (0.02));
    CHECK (with.second == Approx (without.second).epsilon (0.02));
}

TEST_CASE ("a clip along the path counts as a texture: its slope is found", "[graphs][check]")
{
    const auto g = loadGraph (clip_presets / "zip.json").graph;
    const auto with = slopesOf (withGain (g, "teeth", 2.0)), without = slopesOf (withGain (g, "teeth", 0.0));
    CHECK (with.first > 1.2 * without.first);
}

TEST_CASE ("a clip that plays by itself, or when the contact hits it, does not change the verdict on a pad", "[graphs][check]")
{
    const auto without = contactOf (loadGraph (clip_presets / "soft_pad.json").graph);
    INFO (without.text);
    CHECK (without.verdict == check::Verdict::passive_here);
    for (const auto* drive : { "start", "run" })
    {
        const auto with = contactOf (padWithClip (drive).graph);
        INFO (drive << ": " << with.text);
        CHECK (with.verdict == without.verdict);
        CHECK (with.value == Approx (without.value).epsilon (0.02));   // the hand that the clip moves goes a little deeper
    }
}
