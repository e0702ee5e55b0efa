// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/desk_ports.hpp>

namespace tactus::nodes
{

/// A mixing desk for layers that are forces in three axes, such as friction, a texture and the push of a surface, each in its own direction.
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
///     ceiling    out = s, shortened to the length `ceiling` if it is longer; reduction = 20 log10 (|s| / |out|), dB
///
/// |v| is the length of a vector. All factors are numbers, so each layer keeps its direction. The ceiling keeps the direction of the sum.
/// A channel sounds if its level is above 1 % of the loudest recent level (a peak that decays with time constant 2 s).
///
/// Source: definition; the order is the same as in layer.mix and in an audio mixing desk.
///
/// Good to know
///  - Layers along one axis are mixed as layer.mix mixes numbers.
///  - mute and solo are switches: on above 0.5. A channel that is both soloed and muted is silent. Muted channels duck no other
///    channel.
///  - Equal priorities, the default, do not duck each other. A higher number has priority.
///  - A channel that is open, not ducked, and below the ceiling passes unchanged, bit for bit.
///  - The ceiling has no memory: it cannot overshoot or pump. It limits the length, so a strong layer in one direction also weakens the
///    others. If reduction is not 0, turn the gains down.
///  - A ceiling that is set or taken away while the desk runs fades in or out within 10 ms, as a mute does.
///  - Ducking depends on time. A spring that is ducked while it is pressed but not while it is released generates energy.
///  - The first tick starts without ramps, and so does the tick after a fault. One component that is not finite silences all channels.
///  - `names` are the labels of the channels for people and hosts, separated by commas: "friction, weave, shock".
///  - vector.along and vector.scale give a scalar layer a direction.
struct LayerMixVectors
{
    using Inputs = In<InputList<Vec3>>;
    using Params = DeskParams;

    using Settings = DeskSettings;
    using Outputs = DeskOutputs<Vec3>;

    static constexpr Info info {
        .id = "layer.mix_vectors",
        .name = "Force layer mixer",
        .summary = "Mixes layers that are forces in three axes: gain, mute, solo, priority, ceiling.",
        .source = "definition",
        .keywords = "mixer desk faders",
    };

    static constexpr auto ports = deskPorts<Inputs, Outputs> ("largest length of the mix; 0: no limit", "peak length of each layer after gain, mute and solo, before ducking");

    Params params;
    Settings settings;

    void prepare (const Setup& setup) noexcept { desk.prepare (setup.dt_s()); }
    void update() noexcept { desk.update (params, settings.inputs); }
    void adopt (const LayerMixVectors& old) noexcept { desk.adopt (old.desk); }
    Outputs tick (const Inputs& in) noexcept { return desk.mix<Outputs> (in.in, params); }

    void serialize (auto& archive) { archive (desk); }

private:
    MixingDesk<Vec3> desk;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::LayerMixVectors);
