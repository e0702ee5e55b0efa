// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>

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

/// Finds the triangle of a mesh that is nearest to a point, any of them if there are several. [any thread]
class NearestTriangle
{
public:
    virtual ~NearestTriangle() = default;
    virtual int operator() (const Vec3& p) const noexcept = 0;
};

/// Returns the triangle nearest to p, the first one if there are several. Looks at every triangle of the mesh.
int nearestOfAll (const Mesh&, const Vec3& p) noexcept;

}   // namespace tactus
