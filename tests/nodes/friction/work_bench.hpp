// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

namespace tactus::test
{

/// Moves the tool of a friction node, and counts the work of the hand over each step in four ways:
///
///   model      the growth of stored_energy plus dissipated_energy, over the straight path between the samples
///   trapezoid  -(f before + f after) / 2 . dp; equal to `model` while sticking, and on dense paths
///   held       -f before . dp, the work on a device that holds its force between samples; a spring of slope K leaks
///              up to K |dp|^2 / 2 per step, which the device must damp (section 1)
///   reached    -f after . dp; never less than the growth of stored energy, whatever the step: the proof of passivity
template <typename Node>
struct WorkBench
{
    WorkBench() = default;
    explicit WorkBench (const typename Node::Params& params) { node.params = params; }

    const typename Node::Outputs& tick (const typename Node::Inputs& in)
    {
        const Vec3 before = out.force, dp = in.position - p;
        out = node.tick (in);
        held -= before.dot (dp);
        reached -= out.force.dot (dp);
        trapezoid -= 0.5 * (before + out.force).dot (dp);
        p = in.position;
        return out;
    }

    double model() const { return out.stored_energy + out.dissipated_energy; }

    Node node;
    typename Node::Outputs out;
    Vec3 p = Vec3::Zero();
    double held = 0.0, reached = 0.0, trapezoid = 0.0;   // J
};

}   // namespace tactus::test
