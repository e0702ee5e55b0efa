// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh.hpp"
#include "mesh_parts.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace tactus::host
{

namespace
{
struct Kind
{
    std::string_view ending;
    void (*read) (std::string_view, MeshBuilder&);
};
constexpr Kind kinds[] = { { ".obj", readObj }, { ".off", readOff }, { ".ply", readPly }, { ".stl", readStl } };

std::string endingOf (std::string_view name)
{
    auto ending = std::filesystem::path (name).extension().string();
    std::ranges::transform (ending, ending.begin(), [] (unsigned char c)
                            { return static_cast<char> (std::tolower (c)); });
    return ending;
}

tl::unexpected<Error> fail (std::string id, std::string where, std::string what, std::string remedy)
{
    return tl::unexpected (Error { .id = std::move (id), .where = std::move (where), .what = std::move (what), .remedy = std::move (remedy) });
}
}   // namespace

void MeshBuilder::point (const Vec3& at, std::size_t line)
{
    if (! at.allFinite()) throw MeshProblem { "mesh/syntax", "a point is not finite", line };
    const auto [found, fresh] = known.try_emplace ({ at.x(), at.y(), at.z() }, static_cast<int> (made.points.size()));
    if (fresh) made.points.push_back (at);
    joined.push_back (found->second);
}

void MeshBuilder::face (std::span<const long long> corners, std::size_t line)
{
    for (const auto corner : corners)
        if (corner < 0 || corner >= points())
            throw MeshProblem { "mesh/no_such_point", "a face names a point that is not among the " + std::to_string (points()) + " before it", line };

    const auto at = [&] (std::size_t i)
    { return joined[static_cast<std::size_t> (corners[i])]; };
    for (std::size_t i = 2; i < corners.size(); ++i)
        if (const std::array<int, 3> t { at (0), at (i - 1), at (i) }; t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            made.triangles.push_back (t);
}

Vec3 takePoint (std::string_view& line, std::size_t number)
{
    Vec3 at;
    for (auto& coordinate : at)
    {
        const auto word = takeWord (line);
        const auto value = numberIn<double> (word);
        if (! value) throw MeshProblem { "mesh/syntax", "a point needs three numbers, but here is '" + std::string (word.substr (0, 40)) + "'", number };
        coordinate = *value;
    }
    return at;
}

long long wholeNumber (std::string_view word, std::size_t line)
{
    const auto value = numberIn<long long> (word);
    if (! value) throw MeshProblem { "mesh/syntax", "'" + std::string (word.substr (0, 40)) + "' is not a whole number", line };
    return *value;
}

tl::expected<Mesh, Error> readMesh (std::string_view bytes, std::string_view name)
{
    const auto kind = std::ranges::find (kinds, endingOf (name), &Kind::ending);
    if (kind == std::end (kinds))
        return fail ("mesh/unknown_kind", std::string (name), "its name does not end like that of a mesh", "save it as .obj, .off, .ply or .stl");

    MeshBuilder builder;
    try
    {
        kind->read (bytes, builder);
    }
    catch (const MeshProblem& p)
    {
        return fail (p.id, std::string (name) + (p.line > 0 ? ":" + std::to_string (p.line) : ""), p.what, "check that it is a whole " + std::string (kind->ending) + " file, and save it again where it was made");
    }

    auto mesh = builder.take();
    if (mesh.triangles.empty())
        return fail ("mesh/no_triangles", std::string (name), "there are no triangles in it", "save a surface, not only points or lines");
    return mesh;
}

}   // namespace tactus::host
