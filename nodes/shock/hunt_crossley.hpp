// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/free_impact.hpp>
#include <tactus/node/node.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
/// `dissipated_energy` is the energy that the object has kept from all hits so far: the work of the damping, which is the integral of
/// D d' over depth. `gain` scales only the force and does not change this energy.
///
/// A contact of fewer than four samples is too short for samples to show its shape. The node solves it on the tick of the hit. Each
/// sample is then the mean force over the sample period before it, so the impulse is m v (1 + e) however short the contact, and comes
/// half a sample late. The tick of each hit evaluates K and D about 400 times if the contact is this short, else 64 times.
///
/// `mass` 0 means the mass of the device that the hit comes from: the tool as the hand feels it. If the device does not give its
/// mass, the node uses 50 g.
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
///  - The impulse of a contact of four samples or more is the sum over its samples. It is off by up to 4 % at four samples, by 1 % at
///    eight, and by less if the law starts softer than a spring.
///  - The steps are explicit: where h D / m approaches 1 (h: the length of a substep), the mass is thrown back too soon. Use more
///    substeps then.
///  - While all voices sound, a new hit is dropped; no voice is cut short.
///  - A contact of fewer than four samples keeps its impulse but not its peak: `warning` says so if a hit of 1 m/s is this short.
///    Harder hits are shorter: with a stiffness k d^n, their duration is proportional to v^(-(n - 1) / (n + 1)).
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
        double dissipated_energy = 0.0;
    };

    static constexpr Info info {
        .id = "shock.hunt_crossley",
        .name = "Hunt-Crossley shock",
        .summary = "The push of an impact, played on a hit.",
        .source = "Hayward 2007, section 6, eq. (10); Hunt & Crossley 1975",
        .keywords = "collision bounce",
    };

    static constexpr std::tuple ports {
        input (&Inputs::hit, "hit", unit::hit, "impact speed v"),
        param (&Params::mass, "mass", unit::kilogram, "mass m that is thrown back; 0: that of the device",
               { .hard = { 0, inf }, .usual = { 0, 1 }, .latch = true }),
        param (&Params::gain, "gain", unit::gain, "gain of the output", { .usual = { 0, 4 } }),
        setting (&Settings::stiffness, "stiffness", unit::metre, unit::newton, "K, force against depth"),
        setting (&Settings::damping, "damping", unit::metre, unit::damping, "D against depth, or a dissipation that multiplies K"),
        setting (&Settings::substeps, "substeps", unit::count, "steps of the motion in each sample", { .hard = { 1, 1000 }, .usual = { 1, 32 } }),
        setting (&Settings::voices, "voices", unit::count, "number of hits that can sound together", { .hard = { 1, 1000 }, .usual = { 1, 16 } }),
        output (&Outputs::resistance, "resistance", unit::newton, "force out of the object"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy that the object has kept from all hits; gain has no effect on it"),
    };

    Params params;
    Settings settings;

    Cost cost() const { return { .memory = double (sizeof (Voice)) * settings.voices }; }

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
        dt = setup.dt_s();
        h = dt / settings.substeps;
        voices.assign (at (settings.voices), {});
    }

    void learn (const DeviceMechanics& device) noexcept { device_mass = device.mass; }

    /// Hits that are still sounding continue, up to the number of voices. Each keeps its index, because the order in which voices are
    /// added shows in the last bit of the sum.
    void adopt (const HuntCrossley& old) noexcept
    {
        dissipated = old.dissipated;
        const auto kept = std::min (voices.size(), old.voices.size());
        std::copy_n (old.voices.begin(), kept, voices.begin());
        for (std::size_t i = kept; i < old.voices.size(); ++i)
            if (auto* free = old.voices[i].sounds ? freeVoice() : nullptr) *free = old.voices[i];
    }

    Outputs tick (const Inputs& in) noexcept
    {
        double sum = 0.0, lost = 0.0;
        for (Voice& voice : voices)
            if (voice.sounds) sum += voice.score.length > 0 ? play (voice, lost) : advance (voice, settings.substeps, lost);
        if (isFinite (dissipated + lost)) dissipated += lost;

        if (in.hit > 0.0 && isFinite (in.hit))
            if (auto* voice = freeVoice()) start (*voice, in.hit);

        return { .resistance = finiteOrZero (params.gain * sum), .dissipated_energy = dissipated };
    }

    void serialize (auto& archive)
    {
        archive (voices, dissipated);
        for (const Voice& v : voices)
            if (v.score.length < 0 || v.score.length > few + 1 || v.score.played < 0 || v.score.played > v.score.length)
                archive.refuse ("has a contact that is too long");
    }

private:
    static constexpr int few = 4;                   // a contact of fewer samples is played as mean forces
    static constexpr double faded = 1e-9;           // in N and m/s; a voice stops below both, because a mass stopped by damping never leaves the object
    static constexpr double usual_mass = 0.05;      // kg, used if the device does not give its mass
    static constexpr double lightest_mass = 1e-6;   // kg; a smaller `mass` counts as this

    /// A contact of a few samples, solved in advance.
    struct Score
    {
        struct Sample
        {
            double force = 0.0, lost = 0.0;   // N, J
        };

        std::array<Sample, few + 1> samples {};
        int length = 0, played = 0;   // length 0: the contact is too long to be solved in advance
    };

    /// A mass on its way through the object.
    struct Voice
    {
        double d = 0.0, v = 0.0, m = 0.0;   // m, m/s, kg
        bool sounds = false;
        Score score {};
    };

    struct Push
    {
        double N, K;   // the force, and its elastic part, in N
    };

    /// Eq. (10).
    Push push (double d, double v) const noexcept
    {
        const Law& D = settings.damping;
        const double K = settings.stiffness (d);
        return { std::max (0.0, K + (D.kind == Law::Kind::dissipation ? D.a * K : D (d)) * v), K };
    }

    double massNow() const noexcept
    {
        if (params.mass > 0.0) return std::max (params.mass, lightest_mass);
        return device_mass > 0.0 ? device_mass : usual_mass;
    }

    Voice* freeVoice() noexcept
    {
        const auto free = std::ranges::find (voices, false, &Voice::sounds);
        return free == voices.end() ? nullptr : &*free;
    }

    void start (Voice&, double speed) const noexcept;

    /// The next sample of a contact that was solved in advance.
    double play (Voice& voice, double& lost) const noexcept
    {
        auto& score = voice.score;
        const auto& [force, energy] = score.samples[at (score.played)];
        voice.sounds = ++score.played < score.length;
        lost += energy;
        return force;
    }

    /// Takes n steps and returns the force. A voice that has left the object, or has overflowed, stops sounding.
    double advance (Voice& voice, int n, double& lost) const noexcept
    {
        auto& [d, v, m, sounds, score] = voice;
        for (int i = 0; i < n; ++i)
        {
            const auto [N, K] = push (d, v);
            const double before = v;
            v -= h * N / m;
            d += h * v;
            lost += std::max (0.0, 0.5 * h * (N - K) * (before + v));
            sounds = d > 0.0 && isFinite (d, v);
            if (! sounds) return 0.0;
        }
        const double N = push (d, v).N;
        sounds = isFinite (N) && ! (N < faded && std::abs (v) < faded);
        return sounds ? N : 0.0;
    }

    double dt = 1.0 / Setup {}.rate_hz;   // s
    double h = dt / Settings {}.substeps;
    double device_mass = 0.0;   // kg; 0: unknown
    double dissipated = 0.0;    // J
    std::vector<Voice> voices;
};

//==============================================================================
// Implementation below.

/// Starts a voice, and solves a short contact in advance. The mean force of each sample follows from the momentum that the mass loses in
/// this time, and the dissipated energy from the change of kinetic energy and of energy in the spring.
inline void HuntCrossley::start (Voice& voice, double speed) const noexcept
{
    voice = { .v = speed, .m = massNow(), .sounds = true };
    Score score;
    MotionState before { 0.0, speed };
    const auto add = [&] (const MotionState& now) noexcept {
        if (score.length == int (score.samples.size())) return;
        const double moved = 0.5 * voice.m * (before.v - now.v) * (before.v + now.v);
        const double stored = settings.stiffness.energy (now.d) - settings.stiffness.energy (before.d);
        score.samples[at (score.length++)] = { voice.m * (before.v - now.v) / dt, std::max (0.0, moved - stored) };
        before = now;
    };
    const auto force = [this] (double d, double v) noexcept { return push (d, v).N; };
    const auto rebound = freeImpact (force, voice.m, speed, few * dt, dt, add);
    add ({ 0.0, -rebound.speed });
    const auto isNormal = [] (const Score::Sample& s) { return isFinite (s.force, s.lost); };
    if (rebound.duration < few * dt && std::ranges::all_of (score.samples, isNormal)) voice.score = score;
}

inline std::string HuntCrossley::warning (const Setup& setup) const
{
    std::string text;
    if (! (params.mass > 0.0) && ! (device_mass > 0.0))
        text = "mass is 0, which means the mass of the device, but the graph does not give it; set mass, or " + roundedText (usual_mass, 2)
               + " kg is used until a device gives its mass";

    const auto force = [this] (double d, double v) noexcept { return push (d, v).N; };
    const auto rebound = freeImpact (force, massNow(), 1.0, few * setup.dt_s());
    if (rebound.duration < few * setup.dt_s())
        text += (text.empty() ? "" : "; ") + ("a hit of 1 m/s lasts " + roundedText (rebound.duration / setup.dt_s(), 2)) + " samples, fewer than "
                + roundedText (few, 2) + "; use a softer law, a larger mass or a higher rate";
    return text;
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::HuntCrossley);
