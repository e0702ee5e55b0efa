// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/geometry/rotation.hpp>

#include <array>
#include <string>

namespace tactus::host::scene
{

/// The box that a device can reach, in the graph.
struct Reach
{
    std::string role {};
    Vec3 origin = Vec3::Zero();   ///< of the device, m
    Vec3 middle = Vec3::Zero();   ///< of the box that it can reach, m; the origin if the box is not known
    Mat3 half = Mat3::Zero();     ///< half of the edges of the box, a column each, m; 0: the box is not known

    bool hasBox() const noexcept { return ! half.isZero (0.0); }

    /// Corner i is on the side of the larger x, y and z of the device if bit 0, 1 and 2 of i are set.
    std::array<Vec3, 8> corners() const noexcept
    {
        std::array<Vec3, 8> all {};
        for (int i = 0; i < 8; ++i)
            all[static_cast<std::size_t> (i)] = middle + half * Vec3 ((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
        return all;
    }

    /// The same elsewhere.
    Reach movedBy (const Vec3& by) const
    {
        auto moved = *this;
        moved.origin += by;
        moved.middle += by;
        return moved;
    }

    bool operator== (const Reach&) const = default;
};

}   // namespace tactus::host::scene
