// SPDX-License-Identifier: MIT
#include "binary.hpp"
#include "mesh_parts.hpp"

#include <cstdint>

namespace tactus::readers
{

namespace
{
constexpr std::size_t title = 80, header = title + 4;   // in bytes; the header ends with the number of triangles
constexpr std::size_t facet = 4 * 3 * 4 + 2;            // in bytes: normal, three corners, attributes

std::size_t binarySize (std::string_view bytes)
{
    if (bytes.size() < header) return 0;
    auto count = bytes.substr (title);
    return header + facet * *takeNumber<std::uint32_t> (count, std::endian::little);
}

void addTriangle (MeshBuilder& mesh, std::size_t line = 0)
{
    const auto n = mesh.points();
    mesh.face (std::array { n - 3, n - 2, n - 1 }, line);
}

void readText (std::string_view bytes, MeshBuilder& mesh)
{
    Lines lines (bytes);
    while (auto line = lines.next())
    {
        if (takeWord (*line) != "vertex") continue;
        mesh.point (takePoint (*line, lines.number()), lines.number());
        if (mesh.points() % 3 == 0) addTriangle (mesh, lines.number());
    }
    if (mesh.points() % 3 != 0) throw MeshProblem { "mesh/truncated", "its last triangle is incomplete", lines.number() };
}

void readBinary (std::string_view bytes, MeshBuilder& mesh)
{
    if (bytes.size() < header || bytes.size() < binarySize (bytes)) throw MeshProblem { "mesh/truncated", "it has fewer triangles than its header says" };
    bytes = bytes.substr (header, binarySize (bytes) - header);
    while (! bytes.empty())
    {
        auto corners = bytes.substr (std::size_t { 3 } * 4);
        for (int corner = 0; corner < 3; ++corner)
        {
            Vec3 at;
            for (auto& coordinate : at)
                coordinate = static_cast<double> (*takeNumber<float> (corners, std::endian::little));
            mesh.point (at);
        }
        addTriangle (mesh);
        bytes.remove_prefix (facet);
    }
}
}   // namespace

/// Reads text or binary STL; a binary file may also start with the word "solid".
void readStl (std::string_view bytes, MeshBuilder& mesh)
{
    const bool text = bytes.starts_with ("solid") && bytes.size() != binarySize (bytes);
    text ? readText (bytes, mesh) : readBinary (bytes, mesh);
}

}   // namespace tactus::readers
