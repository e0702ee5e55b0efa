// SPDX-License-Identifier: MIT
#pragma once

/// How the code that `tactus export` writes turns constant tables into the settings of nodes, in `prepare`.

#include <tactus/kit/surface.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace tactus::exported
{

using Numbers = std::span<const double>;

inline std::vector<double> listOf (Numbers numbers) { return { numbers.begin(), numbers.end() }; }

/// A Law whose table is constant data.
struct LawData
{
    Law::Kind kind = Law::Kind::none;
    double a = 0.0, b = 1.0;
    Numbers x {}, y {};

    Law law() const { return { kind, a, b, { listOf (x), listOf (y) } }; }
};

/// A Ratio whose tables are constant data.
struct RatioData
{
    double number = 0.0;
    LawData law {};
    Numbers x {}, y {};

    Ratio ratio() const { return { number, law.law(), { listOf (x), listOf (y) } }; }
};

/// Three numbers per point, three indices per triangle.
inline std::shared_ptr<const Mesh> meshOf (Numbers points, std::span<const int> triangles)
{
    auto mesh = std::make_shared<Mesh>();
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
        mesh->points.emplace_back (points[i], points[i + 1], points[i + 2]);
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
        mesh->triangles.push_back ({ triangles[i], triangles[i + 1], triangles[i + 2] });
    return mesh;
}

/// Nine numbers per frame, row after row.
inline std::vector<Eigen::Matrix3d> framesOf (Numbers numbers)
{
    std::vector<Eigen::Matrix3d> all;
    for (std::size_t i = 0; i + 8 < numbers.size(); i += 9)
    {
        auto& frame = all.emplace_back();
        for (int k = 0; k < 9; ++k)
            frame (k / 3, k % 3) = numbers[i + at (k)];
    }
    return all;
}

/// Three laws per node.
inline std::vector<Surface::Curves> curvesOf (std::span<const LawData> laws)
{
    std::vector<Surface::Curves> all;
    for (std::size_t i = 0; i + 2 < laws.size(); i += 3)
        all.push_back ({ laws[i].law(), laws[i + 1].law(), laws[i + 2].law() });
    return all;
}

inline std::vector<Ratio> ratiosOf (std::span<const RatioData> ratios)
{
    std::vector<Ratio> all;
    for (const auto& ratio : ratios)
        all.push_back (ratio.ratio());
    return all;
}

}   // namespace tactus::exported
