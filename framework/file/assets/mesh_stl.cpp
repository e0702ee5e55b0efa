// SPDX-License-Identifier: MIT
#include "binary.hpp"
#include "mesh_parts.hpp"

#include <algorithm>
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

/// Some programs write the words of the format in capitals.
bool isWord (std::string_view text, std::string_view word)
{
    return std::ranges::equal (text, word, [] (char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

/// True for text. A binary file may begin with "solid" too, and have more bytes after its triangles, but text has no zeros.
bool isText (std::string_view bytes)
{
    constexpr std::size_t word = 5, looked_at = 1000;
    auto start = bytes.substr (std::min (bytes.find_first_not_of (" \t\r\n"), bytes.size()));
    if (start.starts_with ("\xef\xbb\xbf")) start.remove_prefix (3);
    if (! isWord (start.substr (0, word), "solid")) return false;
    return bytes.size() != binarySize (bytes) && bytes.substr (0, looked_at).find ('\0') == bytes.npos;
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
        if (! isWord (takeWord (*line), "vertex")) continue;
        mesh.point (takePoint (*line, lines.number()), lines.number());
        if (mesh.points() % 3 == 0) addTriangle (mesh, lines.number());
    }
    if (mesh.points() % 3 != 0) throw MeshProblem { "mesh/truncated", "its last triangle is incomplete", lines.number() };
}

void readBinary (std::string_view bytes, MeshBuilder& mesh)
{
    // A title of text, and a number of triangles below 16 million: a byte of 0 is among the first 84 bytes of every binary file that is complete.
    const bool may_be_binary = bytes.substr (0, header).find ('\0') != bytes.npos || (bytes.size() >= header && bytes.size() >= binarySize (bytes));
    if (! bytes.empty() && ! may_be_binary) throw MeshProblem { "mesh/syntax", "it is neither a text that begins with 'solid', nor a binary .stl" };
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

/// Reads text or binary STL.
void readStl (std::string_view bytes, MeshBuilder& mesh)
{
    isText (bytes) ? readText (bytes, mesh) : readBinary (bytes, mesh);
}

}   // namespace tactus::readers
