// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

/// What a simulator hands from one library to another.
struct Body
{
    double mass = 0.0;
    Eigen::Vector4d wheel_loads = Eigen::Vector4d::Zero();
    Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    Eigen::MatrixXd inertia;
    double drag = 0.0;
};

using Layout = std::vector<std::size_t>;

namespace with
{
Layout layout();
Body made();
double sum (const Body&);
}   // namespace with

namespace without
{
Layout layout();
Body made();
double sum (const Body&);
}   // namespace without
