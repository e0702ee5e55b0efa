// SPDX-License-Identifier: MIT
#pragma once

#include "assets.hpp"
#include "law.hpp"

#include <Eigen/Core>

namespace tactus
{

/// A deflection ratio: a number, or a law of the depth.
struct Ratio
{
    double number = 0.0;
    Law law {};

    double operator() (double depth) const noexcept { return law ? law (depth) : number; }
};

/// A body that can be touched: a mesh, and at its nodes the frames and curves of force over deflection that the
/// chapter's section 4 interpolates between. In files the value of a setting of kind `surface`; see docs/graph_file.md.
struct Surface
{
    using Curves = std::array<Law, 3>;   ///< force over deflection along u^x, u^y and u^z

    std::shared_ptr<const Mesh> mesh;
    std::vector<Eigen::Matrix3d> frames;       ///< one a node, rows u^x, u^y, u^z, u^z inward; none: from the mesh
    std::vector<std::vector<Curves>> curves;   ///< of each tool: one a node, or one for all
    std::vector<Ratio> mu;                     ///< how far the contact gives sideways, over its depth: one a node, or one for all
};

}   // namespace tactus
