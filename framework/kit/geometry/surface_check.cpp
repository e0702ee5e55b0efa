// SPDX-License-Identifier: MIT
#include "surface_check.hpp"
#include "mesh_walk.hpp"
#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tactus
{

namespace
{
constexpr double level = 1.0 - margin (1e-12);   // the cosine of the largest angle that counts as 0

/// The cosine of the largest angle between a frame and the normal of a triangle at its node.
double mostTilted (const Surface& s)
{
    double least = 1.0;
    for (int t = 0; t < s.mesh->size(); ++t)
    {
        const Vec3 up = direction (areaNormal (cornersOf (*s.mesh, t)));
        for (const int c : s.mesh->triangles[at (t)])
            for (std::size_t i = at (c); i < s.frames.size(); i += s.mesh->points.size())
                least = std::min (least, -up.dot (Vec3 (s.frames[i].row (2).transpose())));
    }
    return least;
}

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

std::string wrongSide (const Surface& s)
{
    const auto sentence = [] (std::size_t node) {
        const auto problem = "the surface faces inwards at node " + std::to_string (node) + " and attracts there";
        return problem + ": reverse the triangles of the mesh, or u^z of the frame at this node";
    };
    if (s.frames.empty()) return isInsideOut (*s.mesh) ? sentence (0) : "";
    const auto normals = normalsOf (*s.mesh);
    for (std::size_t i = 0; i < s.frames.size(); ++i)
        if (s.frames[i].row (2).dot (normals[i % normals.size()].transpose()) > 0.0) return sentence (i % normals.size());
    return {};
}

bool isFlat (const Surface& s)
{
    const Vec3 up = direction (areaNormal (cornersOf (*s.mesh, 0)));
    for (int t = 1; t < s.mesh->size(); ++t)
        if (up.dot (direction (areaNormal (cornersOf (*s.mesh, t)))) < level) return false;
    return true;
}

bool isPatchThatLeans (const Surface& s) { return ! s.frames.empty() && isFlat (s) && mostTilted (s) < level; }

std::string leaning (const Surface& s)
{
    constexpr double much = 0.9962;   // cos 5 degrees
    if (! isPatchThatLeans (s)) return {};
    const double least = mostTilted (s);
    if (least > much) return {};
    const auto degrees = std::lround (math::acos (std::clamp (least, -1.0, 1.0)) * 180.0 / std::numbers::pi);
    return "the body is flat, but its frames are tilted by up to " + std::to_string (degrees)
           + " degrees: without friction, a closed path may generate energy. Leave the frames out, or make them level";
}

}   // namespace tactus
