// SPDX-License-Identifier: MIT
#include "mesh_walk.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tactus
{

namespace
{
std::vector<std::array<bool, 3>> rimOf (const Mesh& mesh)
{
    std::map<std::pair<int, int>, int> sides;   // of each edge
    const auto edge = [&] (std::size_t triangle, std::size_t opposite)
    {
        const auto& corners = mesh.triangles[triangle];
        return std::minmax (corners[(opposite + 1) % 3], corners[(opposite + 2) % 3]);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            ++sides[edge (t, i)];

    std::vector<std::array<bool, 3>> rim (mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            rim[t][i] = sides[edge (t, i)] == 1;
    return rim;
}
}   // namespace

MeshWalk::MeshWalk (Mesh m) : body (std::move (m)), rim (rimOf (body)), first (body.points.size() + 1, 0), around (3 * body.triangles.size())
{
    double size = 0.0;
    for (const auto& point : body.points)
        size = std::max (size, point.cwiseAbs().maxCoeff());
    const Vec3 slack = Vec3::Constant (1e-12 * size);   // far more than a computed point can be off
    for (const auto& corners : body.triangles)
    {
        const auto at = [&] (std::size_t i) -> const Vec3&
        { return body.points[static_cast<std::size_t> (corners[i])]; };
        const Vec3 &a = at (0), &b = at (1), &c = at (2);
        boxes.push_back ({ a.cwiseMin (b).cwiseMin (c) - slack, a.cwiseMax (b).cwiseMax (c) + slack });
    }
    for (std::size_t t = 0; t < boxes.size(); ++t)
    {
        if (t % block == 0) blocks.push_back (boxes[t]);
        blocks.back().low = blocks.back().low.cwiseMin (boxes[t].low);
        blocks.back().high = blocks.back().high.cwiseMax (boxes[t].high);
    }

    for (const auto& corners : body.triangles)
        for (const int c : corners)
            ++first[static_cast<std::size_t> (c) + 1];
    for (std::size_t i = 1; i < first.size(); ++i)
        first[i] += first[i - 1];

    auto next = first;
    for (int t = 0; t < static_cast<int> (body.triangles.size()); ++t)
        for (const int c : body.triangles[static_cast<std::size_t> (t)])
            around[static_cast<std::size_t> (next[static_cast<std::size_t> (c)]++)] = t;
}

/// What lies within a distance of p.
class MeshWalk::Reach
{
public:
    Reach (const Vec3& p, double distance2) noexcept : centre (p) { shrinkTo (distance2); }

    void shrinkTo (double distance2) noexcept
    {
        if (! (distance2 < square)) return;
        square = distance2;
        const Vec3 reach = Vec3::Constant (std::sqrt (distance2) * (1.0 + rounding));
        around = { centre - reach, centre + reach };
    }

    /// True if all that is in a box certainly lies beyond; false says nothing.
    bool misses (const Box& box) const noexcept
    {
        for (int i = 0; i < 3; ++i)
            if (box.low[i] > around.high[i] || box.high[i] < around.low[i]) return true;
        return (box.low - centre).cwiseMax (centre - box.high).cwiseMax (0.0).squaredNorm() * (1.0 - rounding) > square;
    }

private:
    static constexpr double rounding = 1e-12;   // relative

    static constexpr double endless = std::numeric_limits<double>::infinity();

    Vec3 centre;
    Box around { Vec3::Constant (-endless), Vec3::Constant (endless) };
    double square = endless;
};

Spot MeshWalk::nearestOfAll (const Vec3& p, int guess) const noexcept
{
    Spot best;
    double least = std::numeric_limits<double>::infinity();
    Reach reach { p, guess >= 0 ? (at (guess, p).on.point - p).squaredNorm() : least };
    for (std::size_t t = 0; t < boxes.size(); ++t)
    {
        if (t % block == 0 && reach.misses (blocks[t / block]))
        {
            t += block - 1;
            continue;
        }
        if (reach.misses (boxes[t])) continue;
        const Spot there = at (static_cast<int> (t), p);
        if (const double distance2 = (there.on.point - p).squaredNorm(); distance2 < least)
        {
            best = there;
            least = distance2;
            reach.shrinkTo (distance2);
        }
    }
    return best.triangle < 0 ? at (0, p) : best;
}

Spot MeshWalk::nearest (int from, const Vec3& p) const noexcept
{
    constexpr int most = 1000;         // steps: as far as a hand gets in a tick on any mesh, and an end to it
    constexpr double nearer = 1e-12;   // relative: neighbours on a common edge are equally near but for rounding

    Spot here = at (from, p);
    for (int step = 0; step < most; ++step)
    {
        Spot best = here;
        double least = (here.on.point - p).squaredNorm() * (1.0 - nearer);
        Reach reach { p, least };
        for (std::size_t c = 0; c < 3; ++c)
        {
            if (here.on.weights[c] <= 0.0) continue;   // what is nearer lies beyond the corners of the edge we stand on
            const auto corner = static_cast<std::size_t> (body.triangles[static_cast<std::size_t> (here.triangle)][c]);
            for (int i = first[corner]; i < first[corner + 1]; ++i)
            {
                const int neighbour = around[static_cast<std::size_t> (i)];
                if (neighbour == here.triangle || reach.misses (boxes[static_cast<std::size_t> (neighbour)])) continue;
                const Spot there = at (neighbour, p);
                if (const double distance2 = (there.on.point - p).squaredNorm(); distance2 < least)
                {
                    best = there;
                    least = distance2;
                    reach.shrinkTo (distance2);
                }
            }
        }
        if (best.triangle == here.triangle) break;
        here = best;
    }
    return here;
}

bool MeshWalk::isBeyondRim (const Spot& spot, const Vec3& p) const noexcept
{
    constexpr double further = 0.7071;   // of the way there: more outwards than up or down
    const Vec3 away = p - spot.on.point;
    const auto passes = [&] (int triangle)
    {
        const auto t = static_cast<std::size_t> (triangle);
        const auto& corners = body.triangles[t];
        for (std::size_t i = 0; i < 3; ++i)
        {
            if (! rim[t][i]) continue;
            const auto& a = body.points[static_cast<std::size_t> (corners[(i + 1) % 3])];
            const auto& b = body.points[static_cast<std::size_t> (corners[(i + 2) % 3])];
            const Vec3 along = b - a, inward = body.points[static_cast<std::size_t> (corners[i])] - a;
            if (along.cross (spot.on.point - a).norm() > 1e-9 * along.squaredNorm()) continue;   // on another edge
            const Vec3 outward = -direction (inward - along * (inward.dot (along) / along.squaredNorm()));
            const Vec3 up = direction (along.cross (inward));
            if (outward.dot (away) > 0.0 && (away - up.dot (away) * up).norm() > further * away.norm()) return true;
        }
        return false;
    };

    const auto& weights = spot.on.weights;
    const auto t = static_cast<std::size_t> (spot.triangle);
    for (std::size_t i = 0; i < 3; ++i)
        if (weights[i] == 1.0)
        {
            const auto corner = static_cast<std::size_t> (body.triangles[t][i]);
            return std::any_of (around.begin() + first[corner], around.begin() + first[corner + 1], passes);
        }
    return std::ranges::count (weights, 0.0) > 0 && passes (spot.triangle);
}

bool isInsideOut (const Mesh& mesh)
{
    const auto isOpen = [] (const std::array<bool, 3>& edges)
    { return edges[0] || edges[1] || edges[2]; };
    if (std::ranges::any_of (rimOf (mesh), isOpen)) return false;
    double volume = 0.0;
    for (const auto& t : mesh.triangles)
    {
        const auto at = [&] (std::size_t i) -> const Vec3&
        { return mesh.points[static_cast<std::size_t> (t[i])]; };
        volume += at (0).dot (at (1).cross (at (2)));
    }
    return volume < 0.0;
}

std::vector<Vec3> normalsOf (const Mesh& mesh)
{
    std::vector<Vec3> normals (mesh.points.size(), Vec3::Zero());
    for (const auto& corners : mesh.triangles)
        for (std::size_t c = 0; c < 3; ++c)
        {
            const auto at = [&] (std::size_t i) -> const Vec3&
            { return mesh.points[static_cast<std::size_t> (corners[(c + i) % 3])]; };
            const Vec3 u = at (1) - at (0), v = at (2) - at (0), n = u.cross (v);
            normals[static_cast<std::size_t> (corners[c])] += direction (n) * std::atan2 (n.norm(), u.dot (v));
        }
    for (auto& n : normals)
        n = direction (n);
    return normals;
}

}   // namespace tactus
