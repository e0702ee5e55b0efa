// SPDX-License-Identifier: MIT
// A normal that turns or trembles, as on rough ground, takes the stretch along: a held contact does not walk.
#include <tactus/nodes/friction/elasto_plastic.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using tactus::Bristle;
using tactus::Vec3;
using tactus::nodes::ElastoPlastic;

namespace
{
using Load = ElastoPlastic::Load;
using Outputs = ElastoPlastic::Outputs;

constexpr double degree = M_PI / 180.0;

/// A normal that trembles about one axis, or about two as if on a cone.
struct Tremor
{
    double angle = 5.0 * degree, frequency = 10.0;   // rad, Hz
    Vec3 mean = Vec3::UnitZ();
    bool cone = false;

    Vec3 normal (double t) const
    {
        const double phase = 2.0 * M_PI * frequency * t, tilt = std::tan (angle);
        return mean + Vec3 { tilt * std::sin (phase), cone ? tilt * std::cos (phase) : 0.0, 0.0 };
    }
};

/// A contact without parallel transport: the stretch is projected on the tangent plane of each sample (docs/decisions/parallel_transport.md).
struct Projected
{
    Bristle bristle { .d_max = 1e-4, .d_stick = 1e-4 };
    double sigma = 0.5 / 1e-4;   // N/m
    Vec3 p = Vec3::Zero(), d = Vec3::Zero();

    Vec3 force (const Vec3& position, const Vec3& normal)
    {
        const Vec3 n = normal.normalized(), dp = position - p, kept = d - n * n.dot (d);
        d = bristle.stretch (kept, dp - n * n.dot (dp)).d;
        p = position;
        return -sigma * d;
    }
};

/// A hand that leans with 0.1 N on a tool of 50 g, while the contact can hold 0.5 N. The tool moves in x and y.
struct Lean
{
    Tremor tremor;
    double rate = 4000.0, seconds = 60.0;
    double direction = 0.0;   // of the hand's force, in rad from x towards y
    Load load = Load::bound;

    /// How far the tool walks after the first 10 s, in m. Its position is averaged over a second.
    double walk() const
    {
        ElastoPlastic node;
        node.params = { .mu = 0.5, .d_max = 1e-4, .load = load };
        return walkOn ([&] (const Vec3& p, const Vec3& n) { return node.tick ({ .position = p, .normal = n }).force; });
    }

    template <typename Contact>
    double walkOn (Contact&& contact) const
    {
        const double dt = 1.0 / rate, mass = 0.05, damping = 12.0, decay = std::exp (-damping * dt / mass);
        const double per_v = mass / damping * (1.0 - decay);
        const Vec3 hand = 0.1 * Vec3 { std::cos (direction), std::sin (direction), 0.0 };
        const int ticks = static_cast<int> (seconds * rate), second = static_cast<int> (rate);
        Vec3 x = Vec3::Zero(), v = Vec3::Zero(), first = Vec3::Zero(), last = Vec3::Zero();
        for (int k = 0; k < ticks; ++k)
        {
            Vec3 f = hand + contact (x, tremor.normal (k * dt));
            f.z() = 0.0;
            x += v * per_v + f / damping * (dt - per_v);
            v = v * decay + f / damping * (1.0 - decay);
            if (k >= 10 * second && k < 11 * second) first += x / second;
            if (k >= ticks - second) last += x / second;
        }
        return (last - first).norm();
    }
};
}   // namespace

TEST_CASE ("friction: however the normal trembles, a tool that is held in place keeps its force and costs nothing", "[nodes][friction][energy]")
{
    tactus::test::property ("any tremor of up to 19 degrees and any direction of the stretch", [] {
        std::mt19937 random (*rc::gen::arbitrary<unsigned>());
        std::uniform_real_distribution<double> uniform;
        std::normal_distribution<double> gauss;
        ElastoPlastic node;
        node.params.load = uniform (random) < 0.5 ? Load::bound : Load::passive;
        const Vec3 start = Vec3 { gauss (random), gauss (random), gauss (random) }.normalized();
        const double turn = 2.0 * M_PI * uniform (random);
        node.tick ({ .normal = start });
        const Vec3 p = 2e-5 * Vec3 { std::cos (turn), std::sin (turn), 0.0 };
        const Outputs held = node.tick ({ .position = p, .normal = start });
        for (int k = 0; k < 2000; ++k)
        {
            const Vec3 tilt = Vec3 { uniform (random), uniform (random), uniform (random) } - Vec3::Constant (0.5);
            const Vec3 n = start + 0.4 * tilt;
            const auto out = node.tick ({ .position = p, .normal = uniform (random) < 0.1 ? Vec3 { -n } : n });
            RC_ASSERT (std::abs (out.deflection.norm() - held.deflection.norm()) < 1e-19);
            RC_ASSERT (std::abs (out.force.dot (n)) < 1e-15);
            RC_ASSERT (out.stored_energy == held.stored_energy);
            RC_ASSERT (out.dissipated_energy == 0.0);
            RC_ASSERT (out.state == 1.0);
        }
        RC_ASSERT (node.tick ({ .position = p, .normal = start }).force == held.force);
    });
}

TEST_CASE ("friction: under a trembling normal, a tool that leans with a constant force walks no further than the header says", "[nodes][friction]")
{
    for (const bool cone : { false, true })
        for (const double frequency : { 1.0, 10.0, 30.0 })
            for (const double rate : { 1000.0, 20'000.0 })
            {
                const double angle = (frequency == 10.0 ? 10.0 : 5.0) * degree;
                const Lean lean { .tremor = { .angle = angle, .frequency = frequency, .cone = cone }, .rate = rate, .seconds = rate > 1000.0 ? 21.0 : 60.0 };
                const double cycles = frequency * (lean.seconds - 11.0), stretch = 2e-5;
                INFO (frequency << " Hz at " << rate << " Hz, " << (cone ? "on a cone" : "about one axis"));
                CHECK (lean.walk() < 2.0 * stretch * std::pow (angle, 4.0) * cycles);
            }
}

TEST_CASE ("friction: if the stretch were projected on the plane of each sample, the contact would walk", "[nodes][friction]")
{
    for (const double rate : { 1000.0, 20'000.0 })
    {
        const Lean lean { .tremor = { .cone = true }, .rate = rate, .seconds = 21.0 };
        Projected projected;
        const double walk = lean.walkOn ([&] (const Vec3& p, const Vec3& n) { return projected.force (p, n); });
        CHECK (walk / 10.0 == Approx (4.8e-6).epsilon (0.02));
        CHECK (lean.walk() / 10.0 < 0.03e-6);

        Projected held;
        const Vec3 p { 2e-5, 0.0, 0.0 };
        const double before = held.force (p, Vec3::UnitZ()).norm();
        double after = 0.0;
        for (int k = 0; k < 60 * static_cast<int> (rate); ++k)
            after = held.force (p, Tremor {}.normal (k / rate)).norm();
        CHECK (after / before == Approx (rate > 1000.0 ? 0.98 : 0.64).epsilon (0.01));
    }
}

TEST_CASE ("friction: a normal that jumps takes the stretch along by the smallest turn of the plane", "[nodes][friction]")
{
    ElastoPlastic node;
    node.tick ({});
    const auto pulled = node.tick ({ .position = { 3e-5, 4e-5, 0 } });
    const auto at = [&] (const Vec3& normal) { return node.tick ({ .position = { 3e-5, 4e-5, 0 }, .normal = normal }).deflection; };
    const auto meets = [] (const Vec3& a, const Vec3& b) { return (a - b).norm() < 1e-18; };
    CHECK (meets (at ({ 1, 0, 0 }), { 0, 4e-5, -3e-5 }));
    CHECK (meets (at ({ 0, 0, 1 }), pulled.deflection));
    CHECK (at ({ 0, 0, -1 }) == pulled.deflection);
    // A normal that goes around a corner of a cube turns from face to face: the stretch comes back turned by a right angle.
    at ({ 1, 0, 0 });
    at ({ 0, 1, 0 });
    CHECK (meets (at ({ 0, 0, 1 }), { -4e-5, 3e-5, 0 }));
}

TEST_CASE ("friction: a held contact walks by pi angle a in each cycle in which the tool also moves along the normal by a", "[nodes][friction]")
{
    // Along a step dp, the plane sees only dp - n (n . dp). Around a cycle of n and p, what is left out along the normal adds up to
    // the integral of n dz: an ellipse with the half axes sin (angle) and a, if the tool is in the middle while the normal leans most.
    constexpr int per_cycle = 400, cycles = 10;
    for (const auto& [angle, a] : { std::pair { 5.0 * degree, 8e-6 }, std::pair { 5.0 * degree, -8e-6 }, std::pair { 2.0 * degree, 3e-6 } })
    {
        ElastoPlastic node;
        node.params = { .mu = 0.5, .d_max = 1e-4 };
        double work = 0.0;   // J: of the hand, along straight lines between samples
        Vec3 p = Vec3::Zero();
        Outputs out, first;
        for (int k = 0; k <= cycles * per_cycle; ++k)
        {
            const double phase = 2.0 * M_PI * k / per_cycle;
            const Vec3 to { 2e-5, 0.0, a * std::cos (phase) };
            const auto before = out;
            out = node.tick (
                { .position = to,
                  .normal = { std::sin (angle) * std::sin (phase), 0.0, std::sqrt (1.0 - std::pow (std::sin (angle) * std::sin (phase), 2)) } });
            REQUIRE (out.state == 1.0);
            if (k > 0) work -= 0.5 * (before.force + out.force).dot (to - p);
            if (k == 0) first = out;
            p = to;
        }
        const double walk = first.deflection.x() - out.deflection.x();   // of the contact point, forwards
        INFO (angle / degree << " degrees, " << a << " m");
        CHECK (walk == Approx (-cycles * M_PI * std::sin (angle) * a).epsilon (0.01));
        CHECK (std::abs (walk / cycles) * 10.0 == Approx (std::abs (a) == 8e-6 ? 21.9e-6 : 3.29e-6).epsilon (0.01));   // m/s at 10 Hz
        CHECK (out.dissipated_energy == 0.0);
        CHECK (out.stored_energy - first.stored_energy == Approx (work).epsilon (0.02));   // what moves the contact is the work of the hand
    }
}

TEST_CASE ("friction: with the normal of the mean surface, a tool may move along it as it likes: a held contact does not walk", "[nodes][friction]")
{
    ElastoPlastic node;
    node.params = { .mu = 0.5, .d_max = 1e-4 };
    node.tick ({});
    const auto held = node.tick ({ .position = { 2e-5, 1e-5, 0.0 } });
    for (int k = 0; k < 4000; ++k)
        REQUIRE (node.tick ({ .position = { 2e-5, 1e-5, 1e-3 * std::sin (0.1 * k) } }).deflection == held.deflection);
}
