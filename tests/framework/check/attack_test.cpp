// SPDX-License-Identifier: MIT
// Random loops: none that explodes may pass the check.

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

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
}   // namespace

TEST_CASE ("no loop that explodes passes the check", "[check]")
{
    rc::prop ("random loops", [] {
        const auto loops = randomLoops();
        if (loops.pushesAway()) return;
        const double growth = loops.growth (10'000);
        const auto broken = test::brokenIds (loops.conditions (1e-3, { .places = 2 }));
        RC_TAG (std::string (growth > 1.5 ? "unstable" : "stable") + (broken.empty() ? " passes" : " breaks"));
        if (growth <= 1.5) return;
        RC_LOG() << "growth " << growth << '\n';
        for (const auto& t : loops.tools)
            RC_LOG() << "M " << t.mass << " B " << t.damping << " d " << t.delay << " F0 " << t.first_mode << '\n';
        for (const auto& w : loops.wires)
            RC_LOG() << w << '\n';
        RC_LOG() << test::describe (loops.conditions (1e-3, { .places = 2 }));
        RC_ASSERT_FALSE (broken.empty());
    });
}
