// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bodies.hpp"
#include "paint.hpp"
#include "raster.hpp"

#include <vector>

namespace tactus::host::scene
{

/// A place where a tool has moved a surface. Points near `at` move with it, and points farther away less.
struct Dent
{
    static constexpr double radius = 6e-3;   ///< m; drawn, not computed: the nodes know only the point that is touched

    Vec3 at = Vec3::Zero();   ///< the point before it moved
    Vec3 by = Vec3::Zero();   ///< how far it has moved

    double share (const Vec3& p) const noexcept
    {
        const double r = (p - at).squaredNorm() / (radius * radius), fall = 1.0 / (1.0 + r);
        return fall * std::sqrt (fall);
    }
};

/// Ridges in the coordinates of a sheet.
struct Ridges
{
    double frequency = 0.0, angle = 0.0, phase = 0.0;   ///< 1/m, rad, rad
    Vec3 from = Vec3::Zero();                           ///< the point of the world that is the origin of the node's coordinates

    bool operator== (const Ridges&) const = default;
};

/// A relief in the coordinates of a sheet.
struct Grain
{
    Relief map;
    Vec3 from = Vec3::Zero();   ///< as in Ridges

    bool operator== (const Grain&) const = default;
};

/// A flat surface, with the ridges and reliefs on it and the dents in it.
class Sheet3D
{
public:
    static constexpr double half_width = 0.06;   ///< m; as in the view from above

    double half = half_width;   ///< m; larger where a tool has gone farther, see cover()

    Vec3 normal = Vec3::UnitZ();
    double offset = 0.0;                 ///< m, along the normal
    std::vector<std::string> roles {};   ///< of the tools that its planes follow
    std::vector<Ridges> ridges {};
    std::vector<Grain> grains {};
    std::vector<Dent> dents {};
    double grid = 0.01;   ///< distance of the lines on it, in m
    int cells = 64;       ///< along each side; each is drawn as two triangles

    /// Makes the sheet large enough to be under this point, in steps of 2 cm, at most half a metre to each side.
    void cover (const Vec3&) noexcept;

    void draw (Raster&, const Camera&, const Paint&) const;

    /// The directions along which the sheet lies; x and y if it is level.
    std::array<Vec3, 2> axes() const noexcept;

    Vec3 centre() const noexcept { return offset * normal; }
};

}   // namespace tactus::host::scene
