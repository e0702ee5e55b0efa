// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/mode.hpp>
#include <tactus/node/node.hpp>

#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace tactus::nodes
{

/// The ring of a struck object: the difference between a tap on wood and one on steel.
///
///     value = gain sum_i a_i v e^(-decay_i t) sin (2 pi frequency_i t)      t since a hit of speed v; hits add up
///
/// Each mode is a phasor z that is multiplied by a fixed complex factor each tick. A hit adds a_i v to its real part, and the
/// sine is its imaginary part. So modes are exact at any rate, a hit starts without a click, and a second hit while the first
/// still rings gives the exact sum of both.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 6, after Okamura, Cutkosky & Dennerlein 2001.
/// The chapter prints e^(b t) with b < 0; here `decay` is -b, positive.
///
/// Good to know
///  - `pitch` and `damping` multiply all frequencies and decays. Wired, they bend a ring while it sounds, without a click.
///  - Modes at or above half the sampling rate, and modes that do not decay, are silent.
///  - Published amplitudes are often accelerations per impact speed: multiply them by the mass of the tip.
///  - A hit whose speed is not positive or not finite is ignored. Each hit adds energy: keep it small compared with
///    the contact's own force.
struct Modal
{
    using Mode = tactus::Mode;

    struct Inputs
    {
        double hit = 0.0;
    };

    struct Params
    {
        double gain = 1.0;
        double pitch = 1.0;
        double damping = 1.0;
    };

    struct Settings
    {
        std::vector<Mode> modes = std::vector<Mode> (1);
    };

    struct Outputs
    {
        double value = 0.0;
    };

    static constexpr Info info {
        .id = "vibration.modal",
        .name = "Modal vibration",
        .summary = "Decaying tones that a hit excites.",
        .source = "Hayward 2007, section 6; Okamura et al. 2001",
        .keywords = "resonator bell tap",
    };

    static constexpr std::tuple ports {
        input (&Inputs::hit, "hit", unit::hit, "impact speed v"),
        param (&Params::gain, "gain", unit::gain, "gain of the output", { .usual = { 0, 4 } }),
        param (&Params::pitch, "pitch", unit::gain, "multiplies all frequencies", { .hard = { 0, inf }, .usual = { 0.25, 4 } }),
        param (&Params::damping, "damping", unit::gain, "multiplies all decays", { .hard = { 0, inf }, .usual = { 0.1, 10 } }),
        setting (&Settings::modes, "modes", unit::count, "the tones of the object"),
        output (&Outputs::value, "value", unit::newton, "force of the vibration"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        voices.assign (settings.modes.size(), {});
        real.assign (voices.size(), 0.0);
        imaginary.assign (voices.size(), 0.0);
        update();
    }

    void update() noexcept
    {
        for (std::size_t i = 0; i < voices.size(); ++i)
        {
            const Mode& mode = settings.modes[i];
            const double turn = 2.0 * std::numbers::pi * mode.frequency * params.pitch * dt;
            const double shrink = mode.decay * params.damping * dt;
            const bool sounds = turn < std::numbers::pi && shrink > 0.0;
            const double length = sounds ? math::exp (-shrink) : 0.0;
            const auto [sine, cosine] = math::sinCos (sounds ? turn : 0.0);
            voices[i].factor = { length * cosine, length * sine };
        }
    }

    /// A mode keeps ringing if the new list has a mode of the same frequency, at the same index or a different one.
    void adopt (const Modal& old) noexcept
    {
        for (std::size_t i = 0; i < old.voices.size(); ++i)
            if (const std::size_t heir = find (old.settings.modes[i].frequency, i); heir < voices.size())
            {
                real[heir] += old.real[i];
                imaginary[heir] += old.imaginary[i];
            }
    }

    Outputs tick (const Inputs& in) noexcept
    {
        const double v = in.hit > 0.0 && isFinite (in.hit) ? in.hit : 0.0;
        turn();   // before a new hit is added
        double sum = 0.0;
        for (const double y : imaginary)
            sum += y;
        if (v > 0.0) strike (v);

        const double value = params.gain * sum;
        if (isFinite (value)) return { .value = value };

        real.assign (voices.size(), 0.0);   // as many as before, so nothing is allocated
        imaginary.assign (voices.size(), 0.0);
        return {};
    }

    void serialize (auto& archive) { archive (real, imaginary); }

private:
    using Phasor = std::complex<double>;

    struct Voice
    {
        Phasor factor;
    };

    static constexpr double flush = 1e-18;   // N; a weaker ring cannot be felt, and is set to 0 before it ends in slow denormal numbers

    /// A hit does not sound on its own tick: it changes only the real parts.
    void strike (double v) noexcept
    {
        for (std::size_t i = 0; i < voices.size(); ++i)
            if (voices[i].factor != Phasor {}) real[i] += settings.modes[i].amplitude * v;
    }

    /// Multiplies each phasor by its factor. There is no branch in the loop, so that a compiler computes several modes at once.
    void turn() noexcept
    {
        const Voice* const voice = voices.data();
        double *const re = real.data(), *const im = imaginary.data();
        for (std::size_t i = 0, n = voices.size(); i < n; ++i)
        {
            const double fx = voice[i].factor.real(), fy = voice[i].factor.imag();
            const double x = re[i] * fx - im[i] * fy, y = re[i] * fy + im[i] * fx;
            const bool is_faint = x * x + y * y < flush * flush;
            re[i] = is_faint ? 0.0 : x;
            im[i] = is_faint ? 0.0 : y;
        }
    }

    /// Index of the mode with this frequency: `preferred` if that mode has it, the number of modes if none has it.
    std::size_t find (double frequency, std::size_t preferred) const noexcept
    {
        const auto& modes = settings.modes;
        if (preferred < modes.size() && modes[preferred].frequency == frequency) return preferred;
        std::size_t i = 0;
        while (i < modes.size() && modes[i].frequency != frequency)
            ++i;
        return i;
    }

    std::vector<Voice> voices;
    std::vector<double> real, imaginary;   // of the phasors, by mode
    double dt = 1.0 / Setup {}.rate_hz;    // s
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Modal);
