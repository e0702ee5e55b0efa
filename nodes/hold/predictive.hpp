// SPDX-License-Identifier: MIT
#pragma once

#include <framework/length.hpp>
#include <framework/node.hpp>

#include <limits>

namespace tactus::nodes
{

/// Plugs most of the energy leak of a sampled force.
///
/// A force that is held between samples is, on average, half a sample old. So a spring gives back more than it took,
/// sigma dp^2 / 2 per sample, and feels alive. This node holds what the force will be in the middle of the sample:
///
///     out = f_k + (f_k - f_(k-1)) / 2 = 1.5 f_k - 0.5 f_(k-1)         no longer than `limit`
///
/// With a spring pushed in and let out by 10 mm the leak falls to less than a hundredth (see the test).
///
/// Source: Ellis, Sarkar & Jenkins 1997 (sample, estimate, hold); Hayward, "Physically-Based Haptic Synthesis" (2007),
/// section 1.
///
/// Good to know
///  - The force must not be predicted across a touch, where it has no slope. Wire the contact to `contact`: when its
///    value changes, the force before is forgotten and that sample passes as it is. A force that happens to be 0 is no change.
///  - Unwired, `contact` is ignored; that is its default of nan, and a nan on the wire is no change either.
///  - It amplifies noise, by up to 2 from one sample to the next, and the device needs more damping for the same
///    stiffness at high frequencies. Put it after filters and before the limiter.
///  - Longer than `limit`, the force keeps its direction.
struct PredictiveHold
{
    struct Inputs
    {
        Vec3 in = Vec3::Zero();
        double contact = std::numeric_limits<double>::quiet_NaN();
    };

    struct Params
    {
        double limit = 100.0;
    };

    struct Outputs
    {
        Vec3 out = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "hold.predictive",
        .name = "Predictive hold",
        .summary = "Holds the force of the middle of the sample, so that springs leak less energy.",
        .source = "Ellis, Sarkar & Jenkins 1997",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", unit::newton, "force f"),
        input (&Inputs::contact, "contact", unit::state, "a change of it starts anew; unwired: ignored"),
        param (&Params::limit, "limit", unit::newton, "longest force it gives", { .hard = { 0, inf }, .usual = { 0, 100 } }),
        output (&Outputs::out, "out", unit::newton, "the force to hold"),
    };

    Params params;

    void prepare (const Setup&) noexcept { last = {}; }

    void adopt (const PredictiveHold& old) noexcept { last = old.last; }

    Claims claims() const { return { .amplitude = params.limit }; }

    Outputs tick (const Inputs& in) noexcept
    {
        const bool wired = in.contact == in.contact;
        if (! isFinite (in.in) || (wired && ! isFinite (in.contact)))
        {
            last = {};
            return {};
        }

        const bool changed = wired && last.wired && in.contact != last.contact;
        const Vec3 before = last.known && ! changed ? last.force : in.in;
        last = { .force = in.in, .contact = wired ? in.contact : last.contact, .wired = wired || last.wired, .known = true };

        const Vec3 quarter = 0.25 * in.in + 0.5 * (0.25 * in.in - 0.25 * before);   // of the force: this cannot overflow
        if (length (quarter) > 0.25 * params.limit) return { .out = finiteOrZero (params.limit * direction (quarter)) };
        return { .out = finiteOrZero (4.0 * quarter) };
    }

private:
    struct Sample
    {
        Vec3 force = Vec3::Zero();
        double contact = 0.0;
        bool wired = false;   // there has been a contact
        bool known = false;   // false until the first finite sample
    };

    Sample last;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::PredictiveHold);
