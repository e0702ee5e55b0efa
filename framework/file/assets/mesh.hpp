// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <span>
#include <string_view>

namespace tactus::readers
{

/// Parses the bytes of an OBJ, OFF, PLY or STL file; the file name's extension selects the format.
///
/// All objects and groups of a file become one mesh. Points keep the order of the file; points closer than a millionth of
/// the mesh's size are merged into the first one, so that triangles share edges. Polygons are assumed to be convex and
/// split into triangles; triangles without area are dropped. Materials, colours and normals are ignored.
///
/// We use our own readers because Assimp 5.2.5 in Debian allocates gigabytes or aborts on truncated files. No input crashes
/// them.
///
/// Error ids: mesh/unknown_kind, mesh/syntax, mesh/truncated, mesh/no_such_point, mesh/no_triangles,
/// mesh/too_large.
/// `where` is name:line for text, name for binary files.
[[nodiscard]] Result<Mesh> readMesh (std::string_view bytes, std::string_view name);

/// A mesh of numbers that a program supplies, as readMesh would make it from a file: three coordinates per point, three indices from 0
/// per triangle. `name` is for messages. Error ids: mesh/syntax, mesh/no_such_point, mesh/no_triangles, mesh/too_large.
[[nodiscard]] Result<Mesh> meshOf (std::span<const double> points, std::span<const std::int32_t> triangles, std::string_view name);

}   // namespace tactus::readers
