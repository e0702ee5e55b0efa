// SPDX-License-Identifier: MIT
#include <tactus/nodes/safety/passivity.hpp>

#include <golden/golden.hpp>
#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using tactus::Vec3;
using tactus::nodes::PassivityObserver;
using tactus::test::Golden;
using tactus::test::ready;
using Pairing = PassivityObserver::Pairing;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

PassivityObserver::Outputs step (PassivityObserver& node, double p, double f, double contact = 1.0)
{
    return node.tick ({ .position = { p, 0, 0 }, .force = { f, 0, 0 }, .contact = contact });
}

/// A wall of stiffness K at x > 0, a mass with a damper, and a hand that pushes.
struct Wall
{
    double K, B, hand;
    double M = 0.1, T = 1e-3;
};

struct Course
{
    double buzz = 0.0;     // peak to peak in the last fifth of the time, m
    double force = 0.0;    // largest force, N
    double lowest = 0.0;   // lowest energy, J
};

/// A hand presses against the wall for a while, with or without an observer. A buzz takes seconds to grow to its full
/// amplitude. What the observer leaves of it decays as 1/t.
Course against (const Wall& wall, PassivityObserver* node, int seconds = 20)
{
    const auto [K, B, hand, M, T] = wall;
    const double a = std::exp (-B * T / M), g = M * (1.0 - a) / B;
    double x = -1e-3, v = 0.1, low = tactus::inf, high = -tactus::inf;
    Course course;
    const int ticks = static_cast<int> (seconds / T);
    for (int k = 0; k < ticks; ++k)
    {
        double f = x > 0.0 ? -K * x : 0.0;
        if (node != nullptr)
        {
            const auto out = step (*node, x, f);
            f = out.force.x();
            course.lowest = std::min (course.lowest, out.energy);
        }
        course.force = std::max (course.force, std::abs (f));
        x += g * v + (T - g) / B * (f + hand);
        v = a * v + (1.0 - a) / B * (f + hand);
        if (k < ticks / 5 * 4) continue;
        low = std::min (low, x);
        high = std::max (high, x);
    }
    course.buzz = high - low;
    return course;
}
}   // namespace

TEST_CASE ("passivity: both pairings match the golden columns", "[nodes][safety][golden]")
{
    const Golden golden ("passivity");
    for (const auto& [pairing, suffix] : { std::pair { Pairing::zoh, "_zoh" }, std::pair { Pairing::backward, "_hr" } })
    {
        auto node = ready<PassivityObserver> ({ .alpha_max = golden.param ("alpha_max"), .pairing = pairing }, 1.0 / golden.dt_s());
        std::vector<PassivityObserver::Outputs> outs;
        for (std::size_t i = 0; i < golden.rows(); ++i)
            outs.push_back (step (node, golden (i, "p"), golden (i, "f_env")));

        INFO (suffix);
        CHECK (golden.worst (std::string ("f_out") + suffix, [&] (std::size_t i) { return outs[i].force.x(); })
               <= 1.0);
        CHECK (golden.worst (std::string ("E") + suffix, [&] (std::size_t i) { return outs[i].energy; })
               <= 1.0);
        CHECK (golden.worst (std::string ("alpha") + suffix, [&] (std::size_t i) { return outs[i].alpha; })
               <= 1.0);
    }
}

TEST_CASE ("passivity: a buzzing wall is calmed, whatever its stiffness, and nothing diverges", "[nodes][safety]")
{
    int buzzing = 0;
    for (const double K : { 600.0, 1000.0, 1500.0, 2000.0, 3000.0, 4000.0, 6000.0, 8000.0 })
        for (const double B : { 0.2, 0.5 })
            for (const double hand : { 0.3, 1.5 })
                for (const double alpha_max : { 0.0, 10.0, 50.0, 180.0 })
                {
                    const Wall wall { K, B, hand };
                    const auto bare = against (wall, nullptr);
                    auto node = ready<PassivityObserver> ({ .alpha_max = alpha_max, .mass = wall.M });
                    const auto braked = against (wall, &node);

                    INFO (K << " " << B << " " << hand << " " << alpha_max << ": " << bare.buzz << " " << braked.buzz << " m, "
                            << braked.force << " N, " << braked.lowest << " J");
                    CHECK (braked.force < 100.0);
                    CHECK (braked.lowest > -2e-3);
                    CHECK (braked.buzz < 3e-4);
                    if (K <= 2.0 * B / wall.T)   // the wall settles without the observer
                        CHECK (braked.buzz <= std::max (bare.buzz, 1e-4));
                    else
                    {
                        ++buzzing;
                        CHECK (braked.buzz < 0.2 * bare.buzz);
                    }
                }
    CHECK (buzzing == 14 * 2 * 4);
}

TEST_CASE ("passivity: what remains of a buzz decays as 1/t", "[nodes][safety]")
{
    // 15.4 mm without the observer; with it 0.16 mm in the third second, 0.011 mm after sixteen.
    const Wall wall { 3000.0, 0.2, 0.3 };
    CHECK (against (wall, nullptr).buzz == Approx (15.4e-3).epsilon (0.01));
    for (const auto& [seconds, left] : { std::pair { 3, 1.6e-4 }, { 5, 6.2e-5 }, { 10, 2.4e-5 }, { 20, 1.13e-5 } })
    {
        auto node = ready<PassivityObserver> ({ .mass = wall.M });
        INFO (seconds);
        CHECK (against (wall, &node, seconds).buzz == Approx (left).epsilon (0.05));
    }
}

TEST_CASE ("passivity: the backward pairing is blind to the leak of the hold", "[nodes][safety]")
{
    for (const double K : { 600.0, 1500.0, 3000.0, 8000.0 })
        for (const double B : { 0.2, 0.5 })
            for (const double hand : { 0.3, 1.5 })
            {
                const Wall wall { K, B, hand };
                auto node = ready<PassivityObserver> ({ .mass = wall.M, .pairing = Pairing::backward });
                INFO (K << " " << B << " " << hand);
                CHECK (against (wall, &node, 3).buzz == against (wall, nullptr, 3).buzz);
            }
}

TEST_CASE ("passivity: no alpha_max raises the damper above what the mass can bear", "[nodes][safety]")
{
    auto node = ready<PassivityObserver> ({ .alpha_max = 1e9, .mass = 0.1 });
    step (node, 0.0, 10.0);
    CHECK (step (node, 1e-6, 0.0).alpha == Approx (1.8 * 0.1 / 1e-3));

    auto silent = ready<PassivityObserver> ({ .mass = 0.1 });   // alpha_max is 0, which means mass / (2 T)
    step (silent, 0.0, 10.0);
    CHECK (step (silent, 1e-4, 0.0).alpha == Approx (50.0));

    for (const double K : { 600.0, 3000.0, 8000.0, 30'000.0 })   // with a cap of 2 mass / T it would take up to a minute to diverge
        for (const double B : { 0.2, 0.5 })
        {
            auto greedy = ready<PassivityObserver> ({ .alpha_max = 1e9, .mass = 0.1 });
            const auto course = against ({ K, B, 0.5 }, &greedy, 60);
            INFO (K << " " << B << ": " << course.force << " N");
            CHECK (course.force < 20.0);
        }
}

TEST_CASE ("passivity: a force that takes energy passes bit for bit", "[nodes][safety]")
{
    tactus::test::property ("a damper, moved any way", [] {
        auto node = ready<PassivityObserver> ({});
        double p = 0.0, before = 0.0;
        for (int k = 0; k < 50; ++k)
        {
            const double next = 1e-5 * *rc::gen::inRange (-100, 100);
            // the force opposes both this step and the previous one, in proportion to the smaller of the two,
            // so it takes energy whether it is held or not
            const double f = (next - p) * before > 0.0 ? -100.0 * std::min (std::abs (next - p), std::abs (before)) * (next > p ? 1.0 : -1.0) : 0.0;
            const auto out = step (node, next, f);
            if (out.energy >= 0.0) RC_ASSERT (out.force.x() == f);
            if (out.energy >= 0.0) RC_ASSERT (out.alpha == 0.0);
            before = next - p;
            p = next;
        }
    });
}

TEST_CASE ("passivity: the energy is the work of the hand against the held force", "[nodes][safety][energy]")
{
    tactus::test::property ("any motion and force", [] {
        auto node = ready<PassivityObserver> ({ .alpha_max = 20.0 });
        double work = 0.0;
        Vec3 p = Vec3::Zero(), held = Vec3::Zero();
        for (int k = 0; k < 60; ++k)
        {
            const int x = *rc::gen::inRange (-100, 100), y = *rc::gen::inRange (-100, 100), f = *rc::gen::inRange (-100, 100);
            const Vec3 next { 1e-5 * x, 1e-5 * y, 0 };
            if (k > 0) work -= held.dot (next - p);
            const auto out = node.tick ({ .position = next, .force = { 0.01 * f, -0.02 * f, 1.0 }, .contact = 1.0 });
            RC_ASSERT (std::abs (out.energy - work) < 1e-12);
            RC_ASSERT (out.alpha >= 0.0);
            RC_ASSERT (out.alpha <= 20.0);
            if (out.energy >= 0.0) RC_ASSERT (out.alpha == 0.0);
            p = next;
            held = out.force;
        }
    });
}

TEST_CASE ("passivity: the damper only ever brakes", "[nodes][safety]")
{
    auto node = ready<PassivityObserver> ({ .alpha_max = 12.0 });
    step (node, 0.0, 5.0);
    const auto out = step (node, 1e-3, 5.0);   // the held 5 N pushed in the direction of the 1 mm move, so the energy is 5 mJ below 0
    CHECK (out.energy == Approx (-5e-3));
    CHECK (out.alpha == Approx (5e-3 * 1e-3 / 1e-6));
    CHECK (out.force.x() == Approx (5.0 - 5.0).margin (1e-12));   // the damper's force alpha dp / T is 5 N
    CHECK (step (node, 1e-3, 5.0).alpha == 0.0);                  // at rest there is nothing to brake
    CHECK (step (node, 1e-3 + 5e-10, 5.0).alpha == 0.0);
}

TEST_CASE ("passivity: out of contact, the energy is reset", "[nodes][safety]")
{
    auto node = ready<PassivityObserver> ({});
    step (node, 0.0, -10.0);
    CHECK (step (node, 1e-3, 0.0).energy == Approx (1e-2));
    const auto out = step (node, 2e-3, 0.3, 0.0);
    CHECK (out.energy == 0.0);
    CHECK (out.alpha == 0.0);
    CHECK (out.force.x() == 0.3);
    CHECK (step (node, 3e-3, 0.0).energy == Approx (-0.3e-3));   // back in contact, the work of the force held until then counts
    CHECK (step (node, 3e-3, 0.0, -1.0).energy == Approx (-0.3e-3).epsilon (1e-6));
}

TEST_CASE ("passivity: the first sample passes, and counts", "[nodes][safety]")
{
    auto node = ready<PassivityObserver> ({ .alpha_max = 7.0 });
    const auto first = step (node, 0.5, -3.0);
    CHECK (first.force.x() == -3.0);
    CHECK (first.energy == 0.0);
    CHECK (first.alpha == 0.0);
    CHECK (step (node, 0.501, 0.0).energy == Approx (3e-3));
}

TEST_CASE ("passivity: a fault gives no force, keeps the energy and forgets the motion", "[nodes][safety]")
{
    for (const Pairing pairing : { Pairing::zoh, Pairing::backward })
        for (const double bad : { not_a_number, tactus::inf })
            for (const int which : { 0, 1, 2 })
            {
                auto node = ready<PassivityObserver> ({ .alpha_max = 12.0, .pairing = pairing });
                step (node, 0.0, 5.0);
                const double energy = step (node, 1e-3, 5.0).energy;
                CHECK (energy == Approx (-5e-3));
                const auto out = step (node, which == 0 ? bad : 0.0, which == 1 ? bad : 0.0, which == 2 ? bad : 1.0);
                CHECK (out.force.isZero (0.0));
                CHECK (out.alpha == 0.0);
                CHECK (out.energy == energy);

                const auto next = step (node, 0.1, 2.0);   // counts as the first sample
                CHECK (next.force.x() == 2.0);
                CHECK (next.alpha == 0.0);
                CHECK (next.energy == energy);
            }
}

TEST_CASE ("passivity: a change of pairing waits for the end of the contact", "[nodes][safety]")
{
    auto node = ready<PassivityObserver> ({ .alpha_max = 1.0 });
    step (node, 0.0, 0.0);
    node.params.pairing = Pairing::backward;
    CHECK (step (node, 1e-3, -1.0).energy == 0.0);   // the held force was 0
    step (node, 1e-3, 0.0, 0.0);
    CHECK (step (node, 2e-3, -1.0).energy == Approx (1e-3));
}

TEST_CASE ("passivity: no input breaks it", "[nodes][safety]")
{
    tactus::test::property ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -1.0, 1e-3, 1e-320, -1e160, 1e300, -1.7e308, not_a_number, tactus::inf);
        const auto size = rc::gen::element (0.0, 1e-320, 0.1, 12.0, 1e300);
        const double alpha_max = *size, mass = *size;
        auto node = ready<PassivityObserver> ({ .alpha_max = alpha_max, .mass = mass, .pairing = *rc::gen::element (Pairing::zoh, Pairing::backward) });
        for (int k = 0; k < 20; ++k)
        {
            const double x = *number, y = *number, fx = *number, fy = *number, contact = *number;
            const auto out = node.tick ({ .position = { x, y, 0 }, .force = { fx, fy, 0 }, .contact = contact });
            RC_ASSERT (tactus::isFinite (out.force, out.energy, out.alpha));
        }
    });
}

TEST_CASE ("passivity: a new instance adopts the energy balance", "[nodes][safety]")
{
    auto old = ready<PassivityObserver> ({}), next = ready<PassivityObserver> ({});
    step (old, 0.0, 5.0);
    step (old, 1e-3, 2.0);
    next.adopt (old);
    const auto a = step (old, 2e-3, 1.0), b = step (next, 2e-3, 1.0);
    CHECK (a.energy == b.energy);
    CHECK (a.force == b.force);
}
