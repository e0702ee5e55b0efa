// SPDX-License-Identifier: MIT
#include "surface_check.hpp"
#include "mesh_walk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus
{

namespace
{
std::string lengthText (double metres)
{
    const auto micrometres = std::lround (metres * 1e6);
    return micrometres < 10'000 ? std::to_string (micrometres) + " um" : std::to_string (micrometres / 1000) + " mm";
}

/// True if a slip over a triangle generates energy at this depth.
bool gains (const Surface& s, int triangle, const std::array<Vec3, 3>& gradients, const std::vector<Surface::Curves>& tool, double depth)
{
    Vec3 slope = Vec3::Zero();
    double drag = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i)
    {
        const auto node = at (s.mesh->triangles[at (triangle)][i]);
        const double ratio = s.mu.empty() ? 0.0 : s.mu[s.mu.size() == 1 ? 0 : node](depth);
        const auto& [x, y, z] = tool[node];
        slope += gradients[i] * (z.energy (depth) + std::max (x.energy (ratio * depth), y.energy (ratio * depth)));
        drag = std::min (drag, std::min (x (ratio * depth), y (ratio * depth)));
    }
    return drag < slope.norm();
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
    return {};
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
        if (s.frames[i].row (2).dot (normals[i].transpose()) > 0.0) return sentence (i);
    return {};
}

std::string leaning (const Surface& s)
{
    constexpr double level = 0.9962;   // cos 5 degrees
    const auto normals = normalsOf (*s.mesh);
    double least = 1.0;
    for (int t = 0; t < s.mesh->size(); ++t)
    {
        const Vec3 up = direction (areaNormal (cornersOf (*s.mesh, t)));
        for (const int c : s.mesh->triangles[at (t)])
        {
            const auto i = at (c);
            least = std::min (least, s.frames.empty() ? up.dot (normals[i]) : -up.dot (Vec3 (s.frames[i].row (2).transpose())));
        }
    }
    if (least > level) return {};
    const auto degrees = std::lround (std::acos (std::clamp (least, -1.0, 1.0)) * 180.0 / std::numbers::pi);
    return "frames are tilted by up to " + std::to_string (degrees)
           + " degrees against their triangles: without friction, a closed path may generate energy. A finer mesh reduces the tilt";
}

std::string slipGain (const Surface& s, double scale)
{
    constexpr double deep = 0.02;   // deeper than a hand presses
    const auto [triangle, depth] = shallowestGain (s, scale);
    if (depth > deep) return {};
    return "when the tool is pressed in deeper than " + lengthText (depth) + ", a slip over triangle " + std::to_string (triangle)
           + " generates energy: its nodes differ too much for so little friction. Raise mu or the curves of x and y, or make the curves of z more alike";
}

SlipGain shallowestGain (const Surface& s, double scale)
{
    SlipGain least;
    for (const auto& tool : s.curves)
    {
        if (tool.size() == 1) continue;   // the curves of this tool are the same everywhere
        for (int t = 0; t < s.mesh->size(); ++t)
        {
            auto corners = cornersOf (*s.mesh, t);
            for (auto& c : corners)
                c *= scale;
            const auto gradients = gradientsOf (corners);
            for (double depth = 1e-5; depth < least.depth && depth < 1.0; depth *= 1.1)
                if (gains (s, t, gradients, tool, depth)) least = { t, depth };
        }
    }
    return least;
}

}   // namespace tactus
