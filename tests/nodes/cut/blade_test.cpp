// SPDX-License-Identifier: MIT
#include <tactus/nodes/cut/blade.hpp>

#include <golden/golden.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using tactus::Law;
using tactus::nodes::Blade;
using tactus::test::Golden;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Law power (double k, double n) { return { .kind = Law::Kind::power, .a = k, .b = n }; }
Law exponential (double a, double b) { return { .kind = Law::Kind::exponential, .a = a, .b = b }; }
Law table (std::vector<double> e, std::vector<double> f) { return { .kind = Law::Kind::table, .table = { std::move (e), std::move (f) } }; }

/// A blade and the hand that holds it. The hand's work is computed with the trapezoid rule, which is exact on dense paths.
struct Bench
{
    explicit Bench (const Blade::Params& params = {}, const Blade::Settings& settings = {})
    {
        node.params = params;
        node.settings = settings;
    }

    const Blade::Outputs& tick (double to)
    {
        const double before = out.resistance, from = depth;
        depth = to;
        out = node.tick ({ .depth = to });
        work += 0.5 * (before + out.resistance) * (to - from);
        most = std::max (most, out.resistance);
        return out;
    }

    /// Moves the blade to a depth in n equal steps.
    const Blade::Outputs& move (double to, int n)
    {
        const double from = depth;
        for (int k = 1; k <= n; ++k)
            tick (k == n ? to : from + (to - from) * k / n);
        return out;
    }

    double taken() const { return out.stored_energy + out.dissipated_energy; }

    Blade node;
    Blade::Outputs out;
    double depth = 0.0, work = 0.0, most = 0.0;
};

/// A random sample such as a hand would press a blade into.
struct Stuff
{
    Blade::Params params;
    Blade::Settings settings;
    double d_rupture = 0.0;
};

class Dice
{
public:
    explicit Dice (unsigned seed) : random (seed) {}

    double uniform (double from, double to) { return std::uniform_real_distribution { from, to }(random); }
    int below (int n) { return std::uniform_int_distribution { 0, n - 1 }(random); }

    Stuff stuff()
    {
        Stuff s;
        s.params.width = uniform (0.005, 0.05);
        s.params.toughness = uniform (50.0, 3000.0);
        const double cost = s.params.width * s.params.toughness;
        s.params.rupture_force = cost * uniform (1.0, 4.0);
        s.settings.law = law (cost);
        if (below (2) == 0) s.settings.cracked_law = weaker (s.settings.law);
        s.d_rupture = s.settings.law.inverse (s.params.rupture_force);
        return s;
    }

private:
    /// A law that reaches this force within a few mm.
    Law law (double force)
    {
        const double e = uniform (1e-3, 5e-3);
        switch (below (3))
        {
        case 0:
        {
            const double n = uniform (0.8, 3.0);
            return power (force / std::pow (e, n), n);
        }
        case 1:
        {
            const double b = uniform (50.0, 600.0);
            return exponential (force / std::expm1 (b * e), b);
        }
        default:
            return table ({ 0.3 * e, 0.8 * e, e }, { 0.1 * force, uniform (0.1, 1.0) * force, force * uniform (1.0, 2.0) });
        }
    }

    Law weaker (Law law)
    {
        const double factor = uniform (0.3, 1.0);
        law.a *= factor;
        for (double& f : law.table.y)
            f *= factor;
        return law;
    }

    std::mt19937 random;
};
}   // namespace

TEST_CASE ("blade: it matches the golden columns", "[nodes][cut][golden]")
{
    const Golden golden ("cutting");
    Bench bench ({ .width = golden.param ("w"), .toughness = golden.param ("Jc"), .rupture_force = golden.param ("f_rupture") });
    std::vector<Blade::Outputs> outputs;
    for (std::size_t i = 0; i < golden.rows(); ++i)
        outputs.push_back (bench.tick (golden (i, "delta")));

    const auto meets = [&] (const std::string& column, double Blade::Outputs::*port) {
        const double worst = golden.worst (column, [&] (std::size_t i) { return outputs[i].*port; });
        INFO (column << " " << worst);
        CHECK (worst <= (column == "state" ? 0.0 : 1.0));
    };
    meets ("f", &Blade::Outputs::resistance);
    meets ("crack", &Blade::Outputs::crack);
    meets ("U", &Blade::Outputs::stored_energy);
    meets ("dissipated", &Blade::Outputs::dissipated_energy);
    meets ("state", &Blade::Outputs::state);
}

TEST_CASE ("blade: the chapter's potato is cut with 4 N", "[nodes][cut]")
{
    Bench bench;   // 20 mm wide, 200 J/m2, 2 N/mm, bursts at 6 N
    bench.tick (0.002999);
    CHECK (bench.out.state == 1.0);
    CHECK (bench.out.resistance == Approx (5.998));

    bench.tick (0.003);
    CHECK (bench.out.state == 2.0);
    CHECK (bench.out.crack == Approx (0.002));      // 2 (d_r - e_c)
    CHECK (bench.out.resistance == Approx (2.0));   // 2 f_cut - f_r: the dip
    CHECK (bench.out.dissipated_energy == Approx (0.008));

    bench.move (0.004, 100);   // the force rises again
    CHECK (bench.out.state == 3.0);
    CHECK (bench.out.resistance == Approx (4.0));
    bench.most = 0.0;
    bench.move (0.015, 1000);
    CHECK (bench.out.state == 4.0);
    CHECK (bench.out.resistance == Approx (4.0).epsilon (1e-12));
    CHECK (bench.most == Approx (4.0).epsilon (1e-8));
    CHECK (bench.out.crack == Approx (0.013));
}

TEST_CASE ("blade: a rupture force above twice the cutting force opens the whole indentation", "[nodes][cut]")
{
    Bench bench ({ .rupture_force = 10.0 });
    const double d = 0.005, stored = 0.5 * 2000.0 * d * d;
    bench.tick (d);
    CHECK (bench.out.state == 2.0);
    CHECK (bench.out.crack == d);
    CHECK (bench.out.resistance == 0.0);
    CHECK (bench.out.dissipated_energy == Approx (stored));   // that is 4 N over 5 mm, plus an excess of 5 mJ
    CHECK (stored - 4.0 * d == Approx (0.005));
    bench.tick (d);
    CHECK (bench.out.state == 0.0);
}

TEST_CASE ("blade: rupture at the cutting force makes no crack and no dip", "[nodes][cut]")
{
    for (const Law& law : { power (2000.0, 1.0), power (3e6, 2.1), exponential (0.3, 400.0), table ({ 1e-3, 3e-3 }, { 0.5, 9.0 }) })
    {
        Bench bench ({ .rupture_force = 4.0 }, { .law = law });
        bench.tick (law.inverse (4.0));
        CHECK (bench.out.state == 2.0);
        CHECK (bench.out.crack == 0.0);
        CHECK (bench.out.resistance == Approx (4.0));
        CHECK (bench.out.dissipated_energy == Approx (0.0).margin (1e-15));
    }
}

TEST_CASE ("blade: rupture balances the energies of any two laws", "[nodes][cut][energy]")
{
    tactus::test::property ("G0 (d_r) = G1 (d_r - c1) + J_c w c1 + excess, with an excess only if the whole indentation opens", [] (unsigned seed) {
        const Stuff s = Dice { seed }.stuff();
        const Law& g0 = s.settings.law;
        const Law& g1 = s.settings.cracked_law ? s.settings.cracked_law : g0;
        Bench bench (s.params, s.settings);
        RC_ASSERT (bench.node.problem() == "");
        bench.tick (s.d_rupture);
        RC_ASSERT (bench.out.state == 2.0);

        const double c = bench.out.crack, cost = s.params.width * s.params.toughness, stored = g0.energy (s.d_rupture);
        const double excess = stored - g1.energy (s.d_rupture - c) - cost * c;
        RC_ASSERT (c >= 0.0);
        RC_ASSERT (c <= s.d_rupture);
        RC_ASSERT (excess >= -1e-12 * stored);
        RC_ASSERT (c == s.d_rupture || excess <= 1e-12 * stored);
        RC_ASSERT (std::abs (bench.taken() - stored) <= 1e-12 * stored);

        // c is the largest root: for a longer crack, the energy does not suffice.
        for (double beyond = c + 1e-4 * s.d_rupture; beyond < s.d_rupture; beyond += 0.01 * s.d_rupture)
            RC_ASSERT (stored - g1.energy (s.d_rupture - beyond) - cost * beyond < 0.0);
    });
}

TEST_CASE ("blade: on a dense path the work of the hand is U + J_c w c + excess", "[nodes][cut][energy]")
{
    tactus::test::property ("any sample, any strokes", [] (unsigned seed) {
        Dice dice { seed };
        const Stuff s = dice.stuff();
        Bench bench (s.params, s.settings);
        bench.move (s.d_rupture * (1.0 - 1e-9), 20'000);
        const double before = bench.work, stored = bench.out.stored_energy;
        bench.tick (s.d_rupture);
        RC_ASSERT (bench.out.state == 2.0);
        bench.work = before + s.settings.law.energy (s.d_rupture) - stored;   // the trapezoid rule cannot integrate a jump

        const double cost = s.params.width * s.params.toughness;
        const double excess = bench.out.dissipated_energy - cost * bench.out.crack;
        for (int stroke = 0; stroke < 6; ++stroke)
        {
            bench.move (dice.uniform (-0.5, 6.0) * s.d_rupture, 20'000);
            const double balance = bench.out.stored_energy + cost * bench.out.crack + excess;
            RC_ASSERT (std::abs (bench.work - balance) <= 1e-6 * balance);
            RC_ASSERT (std::abs (bench.taken() - balance) <= 1e-10 * balance);
        }
    });
}

TEST_CASE ("blade: a closed path never generates energy", "[nodes][cut][energy]")
{
    tactus::test::property ("loops of random steps, far below and far beyond rupture, until cut through", [] (unsigned seed) {
        Dice dice { seed };
        Stuff s = dice.stuff();
        if (dice.below (3) == 0) s.params.thickness = dice.uniform (0.2, 5.0) * s.d_rupture;
        Bench bench (s.params, s.settings);
        // With laws that rise, the work of the hand against the force after each step is never less than what the sample took.
        // Where the force collapses, at rupture and when the sample falls in two, the work is what the sample took.
        double given = 0.0, before = 0.0, heat = 0.0;
        for (int k = 0; k < 2000; ++k)
        {
            const double from = bench.depth, step = dice.uniform (-1.0, 1.0) * s.d_rupture * std::pow (10.0, dice.uniform (-4.0, 0.5));
            const bool was_through = bench.out.state == 5.0;
            bench.tick (k % 50 == 49 ? 0.0 : std::min (from + step, 20.0 * s.d_rupture));

            const bool collapses = bench.out.state == 2.0 || (bench.out.state == 5.0 && ! was_through);
            given += collapses ? bench.taken() - before : bench.out.resistance * (bench.depth - from);
            RC_ASSERT (given >= bench.taken() * (1.0 - 1e-9));
            RC_ASSERT (bench.out.dissipated_energy >= heat);
            RC_ASSERT (bench.depth > 0.0 || bench.out.stored_energy == 0.0);
            heat = bench.out.dissipated_energy;
            before = bench.taken();
        }
    });
}

TEST_CASE ("blade: one jump past rupture ends where a slow blade does", "[nodes][cut]")
{
    tactus::test::property ("any sample, thick or thin, any depth", [] (unsigned seed) {
        Dice dice { seed };
        Stuff s = dice.stuff();
        if (dice.below (2) == 0) s.params.thickness = dice.uniform (0.01, 4.0) * s.d_rupture;
        const double to = dice.uniform (1.0 + 1e-6, 6.0) * s.d_rupture;
        Bench jump (s.params, s.settings), slow (s.params, s.settings);
        jump.tick (to);
        RC_ASSERT (jump.out.state == 2.0);
        slow.move (to, 5000);

        const auto near = [&] (double a, double b, double scale) { return std::abs (a - b) <= 1e-8 * scale; };
        RC_ASSERT (near (jump.out.resistance, slow.out.resistance, s.params.rupture_force));
        RC_ASSERT (near (jump.out.crack, slow.out.crack, s.d_rupture));
        RC_ASSERT (near (jump.out.stored_energy, slow.out.stored_energy, slow.taken()));
        RC_ASSERT (near (jump.out.dissipated_energy, slow.out.dissipated_energy, slow.taken()));
        RC_ASSERT (near (jump.tick (-1.0).crack, slow.tick (-1.0).crack, s.d_rupture));
        RC_ASSERT (jump.out.state == slow.out.state);
    });
}

TEST_CASE ("blade: back in its cut, it feels nothing down to the tip and does not rupture the sample again", "[nodes][cut]")
{
    tactus::test::property ("any sample", [] (unsigned seed) {
        Dice dice { seed };
        const Stuff s = dice.stuff();
        const Law& g1 = s.settings.cracked_law ? s.settings.cracked_law : s.settings.law;
        const double cost = s.params.width * s.params.toughness;
        Bench bench (s.params, s.settings);
        bench.move (dice.uniform (2.0, 6.0) * s.d_rupture, 1000);
        bench.move (-0.001, 100);
        const double crack = bench.out.crack;

        bench.most = 0.0;
        bench.move (crack, 1000);
        RC_ASSERT (bench.most == 0.0);
        RC_ASSERT (bench.out.state == 0.0);

        bench.move (crack + 0.5 * g1.inverse (cost), 100);
        RC_ASSERT (bench.out.state == 3.0);
        RC_ASSERT (bench.out.crack == crack);
        bench.move (crack + 3.0 * g1.inverse (cost), 1000);
        RC_ASSERT (bench.out.state == 4.0);
        RC_ASSERT (bench.most <= cost * (1.0 + 1e-6));
    });
}

TEST_CASE ("blade: the cutting force is J_c w, however stiff the sample", "[nodes][cut]")
{
    tactus::test::property ("any laws", [] (unsigned seed) {
        const Stuff s = Dice { seed }.stuff();
        Bench bench (s.params, s.settings);
        bench.tick (5.0 * s.d_rupture);
        for (int k = 0; k < 10; ++k)
        {
            bench.tick (bench.depth + 2.0 * s.d_rupture);   // the first step may only load the sample up to the cutting force again
            if (k > 0) RC_ASSERT (bench.out.state == 4.0);
            RC_ASSERT (std::abs (bench.out.resistance - s.params.width * s.params.toughness) <= 1e-9 * s.params.rupture_force);
        }
    });
}

TEST_CASE ("blade: a slow blade does not chatter between cutting and holding", "[nodes][cut]")
{
    Bench bench;
    bench.tick (0.01);
    for (int k = 0; k < 20'000; ++k)
    {
        bench.tick (bench.depth + 1e-9);
        REQUIRE (bench.out.state == 4.0);
        REQUIRE (bench.out.resistance == Approx (4.0).epsilon (1e-9));
    }
}

TEST_CASE ("blade: repeating a tick changes nothing but the state", "[nodes][cut]")
{
    tactus::test::property ("virgin, bursting, elastic, cutting, cut through", [] (unsigned seed) {
        Dice dice { seed };
        Stuff s = dice.stuff();
        if (dice.below (2) == 0) s.params.thickness = dice.uniform (1.0, 6.0) * s.d_rupture;
        Bench bench (s.params, s.settings);
        for (int k = 0; k < 40; ++k)
        {
            const auto first = bench.tick (dice.uniform (-0.5, 0.2 * k) * s.d_rupture);
            for (int again = 0; again < 3; ++again)
            {
                const auto second = bench.tick (bench.depth);
                RC_ASSERT (second.resistance == first.resistance);
                RC_ASSERT (second.crack == first.crack);
                RC_ASSERT (second.stored_energy == first.stored_energy);
                RC_ASSERT (second.dissipated_energy == first.dissipated_energy);
                const bool moved = first.state == 2.0 || first.state == 4.0;
                const bool through = second.state == 5.0 && first.state == 2.0;
                const double held = bench.depth > first.crack ? 3.0 : 0.0, expected = moved ? held : first.state;
                RC_ASSERT (second.state == (through ? 5.0 : expected));
            }
        }
    });
}

TEST_CASE ("blade: a sample that is cut through never gives a force again", "[nodes][cut][energy]")
{
    Bench bench ({ .thickness = 0.01 });
    bench.move (0.0119, 10'000);
    CHECK (bench.out.state == 4.0);
    bench.move (0.0121, 10);
    CHECK (bench.out.state == 5.0);
    CHECK (bench.out.crack == 0.01);
    CHECK (bench.out.stored_energy == 0.0);
    CHECK (bench.out.dissipated_energy == Approx (4.0 * 0.01 + 0.5 * 4.0 * 0.002));   // J_c w c, and the spring energy released

    bench.node.params.thickness = 1.0;
    for (const double depth : { 0.02, -0.01, 0.005, 0.05 })
    {
        bench.tick (depth);
        CHECK (bench.out.resistance == 0.0);
        CHECK (bench.out.state == 5.0);
        CHECK (bench.out.crack == 0.01);
    }
}

TEST_CASE ("blade: a skin that bursts through takes the stored energy", "[nodes][cut][energy]")
{
    Bench bench ({ .thickness = 0.001 });
    bench.tick (0.02);
    CHECK (bench.out.state == 2.0);
    CHECK (bench.out.crack == 0.001);
    CHECK (bench.out.resistance == 0.0);
    CHECK (bench.out.dissipated_energy == Approx (0.5 * 6.0 * 0.003));
    bench.tick (0.02);
    CHECK (bench.out.state == 5.0);
}

TEST_CASE ("blade: params are read on touch", "[nodes][cut]")
{
    Bench bench;
    bench.tick (0.001);
    bench.node.params = { .width = 0.04, .toughness = 300.0, .rupture_force = 30.0 };
    bench.tick (0.0031);
    CHECK (bench.out.state == 2.0);
    bench.tick (0.01);
    CHECK (bench.out.resistance == Approx (4.0));

    bench.tick (0.0);   // leaves the sample; the next tick touches the tip of the crack again
    bench.tick (0.02);
    CHECK (bench.out.resistance == Approx (12.0));
}

TEST_CASE ("blade: a fault is forgotten, but the crack stays", "[nodes][cut]")
{
    for (const double bad : { not_a_number, tactus::inf, -tactus::inf })
    {
        Bench bench, whole;
        bench.tick (0.006);
        whole.tick (0.006);
        const auto out = bench.node.tick ({ .depth = bad });
        CHECK (out.resistance == 0.0);
        CHECK (out.stored_energy == 0.0);
        CHECK (out.crack == whole.out.crack);
        CHECK (out.dissipated_energy == whole.out.dissipated_energy);
        CHECK (out.state == -1.0);
        for (const double depth : { 0.0055, 0.003, 0.007, 0.009 })
            CHECK (bench.tick (depth).resistance == whole.tick (depth).resistance);
    }

    Bench virgin;
    virgin.tick (0.002);
    virgin.tick (not_a_number);
    CHECK (virgin.node.tick ({ .depth = 0.002 }).state == 1.0);
}

TEST_CASE ("blade: an instance replaced in the middle of a cut keeps cutting", "[nodes][cut]")
{
    Bench bench, next;
    bench.tick (0.006);
    next.node.adopt (bench.node);
    for (const double depth : { 0.0055, 0.008, 0.001, 0.009 })
    {
        const auto a = bench.tick (depth), b = next.tick (depth);
        CHECK (a.resistance == b.resistance);
        CHECK (a.dissipated_energy == b.dissipated_energy);
        CHECK (a.state == b.state);
    }

    Bench stiffer ({}, { .law = power (4000.0, 1.0) });
    stiffer.node.adopt (bench.node);
    CHECK (stiffer.tick (0.02).resistance == Approx (4.0));   // J_c w, whatever the law
}

TEST_CASE ("blade: impossible samples are reported", "[nodes][cut]")
{
    const auto problem = [] (const Blade::Params& params, const Blade::Settings& settings) { return Bench (params, settings).node.problem(); };

    CHECK (problem ({}, {}) == "");
    CHECK (problem ({ .rupture_force = 4.0 }, {}) == "");
    CHECK (problem ({ .rupture_force = 3.0 }, {}) == "rupture_force is 3 N; it must be at least width times toughness, which is 4 N");
    CHECK (problem ({}, { .cracked_law = power (1000.0, 1.0) }) == "");
    CHECK (problem ({}, { .cracked_law = power (3000.0, 1.0) })
           == "at rupture, 0.003 m deep, cracked_law stores 0.0135 J; it must not store more than law does, 0.009 J");
    CHECK (problem ({}, { .law = table ({ 1e-3, 2e-3 }, { 9.0, 8.0 }) }) == "law must not fall with depth");
    CHECK (problem ({}, { .cracked_law = table ({ 1e-3, 2e-3 }, { 1.0, 0.5 }) }) == "cracked_law must not fall with depth");
}

TEST_CASE ("blade: impossible params generate no energy either", "[nodes][cut][energy]")
{
    Bench weak ({ .rupture_force = 1.0 });   // bursts at 4 N, the cutting force
    weak.move (0.0019, 100);
    CHECK (weak.out.state == 1.0);
    weak.move (0.0021, 2);
    CHECK (weak.out.resistance == Approx (4.0));

    Bench stiff ({}, { .cracked_law = power (3000.0, 1.0) });
    stiff.move (0.01, 100);
    CHECK (stiff.out.state == 1.0);
}
