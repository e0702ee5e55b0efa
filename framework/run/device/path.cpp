// SPDX-License-Identifier: MIT
#include "path.hpp"

#include <tactus/kit/math/math.hpp>

#include <algorithm>

namespace tactus
{

Path::Point GesturePath::at (double t) const noexcept
{
    // A central difference over 20 us: its error, a sixth of the step squared times the jerk, stays below 1e-7 m/s for the
    // fastest gesture. So gestures only need to define positions.
    constexpr double h = 1e-5;

    const double within = math::fmod (t, gesture.duration_s);
    const Vec3 before = gesture.position (within - h), after = gesture.position (within + h);
    return { placement.offset + placement.scale * gesture.position (within), placement.scale / (2.0 * h) * (after - before) };
}

TracePath::TracePath (const TraceData& trace, const Placement& placement) : lasts (trace.duration())
{
    for (const auto& row : trace.rows)
        if (isFinite (row.position)) knots.push_back ({ row.t, placement.offset + placement.scale * row.position });
}

Path::Point TracePath::at (double t) const noexcept
{
    if (knots.empty()) return {};

    const auto next = std::upper_bound (knots.begin(), knots.end(), t, [] (double time, const Knot& knot) { return time < knot.t; });
    if (next == knots.begin()) return { .position = knots.front().position };
    if (next == knots.end()) return { .position = knots.back().position };

    const auto& before = *(next - 1);
    const Vec3 velocity = (next->position - before.position) / (next->t - before.t);
    return { before.position + (t - before.t) * velocity, velocity };
}

}   // namespace tactus
