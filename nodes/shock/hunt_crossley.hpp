// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// The push of a struck object: a mass runs into a damped spring and is thrown back.
///
///     N = max (0, K (d) + D (d) d')      while the mass is d > 0 deep, d' > 0 on its way in     (10)
///     m d'' = -N,  d = 0, d' = v         starting at a hit of speed v
///
/// K is `stiffness`, D `damping`, m `mass`. It is played on a hit rather than computed from the hand's position, so it is as hard
/// as the object, however slow the device. Hits add up; each has its own mass.
///
/// With D = lambda K, as in Hunt and Crossley, the mass leaves at e v,
///
///     e = (1 + W (-(1 + x) exp (-(1 + x)))) / x,   x = lambda v, W Lambert's function; 1 - 2 x / 3 for a small x
///
/// whatever its mass and the law. The impulse is m v (1 + e), and the energy m v^2 (1 - e^2) / 2, the area of the loop of force
/// against depth, is lost. `damping` is given as {"dissipation": lambda}, or as a separate law in N s/m.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 6, eq. (10); Hunt & Crossley 1975.
///
/// Departures from the printed chapter
///  - Eq. (10) is printed N = K - D d'. With d' positive into the object this creates energy: lambda v = 0.3 returns 1.25 v.
///  - The "initial value of d^z" is 0 at the first touch; the chapter means its rate.
///  - No adhesion: N is never negative. It would not become negative in a free impact.
///
/// Good to know
///  - The force is 0 on the tick of a hit, and at the end: no click. Within a sample the motion takes `substeps` steps of the
///    semi-implicit Euler rule; over a contact of 66 samples, 4 substeps are off by 0.13 % of the peak, 16 by 0.03 %.
///  - The steps are explicit: where h D / m approaches 1 (h: the length of a substep), the mass is thrown back too soon. Use more
///    substeps then.
///  - While all voices sound, a new hit is dropped; no voice is cut short.
///  - A contact of fewer than four samples is not accurate: `warning` reports it for a hit of 1 m/s. Harder hits are shorter:
///    with a stiffness k d^n, their duration is proportional to v^(-(n - 1) / (n + 1)).
///  - A hit whose speed is not positive or not finite is ignored. A quantised position makes the contact
///    flicker: use contact.impact.
///  - It gives the hand an impulse that the hand never put in: this node is not passive.
struct HuntCrossley
{
    struct Inputs
    {
        double hit = 0.0;
    };

    struct Params
    {
        double mass = 0.05;
        double gain = 1.0;
    };

    struct Settings
    {
        Law stiffness { .kind = Law::Kind::power, .a = 5e5, .b = 1.5 };
        Law damping { .kind = Law::Kind::dissipation, .a = 1.0 };
        int substeps = 8;
        int voices = 4;
    };

    struct Outputs
    {
        double resistance = 0.0;
    };

    static constexpr Info info {
        .id = "shock.hunt_crossley",
        .name = "Hunt-Crossley shock",
        .summary = "The push of an impact, played on a hit.",
        .source = "Hayward 2007, section 6, eq. (10); Hunt & Crossley 1975",
    };

    static constexpr std::tuple ports {
        input (&Inputs::hit, "hit", unit::hit, "impact speed v"),
        param (&Params::mass, "mass", unit::kilogram, "mass m that is thrown back", { .hard = { 1e-6, inf }, .usual = { 0.001, 1 }, .latch = true }),
        param (&Params::gain, "gain", unit::gain, "gain of the output", { .usual = { 0, 4 } }),
        setting (&Settings::stiffness, "stiffness", unit::metre, unit::newton, "K, force against depth"),
        setting (&Settings::damping, "damping", unit::metre, unit::damping, "D against depth, or a dissipation that multiplies K"),
        setting (&Settings::substeps, "substeps", unit::count, "steps of the motion in each sample", { .hard = { 1, 1000 }, .usual = { 1, 32 } }),
        setting (&Settings::voices, "voices", unit::count, "number of hits that can sound together", { .hard = { 1, 1000 }, .usual = { 1, 16 } }),
        output (&Outputs::resistance, "resistance", unit::newton, "force out of the object"),
    };

    Params params;
    Settings settings;

    Cost cost() const { return { .memory = 32.0 * settings.voices }; }

    std::string problem() const
    {
        const Law& K = settings.stiffness;
        if (! K.rises() || ! isFinite (K.inverse (1e-9))) return "stiffness must give a force above 0 at some depth, and must not fall with depth";
        if (! settings.damping.rises()) return "damping must not be negative, nor fall with depth";
        return {};
    }

    std::string warning (const Setup&) const;

    void prepare (const Setup& setup)
    {
        h = setup.dt_s() / settings.substeps;
        voices.assign (at (settings.voices), {});
    }

    /// Hits that are still sounding continue, up to the number of voices. Each keeps its index, because the order in which voices are
    /// added shows in the last bit of the sum.
    void adopt (const HuntCrossley& old) noexcept
    {
        const auto kept = std::min (voices.size(), old.voices.size());
        std::copy_n (old.voices.begin(), kept, voices.begin());
        for (std::size_t i = kept; i < old.voices.size(); ++i)
            if (old.voices[i].sounds) start (old.voices[i]);
    }

    Outputs tick (const Inputs& in) noexcept
    {
        double sum = 0.0;
        for (Voice& voice : voices)
            if (voice.sounds) sum += advance (voice, settings.substeps, h);

        if (in.hit > 0.0 && isFinite (in.hit)) start ({ .v = in.hit, .m = params.mass, .sounds = true });

        return { .resistance = finiteOrZero (params.gain * sum) };
    }

private:
    /// A mass on its way through the object.
    struct Voice
    {
        double d = 0.0, v = 0.0, m = 0.0;   // m, m/s, kg
        bool sounds = false;
    };

    static constexpr double faded = 1e-9;   // in N and m/s; a voice below both stops: a mass brought to rest by damping would never leave the object

    /// Eq. (10).
    double force (double d, double v) const noexcept
    {
        const Law& D = settings.damping;
        const double K = settings.stiffness (d);
        return std::max (0.0, K + (D.kind == Law::Kind::dissipation ? D.a * K : D (d)) * v);
    }

    void start (const Voice& hit) noexcept
    {
        const auto free = std::ranges::find (voices, false, &Voice::sounds);
        if (free != voices.end()) *free = hit;
    }

    /// Takes n steps and returns the force. A voice that has left the object, or has overflowed, stops sounding.
    double advance (Voice& voice, int n, double step) const noexcept
    {
        auto& [d, v, m, sounds] = voice;
        for (int i = 0; i < n; ++i)
        {
            v -= step * force (d, v) / m;
            d += step * v;
            sounds = d > 0.0 && isFinite (d, v);
            if (! sounds) return 0.0;
        }
        const double N = force (d, v);
        sounds = isFinite (N) && ! (N < faded && std::abs (v) < faded);
        return sounds ? N : 0.0;
    }

    double h = 1.0 / (Setup {}.rate_hz * Settings {}.substeps);   // s
    std::vector<Voice> voices;
};

//==============================================================================
// Implementation below.

inline std::string HuntCrossley::warning (const Setup& setup) const
{
    constexpr int enough = 4, fine = 256;   // in samples; and steps per sample
    Voice voice { .v = 1.0, .m = params.mass, .sounds = true };
    int steps = 0;
    while (voice.sounds && steps < enough * fine)
    {
        advance (voice, 1, setup.dt_s() / fine);
        ++steps;
    }
    if (voice.sounds) return {};

    std::ostringstream text;
    text << "a hit of 1 m/s lasts " << std::setprecision (2) << double (steps) / fine << " samples, fewer than " << enough
         << "; use a softer law, a larger mass or a higher rate";
    return text.str();
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::HuntCrossley);
