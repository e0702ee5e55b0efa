// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/nodes/cut/blade.hpp>
#include <tactus/nodes/cut/edge.hpp>

#include <golden/golden.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using tactus::Law;
using tactus::shortestRotation;
using tactus::Vec3;
using tactus::nodes::Blade;
using tactus::nodes::Edge;
using tactus::test::Golden;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// An edge and the hand that holds it. The hand's work is computed with the trapezoid rule. `missed`: the most that the rule can miss if
/// the force lies between those at the ends of each step.
struct Bench
{
    explicit Bench (const Edge::Params& params = {}, const Edge::Settings& settings = {})
    {
        node.params = params;
        node.settings = settings;
        node.prepare ({});
    }

    const Edge::Outputs& tick (const Vec3& to, const Vec3& turned = Vec3::Zero())
    {
        const Eigen::AngleAxisd turn { tactus::rotationMatrix (turned) * tactus::rotationMatrix (rotation).transpose() };
        const Vec3 step = to - position, angle = turn.angle() * turn.axis();
        const Edge::Outputs before = out;
        out = node.tick ({ .position = to, .rotation = turned });
        work -= 0.5 * (before.force + out.force).dot (step) + 0.5 * (before.torque + out.torque).dot (angle);
        missed += 0.5 * (out.force - before.force).norm() * step.norm() + 0.5 * (out.torque - before.torque).norm() * angle.norm();
        position = to;
        rotation = turned;
        most = std::max (most, out.resistance);
        ruptures += out.state == 2.0;
        return out;
    }

    /// Moves the edge to a position and rotation in n equal steps.
    const Edge::Outputs& move (const Vec3& to, const Vec3& turned, int n)
    {
        const Vec3 from = position, from_rotation = rotation;
        for (int k = 1; k <= n; ++k)
        {
            const double part = static_cast<double> (k) / n;
            tick (from + part * (to - from), from_rotation + part * (turned - from_rotation));
        }
        return out;
    }
    const Edge::Outputs& move (const Vec3& to, int n) { return move (to, rotation, n); }

    double taken() const { return out.stored_energy + out.dissipated_energy; }

    Edge node;
    Edge::Outputs out;
    Vec3 position = Vec3::Zero(), rotation = Vec3::Zero();
    double work = 0.0, missed = 0.0, most = 0.0;
    int ruptures = 0;
};

class Dice
{
public:
    explicit Dice (unsigned seed) : random (seed) {}

    double uniform (double from, double to) { return std::uniform_real_distribution { from, to }(random); }
    int below (int n) { return std::uniform_int_distribution { 0, n - 1 }(random); }
    Vec3 vector (double size) { return { uniform (-size, size), uniform (-size, size), uniform (-size, size) }; }

private:
    std::mt19937 random;
};

/// A potato that bursts at the cutting force. Its force does not dip after the rupture, so it has a closed form.
const Edge::Params skinless { .rupture_force = 4.0 };
constexpr double toughness = 200.0, width = 0.02;

/// A smooth random path through and around the body. It is closed: s = 1 is the start again.
class Walk
{
public:
    Walk (Dice& dice, double along, double aside, double deep, double turn)
    {
        for (auto& w : waves)
            for (int i = 0; i < 2; ++i)
            {
                w.position[i] = dice.vector (1.0).cwiseProduct (Vec3 { along, aside, deep }) / 2.0;
                w.rotation[i] = dice.vector (turn / 2.0);
            }
    }

    Vec3 position (double s) const { return sum (s, &Wave::position); }
    Vec3 rotation (double s) const { return sum (s, &Wave::rotation); }

private:
    struct Wave
    {
        Vec3 position[2], rotation[2];
    };

    Vec3 sum (double s, const Vec3 (Wave::*part)[2]) const
    {
        Vec3 v = Vec3::Zero();
        for (int i = 0; i < 4; ++i)
            v += std::sin (2.0 * M_PI * (i + 1) * s) * (waves[i].*part)[0] + std::cos (2.0 * M_PI * (i + 1) * s) * (waves[i].*part)[1];
        return v;
    }

    Wave waves[4];
};

/// The energy of an edge on a random closed path of n steps, in J.
struct Balance
{
    double work = 0.0, growth = 0.0, missed = 0.0;
    bool is_physical = true;   // nothing that is spent comes back, and no stored energy is negative

    Balance (unsigned seed, int n)
    {
        Dice dice { seed };
        const double thickness = dice.below (3) ? 0.0 : dice.uniform (1e-3, 1e-2);
        const Edge::Params params { .rupture_force = dice.uniform (4.0, 9.0), .thickness = thickness };
        const Edge::Settings settings { .grid = dice.uniform (5e-4, 3e-3) };
        const Walk walk (dice, dice.uniform (0.0, 0.03), dice.uniform (0.0, 0.01), 0.008, dice.uniform (0.0, 0.8));
        Bench bench (params, settings);
        double heat = 0.0;
        bench.tick (walk.position (0.0), walk.rotation (0.0));
        const double start = bench.taken();
        bench.work = bench.missed = 0.0;
        for (int k = 1; k <= n; ++k)
        {
            bench.tick (walk.position (static_cast<double> (k) / n), walk.rotation (static_cast<double> (k) / n));
            is_physical = is_physical && bench.out.dissipated_energy >= heat && bench.out.stored_energy >= 0.0;
            heat = bench.out.dissipated_energy;
        }
        work = bench.work;
        growth = bench.taken() - start;
        missed = bench.missed;
    }
};
}   // namespace

TEST_CASE ("edge: pressed in level, it matches the golden columns of the blade", "[nodes][cut][golden]")
{
    const Golden golden ("cutting");
    Bench bench ({ .width = golden.param ("w"), .toughness = golden.param ("Jc"), .rupture_force = golden.param ("f_rupture") });
    std::vector<Edge::Outputs> outputs;
    for (std::size_t i = 0; i < golden.rows(); ++i)
        outputs.push_back (bench.tick ({ 0.0, 0.0, -golden (i, "delta") }));

    const auto meets = [&] (const std::string& column, double Edge::Outputs::*port) {
        const double worst = golden.worst (column, [&] (std::size_t i) { return outputs[i].*port; });
        INFO (column << " " << worst);
        CHECK (worst <= (column == "state" ? 0.0 : 1.0));
    };
    meets ("f", &Edge::Outputs::resistance);
    meets ("crack", &Edge::Outputs::crack);
    meets ("U", &Edge::Outputs::stored_energy);
    meets ("dissipated", &Edge::Outputs::dissipated_energy);
    meets ("state", &Edge::Outputs::state);
}

TEST_CASE ("edge: pressed in level, it is a blade, in any direction and with any grid", "[nodes][cut]")
{
    tactus::test::property ("random strokes and jumps, thick and thin samples", [] (unsigned seed) {
        Dice dice { seed };
        const double long_ = dice.uniform (0.002, 0.05);
        const Edge::Params params { .width = long_,
                                    .toughness = dice.uniform (50.0, 1000.0),
                                    .rupture_force = 1000.0 * long_ * dice.uniform (1.0, 3.0),
                                    .thickness = dice.below (2) ? dice.uniform (1e-3, 2e-2) : 0.0 };
        const Law law { .kind = Law::Kind::exponential, .a = dice.uniform (1.0, 5.0), .b = dice.uniform (200.0, 600.0) };
        Law weaker = law;
        weaker.a *= 0.7;
        const Vec3 up = dice.vector (1.0);
        Bench edge (params, { .law = law, .cracked_law = weaker, .grid = dice.uniform (2e-4, 5e-3), .normal = up, .offset = dice.uniform (-0.1, 0.1) });
        Blade blade;
        blade.params = { .width = params.width, .toughness = params.toughness, .rupture_force = params.rupture_force, .thickness = params.thickness };
        blade.settings = { .law = law, .cracked_law = weaker };

        const Vec3 n = up.normalized();
        const Vec3 along = tactus::perpendicularTo (n);
        const Eigen::AngleAxisd rotation { shortestRotation (Vec3::UnitX(), along) };
        const Vec3 start = along * dice.uniform (-0.1, 0.1) + n.cross (along) * dice.uniform (-0.1, 0.1);
        const double d_r = law.inverse (params.rupture_force);
        double depth = 0.0;
        for (int k = 0; k < 300; ++k)
        {
            depth = dice.below (10) ? depth + dice.uniform (-0.2, 0.3) * d_r : dice.uniform (-1.0, 5.0) * d_r;
            const Vec3 p = start + n * (edge.node.settings.offset - depth);
            const auto a = edge.tick (p, rotation.angle() * rotation.axis());
            const auto b = blade.tick ({ .depth = depth });
            const auto near = [] (double x, double y, double scale) { return std::abs (x - y) <= 1e-9 * scale; };
            RC_ASSERT (near (a.resistance, b.resistance, params.rupture_force));
            RC_ASSERT (near (a.crack, b.crack, d_r));
            RC_ASSERT (near (a.stored_energy, b.stored_energy, b.stored_energy + b.dissipated_energy + 1e-3));
            RC_ASSERT (near (a.dissipated_energy, b.dissipated_energy, b.stored_energy + b.dissipated_energy + 1e-3));
            RC_ASSERT (a.state == b.state);
            RC_ASSERT ((a.force - a.resistance * n).norm() <= 1e-6 * params.rupture_force);
            RC_ASSERT (a.torque.norm() <= 1e-6 * params.rupture_force * params.width);
        }
    });
}

TEST_CASE ("edge: tilted, its force ramps over width times sine of the angle, up to the cost of the surface that it opens", "[nodes][cut]")
{
    for (const double angle : { -0.6, 0.1, 0.3, 1.0 })
    {
        Bench bench (skinless, { .grid = 2e-4 });
        const Vec3 tilt { 0.0, angle, 0.0 };
        const double half = 0.5 * width * std::abs (std::sin (angle)), e_c = 0.002, slope = std::tan (std::abs (angle));
        bench.tick ({ 0.0, 0.0, half + 1e-3 }, tilt);
        for (double deepest = e_c; deepest < 2.0 * half; deepest += 2e-4)
        {
            bench.move ({ 0.0, 0.0, half - deepest }, 20);
            INFO (angle << " " << deepest);
            CHECK (bench.out.resistance == Approx (toughness * (deepest - 0.5 * e_c) / slope).margin (0.01));
        }
        bench.move ({ 0.0, 0.0, -half - e_c - 1e-3 }, 1000);
        CHECK (bench.out.state == 4.0);
        CHECK (bench.out.resistance == Approx (toughness * width * std::cos (angle)).epsilon (1e-6));
        CHECK (bench.out.crack == Approx (2.0 * half + 1e-3).margin (2e-4 * slope));
    }
}

TEST_CASE ("edge: cut, pull out, move aside, press: a second rupture, and back in the old cut there is none", "[nodes][cut]")
{
    Bench bench;
    const auto stroke = [&] (double x, double y, double yaw) {
        bench.tick ({ x, y, 0.001 }, { 0.0, 0.0, yaw });
        bench.ruptures = 0;
        bench.most = 0.0;
        bench.move ({ x, y, -0.01 }, 2000);
        bench.move ({ x, y, 0.001 }, 500);
    };
    stroke (0.0, 0.0, 0.0);
    CHECK (bench.ruptures == 1);
    CHECK (bench.most == Approx (6.0).epsilon (2e-3));

    stroke (0.0, 0.0005, 0.0);   // back in the cut, within a column
    CHECK (bench.ruptures == 0);
    CHECK (bench.most == Approx (4.0).epsilon (1e-6));

    stroke (0.0, 0.05, 0.0);
    CHECK (bench.ruptures == 1);
    CHECK (bench.most == Approx (6.0).epsilon (2e-3));

    stroke (0.0, 0.0, 0.3);   // turned: the edge cuts another plane
    CHECK (bench.ruptures == 1);
    stroke (0.0, 0.0, M_PI);   // turned by half a turn: the first plane again
    CHECK (bench.ruptures == 0);
    stroke (0.0, 0.05, 0.0);
    CHECK (bench.ruptures == 0);
}

TEST_CASE ("edge: half outside its cut, it breaks through on the other half alone, and feels a torque", "[nodes][cut]")
{
    Bench bench;
    bench.move ({ 0.0, 0.0, -0.01 }, 1000);
    bench.move ({ 0.0, 0.0, 0.001 }, 100);
    bench.move ({ 0.01, 0.0, 0.001 }, 10);
    bench.ruptures = 0;
    bench.move ({ 0.01, 0.0, -0.00299 }, 399);
    CHECK (bench.ruptures <= 1);
    CHECK (bench.out.resistance == Approx (0.475 * 2000.0 * 0.00299).epsilon (1e-9));                       // 9.5 mm uncut: half the edge minus half a column
    CHECK (bench.out.torque.y() == Approx (-0.25 * width * 1.05 * bench.out.resistance).epsilon (0.001));   // lifts the half over uncut material
    bench.move ({ 0.01, 0.0, -0.00301 }, 2);
    CHECK (bench.ruptures >= 1);
    bench.move ({ 0.01, 0.0, -0.02 }, 1000);
    CHECK (bench.out.resistance == Approx (4.0));
}

TEST_CASE ("edge: drawn along itself at a depth, it feels the cost of the surface that its end opens, without ripple", "[nodes][cut]")
{
    Bench bench (skinless);
    bench.move ({ 0.0, 0.0, -0.012 }, 1000);
    const double depth = bench.out.crack, before = bench.taken();
    CHECK (depth == Approx (0.01));
    bench.move ({ 0.01, 0.0, -0.012 }, 1000);
    for (int k = 0; k < 500; ++k)
    {
        bench.tick (bench.position + Vec3 { 2e-5, 0.0, 0.0 });
        REQUIRE (bench.out.force.x() == Approx (-toughness * depth).epsilon (1e-9));
        REQUIRE (bench.out.resistance == Approx (4.0).epsilon (0.05));   // +- J_c h: the column at the leading end is not cut yet
    }
    bench.move ({ 0.05, 0.0, -0.012 }, 3000);
    CHECK (bench.taken() - before == Approx (toughness * depth * 0.05).epsilon (0.05));
    CHECK (bench.work == Approx (bench.taken()).epsilon (1e-4));

    bench.move ({ 0.047, 0.0, -0.012 }, 3000);   // back over its own cut
    CHECK (std::abs (bench.out.force.x()) < 1e-9);
}

TEST_CASE ("edge: the work of the hand is stored or spent on cracks, however it moves and turns", "[nodes][cut][energy]")
{
    tactus::test::property ("any sample, any closed path; the error is at most that of the trapezoid rule, which falls with the step", [] (unsigned seed) {
        for (const int n : { 1'500, 40'000 })
        {
            const Balance balance (seed, n);
            RC_ASSERT (balance.is_physical);
            RC_ASSERT (std::abs (balance.work - balance.growth) < balance.missed + 1e-9);
        }
    });
}

TEST_CASE ("edge: these paths once gave energy, while a tilted edge had not yet cracked the body", "[nodes][cut][energy]")
{
    for (const unsigned seed : { 6964001u, 920846u, 166727u })
    {
        const Balance balance (seed, 40'000);
        INFO (seed);
        CHECK (balance.work == Approx (balance.growth).epsilon (5e-4));
    }
}

TEST_CASE ("edge: before it cracks the body, a tilted edge slides along itself without a force", "[nodes][cut]")
{
    Bench bench;
    bench.tick ({ 0.0, 0.0, 0.004 }, { 0.0, 0.3, 0.2 });
    bench.move ({ 0.0, 0.0, 0.001 }, 100);
    REQUIRE (bench.out.state == 1.0);
    const double stored = bench.out.stored_energy, resistance = bench.out.resistance;
    REQUIRE (resistance > 0.1);
    for (int k = 0; k < 300; ++k)
    {
        bench.tick (bench.position + Vec3 { 2e-5, 1e-5, 0.0 }, bench.rotation);
        REQUIRE (bench.out.force.head<2>().norm() < 1e-12);
        REQUIRE (bench.out.resistance == Approx (resistance));
        REQUIRE (bench.out.stored_energy == Approx (stored));
    }
}

TEST_CASE ("edge: the dissipated energy does not depend on the rate, and a jump ends in the same state as a slow motion", "[nodes][cut]")
{
    Dice dice { 3 };
    for (int trial = 0; trial < 8; ++trial)
    {
        // The edge stays in one plane. Otherwise it could enter an old cut only when a sample has both ends within a column's width of
        // it, and this depends on the rate.
        const Walk walk (dice, 0.02, 0.0, 0.006, 0.4);
        double spent[2] {};
        for (int fast = 0; fast < 2; ++fast)
        {
            Bench bench;
            const int steps = fast ? 40'000 : 2'000;
            for (int k = 0; k <= steps; ++k)
            {
                const double s = static_cast<double> (k) / steps;
                bench.tick (walk.position (s), walk.rotation (s).cwiseProduct (Vec3::UnitY()));
            }
            spent[fast] = bench.out.dissipated_energy;
        }
        CHECK (spent[0] == Approx (spent[1]).epsilon (0.01).margin (1e-4));
    }

    const Vec3 tilt { 0.0, 0.2, 0.1 };
    Bench jump, slow;
    slow.tick ({ 0.0, 0.0, 0.01 }, tilt);
    slow.move ({ 0.0, 0.0, -0.01 }, 5000);
    jump.tick ({ 0.0, 0.0, -0.01 }, tilt);
    CHECK (jump.out.state == 2.0);
    CHECK (jump.out.resistance == Approx (slow.out.resistance));
    CHECK (jump.out.dissipated_energy == Approx (slow.out.dissipated_energy));
    CHECK (jump.out.crack == Approx (slow.out.crack));
}

TEST_CASE ("edge: inside its cut it may move aside and turn, and the next cut is where it enters again", "[nodes][cut]")
{
    Bench bench;
    bench.move ({ 0.0, 0.0, -0.01 }, 1000);
    const auto before = bench.out;
    bench.move ({ 0.0, 0.03, -0.01 }, 100);
    CHECK (bench.out.resistance == before.resistance);
    CHECK (bench.out.stored_energy == before.stored_energy);
    CHECK (bench.work == Approx (bench.taken()).epsilon (0.01));

    bench.tick ({ 0.0, 0.03, 0.001 });
    bench.ruptures = 0;
    bench.move ({ 0.0, 0.03, -0.01 }, 1000);
    CHECK (bench.ruptures == 1);
}

TEST_CASE ("edge: until it cracks the body it slides over the surface, and the cut is where it cracks", "[nodes][cut]")
{
    Bench bench;
    bench.move ({ 0.0, 0.0, -0.002 }, 100);
    const auto before = bench.out;
    bench.move ({ 0.003, 0.03, -0.002 }, { 0.0, 0.0, 0.5 }, 100);
    CHECK (bench.out.resistance == Approx (before.resistance));
    CHECK (bench.out.force.head<2>().norm() < 1e-9);
    CHECK (bench.out.torque.norm() < 1e-9);
    bench.move ({ 0.003, 0.03, -0.01 }, 1000);
    CHECK (bench.ruptures == 1);

    bench.tick ({ 0.003, 0.03, 0.001 }, { 0.0, 0.0, 0.5 });
    bench.move ({ 0.003, 0.03, -0.01 }, 1000);
    CHECK (bench.ruptures == 1);
    bench.tick ({ 0.0, 0.0, 0.001 });
    bench.move ({ 0.0, 0.0, -0.01 }, 1000);
    CHECK (bench.ruptures == 2);
}

TEST_CASE ("edge: repeating a tick changes nothing but the state", "[nodes][cut]")
{
    tactus::test::property ("any pose", [] (unsigned seed) {
        Dice dice { seed };
        Bench bench ({ .thickness = dice.below (2) ? 0.01 : 0.0 });
        for (int k = 0; k < 100; ++k)
        {
            const auto first = bench.tick (dice.vector (0.01), dice.vector (0.4));
            for (int again = 0; again < 2; ++again)
            {
                const auto second = bench.tick (bench.position, bench.rotation);
                RC_ASSERT (second.force == first.force);
                RC_ASSERT (second.torque == first.torque);
                RC_ASSERT (second.crack == first.crack);
                RC_ASSERT (second.stored_energy == first.stored_energy);
                RC_ASSERT (second.dissipated_energy == first.dissipated_energy);
                RC_ASSERT (second.state != 2.0);
                RC_ASSERT (second.state != 4.0);
            }
        }
    });
}

TEST_CASE ("edge: a fault is forgotten, but the cut keeps its place", "[nodes][cut]")
{
    Bench bench, whole;
    for (auto* b : { &bench, &whole })
        b->move ({ 0.0, 0.0, -0.01 }, 500);
    for (const Vec3& bad : { Vec3 { not_a_number, 0.0, 0.0 }, Vec3 { 0.0, tactus::inf, 0.0 } })
    {
        for (const auto& out : { bench.node.tick ({ .position = bad }), bench.node.tick ({ .rotation = bad }) })
        {
            CHECK (out.force == Vec3::Zero());
            CHECK (out.torque == Vec3::Zero());
            CHECK (out.stored_energy == 0.0);
            CHECK (out.crack == whole.out.crack);
            CHECK (out.dissipated_energy == whole.out.dissipated_energy);
            CHECK (out.state == -1.0);
        }
        for (const double z : { -0.009, -0.004, -0.012, 0.001, -0.011 })
        {
            const auto a = bench.tick ({ 0.0, 0.0, z }), b = whole.tick ({ 0.0, 0.0, z });
            CHECK (a.resistance == b.resistance);
            CHECK (a.state == b.state);
        }
    }
}

TEST_CASE ("edge: it remembers 16 cuts and 512 columns of each", "[nodes][cut]")
{
    Bench bench;
    const auto ruptures = [&] (double x, double y) {
        bench.tick ({ x, y, 0.001 });
        bench.ruptures = 0;
        bench.tick ({ x, y, -0.01 });
        bench.tick ({ x, y, 0.001 });
        return bench.ruptures;
    };
    for (int i = 0; i < 16; ++i)
        CHECK (ruptures (0.0, 0.01 * i) == 1);
    for (int i = 0; i < 16; ++i)
        CHECK (ruptures (0.0, 0.01 * i) == 0);
    CHECK (ruptures (0.0, 0.5) == 1);   // replaces the first cut
    CHECK (ruptures (0.0, 0.01) == 0);
    CHECK (ruptures (0.0, 0.0) == 1);   // replaces the third cut, the least recently used
    CHECK (ruptures (0.0, 0.01) == 0);
    CHECK (ruptures (0.0, 0.02) == 1);

    CHECK (ruptures (0.4, 0.02) == 1);
    CHECK (ruptures (0.0, 0.02) == 0);
    CHECK (ruptures (0.512, 0.02) == 1);   // 512 columns further along: overwrites the first part of the cut
    CHECK (ruptures (0.0, 0.02) == 1);
}

TEST_CASE ("edge: an edge far longer than its grid still cuts at its force", "[nodes][cut]")
{
    Bench bench ({ .width = 2.0, .toughness = 20.0, .rupture_force = 60.0 });
    bench.move ({ 0.0, 0.0, -0.06 }, 100);
    CHECK (bench.out.resistance == Approx (40.0));
    bench.move ({ 0.0, 0.0, 0.01 }, 2);
    bench.ruptures = 0;
    bench.move ({ 0.0, 0.0, -0.06 }, 100);
    CHECK (bench.ruptures == 0);
}

TEST_CASE ("edge: an edge that enters upright opens no surface", "[nodes][cut]")
{
    Bench bench;
    const Vec3 upright { 0.0, M_PI / 2.0, 0.0 };
    bench.tick ({ 0.0, 0.0, 0.02 }, upright);
    bench.move ({ 0.0, 0.0, -0.02 }, 100);
    CHECK (bench.out.force.norm() < 1e-9);
    CHECK (bench.out.dissipated_energy < 1e-9);
}

TEST_CASE ("edge: an instance replaced in the middle of a cut keeps cutting", "[nodes][cut]")
{
    Bench bench, next;
    bench.move ({ 0.0, 0.0, -0.006 }, { 0.0, 0.2, 0.0 }, 100);
    next.node.adopt (bench.node);
    for (const double z : { -0.0055, -0.008, 0.02, -0.009 })
    {
        const auto a = bench.tick ({ 0.0, 0.0, z }, { 0.0, 0.2, 0.0 }), b = next.tick ({ 0.0, 0.0, z }, { 0.0, 0.2, 0.0 });
        CHECK (a.force == b.force);
        CHECK (a.dissipated_energy == b.dissipated_energy);
        CHECK (a.state == b.state);
    }

    Bench turned ({}, { .normal = Vec3::UnitY() });   // another surface: the old cuts are not in it
    turned.node.adopt (bench.node);
    CHECK (turned.tick ({ 0.0, -0.01, 0.0 }).state == 2.0);
}

TEST_CASE ("edge: impossible samples are reported", "[nodes][cut]")
{
    const auto problem = [] (const Edge::Params& params, const Edge::Settings& settings) { return Bench (params, settings).node.problem(); };
    CHECK (problem ({}, {}) == "");
    CHECK (problem ({ .rupture_force = 3.0 }, {}) == "rupture_force is 3 N; it must be at least width times toughness, which is 4 N");
    CHECK (problem ({}, { .normal = Vec3::Zero() }) == "normal must have a direction; it is 0");
}
