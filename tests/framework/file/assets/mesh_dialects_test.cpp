// SPDX-License-Identifier: MIT
// Random meshes as programs write them, read and compared with the originals.
#include <tactus/file/assets/mesh.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

using namespace tactus;

namespace
{
using Corners = std::array<Vec3, 3>;

struct Random
{
    std::mt19937 engine { 1 };

    int below (int n) { return std::uniform_int_distribution { 0, n - 1 }(engine); }
    bool once_in (int n) { return below (n) == 0; }
};

/// A strip of triangles over a hilly ground, on a grid of 1/8, so that floats hold its coordinates.
std::vector<Vec3> strip (Random& random)
{
    std::vector<Vec3> points;
    for (int i = 0, n = 3 + random.below (20); i < n; ++i)
        points.emplace_back (i / 2, i % 2, random.below (8) / 8.0);
    return points;
}

std::vector<Corners> trianglesOf (const std::vector<Vec3>& p)
{
    std::vector<Corners> all;
    for (std::size_t i = 2; i < p.size(); ++i)
        all.push_back (i % 2 == 0 ? Corners { p[i - 2], p[i - 1], p[i] } : Corners { p[i - 2], p[i], p[i - 1] });
    return all;
}

std::string textOf (const Vec3& p) { return std::to_string (p.x()) + " " + std::to_string (p.y()) + " " + std::to_string (p.z()); }

template <typename T>
std::string bytesOf (T value)
{
    std::string bytes;
    const auto bits = std::bit_cast<std::uint32_t> (value);
    for (unsigned i = 0; i < 4; ++i)
        bytes += static_cast<char> (bits >> 8 * i & 255u);
    return bytes;
}

std::string upper (std::string text)
{
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char> (c - 'a' + 'A');
    return text;
}

/// An .obj whose lines are continued at random places between words.
std::string asObj (const std::vector<Vec3>& points, Random& random)
{
    const std::string end = random.once_in (2) ? "\n" : "\r\n";
    std::string plain;
    for (const auto& p : points)
        plain += "v " + textOf (p) + "\n";
    for (std::size_t i = 2; i < points.size(); ++i)
    {
        const auto n = i + 1;
        plain += "f " + std::to_string (n - 2) + " " + std::to_string (i % 2 == 0 ? n - 1 : n) + " " + std::to_string (i % 2 == 0 ? n : n - 1) + "\n";
    }
    std::string text;
    for (const char c : plain)
        text += c == '\n' ? end : c == ' ' && random.once_in (6) ? " \\" + end
                                                                 : std::string (1, c);
    return text;
}

std::string asTextStl (const std::vector<Vec3>& points, Random& random)
{
    std::string text = "solid a\n";
    for (const auto& t : trianglesOf (points))
    {
        text += " facet normal 0 0 1\n  outer loop\n";
        for (const auto& p : t)
            text += "   vertex " + textOf (p) + "\n";
        text += "  endloop\n endfacet\n";
    }
    text += "endsolid a\n";
    return random.once_in (2) ? upper (text) : text;
}

std::string asBinaryStl (const std::vector<Vec3>& points, Random& random)
{
    const auto triangles = trianglesOf (points);
    std::string bytes = random.once_in (2) ? "solid by a program" : "a header";
    bytes.resize (80, random.once_in (2) ? ' ' : '\0');
    bytes += bytesOf (static_cast<std::uint32_t> (triangles.size()));
    for (const auto& t : triangles)
    {
        bytes += std::string (12, '\0');
        for (const auto& p : t)
            for (const double c : p)
                bytes += bytesOf (static_cast<float> (c));
        bytes += std::string (2, '\0');
    }
    return bytes + std::string (static_cast<std::size_t> (random.below (3)) * 10, '\0');
}

std::string asStripsPly (const std::vector<Vec3>& points, Random& random)
{
    const auto n = points.size();
    const bool is_binary = random.once_in (2);
    std::string bytes = "ply\nformat " + std::string (is_binary ? "binary_little_endian" : "ascii") + " 1.0\nelement vertex " + std::to_string (n)
                        + "\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    for (const auto& p : points)
        if (is_binary)
            for (const double c : p)
                bytes += bytesOf (static_cast<float> (c));
        else
            bytes += textOf (p) + "\n";
    // A strip may break anywhere; it goes on with its last two points, in the order that keeps the way round.
    std::vector<std::int32_t> strip { 0, 1 };
    for (std::size_t i = 2; i < n; ++i)
    {
        strip.push_back (static_cast<std::int32_t> (i));
        if (i + 1 < n && i % 2 == 1 && random.once_in (4)) strip.insert (strip.end(), { -1, static_cast<std::int32_t> (i) - 1, static_cast<std::int32_t> (i) });
    }
    if (is_binary)
    {
        bytes += bytesOf (static_cast<std::int32_t> (strip.size()));
        for (const auto i : strip)
            bytes += bytesOf (i);
        return bytes;
    }
    bytes += std::to_string (strip.size());
    for (const auto i : strip)
        bytes += " " + std::to_string (i);
    return bytes + "\n";
}
}   // namespace

TEST_CASE ("meshes of 300 dialects have the triangles that were written", "[file][assets][mesh]")
{
    Random random;
    for (int i = 0; i < 300; ++i)
    {
        const auto points = strip (random);
        const int kind = random.below (4);
        const auto bytes = kind == 0   ? asObj (points, random)
                           : kind == 1 ? asTextStl (points, random)
                           : kind == 2 ? asBinaryStl (points, random)
                                       : asStripsPly (points, random);
        const char* names[] { "a.obj", "a.STL", "b.stl", "a.ply" };
        INFO (names[kind] << "\n"
                          << (kind == 2 ? "" : bytes));
        const auto mesh = readers::readMesh (bytes, names[kind]);
        INFO ((mesh ? "" : describe (mesh.error())));
        REQUIRE (mesh);
        const auto wanted = trianglesOf (points);
        REQUIRE (mesh->triangles.size() == wanted.size());
        for (std::size_t t = 0; t < wanted.size(); ++t)
            for (std::size_t c = 0; c < 3; ++c)
                REQUIRE (mesh->points[static_cast<std::size_t> (mesh->triangles[t][c])] == wanted[t][c]);
    }
}
