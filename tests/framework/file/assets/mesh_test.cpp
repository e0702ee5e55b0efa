// SPDX-License-Identifier: MIT
#include "support/with_limits.hpp"

#include <support/property.hpp>
#include <tactus/file/assets/mesh.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cstring>

using namespace tactus;
using readers::readMesh;

namespace
{
using Triangles = std::vector<std::array<int, 3>>;

/// A tetrahedron: four faces that share four corners.
const std::vector<Vec3> corners { { 0, 0, 0 }, { 0.5, 0, 0 }, { 0, 0.25, 0 }, { 0, 0, -0.125 } };
const Triangles faces { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } };

std::string textOf (const Vec3& p)
{
    std::string text;
    for (const double c : p)
        text += std::to_string (c) + " ";
    return text;
}

std::string obj()
{
    std::string text = "# a comment\nmtllib none.mtl\no body\n";
    for (const auto& p : corners)
        text += "v " + textOf (p) + "\n";
    text += "vn 0 0 1\nvt 0 0\ng one\n";
    for (const auto& f : faces)
        text += "f " + std::to_string (f[0] + 1) + "/1/1 " + std::to_string (f[1] - 4) + "//1 " + std::to_string (f[2] + 1)
                + " # from the front, from the end\ng other\nusemtl none\n";
    return text;
}

std::string off (const std::string& head)
{
    std::string text = head;
    for (const auto& p : corners)
        text += textOf (p) + " 255 0 0\n";
    for (const auto& f : faces)
        text += "3 " + std::to_string (f[0]) + " " + std::to_string (f[1]) + " " + std::to_string (f[2]) + " 0.5 0.5 0.5\n\n# between\n";
    return text;
}

template <typename T>
std::string bytesOf (T value, std::endian order = std::endian::little)
{
    std::string bytes (sizeof value, '\0');
    std::memcpy (bytes.data(), &value, sizeof value);
    if (order != std::endian::native) std::ranges::reverse (bytes);
    return bytes;
}

std::string plyHead (const std::string& format)
{
    return "ply\nformat " + format + " 1.0\ncomment of a test\nelement vertex 4\nproperty float x\nproperty double y\nproperty uchar red\nproperty float z\n"
           + "element edge 1\nproperty list uchar short ends\nelement face 4\nproperty short flag\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string plyText()
{
    auto text = plyHead ("ascii");
    for (const auto& p : corners)
        text += std::to_string (p.x()) + " " + std::to_string (p.y()) + " 7 " + std::to_string (p.z()) + "\n";
    text += "2 0 1\n";
    for (const auto& f : faces)
        text += "-1 3 " + std::to_string (f[0]) + " " + std::to_string (f[1]) + " " + std::to_string (f[2]) + "\n";
    return text;
}

std::string plyBinary (std::endian order)
{
    auto bytes = plyHead (order == std::endian::big ? "binary_big_endian" : "binary_little_endian");
    for (const auto& p : corners)
        bytes += bytesOf (static_cast<float> (p.x()), order) + bytesOf (p.y(), order) + "\7" + bytesOf (static_cast<float> (p.z()), order);
    bytes += "\2" + bytesOf (short { 0 }, order) + bytesOf (short { 1 }, order);
    for (const auto& f : faces)
    {
        bytes += bytesOf (short { -1 }, order) + "\3";
        for (const int corner : f)
            bytes += bytesOf (corner, order);
    }
    return bytes;
}

std::string stlText()
{
    std::string text = "solid body\n";
    for (const auto& f : faces)
    {
        text += "  facet normal 0 0 1\n    outer loop\n";
        for (const int corner : f)
            text += "      vertex " + textOf (corners[static_cast<std::size_t> (corner)]) + "\n";
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid body\n";
}

std::string stlBinary (const std::string& title)
{
    auto bytes = title + std::string (80 - title.size(), ' ') + bytesOf (4u);
    for (const auto& f : faces)
    {
        bytes += std::string (12, '\0');
        for (const int corner : f)
            for (const double c : corners[static_cast<std::size_t> (corner)])
                bytes += bytesOf (static_cast<float> (c));
        bytes += std::string (2, '\0');
    }
    return bytes;
}

struct Sample
{
    std::string name, bytes;
};
std::vector<Sample> samples()
{
    return { { "a.obj", obj() },
             { "a.OFF", off ("OFF\n4 4 6\n") },
             { "b.off", off ("# first\nCOFF 4 4 0\n") },
             { "c.off", off ("4 4 0\n") },
             { "a.ply", plyText() },
             { "b.ply", plyBinary (std::endian::little) },
             { "c.ply", plyBinary (std::endian::big) },
             { "a.stl", stlText() },
             { "b.stl", stlBinary ("made by a test") },
             { "c.stl", stlBinary ("solid, or so it says") } };
}

std::string problem (const std::string& bytes, const std::string& name)
{
    const auto mesh = readMesh (bytes, name);
    return mesh ? "" : mesh.error().id + " at " + mesh.error().where;
}
}   // namespace

TEST_CASE ("a tetrahedron gives the same mesh from every kind of file", "[file][assets][mesh]")
{
    for (const auto& [name, bytes] : samples())
    {
        INFO (name);
        const auto mesh = readMesh (bytes, name);
        INFO ((mesh ? "" : describe (mesh.error())));
        REQUIRE (mesh);
        if (name.ends_with (".stl"))   // STL has no point indices: points come in the order of the triangles
        {
            REQUIRE (mesh->points.size() == 4);
            for (std::size_t t = 0; t < faces.size(); ++t)
                for (std::size_t c = 0; c < 3; ++c)
                    CHECK (mesh->points[static_cast<std::size_t> (mesh->triangles[t][c])] == corners[static_cast<std::size_t> (faces[t][c])]);
            continue;
        }
        CHECK (mesh->points == corners);
        CHECK (mesh->triangles == faces);
    }
}

TEST_CASE ("identical points are merged, polygons are split, and triangles without area are dropped", "[file][assets][mesh]")
{
    const auto mesh = readMesh ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -0 0 0\nv 2 0 0\nf 1 2 3 4\nf 5 6 2\nf 1 2 5\nf 1 2\nl 1 2\n", "a.obj");
    REQUIRE (mesh);
    CHECK (mesh->points.size() == 5);
    CHECK (mesh->triangles == Triangles { { 0, 1, 2 }, { 0, 2, 3 } });   // 5 6 2 are collinear
}

TEST_CASE ("corners that differ in their last digit are merged, so that a mesh has no cracks", "[file][assets][mesh]")
{
    const auto mesh = readMesh ("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.0000000001 0 0\nv 1 1 0\nv 0 0.9999999999 0\nf 1 2 3\nf 4 5 6\n", "a.obj");
    REQUIRE (mesh);
    CHECK (mesh->points.size() == 4);
    CHECK (mesh->triangles == Triangles { { 0, 1, 2 }, { 1, 3, 2 } });
}

TEST_CASE ("an unreadable mesh gives an error with a position", "[file][assets][mesh]")
{
    CHECK (problem ("v 0 0 0\n", "a.gltf") == "mesh/unknown_kind at a.gltf");
    CHECK (problem ("v 0 0 0\nv 1 0\n", "a.obj") == "mesh/syntax at a.obj:2");
    CHECK (problem ("v 0 0 nan\n", "a.obj") == "mesh/syntax at a.obj:1");
    CHECK (problem ("v 0 0 0\nf 1 1 2\n", "a.obj") == "mesh/no_such_point at a.obj:2");
    CHECK (problem ("v 0 0 0\nf 0 1 1\n", "a.obj") == "mesh/no_such_point at a.obj:2");
    CHECK (problem ("v 0 0 0\nf one 1 1\n", "a.obj") == "mesh/syntax at a.obj:2");
    CHECK (problem ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "a.obj") == "mesh/no_triangles at a.obj");
    CHECK (problem ("", "a.obj") == "mesh/no_triangles at a.obj");
    CHECK (problem ("OFF\n3 1 0\n0 0 0\n1 0 0\n", "a.off") == "mesh/truncated at a.off:4");
    CHECK (problem ("OFF BINARY\n3 1 0\n", "a.off") == "mesh/syntax at a.off:1");
    CHECK (problem ("4OFF\n3 1 0\n", "a.off") == "mesh/syntax at a.off:1");
    CHECK (problem ("OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "a.off") == "mesh/no_such_point at a.off:4");
    CHECK (problem ("pli\n", "a.ply") == "mesh/syntax at a.ply:1");
    CHECK (problem ("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\n", "a.ply") == "mesh/syntax at a.ply:4");
    CHECK (problem ("ply\nformat ascii 1.0\n", "a.ply") == "mesh/truncated at a.ply:2");
    CHECK (problem ("ply\nformat ascii 1.0\nelement vertex 9999999999999\nproperty float x\nend_header\n1\n2\n", "a.ply") == "mesh/truncated at a.ply:7");
    CHECK (problem (plyBinary (std::endian::big).substr (0, 300), "a.ply") == "mesh/syntax at a.ply");
    CHECK (problem (stlBinary ("t").substr (0, 150), "a.stl") == "mesh/truncated at a.stl");
    CHECK (problem ("solid\nvertex 0 0 0\n", "a.stl") == "mesh/truncated at a.stl:2");
}

TEST_CASE ("a face with more corners than the budget allows is refused before they are read", "[file][assets][mesh]")
{
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\nproperty list int int vertex_index\nend_header\n0\n";
    CHECK (problem (head + "2000000000 0 0 0\n", "a.ply") == "mesh/too_large at a.ply:9");
    CHECK (problem (head + "1000 0 0 0\n", "a.ply") == "mesh/truncated at a.ply:9");

    CHECK (problem ("OFF\n1 1 0\n0 0 0\n2000000000 0 0 0\n", "a.off") == "mesh/too_large at a.off:4");
    CHECK (problem ("OFF\n1 1 0\n0 0 0\n1000 0 0 0\n", "a.off") == "mesh/syntax at a.off:4");   // the line has fewer words than corners
    const WithLimits limits { "triangles=3" };
    CHECK (problem ("v 0 0 0\nf 1 1 1 1 1 1 x\n", "a.obj") == "mesh/too_large at a.obj:2");
}

TEST_CASE ("no damaged mesh crashes the reader", "[file][assets][mesh]")
{
    const auto all = samples();
    test::property ("any bytes changed, doubled or cut off", [&] {
        auto [name, bytes] = *rc::gen::elementOf (all);
        for (const auto& [at, value] : *rc::gen::container<std::vector<std::pair<std::uint16_t, char>>> (rc::gen::arbitrary<std::pair<std::uint16_t, char>>()))
            bytes[at % bytes.size()] = value;
        bytes += bytes.substr (*rc::gen::inRange<std::size_t> (0, bytes.size()));
        bytes.resize (*rc::gen::inRange<std::size_t> (0, bytes.size()));

        const auto mesh = readMesh (bytes, name);
        if (! mesh) RC_ASSERT (mesh.error().id.starts_with ("mesh/"));
        if (mesh)
            for (const auto& t : mesh->triangles)
                for (const int corner : t)
                    RC_ASSERT ((corner >= 0 && corner < static_cast<int> (mesh->points.size())));
    });
}

TEST_CASE ("meshes are read as programs write them: continued lines, capitals, bytes after the end, strips", "[file][assets][mesh]")
{
    const auto triangles = [] (const std::string& bytes, const std::string& name) {
        const auto mesh = readMesh (bytes, name);
        INFO ((mesh ? "" : describe (mesh.error())));
        REQUIRE (mesh);
        return mesh->triangles;
    };
    using Triangles = std::vector<std::array<int, 3>>;
    CHECK (triangles ("v 0 0 0\nv 1 0 \\\n0\nv 0 1 0\nf 1 \\\r\n2 \\\r\n 3\n", "a.obj") == Triangles { { 0, 1, 2 } });
    CHECK (problem ("v 0 0 0\\", "a.obj") == "mesh/truncated at a.obj:1");
    CHECK (triangles ("SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID\n", "a.STL")
           == Triangles { { 0, 1, 2 } });
    const auto binary = stlBinary ("solid of a program that writes its name here");
    CHECK (triangles (binary + std::string (20, '\0'), "a.stl") == triangles (binary, "a.stl"));
    CHECK (triangles ("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
                      "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n8 0 1 2 3 -1 2 3 4\n",
                      "a.ply")
           == Triangles { { 0, 1, 2 }, { 1, 3, 2 }, { 2, 3, 4 } });
}
