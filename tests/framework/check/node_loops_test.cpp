// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "loops.hpp"

#include "support/property.hpp"

using namespace tactus;
using test::Loops;

namespace
{
/// A wall and a friction in its plane, each of which may be left out.
struct WallAndDrag
{
    Simulation tool { .mass = 0.1, .damping = 2.0, .delay = 1 };
    double stiffness = 5000.0, damping = 5.0, d_max = 1e-4;   // N/m, N s/m, m
    bool has_wall = true, has_drag = true;
    double rate_hz = 1000.0;

    check::Condition judged() const
    {
        Loops loops { .rate_hz = rate_hz, .tools = { tool } };
        const auto number = [] (double v) { return std::to_string (v); };
        if (has_wall)
            loops.feels (0, "deform.plane",
                         R"("params": { "stiffness": )" + number (stiffness) + R"(, "damping": )" + number (damping) + R"(, "offset": 1 })");
        if (has_drag) loops.feels (0, "friction.elasto_plastic", R"("params": { "mu": 0.4, "d_max": )" + std::to_string (1e6 * d_max) + R"(e-6 })");
        const auto all = loops.conditions();
        const auto at = std::ranges::find (all, "stiffness", &check::Condition::id);
        REQUIRE (at != all.end());
        return *at;
    }
};
}   // namespace

TEST_CASE ("each node of a contact has the loop that it has alone, and the weakest is that of the whole", "[check]")
{
    test::property ("a wall and a friction", [] {
        const auto pick = [] (double low, double high) { return low * std::pow (high / low, 1e-6 * *rc::gen::inRange (0, 1'000'001)); };
        WallAndDrag both { .stiffness = pick (3000.0, 9000.0), .damping = pick (0.5, 20.0), .d_max = pick (4e-5, 1.2e-4) };
        both.tool.delay = *rc::gen::inRange (0, 3);
        auto wall = both, drag = both;
        wall.has_drag = drag.has_wall = false;
        const auto c = both.judged(), alone = wall.judged(), dragged = drag.judged();
        for (const auto* one : { &c, &alone, &dragged })
            RC_PRE (one->isKnown() && one->value > 1.01 * one->limit);
        RC_ASSERT (c.loops.size() == 2);
        for (const auto& loop : c.loops)
        {
            const auto& one = loop.node.starts_with ("deform") ? alone : dragged;
            RC_ASSERT (std::abs (loop.may_grow - one.may_grow) <= 1e-2 * one.may_grow);
        }
        RC_ASSERT (c.loops[0].may_grow <= c.loops[1].may_grow);
        RC_ASSERT (std::abs (c.loops[0].may_grow - c.may_grow) <= 1e-2 * c.may_grow);
    });
}

TEST_CASE ("the remedy of the weakest node holds with all nodes", "[check]")
{
    for (const double d_max : { 6e-5, 8e-5, 1e-4 })
    {
        WallAndDrag both { .d_max = d_max };
        const auto c = both.judged();
        INFO (c.text << "\n"
                     << c.remedy);
        CHECK (c.verdict == check::Verdict::unstable);
        REQUIRE (c.loops.size() == 2);
        CHECK (c.loops[0].node.starts_with ("friction"));
        CHECK (c.loops[1].node.starts_with ("deform"));
        const std::string no_delay = "no delay of the device, up to ";
        const auto at = c.remedy.find (no_delay);
        both.tool.delay = 0;
        const auto now = both.judged();
        if (at != c.remedy.npos)
            CHECK (std::strtod (c.remedy.c_str() + at + no_delay.size(), nullptr) == Approx (std::isnan (now.may_grow) ? 0.0 : now.may_grow).epsilon (5e-3));
        else
            CHECK (now.may_grow < 1.02);   // no single change clearly suffices
    }
}

namespace
{
/// The number after these words in a remedy, if they are there before `end`.
std::optional<double> numberAfter (const std::string& remedy, const std::string& words, std::size_t begin = 0, std::size_t end = std::string::npos)
{
    const auto at = remedy.find (words, begin);
    if (at >= std::min (end, remedy.size())) return std::nullopt;
    return std::strtod (remedy.c_str() + at + words.size(), nullptr);
}

/// Does what the remedy says first of the wall, and of the friction. Returns false if it says nothing that has a number.
bool follow (WallAndDrag& both, const std::string& remedy)
{
    const auto from = remedy.find ("whatever the hand does: "), start = from == remedy.npos ? 0 : from;
    const auto of_wall = remedy.find ("along the force of 'deform", start), of_drag = remedy.find ("along the force of 'friction", start);
    const auto endOf = [&] (std::size_t at) { return std::min (remedy.find ("along the force of '", at + 1), remedy.find ("; or for all", at)); };
    const bool are_both = of_wall != remedy.npos && of_drag != remedy.npos;
    const auto longer = are_both ? numberAfter (remedy, "a d_max at least ", of_drag, endOf (of_drag)) : numberAfter (remedy, "a d_max at least ", start);
    const bool is_wall = are_both || ! longer;
    const auto wall = are_both ? of_wall : start, end = are_both ? endOf (of_wall) : remedy.npos;
    const auto softer = numberAfter (remedy, "a stiffness of at most ", wall, end), damped = numberAfter (remedy, "a virtual damping of at most ", wall, end);
    if (longer) both.d_max *= *longer;
    if (is_wall && softer)
        both.stiffness = *softer;
    else if (is_wall && damped)
        both.damping = *damped;
    return (! are_both || longer) && (! is_wall || softer || damped);
}
}   // namespace

TEST_CASE ("who follows the remedies of a wall and a friction makes the contact passive", "[check]")
{
    constexpr double rounding = 1.002;
    int both_broken = 0, faster = 0, followed = 0;
    test::property ("a wall and a friction", [&] {
        const auto pick = [] (double low, double high) { return low * std::pow (high / low, 1e-6 * *rc::gen::inRange (0, 1'000'001)); };
        WallAndDrag contact { .stiffness = pick (300.0, 9000.0), .damping = pick (0.2, 3.0), .d_max = pick (4e-5, 1e-3) };
        contact.tool.delay = *rc::gen::inRange (0, 3);
        const auto c = contact.judged();
        if (! c.isKnown() || c.value <= 1.01 * c.limit) return;
        auto changed = contact;
        if (follow (changed, c.remedy))
        {
            ++followed;
            both_broken += c.remedy.find (" and along the force of '") != std::string::npos ? 1 : 0;
            const auto after = changed.judged();
            if (after.value > rounding * after.limit) RC_FAIL (c.remedy + " gives " + std::to_string (after.value) + ": " + after.text);
        }
        if (const auto rate = numberAfter (c.remedy, "a rate of at least "))
        {
            ++faster;
            auto other = contact;
            other.rate_hz = *rate;
            const auto after = other.judged();
            if (after.value > rounding * after.limit) RC_FAIL (c.remedy + " gives " + std::to_string (after.value) + " at the rate");
        }
    });
    CHECK (followed > 10);
    CHECK (both_broken > 3);
    CHECK (faster > 3);
}

TEST_CASE ("footnote 2 of the chapter is told with the damping along the steepest direction", "[check]")
{
    int along_wall = 0, along_drag = 0;
    test::property ("a wall and a friction", [&] {
        const auto pick = [] (double low, double high) { return low * std::pow (high / low, 1e-6 * *rc::gen::inRange (0, 1'000'001)); };
        const WallAndDrag both { .stiffness = pick (300.0, 9000.0), .damping = pick (0.5, 3.0), .d_max = pick (4e-5, 1e-3) };
        auto wall = both, drag = both;
        wall.has_drag = drag.has_wall = false;
        const auto sigma = [] (const WallAndDrag& w) { return *numberAfter (w.judged().text, "sigma "); };
        const double of_wall = sigma (wall), of_drag = sigma (drag);
        RC_PRE (std::abs (of_wall - of_drag) > 0.05 * of_wall);
        const bool is_wall = of_wall > of_drag;
        ++(is_wall ? along_wall : along_drag);
        const auto text = both.judged().text;
        const auto told = numberAfter (text, "b + B ");
        RC_ASSERT (told.has_value());
        if (std::abs (*told - both.tool.damping - (is_wall ? both.damping : 0.0)) > 0.01 * *told) RC_FAIL (text);
    });
    CHECK (along_wall > 5);
    CHECK (along_drag > 5);
}

TEST_CASE ("walls that are not at right angles have no remedies of their own, because each is felt along the other", "[check]")
{
    // Without damping, a device of 2 N s/m at 1 kHz allows 4000 N/m. Two softer walls at 72.5 degrees are steeper together.
    const auto remedyAt = [] (double cosine) {
        Loops loops { .rate_hz = 1000.0, .tools = { Simulation { .mass = 0.1, .damping = 2.0 } } };
        const auto wall = [&] (double stiffness, double x, double z) {
            loops.feels (0, "deform.plane",
                         R"("params": { "stiffness": )" + std::to_string (stiffness) + R"(, "offset": 1, "normal": [)" + std::to_string (x) + ", 0, "
                             + std::to_string (z) + "] }");
        };
        wall (40'000.0, 0.0, 1.0);
        wall (3796.0, std::sqrt (1.0 - cosine * cosine), cosine);
        const auto all = loops.conditions();
        const auto at = std::ranges::find (all, "stiffness", &check::Condition::id);
        REQUIRE (at != all.end());
        CHECK (at->isBroken());
        return at->remedy;
    };
    CHECK (remedyAt (0.0).find ("along the force of 'deform") != std::string::npos);
    CHECK (remedyAt (0.3).find ("along the force of 'deform") == std::string::npos);
}
