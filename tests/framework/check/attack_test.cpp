// SPDX-License-Identifier: MIT
// Random loops: none that explodes may pass the check.

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include "loops.hpp"

using namespace tactus;
using test::Loops;

namespace
{
double pick (double min, double max) { return min * std::pow (max / min, 1e-6 * *rc::gen::inRange (0, 1'000'001)); }

std::string place (int hands) { return "h" + std::to_string (*rc::gen::inRange (0, hands)) + "." + *rc::gen::element ('x', 'y', 'z'); }

/// One to three hands with springs to the ground and between them, couplings in one direction, dampers, delays, slow sections.
Loops randomLoops()
{
    Loops loops;
    const int hands = *rc::gen::inRange (1, 4);
    for (int i = 0; i < hands; ++i)
    {
        Simulation tool { .mass = pick (0.02, 0.5), .damping = pick (0.2, 5.0), .delay = *rc::gen::inRange (0, 3) };
        if (*rc::gen::inRange (0, 4) == 0) tool.first_mode = pick (20.0, 300.0);
        loops.tools.push_back (tool);
        // Hold each tool a little, so that nothing drifts away.
        for (const char axis : { 'x', 'y', 'z' })
            loops.ground (loops.hand (static_cast<std::size_t> (i)) + "." + axis, pick (1.0, 20.0));
    }
    const auto strong = [] { return pick (20.0, 3000.0); };
    for (int i = *rc::gen::inRange (1, 4); i > 0; --i)
        switch (*rc::gen::inRange (0, 5))
        {
        case 0:
            loops.ground (place (hands), strong(), *rc::gen::inRange (0, 4));
            break;
        case 1:
        {
            const auto a = place (hands), b = place (hands);
            if (a != b) loops.spring (a, b, strong(), *rc::gen::inRange (0, 3));
            break;
        }
        case 2:
            loops.pull (place (hands), place (hands), pick (1.0, 300.0));
            break;
        case 3:
            loops.slowGround (static_cast<std::size_t> (*rc::gen::inRange (0, hands)), 'x', strong(), *rc::gen::inRange (2, 8));
            break;
        default:
        {
            const auto a = place (hands), b = place (hands);
            loops.pull (a, b, pick (1.0, 300.0));
            loops.pull (b, a, -pick (1.0, 300.0));
        }
        }
    return loops;
}

std::string number (const char* id, double value) { return '"' + std::string (id) + "\": " + std::to_string (value); }

/// What a hand may touch: a wall that pushes against it from one side, perhaps with damping, and with friction that follows the push.
void touch (Loops& loops, std::size_t i)
{
    static const char* sides[] { "[1, 0, 0]", "[-1, 0, 0]", "[0, 1, 0]", "[0, 0, -1]", "[0, 0, 1]", "[0.6, 0, 0.8]" };
    static const char* adhesions[] { "stick", "stick", "dupont", "ramp", "dahl" };
    static const char* loads[] { "bound", "bound", "passive" };
    const std::string side = *rc::gen::elementOf (std::vector<std::string> (std::begin (sides), std::end (sides)));
    const double stiffness = pick (50.0, 6000.0), push = pick (0.05, 1.0);
    auto params = "\"normal\": " + side + ", " + number ("stiffness", stiffness) + ", " + number ("offset", push / stiffness);
    const int damped = *rc::gen::inRange (0, 3);
    if (damped > 0) params += ", " + number ("damping", pick (0.05, 5.0));
    if (damped > 1) params += ", " + number ("dissipation", pick (0.1, 10.0));
    const auto window = *rc::gen::element (0.0, 0.0, 1e-3, 5e-3);
    const auto wall = loops.feels (i, "deform.plane", "\"params\": { " + params + " }, \"settings\": { " + number ("window", window) + " }");
    if (*rc::gen::inRange (0, 2) == 0) return;

    const double d_max = pick (5e-6, 1e-3);
    const auto friction = number ("mu", pick (0.05, 1.0)) + ", \"d_max\": \"" + std::to_string (1e6 * d_max) + " um\", " + number ("reference_load", push)
                          + ", \"adhesion\": \"" + adhesions[*rc::gen::inRange (0, 5)] + "\", \"load\": \"" + loads[*rc::gen::inRange (0, 3)] + '"';
    const auto drag = loops.feels (i, "friction.elasto_plastic", "\"params\": { " + friction + " }");
    loops.wire (wall + ".resistance", drag + ".normal_force");
}

/// A grating or a relief under a hand.
void texture (Loops& loops, std::size_t i)
{
    if (*rc::gen::inRange (0, 2) == 0)
    {
        const auto params = number ("amplitude", pick (5e-3, 0.5)) + ", " + number ("spatial_frequency", pick (50.0, 3000.0)) + ", "
                            + number ("angle", pick (0.01, 3.0)) + ", " + number ("phase", pick (0.1, 6.0));
        loops.feels (i, "texture.grating", "\"params\": { " + params + " }");
        return;
    }
    Grid heights { 12, 12, std::vector<double> (144) };
    for (auto& h : heights.values)
        h = 1e-5 * *rc::gen::inRange (0, 1001) / 1000.0;
    loops.assets->grid = std::make_shared<const Grid> (std::move (heights));
    loops.feels (i, "texture.height_map",
                 "\"params\": { " + number ("gain", pick (0.1, 20.0)) + R"( }, "settings": { "map": { "csv": "heights.csv", "pitch": "0.2 mm" } })");
}

/// One or two hands that touch walls, rub on them, rest on textures, and are held by springs that may be late.
Loops randomContacts()
{
    Loops loops;
    const int hands = *rc::gen::inRange (1, 3);
    for (int i = 0; i < hands; ++i)
    {
        Simulation tool { .mass = pick (0.02, 0.5), .damping = pick (0.2, 5.0), .delay = *rc::gen::inRange (0, 3) };
        if (*rc::gen::inRange (0, 4) == 0) tool.first_mode = pick (20.0, 300.0);
        loops.tools.push_back (tool);
        for (const char axis : { 'x', 'y', 'z' })
            loops.ground (loops.hand (static_cast<std::size_t> (i)) + "." + axis, pick (1.0, 200.0), *rc::gen::inRange (0, 3));
        for (int n = *rc::gen::inRange (0, 3); n > 0; --n)
            touch (loops, static_cast<std::size_t> (i));
        if (*rc::gen::inRange (0, 2) == 1) texture (loops, static_cast<std::size_t> (i));
    }
    if (hands == 2 && *rc::gen::inRange (0, 2) == 0) loops.spring ("h0.x", "h1.x", pick (20.0, 3000.0), *rc::gen::inRange (0, 3));
    return loops;
}

/// False if the check says of any role that its loop is not judged, which is no pass.
bool areLoopsJudged (const std::vector<check::Condition>& all)
{
    return std::ranges::none_of (all, [] (const auto& c) { return (c.id == "stiffness" || c.id == "coupling") && c.verdict == check::Verdict::unknown; });
}

void log (const Loops& loops, const std::vector<check::Condition>& conditions)
{
    for (const auto& t : loops.tools)
        RC_LOG() << "M " << t.mass << " B " << t.damping << " d " << t.delay << " F0 " << t.first_mode << '\n';
    for (const auto* part : { &loops.nodes, &loops.wires })
        for (const auto& text : *part)
            RC_LOG() << text << '\n';
    RC_LOG() << test::describe (conditions);
}
}   // namespace

TEST_CASE ("no loop that explodes passes the check", "[check]")
{
    test::property ("random loops", [] {
        const auto loops = randomLoops();
        if (loops.pushesAway()) return;
        const double growth = loops.growth (10'000);
        const auto conditions = loops.conditions (1e-3, { .places = 2 });
        const bool breaks = check::isBroken (conditions) || ! areLoopsJudged (conditions);
        RC_TAG (std::string (growth > 1.5 ? "unstable" : "stable") + (breaks ? " breaks" : " passes"));
        if (growth <= 1.5) return;
        RC_LOG() << "growth " << growth << '\n';
        log (loops, conditions);
        RC_ASSERT (breaks);
    });
}

TEST_CASE ("no wall, friction or texture on which a tool that is let go never rests passes the check", "[check]")
{
    test::property ("random contacts", [] {
        const auto loops = randomContacts();
        if (loops.pushesAwayFromOrigin()) return;
        // The tool starts 1 um away from its position of rest. A contact bounds how far it swings, so a swing that does not die counts,
        // too.
        const auto [first, last] = loops.swings (10'000);
        const bool unstable = last > 1e-6 && (last > 1.5 * first || (last > 1e-5 && last > 0.9 * first));
        RC_TAG (std::string (unstable ? "unstable" : "stable"));
        if (! unstable) return;
        const auto conditions = loops.conditions (1e-3, {});   // as `tactus check` measures: here, the slope differs from place to place
        RC_LOG() << "swings by " << first << " m, then by " << last << " m\n";
        log (loops, conditions);
        RC_ASSERT (check::isBroken (conditions));
    });
}
