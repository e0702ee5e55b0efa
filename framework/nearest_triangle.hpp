// SPDX-License-Identifier: MIT
#pragma once

#include "assets.hpp"

namespace tactus
{

/// The point of a triangle that is nearest to p, in barycentric weights of its corners.
struct OnTriangle
{
    std::array<double, 3> weights { 1.0, 0.0, 0.0 };
    Vec3 point = Vec3::Zero();
};

OnTriangle nearestOn (const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) noexcept;   // [any thread]
OnTriangle nearestOn (const Mesh&, int triangle, const Vec3& p) noexcept;

/// Answers which triangle of a mesh is nearest to a point; of several, any. [any thread]
class NearestTriangle
{
public:
    virtual ~NearestTriangle() = default;
    virtual int operator() (const Vec3& p) const noexcept = 0;
};

/// Looks at every triangle. Of several that are nearest, the first.
int nearestOfAll (const Mesh&, const Vec3& p) noexcept;

}   // namespace tactus
