// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sheet.hpp"

namespace tactus::host::scene
{

/// A mesh at its place in the world, drawn as the tool has moved it.
class Solid
{
public:
    Solid (std::shared_ptr<const Surface>, double scale, const Vec3& origin, const Vec3& rotation);

    /// True if it was made of these.
    bool isOf (const std::shared_ptr<const Surface>& s, double sc, const Vec3& o, const Vec3& r) const
    {
        return s == surface && sc == scale && o == origin && r == rotation;
    }

    /// Colours each point by how far it has moved; points that have not moved by their stiffness, if the surface has one for each.
    void draw (Raster&, const Camera&, const Paint&, const std::vector<Dent>&) const;

    const Bounds& bounds() const noexcept { return box; }

    /// True if a point is well inside the mesh: by more than a fiftieth of its size, since what is felt is smooth, and the mesh is not. A mesh that is
    /// not closed has no inside, and one of more than 50 000 triangles is not looked at, because that would slow each picture.
    bool contains (const Vec3&) const noexcept;

    int triangles() const noexcept { return static_cast<int> (faces.size()); }
    bool hasStiffnesses() const noexcept { return ! stiffness.empty(); }

    /// The depth at which the colour of depth is full, in m.
    static constexpr double full_colour_m = 5e-3;

private:
    double turnsAround (const Vec3&) const noexcept;
    void findStiffness();

    std::shared_ptr<const Surface> surface;
    double scale;
    Vec3 origin, rotation;
    std::vector<Vec3> points, normals;
    std::vector<std::array<int, 3>> faces;
    std::vector<float> stiffness;   // by point, 0 (softest) to 1; empty: the same everywhere
    Bounds box;
};

}   // namespace tactus::host::scene
