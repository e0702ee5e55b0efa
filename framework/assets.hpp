// SPDX-License-Identifier: MIT
#pragma once

/// What files hold, as nodes take it: plain arrays. Reading files is the host's business; a node never sees a path.

#include "list.hpp"

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tactus
{

/// A recording: one list of samples a channel, all of one length.
struct Signal
{
    double rate_hz = 0.0;
    std::vector<std::vector<double>> channels;
};

/// Numbers in rows and columns, row after row.
struct Grid
{
    int rows = 0, columns = 0;
    std::vector<double> values;

    double operator() (int row, int column) const noexcept { return values[static_cast<std::size_t> (row) * static_cast<std::size_t> (columns) + static_cast<std::size_t> (column)]; }
};

/// The pixels of a picture, the numbers of a table: both a grid, but read from different files.
struct Image
{
    std::shared_ptr<const Grid> grid;
};
struct Sheet
{
    std::shared_ptr<const Grid> grid;
};

/// Triangles between points, counted from 0, counter-clockwise as seen from outside.
struct Mesh
{
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles;
};

/// Where a graph's files come from. Paths are as written in the graph, made relative to its folder. Each returns the
/// content, or a sentence that says why there is none. [main thread]
class Assets
{
public:
    template <typename T>
    using Loaded = std::variant<std::shared_ptr<const T>, std::string>;

    virtual ~Assets() = default;
    virtual Loaded<Signal> signal (const std::string& path) = 0;   ///< a WAV
    virtual Loaded<Grid> image (const std::string& path) = 0;      ///< PNG or JPEG: grey from 0, black, to 1, white
    virtual Loaded<Grid> table (const std::string& path) = 0;      ///< a CSV
    virtual Loaded<Mesh> mesh (const std::string& path) = 0;       ///< OBJ, OFF, PLY or STL
};

}   // namespace tactus
