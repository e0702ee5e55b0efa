// SPDX-License-Identifier: MIT
#include "smooth_body.hpp"
#include "faces.hpp"
#include "least_squares.hpp"
#include "mesh_walk.hpp"
#include <tactus/kit/math/math.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tactus
{

namespace
{
constexpr double weight_reach = 1.6;   // of a node's weight, over its longest edge
constexpr double flattest = 0.05;      // 1 - depth / radius of curvature, for a foot to be kept
constexpr double damping = 0.01;       // weight of a term of a polynomial, over that of the node itself
constexpr int fitted_rings = 3;        // nodes that a polynomial is fitted to

constexpr std::array<int, 15> power_x { 0, 1, 0, 2, 1, 0, 3, 2, 1, 0, 4, 3, 2, 1, 0 }, power_y { 0, 0, 1, 0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 4 };
constexpr std::array<double, 15> choices { 1, 1, 1, 1, 2, 1, 1, 3, 3, 1, 1, 4, 6, 4, 1 };   // binomial

double power (double a, int n)
{
    double result = 1.0;
    for (; n > 0; --n)
        result *= a;
    return result;
}

using Numbers = std::vector<double>;

double dot (const Numbers& a, const Numbers& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}
}   // namespace

SmoothBody::SmoothBody (const Mesh& mesh, double crease) : SmoothBody (MeshWalk (mesh), crease) {}

// Exported code runs this on boards without a heap, so it takes few vectors, and each only once.
SmoothBody::SmoothBody (const MeshWalk& walk, double crease)
    : corners (walk.mesh().triangles.size()), beside (corners.size(), { -1, -1, -1 }), rim (corners.size(), { false, false, false }),
      face (facesOf (walk.mesh(), walk, crease))
{
    placeNodes (walk);
    fit (walk);
    findNear (walk);
    findOver (walk);
    pass();
}

/// Gives each point a node for each of its faces.
void SmoothBody::placeNodes (const MeshWalk& walk)
{
    const Mesh& mesh = walk.mesh();
    const auto eachNode = [&] (const auto& use) {   // use (point, a triangle of the node)
        for (int point = 0; point < static_cast<int> (mesh.points.size()); ++point)
        {
            const auto around = walk.around (point);
            for (auto t = around.begin(); t != around.end(); ++t)
                if (std::none_of (around.begin(), t, [&] (int earlier) { return face[at (earlier)] == face[at (*t)]; })) use (point, *t);
        }
    };
    std::size_t count = 0;
    eachNode ([&] (int, int) { ++count; });
    nodes.reserve (count);
    eachNode ([&] (int point, int triangle) {
        for (const int t : walk.around (point))
            for (std::size_t i = 0; i < 3; ++i)
                if (face[at (t)] == face[at (triangle)] && mesh.triangles[at (t)][i] == point) corners[at (t)][i] = static_cast<int> (nodes.size());
        nodes.push_back ({ .point = point, .p = mesh.points[at (point)], .z = Vec3::Zero() });
    });
    for (int t = 0; t < size(); ++t)
        for (int i = 0; i < 3; ++i)
        {
            const int other = walk.beside (t, i);
            rim[at (t)][at (i)] = other < 0;
            if (other >= 0 && face[at (other)] == face[at (t)]) beside[at (t)][at (i)] = other;

            const auto& own = corners[at (t)];
            const Vec3& p = nodes[at (own[at (i)])].p;
            const Vec3 a = nodes[at (own[at ((i + 1) % 3)])].p - p, b = nodes[at (own[at ((i + 2) % 3)])].p - p, n = a.cross (b);
            nodes[at (own[at (i)])].z += direction (n) * math::atan2 (n.norm(), a.dot (b));
        }
}

/// Calls `use (node)` for the nodes that share a triangle with a node, for most of them twice.
template <typename Use>
void SmoothBody::neighbours (const MeshWalk& walk, int node, const Use& use) const
{
    for (const int t : walk.around (nodes[at (node)].point))
        if (const auto& own = corners[at (t)]; own[0] == node || own[1] == node || own[2] == node)
            for (const int other : own)
                if (other != node) use (other);
}

/// Fits the polynomials, by least squares with weights that fall with the distance.
void SmoothBody::fit (const MeshWalk& walk)
{
    std::vector<int> seen (nodes.size(), -1), use;
    for (int v = 0; v < static_cast<int> (nodes.size()); ++v)
    {
        Node& node = nodes[at (v)];
        node.z = direction (node.z);
        node.x = node.z.unitOrthogonal();
        node.y = node.z.cross (node.x);
        use.clear();
        use.push_back (v);
        seen[at (v)] = v;
        double mean = 0.0, longest = 0.0;
        std::size_t from = 0;
        for (int ring = 0; ring < fitted_rings; ++ring)
        {
            for (const std::size_t to = use.size(); from < to; ++from)
                neighbours (walk, use[from], [&] (int other) {
                    if (std::exchange (seen[at (other)], v) != v) use.push_back (other);
                });
            if (ring > 0) continue;
            for (std::size_t i = 1; i < use.size(); ++i)
            {
                const double edge = (nodes[at (use[i])].p - node.p).norm();
                mean += edge / static_cast<double> (use.size() - 1);
                longest = std::max (longest, edge);
            }
        }
        node.radius = weight_reach * longest;
        node.over = 1.0 / (node.radius * node.radius);

        // The small weight keeps a term small that the nodes say little about. The factors of the terms make this the same for all directions of
        // x and y.
        const auto term = [] (int k, double x, double y) { return std::sqrt (choices[at (k)]) * power (x, power_x[at (k)]) * power (y, power_y[at (k)]); };
        LeastSquares<terms - 1> sums (damping);
        for (std::size_t i = 1; i < use.size(); ++i)
        {
            const Vec3 d = nodes[at (use[i])].p - node.p;
            const double weight = math::exp (-0.5 * d.squaredNorm() / (mean * mean));
            std::array<double, terms> row {};
            for (int k = 1; k < terms; ++k)
                row[at (k - 1)] = weight * term (k, d.dot (node.x) / mean, d.dot (node.y) / mean);
            row[terms - 1] = weight * d.dot (node.z);
            sums.add (row);
        }
        const auto solved = sums.solved();
        for (int k = 1; k < terms; ++k)
            node.c[at (k)] = solved[at (k - 1)] * term (k, 1.0 / mean, 1.0 / mean);
    }
}

/// Lists the nodes whose weights may reach a triangle or the places beside it, so that the next triangle has the same sums.
void SmoothBody::findNear (const MeshWalk& walk)
{
    double widest = 0.0;
    for (const auto& node : nodes)
        widest = std::max (widest, node.radius);
    near.first.reserve (corners.size() + 1);
    std::vector<int> seen, found;
    found.reserve (nodes.size());
    for (const bool lists : { false, true })   // counts first
    {
        seen.assign (nodes.size(), -1);
        near.first.assign (1, 0);
        int count = 0;
        for (int t = 0; t < size(); ++t)
        {
            const auto& own = corners[at (t)];
            const Vec3 centre = (nodes[at (own[0])].p + nodes[at (own[1])].p + nodes[at (own[2])].p) / 3.0;
            double size = 0.0;
            found.clear();
            for (const int node : own)
            {
                size = std::max (size, (nodes[at (node)].p - centre).norm());
                seen[at (node)] = t;
                found.push_back (node);
            }
            for (std::size_t i = 0; i < found.size(); ++i)
            {
                const Node& node = nodes[at (found[i])];
                const double far = (node.p - centre).norm();
                if (far < node.radius + 1.15 * size)
                {
                    ++count;
                    if (lists) near.items.push_back (found[i]);
                }
                if (far > widest + 1.15 * size) continue;
                neighbours (walk, found[i], [&] (int other) {
                    if (std::exchange (seen[at (other)], t) != t) found.push_back (other);
                });
            }
            near.first.push_back (count);
            if (lists) std::sort (near.items.end() - (near.first[at (t + 1)] - near.first[at (t)]), near.items.end());
        }
        if (! lists) near.items.reserve (at (count));
    }
}

/// Lists the faces that a foot on a triangle may pass over to.
void SmoothBody::findOver (const MeshWalk& walk)
{
    const Mesh& mesh = walk.mesh();
    over.first.reserve (corners.size() + 1);
    over.first.push_back (0);
    for (int t = 0; t < size(); ++t)
    {
        const Vec3 centre = (mesh.corner (t, 0) + mesh.corner (t, 1) + mesh.corner (t, 2)) / 3.0;
        const auto above = [&] (int other) { return areaNormal (cornersOf (mesh, other)).dot (centre - mesh.corner (other, 0)) > 0.0; };
        const auto add = [&] (int other, double bulges) {
            const auto known = std::find_if (over.items.begin() + over.first.back(), over.items.end(),
                                             [&] (const Other& o) { return face[at (o.triangle)] == face[at (other)]; });
            if (known == over.items.end()) over.items.push_back ({ other, bulges });
        };
        for (int i = 0; i < 3; ++i)
            if (const int other = walk.beside (t, i); other >= 0 && face[at (other)] != face[at (t)]) add (other, above (other) ? -1.0 : 1.0);
        for (const int point : mesh.triangles[at (t)])
            for (const int other : walk.around (point))
                if (face[at (other)] != face[at (t)] && ! above (other)) add (other, 1.0);
        std::sort (over.items.begin() + over.first.back(), over.items.end(),
                   [&] (const Other& a, const Other& b) { return face[at (a.triangle)] < face[at (b.triangle)]; });
        over.first.push_back (static_cast<int> (over.items.size()));
    }
}

/// Shifts the polynomials so that the surface passes through all nodes: the mixes of the shifts at the nodes must be the distances there. The
/// equations are solved by the stabilised method of biconjugate gradients (van der Vorst 1992).
void SmoothBody::pass()
{
    std::vector<int> home (nodes.size(), 0);
    for (int t = 0; t < size(); ++t)
        for (const int node : corners[at (t)])
            home[at (node)] = t;
    const auto mix = [&] (const Numbers& x, Numbers& mixed) {
        for (std::size_t v = 0; v < nodes.size(); ++v)
        {
            double sum = 0.0, all = 0.0;
            for (int k = near.first[at (home[v])]; k < near.first[at (home[v] + 1)]; ++k)
            {
                const auto other = at (near.items[at (k)]);
                const double r2 = (nodes[v].p - nodes[other].p).squaredNorm() * nodes[other].over;
                if (r2 >= 1.0) continue;
                const double w = weightOf (nodes[other], r2).w;
                sum += w;
                all += w * x[other];
            }
            mixed[v] = all / sum;
        }
    };
    const std::size_t n = nodes.size();
    Numbers shift (n), rest (n), way (n), step (n), turned (n), first (n);
    for (std::size_t v = 0; v < n; ++v)
        rest[v] = first[v] = way[v] = valueAt (home[v], nodes[v].p).g;
    const double start = dot (rest, rest), wanted = margin (1e-12) * margin (1e-12) * start;
    double rho = start;
    for (int k = 0; k < 500 && dot (rest, rest) > wanted; ++k)
    {
        mix (way, step);
        const double a = rho / dot (first, step);
        for (std::size_t v = 0; v < n; ++v)
            rest[v] -= a * step[v];
        mix (rest, turned);
        const double length = dot (turned, turned), b = length > 0.0 ? dot (turned, rest) / length : 0.0;
        for (std::size_t v = 0; v < n; ++v)
        {
            shift[v] += a * way[v] + b * rest[v];
            rest[v] -= b * turned[v];
        }
        const double next = dot (first, rest), c = next / rho * (a / b);
        rho = next;
        if (! isFinite (c)) break;
        for (std::size_t v = 0; v < n; ++v)
            way[v] = rest[v] + c * (way[v] - b * step[v]);
    }
    if (! (dot (rest, rest) < start)) return;   // then the surface is near the nodes only
    for (std::size_t v = 0; v < n; ++v)
        nodes[v].c[0] = shift[v];
}

SmoothBody::Value SmoothBody::valueAt (int triangle, const Vec3& p) const noexcept
{
    // Sums of the weights and of weights times heights, with gradients and second derivatives: xx xy xz yy yz zz.
    double W = 0.0, A = 0.0;
    std::array<double, 3> dW {}, dA {};
    std::array<double, 6> hW {}, hA {};
    for (int item = near.first[at (triangle)]; item < near.first[at (triangle + 1)]; ++item)
    {
        const Node& q = nodes[at (near.items[at (item)])];
        const std::array<double, 3> d { p.x() - q.p.x(), p.y() - q.p.y(), p.z() - q.p.z() };
        const double r2 = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * q.over;
        if (r2 >= 1.0) continue;
        const auto [w, w1, w2] = weightOf (q, r2);
        const double x = d[0] * q.x.x() + d[1] * q.x.y() + d[2] * q.x.z(), y = d[0] * q.y.x() + d[1] * q.y.y() + d[2] * q.y.z(),
                     z = d[0] * q.z.x() + d[1] * q.z.y() + d[2] * q.z.z();

        // The polynomial by powers of y; each row and its derivatives by Horner's rule.
        const auto& c = q.c;
        const double p0 = c[0] + x * (c[1] + x * (c[3] + x * (c[6] + x * c[10]))), p0x = c[1] + x * (2.0 * c[3] + x * (3.0 * c[6] + x * (4.0 * c[10]))),
                     p0xx = 2.0 * c[3] + x * (6.0 * c[6] + x * (12.0 * c[10]));
        const double p1 = c[2] + x * (c[4] + x * (c[7] + x * c[11])), p1x = c[4] + x * (2.0 * c[7] + x * (3.0 * c[11])),
                     p1xx = 2.0 * c[7] + x * (6.0 * c[11]);
        const double p2 = c[5] + x * (c[8] + x * c[12]), p2x = c[8] + x * (2.0 * c[12]), p2xx = 2.0 * c[12], p3 = c[9] + x * c[13], p3x = c[13], p4 = c[14];
        const double f = z - (p0 + y * (p1 + y * (p2 + y * (p3 + y * p4)))), hx = p0x + y * (p1x + y * (p2x + y * p3x)),
                     hy = p1 + y * (2.0 * p2 + y * (3.0 * p3 + y * (4.0 * p4)));
        const double hxx = p0xx + y * (p1xx + y * p2xx), hxy = p1x + y * (2.0 * p2x + y * (3.0 * p3x)), hyy = 2.0 * p2 + y * (6.0 * p3 + y * (12.0 * p4));

        std::array<double, 3> df {}, dw {}, a {}, b {};
        for (std::size_t k = 0; k < 3; ++k)
        {
            const auto axis = static_cast<int> (k);
            df[k] = q.z[axis] - hx * q.x[axis] - hy * q.y[axis];
            dw[k] = w1 * d[k];
            a[k] = w * (hxx * q.x[axis] + hxy * q.y[axis]);
            b[k] = w * (hxy * q.x[axis] + hyy * q.y[axis]);
            dW[k] += dw[k];
            dA[k] += w * df[k] + f * dw[k];
        }
        W += w;
        A += w * f;
        std::size_t m = 0;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = k; l < 3; ++l, ++m)
            {
                const auto axis = static_cast<int> (k);
                const double bends = w2 * d[k] * d[l] + (k == l ? w1 : 0.0);
                hW[m] += bends;
                hA[m] += dw[k] * df[l] + dw[l] * df[k] - q.x[axis] * a[l] - q.y[axis] * b[l] + f * bends;
            }
    }
    Value value;
    if (! (W > 0.0)) return value;
    value.known = true;
    value.g = A / W;
    for (int k = 0; k < 3; ++k)
        value.slope[k] = (dA[at (k)] - value.g * dW[at (k)]) / W;
    std::size_t m = 0;
    for (int k = 0; k < 3; ++k)
        for (int l = k; l < 3; ++l, ++m)
            value.bend (k, l) = value.bend (l, k) = (hA[m] - value.g * hW[m] - value.slope[k] * dW[at (l)] - dW[at (k)] * value.slope[l]) / W;
    return value;
}

/// Barycentric weights times a positive number, of the place of a triangle under x.
std::array<double, 3> SmoothBody::weightsOn (int triangle, const Vec3& x) const noexcept
{
    const auto& own = corners[at (triangle)];
    const Vec3 &a = nodes[at (own[0])].p, &b = nodes[at (own[1])].p, &c = nodes[at (own[2])].p;
    const Vec3 n = (b - a).cross (c - a), over_area = n / n.squaredNorm();
    return { (c - b).cross (x - b).dot (over_area), (a - c).cross (x - c).dot (over_area), (b - a).cross (x - a).dot (over_area) };
}

/// The triangle of the same face over which x is, walking from one of them. At a border, the last one before it.
int SmoothBody::walked (int triangle, const Vec3& x) const noexcept
{
    for (int step = 0; step < 100; ++step)
    {
        const auto weights = weightsOn (triangle, x);
        const auto lowest = std::ranges::min_element (weights) - weights.begin();
        const int next = beside[at (triangle)][at (lowest)];
        if (weights[at (lowest)] >= -margin (1e-9) || next < 0) break;
        triangle = next;
    }
    return triangle;
}

SmoothBody::Foot SmoothBody::footOn (int triangle, const Vec3& point) const noexcept
{
    Foot foot;
    foot.triangles[0] = triangle;
    foot.faces = 1;
    foot.point = point;
    return foot;
}

/// Newton's method on x - p + sum_i l_i grad g_i (x) = 0, g_i (x) = 0, over the faces that hold the foot. The pulls are the l_i.
bool SmoothBody::solve (Foot& foot, const Vec3& p) const noexcept
{
    auto& pulls = foot.pulls;
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 + most, 3 + most>;
    using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 + most, 1>;
    const int m = foot.faces;
    double last = std::numeric_limits<double>::infinity();
    const Value first = std::exchange (foot.value, {});
    for (int step = 0; step < 40; ++step)
    {
        std::array<Value, most> values;
        for (int i = 0; i < m; ++i)
        {
            auto& triangle = foot.triangles[at (i)];
            triangle = walked (triangle, foot.point);
            values[at (i)] = step == 0 && m == 1 && first.known ? first : valueAt (triangle, foot.point);
            if (! values[at (i)].known) return false;
        }
        Vec3 move;
        const double size = nodes[at (corners[at (foot.triangles[0])][0])].radius;
        if (m == 1)
        {
            const Value& v = values[0];
            const double gg = v.slope.squaredNorm();
            foot.normal = v.slope / std::sqrt (gg);
            pulls = { (p - foot.point).dot (v.slope) / gg, 0.0, 0.0 };
            const Vec3 a = foot.normal.unitOrthogonal(), b = foot.normal.cross (a), down = -v.g / gg * v.slope;
            const Mat3 k = Mat3::Identity() + pulls[0] * v.bend;
            const Vec3 r = p - foot.point - k * down;
            const double aa = a.dot (k * a), ab = a.dot (k * b), bb = b.dot (k * b), det = aa * bb - ab * ab;
            foot.found = aa > flattest && (aa - flattest) * (bb - flattest) > ab * ab;
            const double ra = r.dot (a), rb = r.dot (b);
            move = aa > 0.0 && det > 0.0 ? Vec3 { down + (bb * ra - ab * rb) / det * a + (aa * rb - ab * ra) / det * b } : Vec3 { down + ra * a + rb * b };
        }
        else
        {
            Matrix k = Matrix::Zero (3 + m, 3 + m);
            Column r (3 + m);
            if (step < 3)
            {
                Matrix g (3, m);
                for (int i = 0; i < m; ++i)
                    g.col (i) = values[at (i)].slope;
                const Column l = (g.transpose() * g).eval().fullPivLu().solve ((g.transpose() * (p - foot.point)).eval());
                for (int i = 0; i < m; ++i)
                    pulls[at (i)] = l[i];
            }
            Mat3 bend = Mat3::Identity();
            Vec3 rest = foot.point - p;
            for (int i = 0; i < m; ++i)
            {
                const Value& v = values[at (i)];
                bend += pulls[at (i)] * v.bend;
                rest += pulls[at (i)] * v.slope;
                k.block (0, 3 + i, 3, 1) = v.slope;
                k.block (3 + i, 0, 1, 3) = v.slope.transpose();
                r[3 + i] = -v.g;
            }
            k.topLeftCorner (3, 3) = bend;
            r.head (3) = -rest;
            const Column solved = k.fullPivLu().solve (r);
            move = solved.head (3);
            for (int i = 0; i < m; ++i)
                pulls[at (i)] += solved[3 + i];
            foot.found = true;
        }
        double length = move.norm();
        if (! isFinite (move)) return false;
        if (length > 0.5 * size)
        {
            move *= 0.5 * size / length;
            length = 0.5 * size;
        }
        foot.point += move;
        if (m == 1 && length < 1e-8 * size)   // so near that what changes within the move is known
        {
            Value& v = foot.value = values[0];
            v.g += v.slope.dot (move) + 0.5 * move.dot (v.bend * move);
            v.slope += v.bend * move;
        }
        const bool stuck = step > 3 && length > 0.5 * last && length < 1e-4 * size;   // by rounding
        if (length < 1e-6 * size || stuck) return foot.found;                         // the next move is of the order of its square
        last = length;
    }
    return false;
}

/// Takes away a face that would hold the tool back. True if there was one.
bool SmoothBody::leave (Foot& foot, double slack) noexcept
{
    if (foot.faces < 2) return false;
    int least = 0;
    for (int i = 1; i < foot.faces; ++i)
        if (foot.side * foot.pulls[at (i)] < foot.side * foot.pulls[at (least)]) least = i;
    if (foot.side * foot.pulls[at (least)] >= -slack) return false;
    std::shift_left (foot.triangles.begin() + least, foot.triangles.begin() + foot.faces, 1);
    --foot.faces;
    return true;
}

/// Adds a face that the foot has passed and that holds the tool, or notes one that does not. True if it added one.
bool SmoothBody::cross (Foot& foot, bool inside, double slack) const noexcept
{
    int added = -1;
    double farthest = slack;
    for (int i = 0; i < foot.faces && foot.faces < most; ++i)
    {
        const int triangle = foot.triangles[at (i)];
        for (int k = over.first[at (triangle)]; k < over.first[at (triangle + 1)]; ++k)
        {
            const int other = over.items[at (k)].triangle;
            const bool holds =
                std::any_of (foot.triangles.begin(), foot.triangles.begin() + foot.faces, [&] (int t) { return face[at (t)] == face[at (other)]; });
            if (holds) continue;
            const int there = walked (other, foot.point);
            const Value v = valueAt (there, foot.point);
            const double side = over.items[at (k)].bulges;
            if (! v.known || side * v.g <= slack) continue;
            if ((side < 0.0) != inside)
                foot.beyond = there;
            else if (side * v.g > farthest)
            {
                farthest = side * v.g;
                added = there;
                foot.side = side;
            }
        }
    }
    if (added < 0) return false;
    foot.triangles[at (foot.faces++)] = added;
    foot.beyond = -1;
    return true;
}

SmoothBody::Foot SmoothBody::followed (const Foot& before, const Vec3& p) const noexcept
{
    Foot foot = before;
    foot.found = foot.left = false;
    foot.beyond = -1;
    if (foot.faces == 0) return foot;
    const double slack = margin (1e-9) * nodes[at (corners[at (foot.triangles[0])][0])].radius;
    Vec3 away = Vec3::Zero();
    bool inside = false, settled = false;
    for (int round = 0; round < 12 && ! settled; ++round)
    {
        if (! solve (foot, p))
        {
            foot.found = false;
            return foot;
        }
        if (leave (foot, slack)) continue;
        away = p - foot.point;
        inside = foot.faces == 1 ? away.dot (foot.normal) < 0.0 : foot.side < 0.0;
        settled = ! cross (foot, inside, slack);
    }
    foot.found = foot.found && settled;
    foot.distance = (inside ? -1.0 : 1.0) * away.norm();
    // Near the surface, the gradient of g is more exact than the difference of two near points.
    const double least = foot.faces == 1 ? 1e-4 * nodes[at (corners[at (foot.triangles[0])][0])].radius : slack;
    if (std::abs (foot.distance) > least) foot.normal = away / foot.distance;
    for (int i = 0; i < foot.faces; ++i)
    {
        const int triangle = foot.triangles[at (i)];
        const auto weights = weightsOn (triangle, foot.point);
        for (std::size_t k = 0; k < 3; ++k)
        {
            if (weights[k] < -margin (1e-9) && rim[at (triangle)][k]) foot.left = true;
            if (weights[k] < -0.5) foot.found = false;   // far beyond a crease, where the fits know nothing
        }
    }
    return foot;
}

std::array<double, SmoothBody::most> SmoothBody::partsOf (const Foot& foot) noexcept
{
    std::array<double, most> parts { 1.0, 0.0, 0.0 };
    if (foot.faces < 2) return parts;
    double all = 0.0, sum = 0.0;
    for (int i = 0; i < foot.faces; ++i)
        all += foot.pulls[at (i)];
    for (int i = 0; i < foot.faces; ++i)
    {
        const double a = all != 0.0 ? std::clamp (foot.pulls[at (i)] / all, 0.0, 1.0) : 1.0 / foot.faces;
        sum += parts[at (i)] = a * a * (3.0 - 2.0 * a);
    }
    for (auto& part : parts)
        part /= sum;
    return parts;
}

SmoothBody::Motion SmoothBody::motionOf (const Foot& foot, const Vec3& p) const noexcept
{
    Motion motion;
    if (foot.faces == 1)
    {
        const Value v = foot.value.known ? foot.value : valueAt (foot.triangles[0], foot.point);
        const double gg = v.slope.squaredNorm(), pull = (p - foot.point).dot (v.slope) / gg;
        const Vec3 n = v.slope / std::sqrt (gg), a = n.unitOrthogonal(), b = n.cross (a);
        const Mat3 k = Mat3::Identity() + pull * v.bend;
        const double aa = a.dot (k * a), ab = a.dot (k * b), bb = b.dot (k * b), det = aa * bb - ab * ab;
        motion.foot = (bb * a * a.transpose() - ab * (a * b.transpose() + b * a.transpose()) + aa * b * b.transpose()) / det;
        const Vec3 ba = v.bend * a, bb_ = v.bend * b;
        const Mat3 mixed = a * b.transpose() + b * a.transpose();
        const Mat3 turn = (a.dot (ba) * a * a.transpose() + a.dot (bb_) * mixed + b.dot (bb_) * b * b.transpose()) / std::sqrt (gg);
        motion.normal = turn * motion.foot;
        return motion;
    }
    Mat3 k = Mat3::Identity();
    std::array<Vec3, most> slopes;
    for (int i = 0; i < foot.faces; ++i)
    {
        const Value v = valueAt (foot.triangles[at (i)], foot.point);
        slopes[at (i)] = v.slope;
        k += foot.pulls[at (i)] * v.bend;
    }
    if (foot.faces == 2)
    {
        const Vec3 t = direction (slopes[0].cross (slopes[1]));
        motion.foot = t * t.transpose() / t.dot (k * t);
    }
    if (std::abs (foot.distance) > 0.0)
        motion.normal = (Mat3::Identity() - foot.normal * foot.normal.transpose() - motion.foot) / foot.distance;

    // The change of the pulls: sum slopes_i dl_i = (1 - k motion.foot) dp.
    using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most>;
    Columns g (3, foot.faces);
    for (int i = 0; i < foot.faces; ++i)
        g.col (i) = slopes[at (i)];
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most> squared = g.transpose() * g;
    const Columns dual = g * squared.fullPivLu().inverse();
    const Mat3 rest = Mat3::Identity() - k * motion.foot;
    double all = 0.0, sum = 0.0;
    Vec3 all_slope = Vec3::Zero(), sum_slope = Vec3::Zero();
    std::array<Vec3, most> changes;
    for (int i = 0; i < foot.faces; ++i)
    {
        all += foot.pulls[at (i)];
        changes[at (i)] = rest.transpose() * dual.col (i);
        all_slope += changes[at (i)];
    }
    if (all == 0.0) return motion;
    std::array<double, most> smooth {};
    for (int i = 0; i < foot.faces; ++i)
    {
        const double a = std::clamp (foot.pulls[at (i)] / all, 0.0, 1.0);
        smooth[at (i)] = a * a * (3.0 - 2.0 * a);
        motion.parts[at (i)] = 6.0 * a * (1.0 - a) / all * (changes[at (i)] - a * all_slope);
        sum += smooth[at (i)];
        sum_slope += motion.parts[at (i)];
    }
    for (int i = 0; i < foot.faces; ++i)
        motion.parts[at (i)] = (motion.parts[at (i)] - smooth[at (i)] / sum * sum_slope) / sum;
    return motion;
}

}   // namespace tactus
