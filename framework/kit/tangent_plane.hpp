// SPDX-License-Identifier: MIT
#pragma once

#include "lanes.hpp"

#include <tuple>

namespace tactus
{

/// The tangent plane of a contact, and how it takes a vector along when the normal turns: by the smallest turn of the plane (parallel
/// transport, docs/decisions/parallel_transport.md). So the vector keeps its length, and a turn does no work.
///
/// The vector is kept in the plane `home`, which stays while the normal is within 60 degrees of it. So the vector depends on where the normal
/// is, not on how it got there: a normal that comes back brings the vector back. Opposite normals have the same plane.
template <typename V>
struct TangentPlaneOf
{
    Vector<V> n = Vector<V>::UnitZ();       ///< unit normal
    Vector<V> given = Vector<V>::UnitZ();   ///< the normal as it was given, of any length
    Vector<V> home = Vector<V>::UnitZ();    ///< unit normal of the plane in which the vector is kept

    /// Takes the normal of this sample, which must be finite and not 0. `begins` is true on the first sample of a contact.
    void turn (const Vector<V>& normal, MaskOf<V> begins) noexcept
    {
        if (const auto turns = ! isEqual (normal, given); any (turns)) where (turns, n) = normalized<V> (normal / largest (normal));
        given = normal;
        where (begins, home) = n;
        where (n.dot (home) < 0.0, n) = -n;
    }

    /// The part of a vector that lies in the plane of this sample, turned into `home`.
    Vector<V> kept (const Vector<V>& v) const noexcept { return turned (v - n * n.dot (v), n, home); }

    /// A vector in `home`, turned into the plane of this sample.
    Vector<V> shown (const Vector<V>& v) const noexcept { return turned (v, home, n); }

    /// If the normal has turned too far, the plane of this sample becomes `home`, and the kept vector becomes `now`, what shown() gave for it.
    void settle (Vector<V>& vector, const Vector<V>& now) noexcept
    {
        const auto is_far = n.dot (home) < far;
        if (none (is_far)) return;
        where (is_far, vector) = now;
        where (is_far, home) = n;
    }

    auto members() noexcept { return std::tie (n, given, home); }
    auto members() const noexcept { return std::tie (n, given, home); }

private:
    static constexpr double far = 0.5;   // cosine of 60 degrees

    /// Turns a vector in the plane with the unit normal `from` together with this plane, by the smallest angle, into the plane with the
    /// unit normal `to`. The normals are at most a right angle apart.
    static Vector<V> turned (const Vector<V>& v, const Vector<V>& from, const Vector<V>& to) noexcept
    {
        const auto is_same = isEqual (from, to);
        if (every (is_same)) return v;
        Vector<V> result = v - v.dot (to) / (1.0 + from.dot (to)) * (from + to);
        where (is_same, result) = v;
        return result;
    }
};

}   // namespace tactus
