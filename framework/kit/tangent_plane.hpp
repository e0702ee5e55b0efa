// SPDX-License-Identifier: MIT
#pragma once

#include "vec3.hpp"

namespace tactus
{

/// The tangent plane of a contact, and how it takes a vector along when the normal turns: by the smallest turn of the plane (parallel
/// transport, docs/decisions/parallel_transport.md). So the vector keeps its length, and a turn does no work.
///
/// The vector is kept in the plane `home`, which stays while the normal is within 60 degrees of it. So the vector depends on where the normal
/// is, not on how it got there: a normal that comes back brings the vector back. Opposite normals have the same plane.
struct TangentPlane
{
    Vec3 n = Vec3::UnitZ();       ///< unit normal
    Vec3 given = Vec3::UnitZ();   ///< the normal as it was given, of any length
    Vec3 home = Vec3::UnitZ();    ///< unit normal of the plane in which the vector is kept

    /// Takes the normal of this sample, which must be finite and not 0. `begins` is true on the first sample of a contact.
    void turn (const Vec3& normal, bool begins) noexcept
    {
        if (normal != given) n = direction (normal);
        given = normal;
        if (begins) home = n;
        if (n.dot (home) < 0.0) n = -n;
    }

    /// The part of a vector that lies in the plane of this sample, turned into `home`.
    Vec3 kept (const Vec3& v) const noexcept { return turned (v - n * n.dot (v), n, home); }

    /// A vector in `home`, turned into the plane of this sample.
    Vec3 shown (const Vec3& v) const noexcept { return turned (v, home, n); }

    /// If the normal has turned too far, the plane of this sample becomes `home`, and the kept vector becomes `now`, what shown() gave for it.
    void settle (Vec3& vector, const Vec3& now) noexcept
    {
        constexpr double far = 0.5;   // cosine of 60 degrees
        if (! (n.dot (home) < far)) return;
        vector = now;
        home = n;
    }

private:
    /// Turns a vector in the plane with the unit normal `from` together with this plane, by the smallest angle, into the plane with the
    /// unit normal `to`. The normals are at most a right angle apart.
    static Vec3 turned (const Vec3& v, const Vec3& from, const Vec3& to) noexcept
    {
        if (from == to) return v;
        return v - v.dot (to) / (1.0 + from.dot (to)) * (from + to);
    }
};

}   // namespace tactus
