// SPDX-License-Identifier: MIT
#include "faces.hpp"
#include "mesh_walk.hpp"
#include <tactus/kit/math/math.hpp>

namespace tactus
{

std::vector<int> facesOf (const Mesh& mesh, const MeshWalk& walk, double crease)
{
    const double least = math::cos (crease) - 1e-9;
    std::vector<Vec3> normals;
    normals.reserve (mesh.triangles.size());
    for (int t = 0; t < mesh.size(); ++t)
        normals.push_back (direction (areaNormal (cornersOf (mesh, t))));
    std::vector<int> face (mesh.triangles.size(), -1), todo;
    int faces = 0;
    for (int start = 0; start < mesh.size(); ++start)
    {
        if (face[at (start)] >= 0) continue;
        face[at (start)] = faces;
        for (todo = { start }; ! todo.empty();)
        {
            const int t = todo.back();
            todo.pop_back();
            for (int i = 0; i < 3; ++i)
                if (const int other = walk.beside (t, i); other >= 0 && face[at (other)] < 0 && normals[at (t)].dot (normals[at (other)]) >= least)
                {
                    face[at (other)] = faces;
                    todo.push_back (other);
                }
        }
        ++faces;
    }
    return face;
}

}   // namespace tactus
