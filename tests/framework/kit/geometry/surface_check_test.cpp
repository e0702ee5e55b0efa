// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/file/assets/mesh.hpp>
#include <tactus/kit/geometry/surface_check.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

using namespace tactus;

namespace
{
std::shared_ptr<Surface> bodyOf (Mesh mesh)
{
    auto surface = std::make_shared<Surface>();
    surface->mesh = std::make_shared<const Mesh> (std::move (mesh));
    const Law spring { .kind = Law::Kind::power, .a = 500.0, .b = 1.0 };
    surface->curves = { { Surface::Curves { spring, spring, spring } } };
    return surface;
}

/// A block of quads, with n cells along each edge, written as .obj.
Mesh block (int n)
{
    std::ostringstream obj;
    int points = 0;
    const auto side = [&] (const Vec3& origin, const Vec3& u, const Vec3& v) {
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < n; ++k)
            {
                for (const auto& [a, b] : { std::pair { i, k }, std::pair { i + 1, k }, std::pair { i + 1, k + 1 }, std::pair { i, k + 1 } })
                {
                    const Vec3 p = origin + a * u / n + b * v / n;
                    obj << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
                }
                obj << "f";
                for (int c = 1; c <= 4; ++c)
                    obj << ' ' << points + c;
                obj << '\n';
                points += 4;
            }
    };
    const Vec3 x (0.04, 0, 0), y (0, 0.04, 0), z (0, 0, 0.02), o (0, 0, 0);
    side (o, y, x);
    side (o, x, z);
    side (o, z, y);
    side (z, x, y);
    side (x, y, z);
    side (y, z, x);
    return *readers::readMesh (obj.str(), "block.obj");
}

void turnRound (Mesh& mesh, std::size_t t) { std::swap (mesh.triangles[t][0], mesh.triangles[t][1]); }
}   // namespace

TEST_CASE ("mesh: faces that run the other way round than their neighbours are found, whichever they are", "[mesh]")
{
    test::property ("some turned triangles of a block", [] {
        auto mesh = block (*rc::gen::inRange (1, 4));
        RC_ASSERT (wrongSide (*bodyOf (mesh)) == "");
        const auto count = *rc::gen::inRange<std::size_t> (1, mesh.triangles.size() / 4);
        std::size_t first = mesh.triangles.size();
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto t = (7 * i + 3) % mesh.triangles.size();   // 7 shares no factor with the number of triangles
            turnRound (mesh, t);
            first = std::min (first, t);
        }
        const auto warning = wrongSide (*bodyOf (mesh));
        RC_ASSERT (warning.starts_with ("triangle " + std::to_string (first) + ","));
    });
}

TEST_CASE ("mesh: inside out, closed or open, is noticed, and a bowl is not", "[mesh]")
{
    auto closed = block (2);
    for (std::size_t t = 0; t < closed.triangles.size(); ++t)
        turnRound (closed, t);
    CHECK (wrongSide (*bodyOf (closed)).find ("faces inwards at node") != std::string::npos);

    auto open = block (1);
    open.triangles.erase (open.triangles.begin(), open.triangles.begin() + 2);   // the bottom
    CHECK (wrongSide (*bodyOf (open)) == "");
    for (std::size_t t = 0; t < open.triangles.size(); ++t)
        turnRound (open, t);
    CHECK (wrongSide (*bodyOf (open)).starts_with ("the mesh is open, and its faces point to its middle"));

    std::ostringstream bowl;   // z = x^2 + y^2, felt from above
    constexpr int n = 9;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
        {
            const int x = i - n / 2, y = k - n / 2;
            bowl << "v " << x << ' ' << y << ' ' << 0.1 * (x * x + y * y) << '\n';
        }
    for (int i = 0; i + 1 < n; ++i)
        for (int k = 0; k + 1 < n; ++k)
            bowl << "f " << i * n + k + 1 << ' ' << (i + 1) * n + k + 1 << ' ' << (i + 1) * n + k + 2 << ' ' << i * n + k + 2 << '\n';
    CHECK (wrongSide (*bodyOf (*readers::readMesh (bowl.str(), "bowl.obj"))) == "");
}

TEST_CASE ("mesh: a block says from which depth its edges are felt as steps, and a ball has no edges", "[mesh]")
{
    constexpr double crease = std::numbers::pi / 6.0;
    const auto body = bodyOf (block (1));
    CHECK (sharpEdges (*body, crease, {}).starts_with ("the body has sharp edges (12 in the mesh): a slide over them at any depth is felt as a step"));
    CHECK (sharpEdges (*body, crease, { 0.003, 0.002 }).find (": from a depth of 2 mm, the radius of the tool, ") != std::string::npos);
    CHECK (sharpEdges (*body, std::numbers::pi, {}) == "");

    std::ostringstream ball;
    constexpr int rings = 24, sides = 48;
    for (int i = 1; i < rings; ++i)
        for (int k = 0; k < sides; ++k)
        {
            const double a = std::numbers::pi * i / rings, b = 2.0 * std::numbers::pi * k / sides;
            ball << "v " << 0.02 * std::sin (a) * std::cos (b) << ' ' << 0.02 * std::sin (a) * std::sin (b) << ' ' << 0.02 * std::cos (a) << '\n';
        }
    for (int i = 0; i + 2 < rings; ++i)
        for (int k = 0; k < sides; ++k)
            ball << "f " << i * sides + k + 1 << ' ' << (i + 1) * sides + k + 1 << ' ' << (i + 1) * sides + (k + 1) % sides + 1 << ' '
                 << i * sides + (k + 1) % sides + 1 << '\n';
    CHECK (sharpEdges (*bodyOf (*readers::readMesh (ball.str(), "ball.obj")), crease, {}) == "");
}

TEST_CASE ("mesh: a concave face is cut as it is", "[mesh]")
{
    test::property ("stars, whose area is that of their corners", [] {
        const int n = *rc::gen::inRange (4, 40);
        std::ostringstream obj;
        std::vector<Vec3> points;
        for (int i = 0; i < n; ++i)
        {
            const double r = 0.2 + *rc::gen::inRange (1, 100) / 100.0, a = 2.0 * std::numbers::pi * i / n;
            points.emplace_back (r * std::cos (a), r * std::sin (a), 0.0);
            obj << "v " << points.back().x() << ' ' << points.back().y() << " 0\n";
        }
        obj << "f";
        for (int i = 1; i <= n; ++i)
            obj << ' ' << i;
        const auto mesh = readers::readMesh (obj.str(), "star.obj");
        RC_ASSERT (bool (mesh));
        double wanted = 0.0, cut = 0.0;
        for (int i = 0; i < n; ++i)
            wanted += 0.5 * points[at (i)].cross (points[at ((i + 1) % n)]).z();
        for (const auto& t : mesh->triangles)
        {
            const double area = 0.5 * (mesh->points[at (t[1])] - mesh->points[at (t[0])]).cross (mesh->points[at (t[2])] - mesh->points[at (t[0])]).z();
            RC_ASSERT (area > -1e-6);   // none runs the other way round
            cut += area;
        }
        RC_ASSERT (std::abs (cut - wanted) < 1e-4);   // the file has six digits
    });
}

TEST_CASE ("mesh: round edges of a mesh that is too coarse for them are found, and those of a coarse ball are not", "[mesh]")
{
    const auto old = coarseFaces (*bodyOf (block (1)), std::numbers::pi);
    INFO (old);
    CHECK (old.starts_with ("the mesh is too coarse for round edges: "));
    CHECK (old.find ("set crease below 90 degrees") != std::string::npos);
    CHECK (coarseFaces (*bodyOf (block (1)), std::numbers::pi / 6.0) == "");   // its edges are sharp

    Mesh ball;   // an octahedron with its faces divided once
    ball.points = { Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ() };
    for (int side = 0; side < 4; ++side)
        for (const int pole : { 4, 5 })
        {
            const int a = pole, b = pole == 4 ? side : (side + 1) % 4, c = pole == 4 ? (side + 1) % 4 : side;
            const auto between = [&] (int i, int k) {
                const Vec3 p = (ball.points[static_cast<std::size_t> (i)] + ball.points[static_cast<std::size_t> (k)]).normalized();
                const auto known = std::ranges::find (ball.points, p) - ball.points.begin();
                if (known == std::ssize (ball.points)) ball.points.push_back (p);
                return static_cast<int> (known);
            };
            const int ab = between (a, b), bc = between (b, c), ca = between (c, a);
            for (const auto& triangle : { std::array { a, ab, ca }, std::array { ab, b, bc }, std::array { ca, bc, c }, std::array { ab, bc, ca } })
                ball.triangles.push_back (triangle);
        }
    CHECK (wrongSide (*bodyOf (ball)) == "");
    CHECK (coarseFaces (*bodyOf (ball), std::numbers::pi) == "");
}

TEST_CASE ("mesh: a stiffness that changes over fewer than three cells is found, whatever the laws are", "[mesh]")
{
    Mesh strip;
    constexpr int n = 12;
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < 3; ++k)
            strip.points.emplace_back (0.001 * i, 0.001 * k, 0.0);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < 2; ++k)
        {
            const int a = 3 * i + k, b = a + 3;
            strip.triangles.push_back ({ a, b, b + 1 });
            strip.triangles.push_back ({ a, b + 1, a + 1 });
        }
    const auto warningFor = [&] (int cells, double ratio, Law::Kind kind) {
        auto surface = bodyOf (strip);
        const Law spring { .kind = Law::Kind::power, .a = 500.0, .b = 1.0 };
        std::vector<Surface::Curves> nodes;
        for (int i = 0; i <= n; ++i)
            for (int k = 0; k < 3; ++k)
            {
                const double x = std::clamp ((i - 4.0) / cells, 0.0, 1.0), a = 300.0 * (1.0 + (ratio - 1.0) * x);
                const bool is_power = kind == Law::Kind::power;
                nodes.push_back ({ spring, spring, { .kind = kind, .a = is_power ? a : a / 400.0, .b = is_power ? 1.0 : 400.0 } });
            }
        surface->curves = { nodes };
        return abruptStiffness (*surface);
    };
    for (const auto kind : { Law::Kind::power, Law::Kind::exponential })
    {
        for (const double ratio : { 0.2, 1.5, 5.0 })
        {
            CHECK (warningFor (1, ratio, kind).find ("between the points ") != std::string::npos);
            CHECK (warningFor (2, ratio, kind) != "");
            CHECK (warningFor (3, ratio, kind) == "");
            CHECK (warningFor (6, ratio, kind) == "");
        }
        CHECK (warningFor (1, 1.05, kind) == "");
    }
    CHECK (abruptStiffness (*bodyOf (strip)) == "");
}
