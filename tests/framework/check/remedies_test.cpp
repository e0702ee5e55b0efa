// SPDX-License-Identifier: MIT
// Who follows a remedy of a condition has done enough: the condition is then not broken, or, if it was close, holds.
#include <support/property.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace tactus;

namespace
{
/// What a graph asks for, and a device.
struct Case
{
    check::Demand demand {};
    DeviceNumbers device {};

    check::RoleDemand& role() { return demand.roles.front(); }
    check::Texture& texture() { return demand.textures.front(); }

    std::vector<check::Condition> conditions() const { return check::judge (demand, std::vector<check::RoleDevice> { { "tip", device, "made up" } }); }

    void makeStiff (double stiffness)
    {
        for (auto& s : role().slopes)
        {
            s.lag *= stiffness / s.stiffness;
            s.stiffness = stiffness;
        }
    }

    /// With the same static_ratio.
    void stretchBy (double factor)
    {
        demand.stretches.front().d_max *= factor;
        demand.stretches.front().teeth *= factor;
    }

    void tickAt (double rate_hz)
    {
        for (auto& s : role().slopes)
            s.lag *= demand.rate_hz / rate_hz;   // as many ticks as before
        demand.rate_hz = rate_hz;
    }
};

constexpr double beyond = 1.0 + 1e-9;   // "above" and "below" are strict

/// What a remedy begins with, and how the number after it is applied. Longer beginnings come first.
using Follow = std::function<void (Case&, double)>;
const std::vector<std::pair<std::string, Follow>>& remedies()
{
    static const std::vector<std::pair<std::string, Follow>> all {
        { "a d_max at least ", [] (Case& c, double v) { c.makeStiff (c.role().slopes.front().stiffness / v); } },
        { "a stiffness of at most ", [] (Case& c, double v) { c.makeStiff (v); } },
        { "a stiffness at most ", [] (Case& c, double v) { c.makeStiff (c.role().slopes.front().stiffness * v); } },
        { "a rate of at least ", [] (Case& c, double v) { c.tickAt (v); } },
        { "a rate above ", [] (Case& c, double v) { c.tickAt (v * beyond); } },
        { "a virtual damping of at most ", [] (Case& c, double v) { c.role().slopes.front().damping = v; } },
        { "a virtual damping below ", [] (Case& c, double v) { c.role().slopes.front().damping = v / beyond; } },
        { "a device with a damping of at least ", [] (Case& c, double v) { c.device.damping->value = v; } },
        { "a device with a dry friction of at least ", [] (Case& c, double v) { c.device.coulomb->value = v; } },
        { "a quantum of at most ", [] (Case& c, double v) { c.device.quantum->value = 1e-6 * v; } },
        { "a quantum below ", [] (Case& c, double v) { c.device.quantum->value = 1e-6 * v / beyond; } },
        { "a window of at least ",   // in ms: the response to a step of the tool is lower, as it lasts as long; only its height counts here
          [] (Case& c, double v) {
              const auto& s = c.role().slopes.front();
              const auto ticks = static_cast<std::size_t> (std::ceil (1e-3 * v * c.demand.rate_hz * (1.0 - 1e-9)));
              check::Jacobian held = check::Jacobian::Zero (3, 3), excess = held;
              held (0, 0) = s.stiffness;
              excess (0, 0) = s.damping * c.demand.rate_hz / static_cast<double> (ticks);
              auto& linked = c.demand.linked.emplace_back();
              linked.responses = { held + excess, held };
              linked.settled = held;
              linked.late = linked.excess = check::Jacobian::Zero (3, 3);
          } },
        { "a device that gives at least ", [] (Case& c, double v) { c.device.peak_force->value = v; } },
        { "a device whose first mode is at least ", [] (Case& c, double v) { c.device.first_mode->value = v; } },
        { "a device whose first mode is above ", [] (Case& c, double v) { c.device.first_mode->value = v * beyond; } },
        { "a stretch above ", [] (Case& c, double v) { c.stretchBy (1e-6 * v * beyond / c.demand.stretches.front().d_max); } },
        { "teeth above ", [] (Case& c, double v) { c.stretchBy (1e-6 * v * beyond / c.demand.stretches.front().teeth); } },
        { "strokes slower than ",
          [] (Case& c, double v) {
              c.texture().speed = v / beyond;
              if (! c.demand.stretches.empty()) c.demand.stretches.front().speed = v / beyond;
          } },
        { "a texture more than ", [] (Case& c, double v) { c.texture().amplitude *= v * beyond; } },
        { "a texture at most ", [] (Case& c, double v) { c.texture().slope *= v; } },
        { "a force quantum below ", [] (Case& c, double v) { c.device.force_quantum->value = v / beyond; } },
        { "a force that rises over at least ",   // its slope is then judged as a stiffness
          [] (Case& c, double v) {
              c.role().slopes.front() = { .stiffness = c.demand.jumps.front().force / (1e-3 * v) };
              c.demand.jumps.clear();
          } },
    };
    return all;
}

/// Those without a number.
bool isInWords (const std::string& way)
{
    static const std::set<std::string> all { "weaker forces", "a coarser texture", "a texture.antialias", "a softer contact", "slower strokes",
                                             "a softer onset", "a force that does not step",
                                             "a smaller b (that no damper of the graph claims and a ceiling or a filter or a hold.predictive may cause)",
                                             "a virtual damping below that of the device and a softer contact" };
    static const std::array begin { "a texture.antialias with f_max ", "a lower f_max of ", "a filter.butterworth2 at " };
    return all.contains (way) || std::ranges::any_of (begin, [&] (const char* b) { return way.starts_with (b); });
}

/// The alternatives of "largest effect on the loop: …; for a contact …: a, b, or c; the steepest node is …".
std::vector<std::string> waysOf (const check::Condition& c)
{
    auto text = c.remedy;
    const std::string whatever = "whatever the hand does: ";
    if (const auto at = text.find (whatever); at != text.npos) text.erase (0, at + whatever.size());
    text.erase (std::min (text.size(), text.find ("; the steepest node")));
    std::vector<std::string> ways;
    for (std::size_t from = 0; from <= text.size();)
    {
        const auto to = std::min (text.size(), text.find (", ", from));
        auto way = text.substr (from, to - from);
        if (way.starts_with ("or ")) way.erase (0, 3);
        ways.push_back (std::move (way));
        from = to + 2;
    }
    return ways;
}

double drawn (double low, double high)
{
    constexpr int steps = 1000;   // even in the logarithm
    return low * std::pow (high / low, double (*rc::gen::inRange (0, steps + 1)) / steps);
}

Case drawnCase()
{
    Case c;
    const auto number = [] (double low, double high) { return DeviceNumber { .value = drawn (low, high), .source = "made up" }; };
    c.device.mass = number (1e-3, 1.0);
    c.device.damping = number (1e-3, 20.0);
    c.device.coulomb = number (1e-4, 1.0);
    c.device.quantum = number (1e-8, 1e-4);
    c.device.force_quantum = number (1e-5, 0.1);
    c.device.first_mode = number (10.0, 1e4);
    c.device.peak_force = number (0.1, 20.0);
    c.device.delay = DeviceNumber { .value = double (*rc::gen::inRange (0, 4)), .source = "made up" };
    c.demand.rate_hz = drawn (500.0, 1e4);
    if (*rc::gen::arbitrary<bool>()) c.device.rate = DeviceNumber { .value = c.demand.rate_hz * drawn (1.0, 8.0), .source = "made up" };
    c.demand.nodes = { { "node", "some.node" }, { "texture", "some.texture" } };
    check::Slope slope { .stiffness = drawn (10.0, 1e5), .by_node = { 1.0 } };
    if (*rc::gen::arbitrary<bool>()) slope.damping = drawn (1e-2, 50.0);
    if (*rc::gen::arbitrary<bool>()) slope.lag = slope.stiffness / c.demand.rate_hz * drawn (0.1, 3.0);
    const double peak = drawn (0.1, 20.0), fastest = drawn (10.0, 1e6), speed = drawn (0.01, 2.0);
    const double dampers = *rc::gen::arbitrary<bool>() ? slope.damping * drawn (0.1, 2.0) : 0.0;
    c.demand.roles = { { .role = "tip", .slopes = { slope }, .peak_force = peak, .fastest_force = fastest, .speed = speed, .dampers = dampers } };
    const double frequency = drawn (10.0, 1e4), amplitude = drawn (1e-3, 5.0), steepness = drawn (1.0, 1e6), stroke = drawn (1e-3, 2.0);
    c.demand.textures = { { .node = 1, .role = "tip", .spatial_frequency = frequency, .amplitude = amplitude, .slope = steepness, .speed = stroke } };
    if (*rc::gen::arbitrary<bool>())
    {
        const double d_max = drawn (1e-7, 1e-3), teeth = *rc::gen::arbitrary<bool>() ? 0.0 : drawn (1e-8, 1e-3), slide = drawn (1e-3, 2.0);
        using Softer = check::Stretch::Softer;
        const auto softer = *rc::gen::element (Softer::unknown, Softer::d_max, Softer::stiffness);
        c.demand.stretches = { { .role = "tip", .d_max = d_max, .teeth = teeth, .speed = slide, .softer = softer } };
    }
    if (*rc::gen::arbitrary<bool>()) c.demand.jumps = { { .role = "tip", .node = 0, .force = drawn (1e-3, 5.0) } };
    return c;
}
}   // namespace

namespace
{
/// Follows each number of each remedy of a case, and counts which.
void followAll (const Case& c, std::map<std::string, int>& followed)
{
    for (const auto& condition : c.conditions())
    {
        // Passive here, if not everywhere.
        const bool is_passive = condition.id == "stiffness" && ! condition.isBroken() && condition.value <= 1.00001 * condition.limit;
        if (! condition.isKnown() || condition.verdict == check::Verdict::holds || is_passive) continue;
        for (const auto& way : waysOf (condition))
        {
            if (isInWords (way)) continue;
            const auto known = std::ranges::find_if (remedies(), [&] (const auto& r) { return way.starts_with (r.first); });
            if (known == remedies().end()) RC_FAIL ("not known: " + way);
            auto after = c;
            if (condition.text.find (", without b,") != std::string::npos) after.role().slopes.front().damping = 0.0;   // which `damping` asks for
            known->second (after, std::strtod (way.c_str() + known->first.size(), nullptr));
            ++followed[known->first];
            const auto all = after.conditions();
            // A force that rises has a stiffness instead of a jump.
            const auto isSame = [&] (const auto& c) {
                return condition.id == "jump" ? c.id == "stiffness" : c.id == condition.id && (c.id != "scanning" || c.node == condition.node);
            };
            const auto now = std::ranges::find_if (all, isSame);
            if (condition.id == "blow" && now == all.end()) continue;   // a damper that is too weak for a row
            RC_ASSERT (now != all.end());
            const bool must_hold = condition.verdict == check::Verdict::close, is_contact = now->id == "stiffness";
            const bool is_enough =
                is_contact ? now->value <= 1.00002 * now->limit : ! now->isBroken() && (! must_hold || now->verdict == check::Verdict::holds);
            if (! is_enough) RC_FAIL (std::string (condition.id) + ": " + way + " gives " + std::string (check::nameOf (now->verdict)) + ": " + now->text);
        }
    }
}
}   // namespace

TEST_CASE ("who follows any number in a remedy has done enough", "[check][property]")
{
    std::map<std::string, int> followed;
    test::property ("any demand and any device", [&] {
        for (int i = 0; i < 40; ++i)
            followAll (drawnCase(), followed);
    });
    for (const auto& [way, follow] : remedies())
    {
        INFO (way);
        CHECK (followed[way] > 0);   // the rarest about twenty times
    }
}

namespace
{
/// A hand that strokes a plane, what it feels, and a device.
struct Stroke
{
    test::Sketch sketch {};
    DeviceNumbers device {};

    explicit Stroke (double damping, double stiffness = 500.0)
    {
        const auto n = [] (double value) { return DeviceNumber { .value = value, .source = "made up" }; };
        device.mass = n (0.05);
        device.damping = n (damping);
        device.force_quantum = n (0.01);
        sketch.node ("hand", "device.position").node ("motor", "device.force");
        for (auto& node : sketch.graph.root.nodes)
            node.role = "tip";
        sketch.node ("wall", "deform.plane", { { "stiffness", stiffness } }).wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
        sketch.graph.rate_hz = 2000.0;
        const Json hand { { "stiffness", 100.0 }, { "damping", 2.0 }, { "path", "stroke" } };
        sketch.graph.devices.emplace_back ("tip", Json { { "driver", "sim" }, { "mass", 0.05 }, { "damping", 2.0 }, { "hand", hand } });
    }

    check::Condition judged (const char* id) const
    {
        const check::Subject subject { sketch.graph, catalogue() };
        const auto recorded = check::recordMotion (subject, {}, ".");
        INFO (test::text (recorded.messages));
        REQUIRE (recorded.motion.ticks > 0);
        const auto all = check::judge (check::measure (subject, recorded.motion, { .places = 48 }), std::vector<check::RoleDevice> { { "tip", device, "" } });
        const auto at = std::ranges::find (all, id, &check::Condition::id);
        REQUIRE (at != all.end());
        return *at;
    }
};

/// The number after this text in the remedy.
double numberAfter (const check::Condition& c, const std::string& text)
{
    INFO (c.remedy);
    const auto at = c.remedy.find (text);
    REQUIRE (at != std::string::npos);
    return std::strtod (c.remedy.c_str() + at + text.size(), nullptr);
}
}   // namespace

TEST_CASE ("the remedy for a weak texture is a factor of what is set at its node, whatever weakens it on its way to the hand", "[check]")
{
    const auto weak = [] (double amplitude) {
        Stroke s { 2.0 };
        s.sketch.node ("ribs", "texture.grating", { { "amplitude", amplitude }, { "spatial_frequency", 100.0 } });
        s.sketch.node ("less", "vector.scale").node ("third", "signal.constant", { { "value", 0.3 } });
        s.sketch.wire ("hand.position -> ribs.position").wire ("ribs.force -> less.in").wire ("third.out -> less.gain").wire ("less.out -> motor.force");
        return s.judged ("force_resolution");
    };
    const auto before = weak (0.2);   // above 0.1 N at the node, and 0.06 N in the hand
    REQUIRE (before.verdict == check::Verdict::broken);
    CHECK (before.remedy.find ("amplitude") == std::string::npos);
    const double factor = numberAfter (before, "a texture more than ");
    CHECK (factor == Approx (0.1 / 0.06).epsilon (0.02));
    CHECK (weak (0.2 * factor * 1.01).verdict == check::Verdict::holds);
}

TEST_CASE ("the remedy for a stiff friction is a longer stretch, no predictive hold, and that of a wall may be one", "[check]")
{
    const auto rubbed = [] (double d_max) {
        Stroke s { 0.5 };
        s.sketch.node ("drag", "friction.elasto_plastic", { { "d_max", d_max }, { "reference_load", 0.5 } });
        s.sketch.wire ("hand.position -> drag.position").wire ("wall.resistance -> drag.normal_force").wire ("drag.force -> motor.force");
        return s.judged ("stiffness");
    };
    const auto before = rubbed (2e-5);
    INFO (before.text << "; " << before.remedy);
    CHECK (before.value > before.limit);
    CHECK (before.remedy.find ("hold.predictive") == std::string::npos);
    CHECK (before.remedy.find ("'drag'") != std::string::npos);
    const double times = numberAfter (before, "a d_max at least ");
    CHECK (times > 1.0);
    CHECK (rubbed (2e-5 * times).value <= 1.00001 * rubbed (2e-5 * times).limit);

    const auto hard = Stroke { 0.5, 8000.0 }.judged ("stiffness");
    CHECK (hard.value > hard.limit);
    CHECK (hard.remedy.find ("a d_max") == std::string::npos);
}

TEST_CASE ("a friction with a stiffness of its own is told a softer one, because its d_max has no effect on it", "[check]")
{
    const auto type = GENERATE (as<std::string> {}, "friction.elasto_plastic", "friction.anisotropic");
    const auto adhesion = GENERATE (as<std::string> {}, "stick", "dahl");   // dahl is twice as stiff on a reversal
    const auto rubbed = [&] (double stiffness, double d_max) {
        Stroke s { 0.5 };
        s.sketch.node ("drag", type, { { "stiffness", stiffness }, { "d_max", d_max }, { "adhesion", adhesion } });
        s.sketch.wire ("hand.position -> drag.position").wire ("wall.resistance -> drag.normal_force").wire ("drag.force -> motor.force");
        return s.judged ("stiffness");
    };
    const auto before = rubbed (9000.0, 1e-4), longer = rubbed (9000.0, 1e-2);
    INFO (type << ", " << adhesion << ": " << before.text << "; " << before.remedy);
    CHECK (before.value > before.limit);
    CHECK (longer.value == Approx (before.value));
    CHECK (before.remedy.find ("d_max") == std::string::npos);
    const auto after = rubbed (9000.0 * numberAfter (before, "a stiffness at most "), 1e-4);
    CHECK (after.value <= 1.00001 * after.limit);
}

TEST_CASE ("the remedy behind a hold.predictive is a softer wall or a higher rate, since its b falls with them", "[check]")
{
    const auto predicted = [] (double stiffness, double rate_hz) {
        Stroke s { 0.5, stiffness };
        s.sketch.graph.rate_hz = rate_hz;
        s.sketch.graph.root.wires.pop_back();   // wall.force -> motor.force
        s.sketch.node ("hold", "hold.predictive").wire ("wall.force -> hold.in").wire ("hold.out -> motor.force");
        return s.judged ("stiffness");
    };
    const auto before = predicted (8000.0, 2000.0);
    INFO (before.text << "; " << before.remedy);
    CHECK (before.value > before.limit);
    CHECK (before.remedy.find ("a smaller b") == std::string::npos);
    const auto softer = predicted (numberAfter (before, "a stiffness of at most "), 2000.0);
    CHECK (softer.value <= 1.001 * softer.limit);
    CHECK (softer.value > 0.99 * softer.limit);
    const auto faster = predicted (8000.0, numberAfter (before, "a rate of at least "));
    CHECK (faster.value <= 1.001 * faster.limit);
    CHECK (faster.value > 0.99 * faster.limit);
}

TEST_CASE ("no remedy asks for a rate that the device cannot follow", "[check]")
{
    for (const double own : { 0.0, 2000.0 })
    {
        Stroke s { 0.5, 8000.0 };
        if (own > 0.0) s.device.rate = DeviceNumber { .value = own, .source = "made up" };
        const auto stiff = s.judged ("stiffness");
        INFO (stiff.remedy);
        CHECK ((stiff.remedy.find (" rate") == std::string::npos) == (own > 0.0));
    }
}
