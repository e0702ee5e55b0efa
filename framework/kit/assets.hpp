// SPDX-License-Identifier: MIT
#pragma once

/// The contents of files as nodes see them: plain arrays. The program reads the files; a node never sees a path.

#include "at.hpp"
#include "vec3.hpp"

#include <tactus/text/result.hpp>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tactus
{

/// A recording: one list of samples per channel, all of the same length.
struct Signal
{
    double rate_hz = 0.0;
    std::vector<std::vector<double>> channels;
};

/// Numbers in rows and columns, stored row after row.
struct Grid
{
    int rows = 0, columns = 0;
    std::vector<double> values;

    double operator() (int row, int column) const noexcept { return values[at (row) * at (columns) + at (column)]; }
};

/// The pixels of a picture, or the numbers of a table: both are grids, but come from different files.
struct Image
{
    std::shared_ptr<const Grid> grid;
};
struct Sheet
{
    std::shared_ptr<const Grid> grid;
};

/// Triangles, given by the indices of their points from 0, counter-clockwise as seen from outside.
struct Mesh
{
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles;

    int size() const noexcept { return static_cast<int> (triangles.size()); }   ///< number of triangles

    const Vec3& corner (int triangle, int i) const noexcept { return points[at (triangles[at (triangle)][at (i)])]; }
};

/// Loads the files that a graph names. Paths are as written in the graph, relative to its folder. Each function returns the
/// content of a file, or a message that says why there is none. [main thread]
class Assets
{
public:
    template <typename T>
    using Loaded = Result<std::shared_ptr<const T>>;

    virtual ~Assets() = default;
    virtual Loaded<Signal> signal (const std::string& path) = 0;   ///< WAV
    virtual Loaded<Grid> image (const std::string& path) = 0;      ///< PNG or JPEG: grey values from 0 (black) to 1 (white)
    virtual Loaded<Grid> table (const std::string& path) = 0;      ///< CSV
    virtual Loaded<Mesh> mesh (const std::string& path) = 0;       ///< OBJ, OFF, PLY or STL
};

}   // namespace tactus
