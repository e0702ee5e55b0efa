// SPDX-License-Identifier: MIT
#include "mesh.hpp"
#include "mesh_parts.hpp"

#include <tactus/text/budget.hpp>
#include <tactus/text/quote.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace tactus::readers
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
    std::ranges::transform (ending, ending.begin(), [] (unsigned char c) { return static_cast<char> (std::tolower (c)); });
    return ending;
}

Message fail (std::string id, std::string where, std::string what, std::string remedy)
{
    return Message::error (std::move (id), std::move (where), std::move (what), std::move (remedy));
}
}   // namespace

void checkBudget (double Budgets::*which, std::size_t count, std::size_t line)
{
    if (static_cast<double> (count) <= budgets().*which) return;
    auto over = overBudget ("mesh/too_large", which, "it", static_cast<double> (count), "save a coarser mesh");
    throw MeshProblem { std::move (over.id), std::move (over.text), line, std::move (over.remedy) };
}

namespace
{
constexpr std::size_t most_corners_cut = 1000;   // cutting ears takes the square of the number of corners, or more

/// Twice the area of a polygon, times its normal. Source: Newell's method.
Vec3 areaOf (const std::vector<Vec3>& points, const std::vector<int>& polygon)
{
    Vec3 sum = Vec3::Zero();
    const auto& first = points[static_cast<std::size_t> (polygon[0])];
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += (points[static_cast<std::size_t> (polygon[i])] - first).cross (points[static_cast<std::size_t> (polygon[i + 1])] - first);
    return sum;
}

Vec3 turnAt (const std::vector<Vec3>& points, int before, int here, int after)
{
    const auto at = [&] (int i) -> const Vec3& { return points[static_cast<std::size_t> (i)]; };
    return (at (here) - at (before)).cross (at (after) - at (here));
}

bool isConvex (const std::vector<Vec3>& points, const std::vector<int>& polygon)
{
    const Vec3 normal = areaOf (points, polygon);
    const auto n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
        if (turnAt (points, polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]).dot (normal) < 0.0) return false;
    return true;
}

/// Cuts a polygon into triangles at its ears. An ear is a corner whose triangle contains no other corner. Source: Meisters, "Polygons have ears" (1975).
std::vector<std::array<int, 3>> cutIntoTriangles (const std::vector<Vec3>& points, std::vector<int> polygon)
{
    const Vec3 normal = areaOf (points, polygon);
    const auto at = [&] (int i) -> const Vec3& { return points[static_cast<std::size_t> (i)]; };
    const auto isEar = [&] (std::size_t i) {
        const auto n = polygon.size();
        const int a = polygon[(i + n - 1) % n], b = polygon[i], c = polygon[(i + 1) % n];
        if (! (turnAt (points, a, b, c).dot (normal) > 0.0)) return false;
        for (const int p : polygon)
            if (p != a && p != b && p != c && turnAt (points, a, b, p).dot (normal) >= 0.0 && turnAt (points, b, c, p).dot (normal) >= 0.0
                && turnAt (points, c, a, p).dot (normal) >= 0.0 && at (p) != at (a) && at (p) != at (b) && at (p) != at (c))
                return false;
        return true;
    };
    std::vector<std::array<int, 3>> triangles;
    while (polygon.size() > 3)
    {
        std::size_t ear = 0;
        while (ear < polygon.size() && ! isEar (ear))
            ++ear;
        if (ear == polygon.size()) ear = 1;   // it crosses itself: any cut is as good as another
        const auto n = polygon.size();
        triangles.push_back ({ polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n] });
        polygon.erase (polygon.begin() + static_cast<std::ptrdiff_t> (ear));
    }
    triangles.push_back ({ polygon[0], polygon[1], polygon[2] });
    return triangles;
}
}   // namespace

void MeshBuilder::point (const Vec3& at, std::size_t line)
{
    if (! at.allFinite()) throw MeshProblem { "mesh/syntax", "a point is not finite", line };
    const auto [found, fresh] = known.try_emplace ({ at.x(), at.y(), at.z() }, static_cast<int> (made.points.size()));
    if (fresh) made.points.push_back (at);
    checkBudget (&Budgets::points, made.points.size(), line);
    joined.push_back (found->second);
}

void MeshBuilder::face (std::span<const long long> corners, std::size_t line)
{
    for (const auto corner : corners)
        if (corner < 0 || corner >= points())
            throw MeshProblem { "mesh/no_such_point", "a face refers to a point that is not among the " + std::to_string (points()) + " points before it",
                                line };

    std::vector<int> polygon;
    for (const auto corner : corners)
        polygon.push_back (joined[static_cast<std::size_t> (corner)]);
    const auto add = [&] (int a, int b, int c) {
        if (a == b || b == c || c == a) return;
        made.triangles.push_back ({ a, b, c });
        checkBudget (&Budgets::triangles, made.triangles.size(), line);
    };
    if (polygon.size() < 4 || isConvex (made.points, polygon))
        for (std::size_t i = 2; i < polygon.size(); ++i)
            add (polygon[0], polygon[i - 1], polygon[i]);
    else if (polygon.size() > most_corners_cut)
        throw MeshProblem { "mesh/too_large",
                            "a face that is not convex has " + std::to_string (polygon.size()) + " corners; at most " + std::to_string (most_corners_cut)
                                + " are cut into triangles",
                            line, "triangulate it in the program that made it" };
    else
        for (const auto& [a, b, c] : cutIntoTriangles (made.points, polygon))
            add (a, b, c);
}

namespace
{
/// For each point, the index of the first point within the given distance, or its own index if there is none.
std::vector<int> firstNear (const std::vector<Vec3>& points, double reach)
{
    std::vector<int> firsts;
    std::map<std::array<long long, 3>, std::vector<int>> cells;
    for (int i = 0; i < static_cast<int> (points.size()); ++i)
    {
        const Vec3& p = points[static_cast<std::size_t> (i)];
        const auto cellOf = [&] (int axis) { return static_cast<long long> (std::floor (p[axis] / reach)); };
        const auto near = [&] {
            for (long long x = -1; x <= 1; ++x)
                for (long long y = -1; y <= 1; ++y)
                    for (long long z = -1; z <= 1; ++z)
                        if (const auto cell = cells.find ({ cellOf (0) + x, cellOf (1) + y, cellOf (2) + z }); cell != cells.end())
                            for (const int other : cell->second)
                                if ((points[static_cast<std::size_t> (other)] - p).norm() < reach) return other;
            return i;
        }();
        firsts.push_back (near);
        if (near == i) cells[{ cellOf (0), cellOf (1), cellOf (2) }].push_back (i);
    }
    return firsts;
}
}   // namespace

Mesh MeshBuilder::take() const
{
    if (made.points.empty()) return made;
    Vec3 low = made.points[0], high = low;
    for (const auto& p : made.points)
    {
        low = low.cwiseMin (p);
        high = high.cwiseMax (p);
    }
    // Far from the origin, the last digit of a double is coarser than a millionth of the size, and cell indices must fit integers.
    const double reach = std::max (1e-6 * (high - low).norm(), 1e-15 * std::max (low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()));
    if (! (reach > 0.0) || ! std::isfinite (reach)) return made;

    Mesh welded;
    const auto firsts = firstNear (made.points, reach);
    std::vector<int> number (firsts.size());
    for (std::size_t i = 0; i < firsts.size(); ++i)
    {
        const auto first = static_cast<std::size_t> (firsts[i]);
        if (first == i)
        {
            number[i] = static_cast<int> (welded.points.size());
            welded.points.push_back (made.points[i]);
        }
        else
            number[i] = number[first];
    }
    for (const auto& t : made.triangles)
    {
        const auto to = [&] (std::size_t corner) { return number[static_cast<std::size_t> (t[corner])]; };
        const auto at = [&] (std::size_t corner) -> const Vec3& { return welded.points[static_cast<std::size_t> (to (corner))]; };
        if ((at (1) - at (0)).cross (at (2) - at (0)).squaredNorm() > 0.0) welded.triangles.push_back ({ to (0), to (1), to (2) });
    }
    return welded;
}

Vec3 takePoint (std::string_view& line, std::size_t number)
{
    Vec3 at;
    for (auto& coordinate : at)
    {
        const auto word = takeWord (line);
        const auto value = numberIn<double> (word);
        if (! value) throw MeshProblem { "mesh/syntax", "a point needs three numbers; found " + quote (word), number };
        coordinate = *value;
    }
    return at;
}

long long wholeNumber (std::string_view word, std::size_t line)
{
    const auto value = numberIn<long long> (word);
    if (! value) throw MeshProblem { "mesh/syntax", quote (word) + " is not a whole number", line };
    return *value;
}

namespace
{
/// Lets `fill` add points and faces to a builder, and turns what is wrong into a message.
template <typename F>
Result<Mesh> built (F&& fill, std::string_view name, const std::string& remedy)
{
    MeshBuilder builder;
    try
    {
        fill (builder);
    }
    catch (const MeshProblem& p)
    {
        return fail (p.id, std::string (name) + (p.line > 0 ? ":" + std::to_string (p.line) : ""), p.what, p.remedy.empty() ? remedy : p.remedy);
    }

    auto mesh = builder.take();
    if (mesh.triangles.empty())
        return fail ("mesh/no_triangles", std::string (name), "it has no triangles", "save a surface, not only points or lines");
    return mesh;
}
}   // namespace

Result<Mesh> readMesh (std::string_view bytes, std::string_view name)
{
    const auto kind = std::ranges::find (kinds, endingOf (name), &Kind::ending);
    if (kind == std::end (kinds))
        return fail ("mesh/unknown_kind", std::string (name), "its extension is not that of a supported mesh file", "save it as .obj, .off, .ply or .stl");
    return built ([&] (MeshBuilder& builder) { kind->read (bytes, builder); }, name,
                  "check that it is a complete " + std::string (kind->ending) + " file, and export it again");
}

Result<Mesh> meshOf (std::span<const double> points, std::span<const std::int32_t> triangles, std::string_view name)
{
    return built (
        [&] (MeshBuilder& builder) {
            for (std::size_t i = 0; i + 2 < points.size(); i += 3)
                builder.point ({ points[i], points[i + 1], points[i + 2] });
            for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
                builder.face (std::array<long long, 3> { triangles[i], triangles[i + 1], triangles[i + 2] });
        },
        name, "check the points and triangles that the program supplies");
}

}   // namespace tactus::readers
