// SPDX-License-Identifier: MIT
#include "surface_check.hpp"
#include "faces.hpp"
#include "mesh_walk.hpp"
#include "smooth_body.hpp"
#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace tactus
{

namespace
{
std::string badWeights (const Surface& s)
{
    constexpr double rounding = 1e-6;
    for (std::size_t t = 0; t < s.weights.size(); ++t)
        for (std::size_t i = 0; i < s.weights[t].size(); ++i)
        {
            const auto& shares = s.weights[t][i];
            const bool convex = std::ranges::all_of (shares, [] (double w) { return w >= 0.0; })
                                && std::abs (std::accumulate (shares.begin(), shares.end(), 0.0) - 1.0) <= rounding;
            if (convex) continue;
            return "the weights of tool " + std::to_string (t) + ", node " + std::to_string (i) + " must be at least 0, and their sum must be 1";
        }
    return {};
}
}   // namespace

std::string problemOf (const Surface& s)
{
    if (s.mesh->triangles.empty()) return "its mesh has no triangles";
    if (s.curves.empty()) return "it has no curves";
    for (int t = 0; t < s.mesh->size(); ++t)
        if (! (areaNormal (cornersOf (*s.mesh, t)).squaredNorm() > 0.0)) return "triangle " + std::to_string (t) + " has no area";
    for (std::size_t i = 0; i < s.frames.size(); ++i)
        if (! (s.frames[i] * s.frames[i].transpose()).isIdentity (1e-6) || s.frames[i].determinant() < 0.0)
            return "the frame of node " + std::to_string (i) + " is not orthonormal and right-handed: its rows must have length 1"
                   + " and be at right angles, with u^z = u^x x u^y";
    for (std::size_t t = 0; t < s.curves.size(); ++t)
        for (std::size_t i = 0; i < s.curves[t].size(); ++i)
            if (const Law& z = s.curves[t][i][2]; ! z.table.empty() && *std::ranges::min_element (z.table.y) < 0.0)
                return "the z curve of tool " + std::to_string (t) + ", node " + std::to_string (i) + " is negative: a resistance must not pull";
    return badWeights (s);
}

namespace
{
std::string short3 (double v) { return roundedText (v, 3); }

std::string placeOf (const Mesh& mesh, int t)
{
    const auto [a, b, c] = cornersOf (mesh, t);
    const Vec3 middle = (a + b + c) / 3.0;
    return "triangle " + std::to_string (t) + ", around (" + short3 (middle.x()) + ", " + short3 (middle.y()) + ", " + short3 (middle.z()) + ") of the file";
}

/// The connected pieces of a mesh, and the triangles whose corners run the other way round than those of most of their piece.
struct Orientation
{
    std::vector<char> turned;    // by triangle
    std::vector<int> piece;      // by triangle
    std::vector<char> is_open;   // by piece
    int pieces = 0;
};

Orientation orientationOf (const Mesh& mesh)
{
    struct Use
    {
        int triangle;
        bool forwards;
    };
    std::map<std::pair<int, int>, std::vector<Use>> edges;
    for (int t = 0; t < mesh.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
        {
            const int a = mesh.triangles[at (t)][i], b = mesh.triangles[at (t)][(i + 1) % 3];
            edges[std::minmax (a, b)].push_back ({ t, a < b });
        }
    std::vector<std::vector<std::pair<int, bool>>> beside (mesh.triangles.size());   // neighbour, and whether it runs the same way round
    std::vector<char> has_rim (mesh.triangles.size());
    for (const auto& [ends, uses] : edges)
    {
        if (uses.size() == 1) has_rim[at (uses[0].triangle)] = 1;
        if (uses.size() != 2) continue;   // where three meet, no two of them are neighbours
        const bool agrees = uses[0].forwards != uses[1].forwards;
        beside[at (uses[0].triangle)].emplace_back (uses[1].triangle, agrees);
        beside[at (uses[1].triangle)].emplace_back (uses[0].triangle, agrees);
    }
    Orientation made { std::vector<char> (mesh.triangles.size()), std::vector<int> (mesh.triangles.size(), -1), {}, 0 };
    for (int first = 0; first < mesh.size(); ++first)
    {
        if (made.piece[at (first)] >= 0) continue;
        std::vector<int> all { first };
        made.piece[at (first)] = made.pieces;
        bool is_open = false;
        for (std::size_t i = 0; i < all.size(); ++i)
        {
            const int t = all[i];
            is_open = is_open || has_rim[at (t)] != 0;
            for (const auto& [other, agrees] : beside[at (t)])
                if (made.piece[at (other)] < 0)
                {
                    made.piece[at (other)] = made.pieces;
                    made.turned[at (other)] = static_cast<char> (made.turned[at (t)] ^ (agrees ? 0 : 1));
                    all.push_back (other);
                }
        }
        // The direction of most of the area counts as right.
        double area[2] { 0.0, 0.0 };
        for (const int t : all)
            area[made.turned[at (t)] != 0 ? 1 : 0] += areaNormal (cornersOf (mesh, t)).norm();
        if (area[1] > area[0])
            for (const int t : all)
                made.turned[at (t)] ^= 1;
        made.is_open.push_back (is_open ? 1 : 0);
        ++made.pieces;
    }
    return made;
}

/// The volume of a piece of a mesh as seen from its middle, below 0 if it is inside out, and its openness: the sum of its normals over its area, which is
/// 0 for a closed piece and 1 for a flat one.
struct PieceShape
{
    double volume = 0.0, openness = 0.0;
};

PieceShape shapeOf (const Mesh& mesh, const Orientation& orientation, int piece)
{
    Vec3 middle = Vec3::Zero(), sum = Vec3::Zero();
    double area = 0.0;
    PieceShape made;
    for (const bool second : { false, true })
        for (int t = 0; t < mesh.size(); ++t)
        {
            if (orientation.piece[at (t)] != piece) continue;
            const auto corners = cornersOf (mesh, t);
            const Vec3 n = areaNormal (corners), centre = (corners[0] + corners[1] + corners[2]) / 3.0;
            if (second)
                made.volume += (centre - middle / area).dot (n);
            else
            {
                area += n.norm();
                middle += n.norm() * centre;
                sum += n;
            }
        }
    made.openness = sum.norm() / area;
    return made;
}

/// The warning about triangles of a mesh without frames whose corners run the wrong way round; empty if all is well.
std::string wrongWayRound (const Mesh& mesh)
{
    const auto orientation = orientationOf (mesh);
    if (const auto found = std::ranges::find (orientation.turned, 1); found != orientation.turned.end())
    {
        const auto count = std::ranges::count (orientation.turned, 1);
        return placeOf (mesh, static_cast<int> (found - orientation.turned.begin()))
               + (count > 1 ? " and " + std::to_string (count - 1) + " more run" : std::string (" runs"))
               + " through an edge in the same direction as a neighbour, so the mesh faces inwards there, and cannot be felt from outside: reverse the order"
                 " of the corners of these faces (\"recalculate normals outside\" in 3-D programs)";
    }
    constexpr int most_pieces = 64;          // each takes a pass over the mesh
    constexpr double nearly_closed = 0.45;   // a hemisphere has 0.5, and may be a bowl
    for (int piece = 0; piece < std::min (orientation.pieces, most_pieces); ++piece)
    {
        const auto shape = shapeOf (mesh, orientation, piece);
        const bool is_open = orientation.is_open[at (piece)] != 0;
        if (! (shape.volume < 0.0) || (is_open && shape.openness > nearly_closed)) continue;
        const auto first = static_cast<int> (std::ranges::find (orientation.piece, piece) - orientation.piece.begin());
        if (! is_open)
            return "the surface faces inwards at node " + std::to_string (mesh.triangles[at (first)][0])
                   + " and attracts there: reverse the triangles of the mesh, or u^z of the frame at this node";
        return "the mesh is open, and its faces point to its middle, as at " + placeOf (mesh, first)
               + ": it can be felt only from inside; reverse its triangles, unless it is a hollow that is meant to be felt from inside";
    }
    return {};
}
}   // namespace

std::string wrongSide (const Surface& s)
{
    if (s.frames.empty()) return wrongWayRound (*s.mesh);
    const auto sentence = [] (std::size_t node) {
        const auto problem = "the surface faces inwards at node " + std::to_string (node) + " and attracts there";
        return problem + ": reverse the triangles of the mesh, or u^z of the frame at this node";
    };
    const auto normals = normalsOf (*s.mesh);
    for (std::size_t i = 0; i < s.frames.size(); ++i)
        if (s.frames[i].row (2).dot (normals[i % normals.size()].transpose()) > 0.0) return sentence (i % normals.size());
    return {};
}

std::string sharpEdges (const Surface& s, double crease, const std::vector<double>& radii)
{
    const Mesh& mesh = *s.mesh;
    const MeshWalk walk (mesh);
    const auto face = facesOf (mesh, walk, crease);
    int edges = 0;
    for (int t = 0; t < mesh.size(); ++t)
        for (int i = 0; i < 3; ++i)
            if (const int other = walk.beside (t, i); other > t && face[at (other)] != face[at (t)])
            {
                const Vec3 centre = (mesh.corner (t, 0) + mesh.corner (t, 1) + mesh.corner (t, 2)) / 3.0;
                edges += areaNormal (cornersOf (mesh, other)).dot (centre - mesh.corner (other, 0)) < 0.0;
            }
    if (edges == 0) return {};
    const double least = radii.empty() ? 0.0 : *std::ranges::min_element (radii);
    const std::string from = least > 0.0 ? "from a depth of " + roundedText (1e3 * least, 3) + " mm, the radius of the tool, a slide over them"
                                         : "a slide over them at any depth";
    return "the body has sharp edges (" + std::to_string (edges) + " in the mesh): " + from + " is felt as a step of the force; "
           + (least > 0.0 ? "press less deep there, or give the tool a larger tool_radius" : "give the tool a tool_radius larger than the depth of a touch");
}

namespace
{
double degreesBetween (const Vec3& a, const Vec3& b) { return math::atan2 (a.cross (b).norm(), a.dot (b)) * 180.0 / std::numbers::pi; }
}   // namespace

std::string coarseFaces (const Surface& s, double crease)
{
    constexpr double doubtful = 45.0, wrong = 45.0;   // degrees
    constexpr std::size_t most = 50;                  // triangles; a graph is judged at each edit
    const Mesh& mesh = *s.mesh;
    const MeshWalk walk (mesh);
    const auto face = facesOf (mesh, walk, crease);
    const auto normal = [&] (int t) { return areaNormal (cornersOf (mesh, t)); };
    std::vector<int> bent;
    double sharpest = 0.0;
    for (int t = 0; t < mesh.size(); ++t)
    {
        double angle = 0.0;
        for (int i = 0; i < 3; ++i)
            if (const int other = walk.beside (t, i); other >= 0 && face[at (other)] == face[at (t)])
                angle = std::max (angle, degreesBetween (normal (t), normal (other)));
        if (angle > doubtful) bent.push_back (t);
        sharpest = std::max (sharpest, angle);
    }
    if (bent.empty()) return {};
    const SmoothBody body (walk, crease);
    double worst = 0.0;
    int there = -1;
    for (std::size_t i = 0; i < bent.size(); i += 1 + bent.size() / most)
    {
        const Vec3 middle = (mesh.corner (bent[i], 0) + mesh.corner (bent[i], 1) + mesh.corner (bent[i], 2)) / 3.0;
        const auto foot = body.followed (body.footOn (bent[i], middle), middle);
        const double leans = foot.found ? degreesBetween (foot.normal, normal (bent[i])) : 180.0;
        if (leans <= std::max (worst, wrong)) continue;
        worst = leans;
        there = bent[i];
    }
    if (there < 0) return {};
    const std::string how = worst < 180.0 ? "leans by " + roundedText (worst, 2) + " degrees from the mesh" : "is lost";
    return "the mesh is too coarse for round edges: the smooth surface through its points " + how + " at " + placeOf (mesh, there) + "; set crease below "
           + roundedText (sharpest, 3) + " degrees, the sharpest of these edges, or refine the mesh near its edges";
}

std::string abruptStiffness (const Surface& s)
{
    constexpr double pressed = 1e-3, steep = 0.5 * (1.0 - 1e-9), little = 0.1;   // m; of the change around; of the force
    const Mesh& mesh = *s.mesh;
    const auto eachEdge = [&] (const auto& use) {
        for (const auto& corners : mesh.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                use (at (corners[i]), at (corners[(i + 1) % 3]));
    };
    double worst = 0.0;
    std::size_t from = 0, to = 0;
    for (const auto& nodes : s.curves)
    {
        if (nodes.size() == 1) continue;
        std::vector<double> force;
        force.reserve (nodes.size());
        for (const auto& curves : nodes)
            force.push_back (curves[2](pressed));
        auto low = force, high = force;   // of the points up to two edges away
        for (int ring = 0; ring < 2; ++ring)
        {
            const auto low_before = low, high_before = high;
            eachEdge ([&] (std::size_t a, std::size_t b) {
                low[a] = std::min (low[a], low_before[b]);
                low[b] = std::min (low[b], low_before[a]);
                high[a] = std::max (high[a], high_before[b]);
                high[b] = std::max (high[b], high_before[a]);
            });
        }
        eachEdge ([&] (std::size_t a, std::size_t b) {
            const double most = std::max (high[a], high[b]), range = most - std::min (low[a], low[b]), change = std::abs (force[a] - force[b]);
            if (range <= little * most || change < steep * range || change / most <= worst) return;
            worst = change / most;
            from = force[a] < force[b] ? a : b;
            to = force[a] < force[b] ? b : a;
        });
    }
    if (worst == 0.0) return {};
    const Vec3& p = mesh.points[to];
    return "the stiffness changes over fewer than three cells of the mesh, so it is felt to change more slowly: between the points " + std::to_string (from)
           + " and " + std::to_string (to) + ", at (" + short3 (p.x()) + ", " + short3 (p.y()) + ", " + short3 (p.z())
           + ") of the file; refine the mesh there, or let the stiffness change over more cells";
}

std::string faultsOf (const Surface& surface, double crease, const std::vector<double>& radii)
{
    auto all = wrongSide (surface);
    const auto add = [&] (const std::string& more) { all += (all.empty() || more.empty() ? "" : "; ") + more; };
    if (all.empty())
    {
        add (coarseFaces (surface, crease));
        add (sharpEdges (surface, crease, radii));
    }
    add (abruptStiffness (surface));
    return all;
}

}   // namespace tactus
