// SPDX-License-Identifier: MIT
#include <tactus/nodes/cut/scissors.hpp>

#include <golden/golden.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using tactus::nodes::Scissors;
using tactus::test::Golden;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double wide = 1.4;   // in rad; open wide enough for the plates below

/// Scissors and the hand that closes them. The hand's work is computed with the trapezoid rule, which is exact on dense paths.
struct Bench
{
    explicit Bench (const Scissors::Params& params = {})
    {
        node.params = params;
        node.prepare ({});
        tick (wide);
    }

    const Scissors::Outputs& tick (double to)
    {
        const double before = out.torque, from = angle;
        angle = to;
        out = node.tick ({ .angle = to });
        const double step = 0.5 * (before + out.torque) * (from - to);
        work += step;
        handled += std::abs (step);
        return out;
    }

    /// Moves the blades to an angle in n equal steps.
    const Scissors::Outputs& move (double to, int n)
    {
        const double from = angle;
        for (int k = 1; k <= n; ++k)
            tick (k == n ? to : from + (to - from) * k / n);
        return out;
    }

    double taken() const { return out.stored_energy + out.dissipated_energy; }

    Scissors node;
    Scissors::Outputs out;
    double angle = 0.0, work = 0.0, handled = 0.0;   // rad, J
};

class Dice
{
public:
    explicit Dice (unsigned seed) : random (seed) {}

    double uniform (double from, double to) { return std::uniform_real_distribution { from, to }(random); }
    double size (double from, double to) { return std::exp (uniform (std::log (from), std::log (to))); }

    Scissors::Params plate()
    {
        const double h = size (2e-4, 3e-3), toughness = size (50.0, 5000.0);
        return { .thickness = h, .toughness = toughness, .stiffness = toughness * size (200.0, 2000.0), .pivot_distance = h * uniform (1.0, 4.0) };
    }

private:
    std::mt19937 random;
};
}   // namespace

TEST_CASE ("scissors: they match the golden columns", "[nodes][cut][golden]")
{
    const Golden golden ("scissors");
    Bench bench ({ .thickness = golden.param ("h"), .toughness = golden.param ("Jc"), .stiffness = golden.param ("k"), .pivot_distance = golden.param ("x0") });
    std::vector<Scissors::Outputs> outputs;
    for (std::size_t i = 0; i < golden.rows(); ++i)
        outputs.push_back (bench.tick (golden (i, "theta")));

    const auto meets = [&] (const std::string& column, double Scissors::Outputs::*port) {
        const double worst = golden.worst (column, [&] (std::size_t i) { return outputs[i].*port; });
        INFO (column << " " << worst);
        CHECK (worst <= 1.0);
    };
    meets ("torque", &Scissors::Outputs::torque);
    meets ("crack", &Scissors::Outputs::crack_front);
    meets ("U", &Scissors::Outputs::stored_energy);
    meets ("dissipated", &Scissors::Outputs::dissipated_energy);
}

TEST_CASE ("scissors: while they cut, the torque is J_c h x / sin (theta), however stiff the plate", "[nodes][cut]")
{
    tactus::test::property ("any plate", [] (unsigned seed) {
        auto params = Dice { seed }.plate();
        for (const double k : { 1.0, 3.0, 100.0 })
        {
            auto stiffer = params;
            stiffer.stiffness *= k;
            Bench bench (stiffer);
            int cutting = 0;
            const double furthest = 2.0 * std::atan (4.0 * stiffer.toughness / stiffer.stiffness);
            for (double angle = wide; angle > std::max (0.1, furthest); angle -= 1e-3)
            {
                bench.tick (angle);
                if (bench.out.state != 4.0) continue;
                ++cutting;
                const double torque = params.toughness * params.thickness * bench.out.crack_front / std::sin (angle);
                RC_ASSERT (std::abs (bench.out.torque - torque) <= 1e-9 * torque);
            }
            RC_ASSERT (cutting > 0);
        }
    });
}

TEST_CASE ("scissors: the work of the hand is U + J_c h (x - x0)", "[nodes][cut][energy]")
{
    tactus::test::property ("any plate, any strokes", [] (unsigned seed) {
        Dice dice { seed };
        const auto params = dice.plate();
        Bench bench (params);
        for (int stroke = 0; stroke < 6; ++stroke)
        {
            bench.move (dice.uniform (0.05, stroke == 0 ? 0.2 : wide), 20'000);
            const double cracked = params.toughness * params.thickness * (bench.out.crack_front - params.pivot_distance);
            const double balance = bench.out.stored_energy + cracked;
            RC_ASSERT (std::abs (bench.work - balance) <= 1e-4 * bench.handled + 1e-15);
            RC_ASSERT (std::abs (bench.out.dissipated_energy - cracked) <= 1e-9 * cracked);
        }
    });
}

TEST_CASE ("scissors: a closed path never generates energy", "[nodes][cut][energy]")
{
    tactus::test::property ("any plate, strokes that end open", [] (unsigned seed) {
        Dice dice { seed };
        Bench bench (dice.plate());
        for (int stroke = 0; stroke < 10; ++stroke)
        {
            const double before = bench.work;
            bench.move (dice.uniform (0.05, stroke == 0 ? 0.2 : wide), 20'000);
            bench.move (wide, 20'000);
            RC_ASSERT (bench.out.stored_energy == 0.0);
            RC_ASSERT (bench.work >= before - 1e-4 * bench.handled - 1e-15);
        }
    });
}

TEST_CASE ("scissors: one jump cuts as far as closing slowly", "[nodes][cut]")
{
    tactus::test::property ("any plate, even when nearly closed", [] (unsigned seed) {
        Dice dice { seed };
        const auto params = dice.plate();
        Bench jump (params), slow (params);
        const double to = dice.size (1e-4, wide);
        jump.tick (to);
        slow.move (to, 20'000);
        RC_ASSERT (std::abs (jump.out.crack_front - slow.out.crack_front) <= 1e-5 * slow.out.crack_front);
        RC_ASSERT (std::abs (jump.out.dissipated_energy - slow.out.dissipated_energy) <= 1e-5 * slow.taken());
        RC_ASSERT (std::abs (jump.out.torque - slow.out.torque) <= 1e-4 * slow.out.torque);
    });
}

TEST_CASE ("scissors: too parallel to cut, they leave the front at k h / (16 J_c)", "[nodes][cut]")
{
    Bench bench ({ .toughness = 2800.0, .stiffness = 1e6 });
    bench.move (0.001, 2000);
    CHECK (bench.out.crack_front == Approx (1e6 * 1e-3 / (16.0 * 2800.0)).epsilon (1e-6));
    CHECK (bench.out.state == 3.0);
}

TEST_CASE ("scissors: opened and closed again, they feel nothing down to the front", "[nodes][cut]")
{
    tactus::test::property ("any plate", [] (unsigned seed) {
        const auto params = Dice { seed }.plate();
        Bench bench (params);
        bench.move (0.2, 1000);
        const double front = bench.out.crack_front, touch = 2.0 * std::atan (0.5 * params.thickness / front);
        bench.move (wide, 100);
        for (double angle = wide; angle > touch * (1.0 + 1e-9); angle -= 1e-3)
        {
            bench.tick (angle);
            RC_ASSERT (bench.out.torque == 0.0);
            RC_ASSERT (bench.out.state == 0.0);
        }
        bench.move (0.1, 1000);
        RC_ASSERT (bench.out.torque > 0.0);
        RC_ASSERT (bench.out.crack_front >= front);
    });
}

TEST_CASE ("scissors: repeating a tick changes nothing but the state", "[nodes][cut]")
{
    tactus::test::property ("open, elastic, cutting", [] (unsigned seed) {
        Dice dice { seed };
        Bench bench (dice.plate());
        for (int k = 0; k < 50; ++k)
        {
            const auto first = bench.tick (dice.size (0.01, wide));
            for (int again = 0; again < 3; ++again)
            {
                const auto second = bench.tick (bench.angle);
                RC_ASSERT (second.torque == first.torque);
                RC_ASSERT (second.crack_front == first.crack_front);
                RC_ASSERT (second.stored_energy == first.stored_energy);
                RC_ASSERT (second.dissipated_energy == first.dissipated_energy);
                RC_ASSERT (second.state == std::min (first.state, 3.0));
            }
        }
    });
}

TEST_CASE ("scissors: closing slowly they do not chatter between cutting and holding", "[nodes][cut]")
{
    Bench bench;
    bench.tick (0.3);
    for (int k = 0; k < 20'000; ++k)
    {
        bench.tick (bench.angle - 1e-7);
        REQUIRE (bench.out.state == 4.0);
    }
}

TEST_CASE ("scissors: fully closed or fully open, they have no torque and keep the crack", "[nodes][cut]")
{
    Bench bench;
    bench.move (0.3, 100);
    const auto before = bench.out;
    for (const double angle : { 0.0, -0.1, -100.0, M_PI, 7.0 })
    {
        bench.tick (angle);
        CHECK (bench.out.torque == 0.0);
        CHECK (bench.out.stored_energy == 0.0);
        CHECK (bench.out.crack_front == before.crack_front);
        CHECK (bench.out.dissipated_energy == before.dissipated_energy);
        CHECK (bench.out.state == 0.0);
    }
    CHECK (bench.tick (0.3).torque == before.torque);
}

TEST_CASE ("scissors: a fault is forgotten, but the crack stays", "[nodes][cut]")
{
    for (const double bad : { not_a_number, tactus::inf, -tactus::inf })
    {
        Bench bench, whole;
        bench.move (0.3, 100);
        whole.move (0.3, 100);
        const auto out = bench.node.tick ({ .angle = bad });
        CHECK (out.torque == 0.0);
        CHECK (out.stored_energy == 0.0);
        CHECK (out.crack_front == whole.out.crack_front);
        CHECK (out.dissipated_energy == whole.out.dissipated_energy);
        CHECK (out.state == -1.0);
        for (const double angle : { 0.31, 0.25, 0.6, 0.2 })
            CHECK (bench.tick (angle).torque == whole.tick (angle).torque);
    }

    Scissors fresh;
    fresh.params.pivot_distance = 3e-3;
    fresh.prepare ({});
    CHECK (fresh.tick ({ .angle = not_a_number }).crack_front == 3e-3);
}

TEST_CASE ("scissors: params are read when they touch the plate", "[nodes][cut]")
{
    Bench bench, undisturbed;
    bench.move (0.4, 100);
    undisturbed.move (0.4, 100);
    bench.node.params = { .thickness = 2e-3, .toughness = 500.0, .stiffness = 3e5, .pivot_distance = 0.1 };
    CHECK (bench.tick (0.35).torque == undisturbed.tick (0.35).torque);

    bench.tick (wide);
    bench.tick (0.3);
    CHECK (bench.out.state == 4.0);
    CHECK (bench.out.torque == Approx (500.0 * 2e-3 * bench.out.crack_front / std::sin (0.3)));
    CHECK (bench.out.crack_front < 0.1);   // the new pivot_distance, 0.1, applies only to an uncut plate

    Bench untouched;
    untouched.node.params.pivot_distance = 5e-3;
    CHECK (untouched.tick (wide).crack_front == 5e-3);
}

TEST_CASE ("scissors: an instance replaced in the middle of a cut keeps cutting", "[nodes][cut]")
{
    Bench bench, next;
    bench.move (0.3, 100);
    next.node.adopt (bench.node);
    for (const double angle : { 0.31, 0.25, 0.6, 0.2 })
    {
        const auto a = bench.tick (angle), b = next.tick (angle);
        CHECK (a.torque == b.torque);
        CHECK (a.dissipated_energy == b.dissipated_energy);
        CHECK (a.state == b.state);
    }
}
