// SPDX-License-Identifier: MIT
#pragma once

#include "assets.hpp"
#include "law.hpp"

#include <Eigen/Core>

namespace tactus
{

/// A deflection ratio: a number, or a law of depth.
struct Ratio
{
    double number = 0.0;
    Law law {};

    double operator() (double depth) const noexcept { return law ? law (depth) : number; }
};

/// A body that can be touched: a mesh with a frame and curves of force against deflection at each of its nodes. Section 4 of
/// the chapter interpolates between the nodes. In files it is the value of a setting of kind `surface`; see docs/graph_file.md.
struct Surface
{
    using Curves = std::array<Law, 3>;   ///< force against deflection along u^x, u^y and u^z

    std::shared_ptr<const Mesh> mesh;
    std::vector<Eigen::Matrix3d> frames;       ///< one per node, rows u^x, u^y, u^z, with u^z inward; empty: derived from the mesh
    std::vector<std::vector<Curves>> curves;   ///< by tool: one per node, or one for all nodes
    std::vector<Ratio> mu;                     ///< largest sideways deflection of the contact, over its depth: one per node, or one for all nodes
};

}   // namespace tactus
