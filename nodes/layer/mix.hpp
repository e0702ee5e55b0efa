// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/generic.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace tactus::nodes
{

/// A mixing desk for the layers of an effect: contact, texture, shock, each on its own channel.
///
/// On each tick, in this order:
///
///     gain       x_i = gain[i] in[i]
///     mute       times m_i: 0 if mute[i] is on, else 1
///     solo       m_i is also 0 if any solo is on and solo[i] is not; m_i moves in straight ramps of 10 ms
///     level      level[i] = max (|m_i x_i|, level[i] e^(-T / 50 ms)): rises immediately, decays over 50 ms
///     ducking    times d_i: goes to 10^(-duck_db / 20) with time constant 5 ms while a channel of higher priority
///                sounds, else to 1 with 100 ms. Several such channels duck no more than one.
///     sum        s = sum of d_i m_i x_i
///     ceiling    out = s within -ceiling…ceiling, cut hard; reduction = 20 log10 |s / out|, dB
///
/// A channel sounds if its level is above 1 % of the loudest recent level (a peak that decays with time constant
/// 2 s). So the desk needs no threshold in an unknown unit, and mixes millinewtons as well as newtons.
///
/// Source: definition; the order is the same as in an audio mixing desk.
///
/// Good to know
///  - mute and solo are switches: on above 0.5. A channel that is both soloed and muted is silent. Muted channels duck no other
///    channel.
///  - Equal priorities, the default, do not duck each other. A higher number has priority.
///  - A channel that is open, not ducked, and below the ceiling passes unchanged, bit for bit.
///  - The ceiling has no memory and no knee: it cannot overshoot or pump, and a force that depends only on position still depends
///    only on position behind it. Everything above the ceiling is lost, so if reduction is not 0, turn the gains down.
///  - Ducking depends on time. A spring that is ducked while it is pressed but not while it is released generates energy.
///  - The first tick starts without ramps, and so does the tick after a fault. One non-finite input silences all channels.
///  - `names` are the labels of the channels for people and hosts, separated by commas: "contact, texture, shock".
///  - It mixes numbers. For forces in three axes, mix before vector.scale, or use one desk per axis.
struct LayerMix
{
    struct Inputs
    {
        InputList<double> in;
    };

    struct Params
    {
        List gain { 1.0 };
        List mute;
        List solo;
        List priority;
        double duck_db = 12.0;
        double ceiling = 0.0;
    };

    struct Settings
    {
        int inputs = 2;
        std::string names;
    };

    struct Outputs
    {
        double out = 0.0;
        List level;
        double reduction = 0.0;
    };

    static constexpr Info info {
        .id = "layer.mix",
        .name = "Layer mixer",
        .summary = "Mixes the layers of an effect: gain, mute, solo, priority, ceiling.",
        .source = "definition",
        .keywords = "mixer desk faders",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "layers", 0.0),
        param (&Params::gain, "gain", unit::gain, "factor on the layer with the same number", { .usual = { 0, 2 } }),
        param (&Params::mute, "mute", unit::state, "on above 0.5: the layer is silent", { .hard = { 0, 1 } }),
        param (&Params::solo, "solo", unit::state, "on above 0.5: only layers in solo are heard", { .hard = { 0, 1 } }),
        param (&Params::priority, "priority", unit::count, "a layer is ducked while one of higher priority sounds", { .usual = { 0, 10 } }),
        param (&Params::duck_db, "duck_db", unit::decibel, "attenuation of a ducked layer", { .hard = { 0, inf }, .usual = { 0, 60 } }),
        param (&Params::ceiling, "ceiling", sameAs ("in"), "largest magnitude of the mix; 0: no limit", { .hard = { 0, inf }, .usual = { 0, 20 } }),
        inputCount (&Settings::inputs, "number of layers"),
        setting (&Settings::names, "names", unit::count, "labels of the layers, separated by commas"),
        output (&Outputs::out, "out", sameAs ("in"), "the mix"),
        output (&Outputs::level, "level", sameAs ("in"), "peak of each layer after gain, mute and solo, before ducking"),
        output (&Outputs::reduction, "reduction", unit::decibel, "current attenuation by the ceiling"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup) noexcept
    {
        const double dt = setup.dt_s();
        ramp = dt / 10e-3;
        attack = -math::expm1 (-dt / 5e-3);
        release = -math::expm1 (-dt / 100e-3);
        decay = math::exp (-dt / 50e-3);
        fading = math::exp (-dt / 2.0);
        forget();
    }

    void update() noexcept
    {
        any_solo = false;
        for (int i = 0; i < settings.inputs; ++i)
            any_solo = any_solo || params.solo[i] > 0.5;
        ducked = math::pow (10.0, -params.duck_db / 20.0);
    }

    void adopt (const LayerMix& old) noexcept
    {
        channels = old.channels;
        loudest = old.loudest;
        started = old.started;
    }

    Outputs tick (const Inputs& in) noexcept;

private:
    struct Channel
    {
        double open = 1.0;    // m_i, the ramp of mute and solo
        double level = 0.0;   // level of m_i x_i
        double duck = 1.0;    // d_i
    };

    bool mix (const InputList<double>& in, Outputs&) noexcept;
    bool isOpen (int i) const noexcept { return ! (params.mute[i] > 0.5) && (! any_solo || params.solo[i] > 0.5); }
    bool isDucked (int i, int size) const noexcept;

    void forget() noexcept
    {
        channels = {};
        loudest = 0.0;
        started = false;
    }

    /// A falling peak. It ends at 0 rather than in subnormal numbers.
    static double fall (double level, double factor) noexcept { return level > 1e-300 ? level * factor : 0.0; }

    static constexpr double audible = 0.01;   // share of `loudest` above which a channel sounds

    std::array<Channel, list_capacity> channels;
    double loudest = 0.0;
    double ramp = 1.0, attack = 1.0, release = 1.0, decay = 0.0, fading = 0.0;   // per tick
    double ducked = 1.0;
    bool any_solo = false;
    bool started = false;
};

//==============================================================================
// Implementation below.

inline LayerMix::Outputs LayerMix::tick (const Inputs& in) noexcept
{
    Outputs out { .level = { 0.0, in.in.size() } };   // the only result that is returned, so that its list is not copied
    if (! mix (in.in, out))
    {
        forget();
        out = {};
    }
    return out;
}

/// Returns false if something is not finite.
inline bool LayerMix::mix (const InputList<double>& in, Outputs& out) noexcept
{
    if (! isFinite (in)) return false;

    const int size = in.size();
    std::array<double, list_capacity> heard;
    loudest = fall (loudest, fading);
    for (int i = 0; i < size; ++i)
    {
        Channel& c = channels[at (i)];
        const double target = isOpen (i) ? 1.0 : 0.0;
        c.open = started ? std::clamp (target, c.open - ramp, c.open + ramp) : target;

        const double x = c.open * (params.gain[i] * in[i]);
        heard[at (i)] = x;
        c.level = std::max (std::abs (x), fall (c.level, decay));
        loudest = std::max (loudest, c.level);
        out.level[i] = c.level;
        if (! isFinite (x)) return false;
    }

    double sum = 0.0;
    for (int i = 0; i < size; ++i)
    {
        Channel& c = channels[at (i)];
        const double target = isDucked (i, size) ? ducked : 1.0;
        c.duck += (target < c.duck ? attack : release) * (target - c.duck);
        if (std::abs (target - c.duck) < 1e-9) c.duck = target;
        sum += c.duck * heard[at (i)];
    }
    if (! isFinite (sum)) return false;

    started = true;
    out.out = sum;
    if (params.ceiling > 0.0 && std::abs (sum) > params.ceiling)
    {
        out.out = std::copysign (params.ceiling, sum);
        out.reduction = 20.0 / std::numbers::ln10 * (math::log (std::abs (sum)) - math::log (params.ceiling));   // their quotient may be infinite
    }
    return true;
}

/// True if a layer of higher priority sounds.
inline bool LayerMix::isDucked (int i, int size) const noexcept
{
    for (int j = 0; j < size; ++j)
        if (params.priority[j] > params.priority[i] && channels[at (j)].level > audible * loudest) return true;
    return false;
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::LayerMix);
