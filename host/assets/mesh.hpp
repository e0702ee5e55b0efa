// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/assets.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <string_view>

namespace tactus::host
{

/// Reads the bytes of an OBJ, OFF, PLY or STL file; which of them, the ending of its name says.
///
/// All objects and groups of a file become one mesh. Points keep the order of the file; those nearer than a millionth of
/// its size are one, the first, so that triangles share their edges. Polygons are taken as convex and cut into
/// triangles; triangles without area are dropped. Materials, colours and normals are not read.
///
/// These readers are our own because Assimp 5.2.5, which Debian has, asks for gigabytes or aborts on files that are
/// cut off. No input crashes them.
///
/// Ids of errors: mesh/unknown_kind, mesh/syntax, mesh/truncated, mesh/no_such_point, mesh/no_triangles.
/// Where: name:line in text, name in binary files.
[[nodiscard]] tl::expected<Mesh, Error> readMesh (std::string_view bytes, std::string_view name);

}   // namespace tactus::host
