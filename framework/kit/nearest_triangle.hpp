// SPDX-License-Identifier: MIT
#pragma once

#include "assets.hpp"

namespace tactus
{

/// A point of a triangle, and the barycentric weights of the corners there.
struct OnTriangle
{
    std::array<double, 3> weights { 1.0, 0.0, 0.0 };
    Vec3 point = Vec3::Zero();
};

/// The point of a triangle nearest to p. [any thread]
OnTriangle nearestOn (const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) noexcept;
OnTriangle nearestOn (const Mesh&, int triangle, const Vec3& p) noexcept;

/// Answers which triangle of a mesh is nearest to a point. If several are, it may return any of them. [any thread]
class NearestTriangle
{
public:
    virtual ~NearestTriangle() = default;
    virtual int operator() (const Vec3& p) const noexcept = 0;
};

/// Looks at every triangle of the mesh. If several are nearest, returns the first.
int nearestOfAll (const Mesh&, const Vec3& p) noexcept;

}   // namespace tactus
