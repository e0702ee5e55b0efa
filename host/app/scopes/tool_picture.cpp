// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_picture.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace tactus::host
{

std::optional<ToolPicture> toolPicture (const std::string& node, const Signals& signals)
{
    const auto position = signals (node + ".position"), deflection = signals (node + ".deflection");
    const auto force = signals (node + ".force"), state = signals (node + ".state");
    if (position.size() != 3 || deflection.size() != 3 || force.size() != 3 || state.size() != 1) return std::nullopt;
    const auto d_max = signals (node + ".d_max"), ratio = signals (node + ".static_ratio"), normal = signals (node + ".normal");

    auto end = std::numeric_limits<std::uint64_t>::max(), begin = std::uint64_t { 0 };
    for (const auto* list : { &position, &deflection, &force, &state, &d_max, &ratio, &normal })
        for (const auto& t : *list)
        {
            end = std::min (end, t->end());
            begin = std::max (begin, t->begin());
        }
    if (end <= begin) return std::nullopt;
    const auto tick = end - 1;
    const auto vector = [tick] (const TraceList& l) { return Vec3 (l[0]->at (tick), l[1]->at (tick), l[2]->at (tick)); };

    ToolPicture p { vector (position), vector (deflection), vector (force) };
    const double s = state[0]->at (tick);
    if (! isFinite (p.tool) || ! isFinite (p.deflection) || ! isFinite (p.force) || ! std::isfinite (s)) return std::nullopt;
    p.tick = tick;
    p.state = static_cast<int> (std::lround (s));
    if (d_max.size() == 1) p.d_max = finiteOrZero (d_max[0]->at (tick));
    p.d_stick = p.d_max * (ratio.size() == 1 ? std::max (1.0, finiteOrZero (ratio[0]->at (tick))) : 1.0);
    if (normal.size() == 3)
        if (const Vec3 n = vector (normal); isFinite (n) && n.norm() > 0.0) p.normal = n.normalized();
    return p;
}

PlaneView::PlaneView (const Vec3& normal)
{
    constexpr double nearly_along = 0.1;
    const Vec3 n = normal.normalized();
    Vec3 x = Vec3::UnitX() - n * n.x();
    if (x.norm() < nearly_along) x = Vec3::UnitY() - n * n.y();
    right = x.normalized();
    up = n.cross (right);
}

}   // namespace tactus::host
