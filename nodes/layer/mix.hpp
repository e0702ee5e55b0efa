// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/desk_ports.hpp>

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
///  - A ceiling that is set or taken away while the desk runs fades in or out within 10 ms, as a mute does.
///  - Ducking depends on time. A spring that is ducked while it is pressed but not while it is released generates energy.
///  - The first tick starts without ramps, and so does the tick after a fault. One non-finite input silences all channels.
///  - `names` are the labels of the channels for people and hosts, separated by commas: "contact, texture, shock".
///  - It mixes numbers. layer.mix_vectors mixes forces in three axes.
struct LayerMix
{
    using Inputs = In<InputList<double>>;
    using Params = DeskParams;

    using Settings = DeskSettings;
    using Outputs = DeskOutputs<double>;

    static constexpr Info info {
        .id = "layer.mix",
        .name = "Layer mixer",
        .summary = "Mixes the layers of an effect: gain, mute, solo, priority, ceiling.",
        .source = "definition",
        .keywords = "mixer desk faders",
    };

    static constexpr auto ports = deskPorts<Inputs, Outputs> ("largest magnitude of the mix; 0: no limit", "peak of each layer after gain, mute and solo, before ducking");

    Params params;
    Settings settings;

    void prepare (const Setup& setup) noexcept { desk.prepare (setup.dt_s()); }
    void update() noexcept { desk.update (params, settings.inputs); }
    void adopt (const LayerMix& old) noexcept { desk.adopt (old.desk); }
    Outputs tick (const Inputs& in) noexcept { return desk.mix<Outputs> (in.in, params); }

    void serialize (auto& archive) { archive (desk); }

private:
    MixingDesk<double> desk;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::LayerMix);
