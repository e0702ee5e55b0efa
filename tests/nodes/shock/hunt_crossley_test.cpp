// SPDX-License-Identifier: MIT
#include <tactus/nodes/shock/hunt_crossley.hpp>

#include <golden/golden.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using tactus::Law;
using tactus::nodes::HuntCrossley;
using tactus::test::Golden;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Law power (double k, double n) { return { .kind = Law::Kind::power, .a = k, .b = n }; }
Law dissipation (double lambda) { return { .kind = Law::Kind::dissipation, .a = lambda }; }
Law table (std::vector<double> d, std::vector<double> f) { return { .kind = Law::Kind::table, .table = { std::move (d), std::move (f) } }; }

HuntCrossley shock (const HuntCrossley::Settings& settings = {}, double rate_hz = 4000.0, const HuntCrossley::Params& params = {})
{
    HuntCrossley node;
    node.params = params;
    node.settings = settings;
    node.prepare ({ .rate_hz = rate_hz });
    return node;
}

/// Lambert's W0 between -1/e and 0, where it is the root w of w e^w = y between -1 and 0.
double lambert (double y)
{
    double low = -1.0, high = 0.0;
    for (int i = 0; i < 200; ++i)
    {
        const double w = 0.5 * (low + high);
        (w * std::exp (w) < y ? low : high) = w;
    }
    return 0.5 * (low + high);
}

double restitution (double x) { return (1.0 + lambert (-(1.0 + x) * std::exp (-(1.0 + x)))) / x; }

class Dice
{
public:
    explicit Dice (unsigned seed) : random (seed) {}

    double uniform (double from, double to) { return std::uniform_real_distribution { from, to }(random); }
    double size (double from, double to) { return std::exp (uniform (std::log (from), std::log (to))); }
    int below (int n) { return std::uniform_int_distribution { 0, n - 1 }(random); }

private:
    std::mt19937 random;
};

/// The effect of one hit, computed from its force alone.
struct Impact
{
    double impulse = 0.0;      // N s
    double loop = 0.0;         // J, the area of the loop of force against depth
    double peak = 0.0;         // N
    double dissipated = 0.0;   // J, from the output of the node
    int samples = 0;
};

Impact strike (HuntCrossley node, double v, double dt)
{
    Impact impact;
    const double m = node.params.mass;
    double before = node.tick ({ .hit = v }).resistance, speed = v;
    do
    {
        const auto out = node.tick ({});
        const double now = out.resistance, push = 0.5 * (before + now) * dt;
        impact.dissipated = out.dissipated_energy;
        impact.impulse += push;
        impact.loop += push * (speed - 0.5 * push / m);
        impact.peak = std::max (impact.peak, now);
        ++impact.samples;
        speed -= push / m;
        before = now;
    } while (before != 0.0 && impact.samples < 1'000'000);
    return impact;
}
}   // namespace

TEST_CASE ("shock: it matches the golden columns", "[nodes][shock][golden]")
{
    const Golden golden ("shock");
    const HuntCrossley::Settings settings {
        .stiffness = power (golden.param ("k0"), golden.param ("n")),
        .damping = power (golden.param ("B0"), golden.param ("q")),
        .substeps = int (golden.param ("S")),
        .voices = int (golden.param ("voices")),
    };
    auto node = shock (settings, 1.0 / golden.dt_s(), { .mass = golden.param ("m") });
    std::vector<double> f;
    double peak = 0.0, off = 0.0;
    for (std::size_t i = 0; i < golden.rows(); ++i)
    {
        f.push_back (node.tick ({ .hit = golden (i, "trigger_v") }).resistance);
        peak = std::max (peak, golden (i, "f_exact"));
        off = std::max (off, std::abs (f[i] - golden (i, "f_exact")));
    }
    CHECK (golden.worst ("f_semi_implicit", [&] (std::size_t i) { return f[i]; })
           <= 1.0);
    INFO ("off by " << off / peak << " of the peak");
    CHECK (off <= 0.003 * peak);   // the golden set allows 0.01
}

TEST_CASE ("shock: the closed form of restitution has its known values", "[nodes][shock]")
{
    CHECK (restitution (0.15) == Approx (0.909016).epsilon (1e-6));
    CHECK (restitution (1.0) == Approx (0.593624).epsilon (1e-6));
    CHECK (restitution (5.0) == Approx (0.196980).epsilon (1e-5));
    CHECK (restitution (1e-3) == Approx (1.0 - 2e-3 / 3.0).epsilon (1e-6));
}

TEST_CASE ("shock: restitution, impulse and loop area follow Hunt and Crossley, whatever mass, stiffness and power", "[nodes][shock][energy]")
{
    tactus::test::property ("with a dissipation, or with the same as a law", [] (unsigned seed) {
        Dice dice { seed };
        const double m = dice.size (0.005, 0.5), v = dice.size (0.02, 2.0), d_max = dice.size (1e-4, 5e-3), n = dice.uniform (1.0, 2.5);
        const double k = 0.5 * (n + 1.0) * m * v * v / std::pow (d_max, n + 1.0), x = dice.size (0.01, 5.0), e = restitution (x);
        const double rate = 2000.0 * v / d_max;

        const Law damping = dice.below (2) == 0 ? dissipation (x / v) : power (k * x / v, n);
        const auto impact = strike (shock ({ .stiffness = power (k, n), .damping = damping }, rate, { .mass = m }), v, 1.0 / rate);
        RC_ASSERT (std::abs (impact.impulse / (m * v) - (1.0 + e)) <= 1e-3);
        RC_ASSERT (std::abs (impact.loop / (0.5 * m * v * v) - (1.0 - e * e)) <= 1e-3);
        RC_ASSERT (std::abs (impact.dissipated / (0.5 * m * v * v) - (1.0 - e * e)) <= 1e-3);
    });
}

TEST_CASE ("shock: without damping the mass returns at its initial speed", "[nodes][shock][energy]")
{
    const double k = 5e5, m = 0.05, v = 0.5, d_max = std::pow (2.5 * m * v * v / (2.0 * k), 1.0 / 2.5), rate = 400'000.0;
    const auto impact = strike (shock ({ .stiffness = power (k, 1.5), .damping = dissipation (0.0) }, rate), v, 1.0 / rate);
    CHECK (impact.impulse == Approx (2.0 * m * v).epsilon (1e-4));
    CHECK (impact.loop == Approx (0.0).margin (1e-4 * m * v * v));
    CHECK (impact.dissipated == 0.0);
    CHECK (impact.samples / rate == Approx (2.943275 * d_max / v).epsilon (2e-3));   // Hertz's duration of contact
    CHECK (impact.peak == Approx (k * std::pow (d_max, 1.5)).epsilon (1e-3));
}

TEST_CASE ("shock: a contact shorter than a tick still gives its impulse and takes its energy", "[nodes][shock][energy]")
{
    tactus::test::property ("any law, mass, speed and rate at which it lasts fewer than four samples", [] (unsigned seed) {
        Dice dice { seed };
        const double m = dice.size (0.005, 0.5), v = dice.size (0.02, 2.0), d_max = dice.size (1e-4, 5e-3), n = dice.uniform (1.0, 2.5);
        const double k = 0.5 * (n + 1.0) * m * v * v / std::pow (d_max, n + 1.0), x = dice.size (0.01, 3.0), e = restitution (x);
        const double rate = dice.size (1e-4, 0.8) * v / d_max;   // the contact lasts two to five times d_max / v

        auto node = shock ({ .stiffness = power (k, n), .damping = dissipation (x / v) }, rate, { .mass = m });
        RC_ASSERT (node.tick ({ .hit = v }).resistance == 0.0);
        double impulse = 0.0, dissipated = 0.0;
        int samples = 0;
        for (int i = 0; i < 10; ++i)
        {
            const auto out = node.tick ({});
            RC_ASSERT (out.resistance >= 0.0);
            RC_ASSERT (out.dissipated_energy >= dissipated);
            dissipated = out.dissipated_energy;
            impulse += out.resistance / rate;
            samples += out.resistance > 0.0;
        }
        RC_ASSERT (samples >= 1);
        RC_ASSERT (samples <= 5);
        const double tolerance = samples <= 4 ? 1e-3 : 0.05;   // a contact of four samples or more plays samples of the force itself
        RC_ASSERT (std::abs (impulse / (m * v * (1.0 + e)) - 1.0) <= tolerance);
        RC_ASSERT (std::abs (dissipated / (0.5 * m * v * v) - (1.0 - e * e)) <= tolerance);
    });
}

TEST_CASE ("shock: the impulse is right at any rate", "[nodes][shock]")
{
    const double m = 0.05, v = 0.3, e = 0.832868868;   // e: restitution of the default law, where x = 0.3
    for (double rate = 10.0; rate < 50'000.0; rate *= 1.07)
    {
        auto node = shock ({}, rate);
        node.tick ({ .hit = v });
        double impulse = 0.0;
        for (int k = 0; k < int (0.02 * rate) + 4; ++k)
            impulse += node.tick ({}).resistance / rate;
        INFO (rate << " Hz");
        const double samples = 0.006628937 * rate;
        CHECK (impulse == Approx (m * v * (1.0 + e)).epsilon (samples < 4.0 ? 1e-4 : 0.02));
    }
}

TEST_CASE ("shock: the dissipated energy adds up over hits, never falls, and ignores the gain", "[nodes][shock][energy]")
{
    tactus::test::property ("any hits", [] (unsigned seed) {
        Dice dice { seed };
        const HuntCrossley::Settings settings { .damping = dissipation (dice.size (1e-3, 3.0)), .voices = 16 };
        const double rate = dice.size (200.0, 20'000.0);
        auto node = shock (settings, rate), loud = shock (settings, rate, { .gain = -3.0 });
        double last = 0.0, alone = 0.0;
        for (int k = 0; k < 2000; ++k)
        {
            const double hit = k < 1500 && dice.below (200) == 0 ? dice.size (0.01, 2.0) : 0.0;
            if (hit > 0.0) alone += strike (shock (settings, rate), hit, 1.0 / rate).dissipated;
            const double now = node.tick ({ .hit = hit }).dissipated_energy;
            RC_ASSERT (now >= last);
            RC_ASSERT (loud.tick ({ .hit = hit }).dissipated_energy == now);
            last = now;
        }
        RC_ASSERT (std::abs (last - alone) <= 1e-9 * alone);
    });
}

TEST_CASE ("shock: a mass of 0 means that of the device, or 50 g if that is unknown", "[nodes][shock]")
{
    const auto push = [] (double mass, double of_device) {
        auto node = shock ({}, 4000.0, { .mass = mass });
        node.learn ({ .mass = of_device });
        node.tick ({ .hit = 0.5 });
        for (int k = 0; k < 9; ++k)
            node.tick ({});
        return node.tick ({}).resistance;
    };
    CHECK (push (0.0, 0.2) == push (0.2, 0.0));
    CHECK (push (0.0, 0.2) != push (0.0, 0.0));
    CHECK (push (0.0, 0.0) == push (0.05, 0.0));
    CHECK (push (0.03, 0.2) == push (0.03, 0.0));   // the mass of the node takes precedence over that of the device

    auto node = shock ({}, 4000.0, { .mass = 0.0 });
    CHECK (node.warning ({ .rate_hz = 4000.0 })
           == "mass is 0, which means the mass of the device, but the graph does not give it; set mass, or 0.05 kg is used until a device gives its mass");
    node.learn ({ .mass = 0.08 });
    CHECK (node.warning ({ .rate_hz = 4000.0 }) == "");
}

TEST_CASE ("shock: a hit starts and ends at exactly 0, and never pulls", "[nodes][shock]")
{
    tactus::test::property ("any speed, mass, rate and damping", [] (unsigned seed) {
        Dice dice { seed };
        auto node = shock ({ .damping = dissipation (dice.size (1e-3, 10.0)) }, dice.size (1000.0, 50'000.0), { .mass = dice.size (1e-3, 1.0) });
        RC_ASSERT (node.tick ({ .hit = dice.size (1e-3, 10.0) }).resistance == 0.0);
        for (int k = 0; k < 10'000; ++k)
            RC_ASSERT (node.tick ({}).resistance >= 0.0);
        for (int k = 0; k < 100; ++k)
            RC_ASSERT (node.tick ({}).resistance == 0.0);
    });
}

TEST_CASE ("shock: hits add up exactly, and none causes a step in another", "[nodes][shock]")
{
    auto first = shock(), second = shock(), both = shock();
    for (int k = 0; k < 100; ++k)
    {
        const double a = k == 3 ? 0.4 : 0.0, b = k == 9 ? 0.9 : 0.0;
        const double sum = first.tick ({ .hit = a }).resistance + second.tick ({ .hit = b }).resistance;
        CHECK (both.tick ({ .hit = a + b }).resistance == sum);
    }
}

TEST_CASE ("shock: without a free voice a new hit is dropped, and no voice is cut short", "[nodes][shock]")
{
    auto node = shock ({ .voices = 2 }), undisturbed = shock ({ .voices = 2 });
    for (int k = 0; k < 200; ++k)
    {
        const double hit = k == 3 || k == 5 || k == 120 ? 0.5 : 0.0, dropped = k == 7 || k == 8 ? 2.0 : 0.0;
        const double out = undisturbed.tick ({ .hit = hit }).resistance;
        CHECK (node.tick ({ .hit = hit + dropped }).resistance == out);
        if (k == 119) CHECK (out == 0.0);
        if (k == 121) CHECK (out > 0.0);   // the voices are free again
    }
}

TEST_CASE ("shock: an input that is not a hit is ignored, and the shock continues", "[nodes][shock]")
{
    auto node = shock(), undisturbed = shock();
    node.tick ({ .hit = 1.0 });
    undisturbed.tick ({ .hit = 1.0 });
    for (const double v : { -1.0, 0.0, not_a_number, tactus::inf, -tactus::inf })
        CHECK (node.tick ({ .hit = v }).resistance == undisturbed.tick ({}).resistance);
}

TEST_CASE ("shock: the mass is read on the hit, the gain on every tick", "[nodes][shock]")
{
    auto node = shock(), undisturbed = shock();
    node.tick ({ .hit = 0.5 });
    undisturbed.tick ({ .hit = 0.5 });
    node.params = { .mass = 1.0, .gain = 3.0 };
    for (int k = 0; k < 50; ++k)
        CHECK (node.tick ({}).resistance == 3.0 * undisturbed.tick ({}).resistance);
}

TEST_CASE ("shock: any hit gives a finite force and ends", "[nodes][shock]")
{
    for (const double v : { 5e-324, 1e-300, 1e-9, 1e3, 1e9, 1e150, 1e300, 1.7e308 })
        for (const Law& damping : { dissipation (0.0), dissipation (1e6), power (1e6, 0.1), power (1e300, 1.0) })
        {
            auto node = shock ({ .damping = damping, .voices = 1 });
            node.tick ({ .hit = v });
            double out = 1.0;
            for (int k = 0; k < 4000; ++k)
            {
                out = node.tick ({}).resistance;
                REQUIRE (std::isfinite (out));
            }
            INFO (v << " " << damping.a);
            CHECK (out == 0.0);
        }

    // Damping stops the mass before the spring can.
    auto stopped = shock ({ .stiffness = table ({ 1.0, 2.0 }, { 0.0, 1.0 }), .damping = power (1e6, 1.0), .voices = 1 });
    stopped.tick ({ .hit = 1.0 });
    for (int k = 0; k < 40'000; ++k)
        stopped.tick ({});
    stopped.tick ({ .hit = 1.0 });
    CHECK (stopped.tick ({}).resistance > 0.0);
}

TEST_CASE ("shock: an instance replaced while it sounds keeps sounding", "[nodes][shock]")
{
    auto old = shock(), undisturbed = shock();
    for (int k = 0; k < 12; ++k)
    {
        old.tick ({ .hit = k % 5 == 0 ? 0.5 : 0.0 });
        undisturbed.tick ({ .hit = k % 5 == 0 ? 0.5 : 0.0 });
    }
    auto next = shock ({ .voices = 8 });
    next.adopt (old);
    for (int k = 0; k < 50; ++k)
        CHECK (next.tick ({}).resistance == undisturbed.tick ({}).resistance);
}

TEST_CASE ("shock: a law that is not a spring or not a damper, and a contact that is too short, are reported", "[nodes][shock]")
{
    const auto problem = [] (const Law& stiffness, const Law& damping) { return shock ({ .stiffness = stiffness, .damping = damping }).problem(); };
    const std::string no_spring = "stiffness must give a force above 0 at some depth, and must not fall with depth";
    CHECK (shock().problem() == "");
    CHECK (problem (power (0.0, 1.0), dissipation (1.0)) == no_spring);
    CHECK (problem (dissipation (1.0), dissipation (1.0)) == no_spring);
    CHECK (problem (table ({ 1e-3, 2e-3 }, { 2.0, 1.0 }), dissipation (1.0)) == no_spring);
    CHECK (problem (power (1e4, 1.0), table ({ 1e-3 }, { -1.0 })) == "damping must not be negative, nor fall with depth");

    CHECK (shock().warning ({ .rate_hz = 1000.0 }) == "");
    CHECK (shock().warning ({ .rate_hz = 500.0 }) == "a hit of 1 m/s lasts 2.8 samples, fewer than 4; use a softer law, a larger mass or a higher rate");
    CHECK (shock ({ .stiffness = power (1e9, 1.0) }).warning ({ .rate_hz = 4000.0 }) != "");
}
