// SPDX-License-Identifier: MIT
#include "nearest_by_boxes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace tactus
{

namespace
{
constexpr int triangles_per_leaf = 4;

/// Boxes are this much larger than their triangles, in multiples of the largest coordinate, and distances to them are this much shorter.
/// Both are far more than the rounding errors of nearestOn, so no box is left out that holds the answer.
constexpr double slack = 1e-12;

/// A tree of halves is never deeper: 2^31 triangles have 29 levels.
constexpr std::size_t deepest_tree = 64;

struct Box
{
    Vec3 low = Vec3::Constant (std::numeric_limits<double>::infinity()), high = -low;
    int first = 0;   // of the triangles in a leaf, or of the two boxes inside
    int count = 0;   // triangles of a leaf; 0: there are boxes inside

    void hold (const Vec3& p)
    {
        low = low.cwiseMin (p);
        high = high.cwiseMax (p);
    }

    double distance2 (const Vec3& p) const noexcept { return (1.0 - slack) * (low - p).cwiseMax (p - high).cwiseMax (0.0).squaredNorm(); }
};

class ByBoxes final : public NearestTriangle
{
public:
    explicit ByBoxes (std::shared_ptr<const Mesh> m) : mesh (std::move (m)), triangles (mesh->triangles.size())
    {
        std::iota (triangles.begin(), triangles.end(), 0);
        for (int t = 0; t < mesh->size(); ++t)
        {
            Vec3 middle = Vec3::Zero();
            for (int i = 0; i < 3; ++i)
                middle += mesh->corner (t, i) / 3.0;
            middles.push_back (middle);
        }
        boxes.emplace_back();
        split (0, 0, mesh->size());
        middles = {};
    }

    int operator() (const Vec3& p) const noexcept override
    {
        int best = 0;
        double least = std::numeric_limits<double>::infinity();
        std::array<std::pair<int, double>, deepest_tree> waiting { { { 0, 0.0 } } };   // boxes, with their distances
        std::size_t count = 1;
        while (count > 0)
        {
            const auto [number, away2] = waiting[--count];
            if (away2 > least) continue;
            const Box& box = boxes[at (number)];
            for (int i = box.first; i < box.first + box.count; ++i)
                compare (triangles[at (i)], p, best, least);
            if (box.count > 0) continue;
            std::pair<int, double> near { box.first, boxes[at (box.first)].distance2 (p) }, far { box.first + 1, boxes[at (box.first) + 1].distance2 (p) };
            if (near.second > far.second) std::swap (near, far);
            waiting[count++] = far;
            waiting[count++] = near;
        }
        return best;
    }

private:
    /// The first one of those at the same distance wins.
    void compare (int triangle, const Vec3& p, int& best, double& least) const noexcept
    {
        const double distance2 = (nearestOn (*mesh, triangle, p).point - p).squaredNorm();
        if (! (distance2 < least || (distance2 == least && triangle < best))) return;
        best = triangle;
        least = distance2;
    }

    /// Fills a box with triangles, and divides them between two boxes inside it until there are few.
    void split (int number, int begin, int end)
    {
        Box box, around;
        for (int i = begin; i < end; ++i)
        {
            for (int c = 0; c < 3; ++c)
                box.hold (mesh->corner (triangles[at (i)], c));
            around.hold (middles[at (triangles[at (i)])]);
        }
        const Vec3 room = Vec3::Constant (slack * std::max (box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff()));
        box.low -= room;
        box.high += room;
        const bool is_leaf = end - begin <= triangles_per_leaf;
        box.first = is_leaf ? begin : static_cast<int> (boxes.size());
        box.count = is_leaf ? end - begin : 0;
        boxes[at (number)] = box;
        if (is_leaf) return;

        int axis = 0;
        (around.high - around.low).maxCoeff (&axis);
        const int middle = begin + (end - begin) / 2;
        std::nth_element (triangles.begin() + begin, triangles.begin() + middle, triangles.begin() + end, [&] (int a, int b) {
            const double u = middles[at (a)][axis], v = middles[at (b)][axis];
            return u < v || (u == v && a < b);
        });
        boxes.resize (boxes.size() + 2);
        const int inside = box.first;
        split (inside, begin, middle);
        split (inside + 1, middle, end);
    }

    std::shared_ptr<const Mesh> mesh;
    std::vector<int> triangles;   // leaf by leaf
    std::vector<Vec3> middles;    // by triangle, while the tree is built
    std::vector<Box> boxes;       // the first one holds everything
};
}   // namespace

std::unique_ptr<NearestTriangle> nearestByBoxes (std::shared_ptr<const Mesh> mesh) { return std::make_unique<ByBoxes> (std::move (mesh)); }

}   // namespace tactus
