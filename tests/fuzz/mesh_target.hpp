// SPDX-License-Identifier: MIT
#pragma once

#include "whole_error.hpp"

#include <tactus/file/assets/mesh.hpp>

#include <string>

namespace tactus::fuzz
{

/// Reads the bytes as each kind of mesh file. Either every triangle has three different finite points, or reading reports an
/// error with its location. Aborts otherwise.
inline void tryMesh (std::string_view bytes)
{
    for (const auto* name : { "fuzz.obj", "fuzz.off", "fuzz.ply", "fuzz.stl" })
    {
        const auto mesh = readers::readMesh (bytes, name);
        if (! mesh)
        {
            checkWhole (mesh.error());
            continue;
        }
        if (mesh->triangles.empty()) std::abort();
        for (const auto& p : mesh->points)
            if (! isFinite (p)) std::abort();
        for (const auto& t : mesh->triangles)
        {
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) std::abort();
            for (const int corner : t)
                if (corner < 0 || corner >= static_cast<int> (mesh->points.size())) std::abort();
        }
    }
}

}   // namespace tactus::fuzz
