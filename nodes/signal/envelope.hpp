// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <algorithm>

namespace tactus::nodes
{

/// An ADSR envelope driven by a gate: attack, decay, sustain, release.
///
///     gate > 0.5   rises at the rate of 0 to 1 in `attack`, falls from 1 to `sustain` in `decay`, and stays there
///     else         falls to 0 in `release`, from wherever it is
///
/// All segments are straight lines. Each starts from the current level: a gate that reopens during the release continues from
/// there, without a step. A time of less than one tick makes its segment a step. On a non-finite gate it gives 0 and
/// starts again from rest.
///
/// Source: the ADSR of the early Moog and ARP synthesisers, with the straight segments and constant release time of
/// juce::ADSR.
struct SignalEnvelope
{
    struct Inputs
    {
        double gate = 0.0;
    };

    struct Params
    {
        double attack = 0.01;
        double decay = 0.1;
        double sustain = 1.0;
        double release = 0.1;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.envelope",
        .name = "Envelope",
        .summary = "Rises with a gate and falls after it.",
        .source = "ADSR envelope, straight segments",
        .keywords = "adsr attack release",
    };

    static constexpr std::tuple ports {
        input (&Inputs::gate, "gate", unit::gain, "open above 0.5"),
        param (&Params::attack, "attack", unit::second, "time from 0 to 1", { .hard = { 0, inf }, .usual = { 0, 1 } }),
        param (&Params::decay, "decay", unit::second, "time from 1 to sustain", { .hard = { 0, inf }, .usual = { 0, 1 } }),
        param (&Params::sustain, "sustain", unit::gain, "level while the gate stays open", { .hard = { 0, 1 } }),
        param (&Params::release, "release", unit::second, "time to 0 after the gate closes", { .hard = { 0, inf }, .usual = { 0, 2 } }),
        output (&Outputs::out, "out", unit::gain, "0 … 1"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { dt = setup.dt_s(); }

    void update() noexcept
    {
        rise = portionOf (params.attack);
        fall = (1.0 - params.sustain) * portionOf (params.decay);
        fade = portionOf (params.release);
    }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.gate))
        {
            stage = Stage::release;
            level = released_at = 0.0;
            return {};
        }

        const bool open = in.gate > 0.5;
        if (open && stage == Stage::release) stage = Stage::attack;
        if (! open && stage != Stage::release)
        {
            stage = Stage::release;
            released_at = level;
        }

        switch (stage)
        {
        case Stage::attack:
            level += rise;
            if (level < 1.0 - rounding) break;
            level = 1.0;
            stage = Stage::decay;
            break;
        case Stage::decay:
            level -= fall;
            if (level > params.sustain + rounding) break;
            stage = Stage::sustain;
            [[fallthrough]];
        case Stage::sustain:
            level = params.sustain;
            break;
        case Stage::release:
            level -= fade * released_at;
            if (level < rounding) level = 0.0;
            break;
        }
        return { .out = finiteOrZero (level) };
    }

    Claims claims() const { return { .amplitude = 1.0 }; }

    void serialize (auto& archive) { archive (level, released_at, stage); }

private:
    enum class Stage
    {
        attack,
        decay,
        sustain,
        release   // also the state at rest
    };

    static constexpr double rounding = margin (1e-9);   // so that n steps of 1/n take n ticks

    double portionOf (double time) const noexcept { return time > dt ? dt / time : 1.0; }

    double dt = 0.0;                             // s
    double rise = 1.0, fall = 1.0, fade = 1.0;   // change per tick; fade: as a share of released_at
    double level = 0.0, released_at = 0.0;
    Stage stage = Stage::release;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalEnvelope);
