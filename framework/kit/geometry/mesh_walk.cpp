// SPDX-License-Identifier: MIT
#include "mesh_walk.hpp"
#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace tactus
{

namespace
{
/// By triangle, then corner: another triangle that has the edge opposite that corner; -1: none.
std::vector<std::array<int, 3>> neighboursOf (const Mesh& mesh)
{
    struct Side
    {
        std::pair<int, int> ends;
        int triangle, corner;
    };
    std::vector<Side> sides;
    sides.reserve (3 * mesh.triangles.size());
    for (int t = 0; t < mesh.size(); ++t)
        for (int i = 0; i < 3; ++i)
        {
            const auto& corners = mesh.triangles[at (t)];
            sides.push_back ({ std::minmax (corners[at ((i + 1) % 3)], corners[at ((i + 2) % 3)]), t, i });
        }
    std::ranges::sort (sides, {}, [] (const Side& s) { return std::tuple (s.ends, s.triangle, s.corner); });   // a stable sort takes memory from the heap
    std::vector<std::array<int, 3>> neighbours (mesh.triangles.size(), { -1, -1, -1 });
    for (std::size_t i = 1; i < sides.size(); ++i)
    {
        const Side &a = sides[i - 1], &b = sides[i];
        if (a.ends != b.ends) continue;
        neighbours[at (b.triangle)][at (b.corner)] = a.triangle;
        if (auto& other = neighbours[at (a.triangle)][at (a.corner)]; other < 0) other = b.triangle;
    }
    return neighbours;
}
}   // namespace

MeshWalk::MeshWalk (Mesh m) : body (std::move (m)), neighbours (neighboursOf (body)), first (body.points.size() + 1, 0), sharing (3 * body.triangles.size())
{
    double size = 0.0;
    for (const auto& point : body.points)
        size = std::max (size, point.cwiseAbs().maxCoeff());
    boxes.reserve (body.triangles.size());
    blocks.reserve (body.triangles.size() / block + 1);
    const Vec3 slack = Vec3::Constant (margin (1e-12) * size);   // far more than the rounding error of a computed point
    for (int t = 0; t < body.size(); ++t)
    {
        const auto [a, b, c] = cornersOf (body, t);
        boxes.push_back ({ a.cwiseMin (b).cwiseMin (c) - slack, a.cwiseMax (b).cwiseMax (c) + slack });
        if (t % block == 0) blocks.push_back (boxes.back());
        blocks.back().low = blocks.back().low.cwiseMin (boxes.back().low);
        blocks.back().high = blocks.back().high.cwiseMax (boxes.back().high);
    }

    for (const auto& corners : body.triangles)
        for (const int c : corners)
            ++first[at (c + 1)];
    for (std::size_t i = 1; i < first.size(); ++i)
        first[i] += first[i - 1];

    auto next = first;
    for (int t = 0; t < body.size(); ++t)
        for (const int c : body.triangles[at (t)])
            sharing[at (next[at (c)]++)] = t;
}

/// Everything within a distance of p.
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

    /// True if everything in the box is certainly out of reach. False is inconclusive.
    bool misses (const Box& box) const noexcept
    {
        for (int i = 0; i < 3; ++i)
            if (box.low[i] > around.high[i] || box.high[i] < around.low[i]) return true;
        return (box.low - centre).cwiseMax (centre - box.high).cwiseMax (0.0).squaredNorm() * (1.0 - rounding) > square;
    }

private:
    static constexpr double rounding = margin (1e-12);   // relative bound on rounding errors
    static constexpr double endless = std::numeric_limits<double>::infinity();

    Vec3 centre;
    Box around { Vec3::Constant (-endless), Vec3::Constant (endless) };
    double square = endless;
};

Spot MeshWalk::nearestOfAll (const Vec3& p, int guess) const noexcept
{
    Spot best;
    double least = std::numeric_limits<double>::infinity();
    Reach reach { p, guess >= 0 ? (spotOn (guess, p).on.point - p).squaredNorm() : least };
    for (int t = 0; t < body.size(); ++t)
    {
        if (t % block == 0 && reach.misses (blocks[at (t / block)]))
        {
            t += block - 1;
            continue;
        }
        if (reach.misses (boxes[at (t)])) continue;
        const Spot there = spotOn (t, p);
        if (const double distance2 = (there.on.point - p).squaredNorm(); distance2 < least)
        {
            best = there;
            least = distance2;
            reach.shrinkTo (distance2);
        }
    }
    return best.triangle < 0 ? spotOn (0, p) : best;
}

Spot MeshWalk::nearest (int from, const Vec3& p) const noexcept
{
    constexpr int most = 1000;                  // most steps of a walk: more than a hand needs in a tick on any mesh
    constexpr double nearer = margin (1e-12);   // relative margin: at a common edge, two triangles are equally near except for rounding

    Spot here = spotOn (from, p);
    for (int step = 0; step < most; ++step)
    {
        Spot best = here;
        double least = (here.on.point - p).squaredNorm() * (1.0 - nearer);
        Reach reach { p, least };
        for (std::size_t c = 0; c < 3; ++c)
        {
            if (here.on.weights[c] <= 0.0) continue;   // the spot is on the opposite edge; the triangles at its ends suffice
            const auto corner = at (body.triangles[at (here.triangle)][c]);
            for (int i = first[corner]; i < first[corner + 1]; ++i)
            {
                const int neighbour = sharing[at (i)];
                if (neighbour == here.triangle || reach.misses (boxes[at (neighbour)])) continue;
                const Spot there = spotOn (neighbour, p);
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

Spot MeshWalk::entered (const Vec3& from, const Vec3& to) const noexcept
{
    constexpr double slack = margin (1e-9);   // relative; far larger than the rounding error of a weight
    const Vec3 way = to - from;
    const Box whole { from.cwiseMin (to), from.cwiseMax (to) };
    const auto misses = [&] (const Box& box) { return (box.low.array() > whole.high.array() || box.high.array() < whole.low.array()).any(); };

    int found = -1;
    double soonest = 1.0 + slack;
    for (int t = 0; t < body.size(); ++t)
    {
        if (t % block == 0 && misses (blocks[at (t / block)]))
        {
            t += block - 1;
            continue;
        }
        if (misses (boxes[at (t)])) continue;
        const auto corners = cornersOf (body, t);
        const Vec3 normal = areaNormal (corners);
        const double fall = -normal.dot (way);
        if (! (fall > 0.0)) continue;
        const double share = normal.dot (from - corners[0]) / fall;
        if (! (share >= -slack && share < soonest)) continue;
        const Vec3 there = from + share * way - corners[0];
        const auto gradients = gradientsOf (corners);
        const double second = gradients[1].dot (there), third = gradients[2].dot (there);
        if (second < -slack || third < -slack || second + third > 1.0 + slack) continue;
        soonest = share;
        found = t;
    }
    return found < 0 ? Spot {} : spotOn (found, from + soonest * way);
}

Spot MeshWalk::across (const Spot& spot, int corner) const noexcept
{
    Spot there { beside (spot.triangle, corner), { { 0.0, 0.0, 0.0 }, spot.on.point } };
    const auto &from = body.triangles[at (spot.triangle)], &to = body.triangles[at (there.triangle)];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (static_cast<int> (i) != corner && from[i] == to[j]) there.on.weights[j] = spot.on.weights[i];
    return there;
}

std::vector<Vec3> normalsOf (const Mesh& mesh)
{
    std::vector<Vec3> normals (mesh.points.size(), Vec3::Zero());
    for (int t = 0; t < mesh.size(); ++t)
        for (int c = 0; c < 3; ++c)
        {
            const Vec3& corner = mesh.corner (t, c);
            const Vec3 u = mesh.corner (t, (c + 1) % 3) - corner, v = mesh.corner (t, (c + 2) % 3) - corner, n = u.cross (v);
            normals[at (mesh.triangles[at (t)][at (c)])] += direction (n) * math::atan2 (n.norm(), u.dot (v));
        }
    for (auto& n : normals)
        n = direction (n);
    return normals;
}

}   // namespace tactus
