// SPDX-License-Identifier: MIT
#include "surface_check.hpp"
#include "mesh_walk.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

}   // namespace tactus
