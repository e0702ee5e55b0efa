// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/model/with_prefix.hpp>
#include <host/app/scopes/energy_meter.hpp>

#include "made_trace.hpp"

#include "support/rig.hpp"

#include <rapidcheck.h>

#include <cmath>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// The traces of a tool that is moved along a path, and of a force on it.
struct Recorded
{
    std::vector<std::shared_ptr<Trace>> position, applied;
    std::shared_ptr<Trace> stored = emptyTrace ("n.stored_energy", 4000.0), dissipated = emptyTrace ("n.dissipated_energy", 4000.0);
    std::uint64_t tick = 0;
    Vec3 held = Vec3::Zero();   // the force since the last tick

    Recorded()
    {
        for (const char* c : { "x", "y", "z" })
        {
            position.push_back (emptyTrace (std::string ("p.") + c, 4000.0));
            applied.push_back (emptyTrace (std::string ("f.") + c, 4000.0));
        }
    }

    void add (const Vec3& p, const Vec3& force_from_now, double in, double lost)
    {
        for (int i = 0; i < 3; ++i)
        {
            position[static_cast<std::size_t> (i)]->add (tick, p[i]);
            applied[static_cast<std::size_t> (i)]->add (tick, held[i]);
        }
        stored->add (tick, in);
        dissipated->add (tick, lost);
        held = force_from_now;
        ++tick;
    }

    EnergyMeter::Sources sources() const { return { { position.begin(), position.end() }, { applied.begin(), applied.end() }, { stored }, { dissipated } }; }
};

void rub (Recorded& r, Rig& node, int ticks)
{
    for (int k = 0; k < ticks; ++k)
    {
        const double t = static_cast<double> (r.tick) / 4000.0;
        const Vec3 p (0.02 * std::sin (6.0 * t), 0.007 * std::sin (9.0 * t), 0.0);
        node.input ("position", p).input ("normal_force", 1.0).tick();
        r.add (p, node.vector ("force"), node.out ("stored_energy"), node.out ("dissipated_energy"));
    }
}

Rig bristle()
{
    Rig node { "friction.elasto_plastic" };
    node.param ("d_max", 2e-3).prepare();
    return node;
}

/// A friction that is rubbed for 2 s, and its balance.
struct Rubbed
{
    Recorded r;
    Rig node = bristle();
    EnergyMeter meter;

    Rubbed() { more (8000); }

    void more (int ticks)
    {
        rub (r, node, ticks);
        meter.follow (r.sources());
    }
};
}   // namespace

TEST_CASE ("scopes: the work of the hand on friction is stored or dissipated, except for the leak of the held force", "[app][scopes]")
{
    const Rubbed rubbed;
    const auto& b = rubbed.meter.balance();
    CHECK (b.dissipated > 0.02);
    CHECK (b.dissipated == rubbed.r.dissipated->at (7999));
    CHECK (std::abs (b.elsewhere()) < 1e-4 * b.work);
    CHECK (b.isPassive());
    CHECK (describe (b).starts_with ("passive"));
}

TEST_CASE ("scopes: the energy created by holding a spring force is half the stiffness times the sum of the squared steps", "[app][scopes]")
{
    constexpr double stiffness = 500.0;
    Recorded r;
    double expected = 0.0, before = 0.0;
    for (int k = 0; k < 4000; ++k)
    {
        const double x = 0.01 * std::sin (0.07 * k);
        if (k > 0 && k < 3999) expected += 0.5 * stiffness * (x - before) * (x - before);   // not known yet for the last step
        before = x;
        r.add (Vec3 (x, 0, 0), Vec3 (-stiffness * x, 0, 0), 0.5 * stiffness * x * x, 0.0);
    }
    EnergyMeter meter;
    meter.follow (r.sources());
    CHECK (meter.balance().held == Approx (expected));
    CHECK (std::abs (meter.balance().elsewhere()) < 1e-3 * expected);
    CHECK_FALSE (meter.balance().isPassive());   // a bare sampled spring generates energy
}

TEST_CASE ("scopes: with a delay of the device, the work is that of the forces that act, and a spring gives more energy than it got", "[app][scopes]")
{
    constexpr double stiffness = 500.0;
    for (const double late : { 0.0, 1.0, 1.5, 3.0 })
    {
        Recorded r;
        std::vector<double> x;
        for (int k = 0; k < 4000; ++k)
        {
            x.push_back (0.01 * std::sin (0.07 * k));
            r.add (Vec3 (x.back(), 0, 0), Vec3 (-stiffness * x.back(), 0, 0), 0.5 * stiffness * x.back() * x.back(), 0.0);
        }
        double work = 0.0;   // the force of the step before acts `late` ticks later
        const auto whole = static_cast<std::size_t> (late);
        for (std::size_t k = 5; k < x.size(); ++k)
        {
            const double at = x[k - 1 - whole] + (late - std::floor (late)) * (x[k - 2 - whole] - x[k - 1 - whole]);
            work += stiffness * at * (x[k] - x[k - 1]);
        }
        EnergyMeter meter;
        auto sources = r.sources();
        sources.late = late;
        meter.follow (sources);
        const auto& b = meter.balance();
        INFO (late << ": " << describe (b));
        CHECK (b.work == Approx (work).margin (2e-3));   // but for the first steps
        CHECK (std::abs (b.elsewhere()) < 0.01 * b.held);
        CHECK_FALSE (b.isPassive());
        CHECK ((describe (b).find ("the delay of the device and holding") != std::string::npos) == (late > 0.0));
    }
}

TEST_CASE ("scopes: what nodes report beyond the work of the hand is not blamed on one cause", "[app][scopes]")
{
    Recorded r;
    for (int k = 0; k < 4000; ++k)   // a mixer lets half of a damper's force through
        r.add (Vec3 (1e-5 * k, 0, 0), Vec3 (-0.5, 0, 0), 0.0, 1e-5 * k);
    EnergyMeter meter;
    meter.follow (r.sources());
    CHECK (meter.balance().elsewhere() == Approx (-0.02).epsilon (1e-3));
    const auto said = describe (meter.balance());
    INFO (said);
    CHECK (said.find ("more than the hand gave: their force was turned down, as by a mixer, limited or faded, or ") != std::string::npos);
}

TEST_CASE ("scopes: the energy sum does not depend on how the ticks are batched", "[app][scopes]")
{
    Recorded at_once, in_parts;
    auto a = bristle(), b = bristle();
    rub (at_once, a, 6000);
    EnergyMeter whole, parts;
    whole.follow (at_once.sources());
    while (in_parts.tick < 6000)
    {
        rub (in_parts, b, static_cast<int> (std::min<std::uint64_t> (137, 6000 - in_parts.tick)));
        parts.follow (in_parts.sources());
    }
    CHECK (parts.balance().work == whole.balance().work);
    CHECK (parts.traces()[0]->at (5999) == whole.balance().work);
    CHECK (parts.balance().gaps == 0);
}

TEST_CASE ("scopes: a force along the motion of the tool is reported as active, with the energy that came out", "[app][scopes]")
{
    Recorded r;
    for (int k = 0; k <= 100; ++k)
        r.add (Vec3 (1e-3 * k, 0, 0), Vec3 (0.5, 0, 0), 0.0, 0.0);   // 0.5 N over 0.1 m
    EnergyMeter meter;
    meter.follow (r.sources());
    CHECK (meter.balance().work == Approx (-0.05));
    CHECK_FALSE (meter.balance().isPassive());
    const auto said = describe (meter.balance());
    INFO (said);
    CHECK (said.starts_with ("active over "));
    CHECK (said.find (", without the damping of the device: at one moment, 50\u00a0mJ more had come out than had gone in; ") != std::string::npos);
    CHECK (said.find ("; by now, work of the hand -50\u00a0mJ") != std::string::npos);
}

TEST_CASE ("scopes: a preloaded spring may give back the energy that it stores, but no more", "[app][scopes]")
{
    const auto let_out = [] (double held) {
        Recorded r;
        for (int k = 0; k <= 1000; ++k)
            r.add (Vec3 (1e-4 * k, 0, 0), Vec3 (1.0, 0, 0), held * (1.0 - k / 1000.0), 0.0);   // gives 0.1 J
        EnergyMeter meter;
        meter.follow (r.sources());
        return meter.balance().isPassive();
    };
    CHECK (let_out (0.1001));
    CHECK_FALSE (let_out (0.09));
}

TEST_CASE ("scopes: across missed ticks the work is estimated, and the gaps are counted", "[app][scopes]")
{
    Recorded r;
    for (int k = 0; k <= 100; ++k)
    {
        const bool is_lost = k > 40 && k <= 50;
        if (is_lost)
            ++r.tick;
        else
            r.add (Vec3 (1e-3 * k, 0, 0), Vec3 (-2.0, 0, 0), 0.0, 0.0);
    }
    EnergyMeter meter;
    meter.follow (r.sources());
    CHECK (meter.balance().work == Approx (0.2));
    CHECK (meter.balance().gaps == 10);
}

TEST_CASE ("scopes: a reset counts from now on, and says over what time", "[app][scopes]")
{
    Rubbed rubbed;
    auto& meter = rubbed.meter;
    const auto& heat = *rubbed.r.dissipated;
    CHECK (describe (meter.balance()).starts_with ("passive over 2.0\u00a0s: "));
    meter.restart();
    rubbed.more (0);
    CHECK (meter.balance().work == 0.0);
    CHECK (meter.balance().dissipated == 0.0);
    rubbed.more (4000);
    CHECK (meter.balance().dissipated == Approx (heat.at (11'999) - heat.at (8000)));
    CHECK (meter.balance().dissipated < 0.75 * heat.at (7999));
    CHECK (describe (meter.balance()).starts_with ("passive over 1.0\u00a0s: "));
}

TEST_CASE ("scopes: what a node has dissipated stays in the sum while it is bypassed, and after that", "[app][scopes]")
{
    Rubbed rubbed;
    auto& meter = rubbed.meter;
    const bool is_reset = GENERATE (false, true);
    if (is_reset)
    {
        meter.restart();
        rubbed.more (0);
    }
    rubbed.more (4000);
    const auto before = meter.balance();
    const Vec3 rest (rubbed.r.position[0]->at (11'999), rubbed.r.position[1]->at (11'999), 0.0);
    for (int k = 0; k < 400; ++k)
        rubbed.r.add (rest, Vec3::Zero(), 0.0, 0.0);
    rubbed.more (0);
    CHECK (meter.balance().dissipated == Approx (before.dissipated));
    CHECK (meter.balance().elsewhere() == Approx (before.stored).margin (0.01 * before.moved));   // a bypassed node loses what it stored

    auto again = bristle();   // without the bypass, the node starts from zero
    rub (rubbed.r, again, 4000);
    rubbed.more (0);
    CHECK (meter.balance().dissipated == Approx (before.dissipated + rubbed.r.dissipated->at (16'399)));
    CHECK (meter.balance().elsewhere() == Approx (before.stored).margin (0.01 * before.moved));
}

TEST_CASE ("scopes: the balance goes on when an edit adds or removes a node", "[app][scopes]")
{
    Rubbed rubbed;
    auto& meter = rubbed.meter;
    const auto before = meter.balance();
    const auto follow = [&] (const TraceList& dissipated) {
        auto sources = rubbed.r.sources();
        sources.dissipated = dissipated;
        meter.follow (sources);
    };
    const auto another = traceOf (std::vector<double> (12'000, 7.0), 0, 4000.0);   // has dissipated 7 J before it is seen
    follow ({ rubbed.r.dissipated, another });
    rub (rubbed.r, rubbed.node, 2000);
    follow ({ rubbed.r.dissipated, another });
    CHECK (meter.balance().dissipated == Approx (rubbed.r.dissipated->at (9999)));
    CHECK (meter.balance().work > before.work);
    rub (rubbed.r, rubbed.node, 400);   // not read before the node goes
    follow ({ another });
    CHECK (meter.balance().dissipated == Approx (rubbed.r.dissipated->at (10'399)));
    follow ({});
    CHECK (meter.balance().dissipated == Approx (rubbed.r.dissipated->at (10'399)));
    CHECK (describe (meter.balance()).starts_with ("passive over 2.6\u00a0s: "));
}

TEST_CASE ("scopes: the energy of a run that begins again in the same traces counts from its first tick", "[app][scopes]")
{
    Rubbed rubbed;
    rubbed.r.tick = 0;   // as after STOP and START
    rubbed.more (400);
    CHECK (describe (rubbed.meter.balance()).starts_with ("passive over 0.1\u00a0s: "));
    CHECK (rubbed.meter.balance().dissipated == Approx (rubbed.r.dissipated->at (399) - rubbed.r.dissipated->at (0)));
}

TEST_CASE ("scopes: a new run restarts the energy balance", "[app][scopes]")
{
    EnergyMeter meter;
    for (int run = 0; run < 2; ++run)
    {
        Recorded r;
        for (int k = 0; k <= 100; ++k)
            r.add (Vec3 (1e-3 * k, 0, 0), Vec3 (-1.0, 0, 0), 0.0, 7.0);   // 7 J were dissipated before
        meter.follow (r.sources());
        CHECK (meter.balance().work == Approx (0.1));
        CHECK (meter.balance().dissipated == 0.0);
    }
}

TEST_CASE ("scopes: numbers are short, with a prefix if the unit takes one", "[app][scopes]")
{
    CHECK (withPrefix (0.0031, "J") == "3.10 mJ");
    CHECK (withPrefix (0.0031, "J", 2) == "3.1 mJ");
    CHECK (withPrefix (-0.42, "N") == "-420 mN");
    CHECK (withPrefix (12.3456, "N") == "12.3 N");
    CHECK (withPrefix (1234.0, "Hz") == "1.23 kHz");
    CHECK (withPrefix (0.5, "1") == "0.50");
    CHECK (withPrefix (4e-4, "m") == "400 \u00b5m");
    CHECK (withPrefix (0.0, "N", 2) == "0.0 N");
    CHECK (withPrefix (2500.0, "N/m") == "2500 N/m");
}

TEST_CASE ("any number can be written in few characters", "[app][scopes]")
{
    CHECK (withPrefix (0.00012, "m", 2) == "120 µm");
    CHECK (withPrefix (std::numeric_limits<double>::infinity(), "J") == "inf");
    CHECK (withPrefix (-std::numeric_limits<double>::infinity(), "N/m") == "-inf");
    CHECK (withPrefix (std::numeric_limits<double>::quiet_NaN(), "1") == "nan");
    CHECK (withPrefix (-1.25e300, "1") == "-1.25e+300");
    CHECK (withPrefix (std::numeric_limits<double>::denorm_min(), "1").size() < 12);
    EnergyBalance burst;
    burst.work = burst.worst = std::numeric_limits<double>::infinity();
    CHECK (describe (burst).find ("inf") != std::string::npos);
}
