// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/kit/curve.hpp>
#include <tactus/kit/law.hpp>
#include <tactus/kit/vec3.hpp>

namespace tactus
{

/// A deflection ratio: a number, a law of depth, or a curve of depth that is constant beyond its ends.
struct Ratio
{
    double number = 0.0;
    Law law {};
    Curve curve {};

    bool isNone() const noexcept { return ! law && curve.empty() && number == 0.0; }

    double operator() (double depth) const noexcept
    {
        if (law) return law (depth);
        return curve.empty() ? number : curve (depth);
    }
};

/// A body that can be touched: a mesh with a frame and curves of force against deflection at each of its nodes. Section 4 of
/// the chapter interpolates between the nodes. The curves are given for one or more shapes of tools. In files, a surface is the value
/// of a setting of kind `surface`; see docs/graph_file.md.
struct Surface
{
    using Curves = std::array<Law, 3>;   ///< force against deflection along u^x, u^y and u^z

    std::shared_ptr<const Mesh> mesh;
    /// Rows u^x, u^y, u^z, with u^z inward: one per node; or one per shape and node, those of the first shape first. Empty: derived
    /// from the mesh.
    std::vector<Eigen::Matrix3d> frames;
    std::vector<std::vector<Curves>> curves;   ///< by shape: one per node, or one for all nodes

    /// Largest sideways deflection of the contact, over its depth: one for all nodes; one per node; or one per shape and node, those
    /// of the first shape first.
    std::vector<Ratio> mu;

    /// By tool, then by node (or one entry for all nodes): the share of each shape in the response. Shares are at least 0 and add up
    /// to 1. Empty: tool number t is shape t.
    std::vector<std::vector<std::vector<double>>> weights {};
};

}   // namespace tactus
