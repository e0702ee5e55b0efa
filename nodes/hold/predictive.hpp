// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>
#include <tactus/node/node.hpp>

#include <limits>

namespace tactus::nodes
{

/// Removes most of the energy leak of a sampled force.
///
/// A force held between samples is half a sample old on average. So a spring of stiffness sigma that moves by dp in a sample
/// gives back more than it took, sigma dp^2 / 2 per sample, and feels active. This node predicts the force in the middle of the
/// sample and holds that:
///
///     out = f_k + (f_k - f_(k-1)) / 2 = 1.5 f_k - 0.5 f_(k-1)         its length limited to `limit`
///
/// With a spring pushed in and released by 10 mm, the leak falls to less than a hundredth (see the test).
///
/// Source: Ellis, Sarkar & Jenkins 1997 (sample, estimate, hold); Hayward, "Physically-Based Haptic Synthesis" (2007),
/// section 1.
///
/// Good to know
///  - The force must not be predicted across a touch, where it has no slope. Wire the contact to `contact`: when its value
///    changes, the previous force is forgotten and that sample passes unchanged. A force of 0 alone is not a change.
///  - Unwired, `contact` is ignored: its default is nan, and a nan on the wire is not a change either.
///  - It amplifies noise, by up to 2 from one sample to the next, and at high frequencies the device needs more damping for the
///    same stiffness. Put it after filters and before the limiter.
///  - A force longer than `limit` is shortened and keeps its direction.
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
        .summary = "Predicts the force in the middle of the sample, so that springs leak less energy.",
        .source = "Ellis, Sarkar & Jenkins 1997",
        .keywords = "zero-order zoh",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", unit::newton, "force f"),
        input (&Inputs::contact, "contact", unit::state, "a change restarts the prediction; unwired: ignored"),
        param (&Params::limit, "limit", unit::newton, "largest magnitude of the output", { .hard = { 0, inf }, .usual = { 0, 100 } }),
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

        const Vec3 quarter = 0.25 * in.in + 0.5 * (0.25 * in.in - 0.25 * before);   // a quarter of the force, which cannot overflow
        if (length (quarter) > 0.25 * params.limit) return { .out = finiteOrZero (params.limit * direction (quarter)) };
        return { .out = finiteOrZero (4.0 * quarter) };
    }

    void serialize (auto& archive) { archive (last); }

private:
    struct Sample
    {
        Vec3 force = Vec3::Zero();
        double contact = 0.0;
        bool wired = false;   // true once `contact` has had a value
        bool known = false;   // false until the first finite sample
    };

    Sample last;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::PredictiveHold);
