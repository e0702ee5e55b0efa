// SPDX-License-Identifier: MIT
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/file/graph_file.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <map>
#include <set>

using namespace tactus;

namespace
{
/// A stroke over a soft ribbed board. A good device can render it without breaking a condition.
struct Board
{
    double rate_hz = 2000.0;
    double stiffness = 200.0, damping = 0.0;             // of the wall, N/m and N s/m
    double d_max = 1e-3, static_ratio = 1.0;             // m, and the length of teeth over d_max, plus 1
    double amplitude = 0.1, spatial_frequency = 100.0;   // of the grating, N and 1/m
    double knock = 0.0;                                  // amplitude of a square wave, N
    const char* path = "stroke";
    double above = 0.0;   // how far the path is raised above the board, m
    int delay = 0;        // of the wire from the wall, in ticks

    graph::Graph graph() const
    {
        test::Sketch s;
        s.node ("hand", "device.position").node ("motor", "device.force");
        for (auto& node : s.graph.root.nodes)
            node.role = "tip";
        s.node ("wall", "deform.plane", { { "stiffness", stiffness }, { "damping", damping } });
        s.node ("drag", "friction.elasto_plastic", { { "d_max", d_max }, { "static_ratio", static_ratio } });
        s.node ("ribs", "texture.grating", { { "amplitude", amplitude }, { "spatial_frequency", spatial_frequency } });
        s.node ("square", "signal.lfo", { { "amplitude", knock }, { "shape", "square" }, { "frequency", 20.0 } }).node ("knock", "vector.join");
        s.wire ("hand.position -> wall.position").wire ("hand.position -> drag.position").wire ("hand.position -> ribs.position");
        s.wire ("wall.resistance -> drag.normal_force").wire ("drag.force -> motor.force").wire ("ribs.force -> motor.force");
        s.wire (delay > 0 ? "wall.force -> [" + std::to_string (delay) + "] -> motor.force" : "wall.force -> motor.force");
        s.wire ("square.out -> knock.z").wire ("knock.out -> motor.force");
        s.graph.rate_hz = rate_hz;
        const Json hand { { "stiffness", 100.0 }, { "damping", 2.0 }, { "path", path }, { "offset", { 0.0, 0.0, above } } };
        const Json tip { { "driver", "sim" }, { "mass", 0.05 }, { "damping", 2.0 }, { "position", { 0.0, 0.0, above } }, { "hand", hand } };
        s.graph.devices.emplace_back ("tip", tip);
        return s.graph;
    }
};

DeviceNumbers goodDevice()
{
    const auto n = [] (double value) { return DeviceNumber { .value = value, .source = "made up" }; };
    DeviceNumbers d;
    d.mass = n (0.1);
    d.damping = n (2.0);
    d.coulomb = n (0.2);
    d.quantum = n (1e-5);
    d.force_quantum = n (1e-3);
    d.delay = n (0.0);
    d.first_mode = n (200.0);
    d.peak_force = n (5.0);
    return d;
}

struct Trial
{
    Board board {};
    DeviceNumbers device = goodDevice();
    check::JudgeOptions options {};

    check::Demand demand() const
    {
        const auto graph = board.graph();
        const check::Subject subject { graph, catalogue() };
        const auto recorded = check::recordMotion (subject, {}, ".");
        INFO (test::text (recorded.messages));
        REQUIRE (recorded.motion.ticks > 0);
        return check::measure (subject, recorded.motion, { .places = 48 });
    }

    std::vector<check::Condition> conditions() const
    {
        const std::vector<check::RoleDevice> devices { { "tip", device, "made up" } };
        return check::judge (demand(), devices, options);
    }

    std::set<std::string> broken() const
    {
        std::set<std::string> names;
        for (const auto& c : conditions())
            if (c.isBroken()) names.insert (std::string (c.id));
        return names;
    }
};

std::set<std::string> brokenBy (const std::function<void (Trial&)>& change)
{
    Trial t;
    change (t);
    return t.broken();
}

const check::Condition& named (const std::vector<check::Condition>& all, std::string_view id)
{
    const auto at = std::ranges::find (all, id, &check::Condition::id);
    REQUIRE (at != all.end());
    return *at;
}

using Names = std::set<std::string>;
}   // namespace

TEST_CASE ("teeth of stick-slip are scanned like a texture of their length", "[check]")
{
    Trial t;
    t.board.static_ratio = 1.5;   // teeth of 0.5 mm
    const auto scanned = [&] {
        const auto all = t.conditions();
        const auto at = std::ranges::find_if (all, [] (const auto& c) { return c.id == "scanning" && c.node == "drag"; });
        REQUIRE (at != all.end());
        return *at;
    };
    CHECK (scanned().value > 0.0);   // at the speed of the motion
    const auto demand = t.demand();
    REQUIRE (demand.stretches.size() == 1);
    CHECK (demand.stretches.front().teeth == Approx (0.5 * demand.stretches.front().d_max));
    CHECK (demand.stretches.front().speed > 0.0);
    CHECK (demand.stretches.front().speed <= demand.roles.front().speed);
    const double two_ticks = demand.stretches.front().teeth * t.board.rate_hz / 2.0;   // the speed at which a tooth lasts so long
    t.options.speed = 0.98 * two_ticks;
    CHECK (scanned().value == Approx (0.98));
    CHECK (scanned().verdict == check::Verdict::close);
    t.options.speed = 1.02 * two_ticks;
    CHECK (scanned().isBroken());
    CHECK (scanned().text.find ("teeth of ") == 0);
    CHECK (scanned().remedy.find ("strokes slower than ") == 0);
    t.board.static_ratio = 1.0;
    for (const auto& c : t.conditions())
        CHECK_FALSE ((c.id == "scanning" && c.node == "drag"));
}

TEST_CASE ("a good device breaks no condition, and all of them are judged", "[check]")
{
    Names ids;
    for (const auto& c : Trial {}.conditions())
    {
        INFO (c.id << ": " << c.value << " of " << c.limit << ", " << c.text);
        const bool holds = c.verdict == (c.id == "stiffness" ? check::Verdict::passive : check::Verdict::holds);
        CHECK ((holds || c.verdict == check::Verdict::close));
        CHECK (c.margin() >= 1.0);
        CHECK (c.remedy.empty() == holds);
        ids.insert (std::string (c.id));
    }
    CHECK (ids
           == Names { "stiffness", "damping", "quantum", "peak_force", "slew", "d_max", "scanning", "low_speed", "high_speed", "force_resolution", "gain",
                      "structural" });
}

TEST_CASE ("a graph or a device that breaks one condition breaks only that one", "[check]")
{
    CHECK (brokenBy ([] (Trial& t) { t.device.damping->value = 0.03; }) == Names { "stiffness" });
    CHECK (brokenBy ([] (Trial& t) { t.board.stiffness = 12e3; t.device.coulomb->value = 1.0; t.device.peak_force->value = 50.0; }) == Names { "stiffness" });
    CHECK (brokenBy ([] (Trial& t) { t.device.mass->value = 1e-4; t.board.damping = 3.0; }) == Names { "damping" });
    CHECK (brokenBy ([] (Trial& t) { t.device.coulomb->value = 5e-4; }) == Names { "quantum" });
    CHECK (brokenBy ([] (Trial& t) { t.device.peak_force->value = 0.2; t.device.first_mode->value = 1e4; }) == Names { "peak_force" });
    CHECK (brokenBy ([] (Trial& t) { t.board.knock = 2.0; t.device.peak_force->value = 8.0; t.device.first_mode->value = 100.0; }) == Names { "slew" });
    CHECK (brokenBy ([] (Trial& t) { t.board.d_max = 5e-6; t.device.damping->value = 200.0; t.device.coulomb->value = 5.0; }) == Names { "d_max" });
    CHECK (brokenBy ([] (Trial& t) { t.options.speed = 11.0; t.device.first_mode->value = 1e4; }) == Names { "scanning" });
    CHECK (brokenBy ([] (Trial& t) { t.device.force_quantum->value = 0.02; }) == Names { "force_resolution" });
    CHECK (brokenBy ([] (Trial& t) { t.device.first_mode->value = 3.0; t.device.peak_force->value = 500.0; }) == Names { "structural" });

    const auto finelyRibbed = [] (Trial& t) {
        t.board.spatial_frequency = 6000.0;
        t.options.speed = 0.01;
    };
    CHECK (brokenBy ([&] (Trial& t) { finelyRibbed (t); t.options.factors.beta = 20.0; }) == Names { "low_speed" });
    CHECK (brokenBy ([&] (Trial& t) { finelyRibbed (t); t.options.factors.alpha = 20.0; }) == Names { "high_speed" });
    CHECK (brokenBy ([&] (Trial& t) { finelyRibbed (t); t.board.amplitude = 0.5; }) == Names { "gain" });
}

TEST_CASE ("a friction and a texture that the motion does not reach are listed, with what to do", "[check]")
{
    Trial t;
    t.board.above = 0.02;
    t.board.amplitude = 0.0;
    std::map<std::string, check::Condition> unreached;
    for (const auto& c : t.conditions())
    {
        CHECK_FALSE (c.isBroken());
        if (c.id == "reach") unreached.emplace (c.node, c);
    }
    REQUIRE (unreached.size() == 2);
    for (const auto* node : { "drag", "ribs" })
    {
        INFO (node);
        REQUIRE (unreached.contains (node));
        const auto& c = unreached.at (node);
        CHECK (c.verdict == check::Verdict::not_reached);
        CHECK (c.margin() == 0.0);
        CHECK (c.remedy.find ("--sweep") != std::string::npos);
    }
}

TEST_CASE ("every condition that a graph breaks is reported by name", "[check]")
{
    Trial t;
    t.board = { .rate_hz = 1000.0, .stiffness = 1e5, .d_max = 1e-6, .amplitude = 0.01, .spatial_frequency = 20e3 };
    t.device.damping->value = 0.05;
    t.device.coulomb->value = 0.0;
    t.device.quantum->value = 3e-5;
    t.device.force_quantum->value = 0.05;
    t.device.first_mode->value = 30.0;
    const auto all = t.conditions();
    Names broken;
    for (const auto& c : all)
        if (c.isBroken())
        {
            broken.insert (std::string (c.id));
            INFO (c.id);
            CHECK (c.remedy.size() > 20);
            CHECK (c.text.size() > 3);
            CHECK (c.margin() < 1.0);
        }
    for (const auto* id : { "stiffness", "quantum", "d_max", "scanning", "low_speed", "high_speed", "force_resolution", "gain", "structural" })
    {
        INFO (id);
        CHECK (broken.contains (id));
    }
    CHECK (named (all, "d_max").node == "drag");
    CHECK (named (all, "gain").node == "ribs");
    CHECK (named (all, "stiffness").value >= 1e5 * 1e-3 / 2.0);
}

TEST_CASE ("the measured stiffness, damping and delay of a wall are those of its datasheet, whatever its orientation", "[check]")
{
    Trial t;
    t.board = { .stiffness = 700.0, .damping = 1.5, .amplitude = 0.0, .path = "press", .delay = 3 };
    auto graph = t.board.graph();
    std::erase_if (graph.root.wires, [] (const graph::Wire& w) { return w.from.node == "drag"; });
    const auto press = check::recordMotion ({ graph, catalogue() }, {}, ".");
    const auto demand = check::measure ({ graph, catalogue() }, press.motion, { .places = 48 });
    const auto most = std::ranges::max_element (demand.roles[0].slopes, {}, &check::Slope::stiffness);
    REQUIRE (most != demand.roles[0].slopes.end());
    CHECK (most->stiffness == Approx (700.0).epsilon (1e-5));
    CHECK (most->damping == Approx (1.5).epsilon (1e-3));
    CHECK (most->lag == Approx (700.0 * 3 / 2000.0).epsilon (1e-3));
    CHECK (demand.roles[0].longest == 3);
}

TEST_CASE ("a stiff friction counts twice on a reversal of Dahl's model, and once with ideal sticking", "[check]")
{
    for (const auto& [adhesion, factor] : { std::pair ("stick", 1.0), std::pair ("dahl", 2.0) })
    {
        test::Sketch s;
        s.node ("hand", "device.position").node ("motor", "device.force");
        for (auto& node : s.graph.root.nodes)
            node.role = "tip";
        s.node ("drag", "friction.elasto_plastic", { { "mu", 0.5 }, { "d_max", 1e-3 }, { "adhesion", adhesion } });
        s.wire ("hand.position -> drag.position").wire ("drag.force -> motor.force");
        s.graph.rate_hz = 1000.0;
        s.graph.devices.emplace_back ("tip", Json { { "driver", "gesture" }, { "path", "stroke" } });
        const auto motion = check::recordMotion ({ s.graph, catalogue() }, {}, ".").motion;
        const auto demand = check::measure ({ s.graph, catalogue() }, motion, { .places = 48 });
        double most = 0.0;
        for (const auto& slope : demand.roles[0].slopes)
            most = std::max (most, slope.stiffness);
        INFO (adhesion);
        CHECK (most == Approx (factor * 500.0).epsilon (0.02));
    }
}

TEST_CASE ("a tone that a slip sets off is an event, not a slope", "[check]")
{
    const auto graph = loadGraph (std::string (TACTUS_SOURCE_DIR) + "/graphs/singing_glass.json").graph;
    const auto motion = check::recordMotion ({ graph, catalogue() }, {}, ".").motion;
    REQUIRE (motion.ticks > 0);
    const auto demand = check::measure ({ graph, catalogue() }, motion);
    for (const auto& slope : demand.roles[0].slopes)
    {
        INFO (slope.t_s << " s");
        CHECK (slope.stiffness < 2e4);
        CHECK (slope.damping < 20.0);
    }
}

TEST_CASE ("a low-pass in the loop counts as a delay, as long as the one it has at low frequency", "[check]")
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("motor", "device.force");
    for (auto& node : s.graph.root.nodes)
        node.role = "tip";
    s.node ("wall", "deform.plane", { { "stiffness", 500.0 }, { "offset", 1.0 } }).node ("smooth", "filter.butterworth2", { { "cutoff", 400.0 } });
    s.wire ("hand.position -> wall.position").wire ("wall.resistance -> smooth.in").node ("up", "vector.join").wire ("smooth.out -> up.z");
    s.wire ("up.out -> motor.force");
    s.graph.rate_hz = 10e3;
    s.graph.devices.emplace_back ("tip", Json { { "driver", "gesture" }, { "path", "stroke" } });   // a free tool would be pushed away
    const auto motion = check::recordMotion ({ s.graph, catalogue() }, {}, ".", 0.1).motion;
    const auto demand = check::measure ({ s.graph, catalogue() }, motion, { .places = 4 });
    const auto& slope = demand.roles[0].slopes.back();
    CHECK (slope.stiffness == Approx (500.0).epsilon (0.02));
    // At low frequency the filter lags by 1/(pi sqrt 2 f_c). Its overshoot counts as damping and is not subtracted from the lag, so the
    // sum of both is never too small.
    const double delay = 1.0 / (3.14159265 * 1.41421356 * 400.0);
    CHECK (slope.lag - slope.damping == Approx (500.0 * delay).epsilon (0.1));
    CHECK (slope.lag >= 500.0 * delay);
}

TEST_CASE ("the PHANTOM renders a 10 mm grating below 0.3 m/s and a 1 mm one below 0.03 m/s, the Pantograph up to 4 and 0.4 m/s", "[check]")
{
    struct Case
    {
        double first_mode, period, speed;
    };
    constexpr Case cases[] { { 30.0, 0.01, 0.3 }, { 30.0, 0.001, 0.03 }, { 400.0, 0.01, 4.0 }, { 400.0, 0.001, 0.4 } };
    for (const auto& [first_mode, period, speed] : cases)
    {
        Trial t;
        t.board = { .rate_hz = 10e3, .amplitude = 0.05, .spatial_frequency = 1.0 / period };
        t.device.first_mode->value = first_mode;
        INFO (first_mode << " Hz, period " << period << " m");
        const auto demand = t.demand();
        const std::vector<check::RoleDevice> devices { { "tip", t.device, "made up" } };
        for (const double factor : { 0.99, 1.01 })
        {
            const auto all = check::judge (demand, devices, { .speed = factor * speed });
            CHECK (named (all, "structural").verdict == (factor < 1.0 ? check::Verdict::holds : check::Verdict::broken));
            CHECK (named (all, "scanning").verdict != check::Verdict::broken);
        }
    }
}

TEST_CASE ("a condition that needs an unknown number of the device is unknown, not broken", "[check]")
{
    Trial t;
    t.device = {};
    for (const auto& c : t.conditions())
    {
        INFO (c.id);
        if (c.id == "scanning")
            CHECK (c.verdict == check::Verdict::holds);
        else
        {
            CHECK (c.verdict == check::Verdict::unknown);
            CHECK (c.remedy.find ("is not known") != std::string::npos);
        }
    }
}

TEST_CASE ("a contact that swings in a trial is not called passive along the motion in the same sentence", "[check]")
{
    Trial t;
    t.board.knock = 0.5;   // plays by itself
    const auto of_slopes = named (t.conditions(), "stiffness");
    INFO (of_slopes.text);
    REQUIRE (of_slopes.verdict == check::Verdict::passive_here);
    REQUIRE (of_slopes.text.find ("passive along this motion only") != std::string::npos);
    const check::Trials trials { .by_role = { { .role = "tip", .is_tried = true, .swings = true, .range = 1e-4, .after_s = 0.5, .off = 1e-3 } },
                                 .places = 1,
                                 .runs = 1 };
    t.options.trials = &trials;
    const auto tried = named (t.conditions(), "stiffness");
    INFO (tried.text);
    CHECK (tried.verdict == check::Verdict::unstable);
    CHECK (tried.text.find ("still moves to and fro by 100 um") != std::string::npos);
    CHECK (tried.text.find ("the slopes alone are passive") != std::string::npos);
    CHECK (tried.text.find ("along this motion") == std::string::npos);
}

TEST_CASE ("what would calm a friction is a longer d_max, not the stiffness and damping that it has not", "[check]")
{
    Trial t;
    t.board.amplitude = 0.0;
    t.board.d_max = 2e-6;
    const auto short_one = named (t.conditions(), "stiffness");
    INFO (short_one.text << '\n'
                         << short_one.remedy);
    REQUIRE (short_one.verdict == check::Verdict::unstable);
    REQUIRE (short_one.remedy.starts_with ("a d_max at least "));
    const double longer = std::stod (short_one.remedy.substr (17));
    CHECK (longer == Approx (1.0 / short_one.may_grow).epsilon (0.02));
    t.board.d_max *= 1.02 * longer;
    CHECK (named (t.conditions(), "stiffness").verdict != check::Verdict::unstable);
}
