// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene.hpp"
#include "parts.hpp"

#include <tactus/kit/geometry/rotation.hpp>

namespace tactus::host::scene
{

namespace
{
using Kind = Appearance::Kind;

/// The plane that a body lies in; empty for kinds that have none.
std::optional<Sheet3D> planeOf (const Body& b)
{
    if (b.kind != Kind::plane && b.kind != Kind::blade) return std::nullopt;
    Sheet3D sheet;
    sheet.normal = direction (b.vector (&Appearance::normal, Vec3::UnitZ()));
    if (sheet.normal.isZero()) return std::nullopt;
    sheet.offset = b.number (&Appearance::offset, 0.0);
    sheet.roles = { b.role };
    return sheet;
}

/// The sheet that a texture of this role is on: the one nearest to the tool, among those that the same tool touches, or among all if it
/// touches none.
Sheet3D& nearestTo (const std::string& role, const Tool* tool, std::vector<Sheet3D>& sheets)
{
    const auto away = [&] (const Sheet3D& s) {
        const double distance = tool != nullptr ? std::abs (s.normal.dot (tool->position) - s.offset) : 0.0;
        return std::pair (std::ranges::count (s.roles, role) == 0, distance);
    };
    return *std::ranges::min_element (sheets, {}, away);
}

/// Two fingers on one plane have the same texture, which should not look twice as rough.
template <typename T>
void addOnce (std::vector<T>& all, const T& one)
{
    if (std::ranges::find (all, one) == all.end()) all.push_back (one);
}

bool isSame (const Sheet3D& a, const Sheet3D& b) noexcept { return (a.normal - b.normal).norm() < 1e-6 && std::abs (a.offset - b.offset) < 1e-6; }
}   // namespace

const Tool* SceneState::tool (const std::string& role) const noexcept
{
    const auto found = std::ranges::find (tools, role, &Tool::role);
    return found == tools.end() ? nullptr : &*found;
}

void Scene::setBodies (std::vector<Body> bodies)
{
    all = std::move (bodies);
    auto before = std::move (solids);
    solids.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const auto& b = all[i];
        if (b.kind != Kind::body || ! b.surface || ! b.surface->mesh) continue;
        const double scale = b.number (&Appearance::scale, 1.0);
        const Vec3 origin = b.vector (&Appearance::origin, Vec3::Zero()), rotation = b.vector (&Appearance::rotation, Vec3::Zero());
        const auto kept = std::ranges::find_if (before, [&] (const auto& s) { return s.second->isOf (b.surface, scale, origin, rotation); });
        solids.emplace_back (i, kept != before.end() ? kept->second : std::make_shared<const Solid> (b.surface, scale, origin, rotation));
    }
}

Bounds Scene::bounds() const noexcept
{
    Bounds box;
    for (const auto& [i, solid] : solids)
        box.add (solid->bounds());
    if (! box.isEmpty()) return box;
    constexpr double half = 0.028;   // m; tools rarely go farther
    const auto sheets = sheetsOf ({});
    const Vec3 middle = sheets.empty() ? Vec3 (Vec3::Zero()) : sheets.front().centre();
    box.add (middle - Vec3 (half, half, 0.004));
    box.add (middle + Vec3 (half, half, 0.012));
    for (const auto& b : all)
        if (b.kind == Kind::scissors) box.add (Vec3 (0.07, 0.0, 0.0));
    return box;
}

int Scene::triangles() const noexcept
{
    int sum = 0;
    for (const auto& [i, solid] : solids)
        sum += solid->triangles();
    return sum;
}

double Scene::gridFor (const Camera& camera) noexcept
{
    if (camera.distance < 0.06) return 1e-3;
    return camera.distance < 0.9 ? 1e-2 : 1e-1;
}

/// The origin of a texture's coordinates. A node before it may have moved the position.
Vec3 Scene::originOf (std::size_t body, const SceneState& now) const
{
    const auto* tool = now.tool (all[body].role);
    const auto there = now.of (body, &Appearance::tool);
    if (tool == nullptr || ! there || ! isFinite (*there)) return Vec3::Zero();
    const Vec3 from = tool->position - *there;
    return from.norm() < 1e-4 ? Vec3 (Vec3::Zero()) : from;   // the two are not from the same tick
}

std::vector<Sheet3D> Scene::sheetsOf (const SceneState& now) const
{
    std::vector<Sheet3D> sheets;
    bool has_texture = false;
    for (const auto& b : all)
    {
        if (auto sheet = planeOf (b))
        {
            const auto there = std::ranges::find_if (sheets, [&] (const auto& s) { return isSame (s, *sheet); });
            there == sheets.end() ? sheets.push_back (*sheet) : there->roles.push_back (b.role);
        }
        has_texture = has_texture || (b.is_placed && (b.kind == Kind::ridges || b.kind == Kind::relief));
    }
    if (sheets.empty() && has_texture && solids.empty()) sheets.emplace_back();
    if (sheets.empty()) return sheets;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const auto& b = all[i];
        if (! b.is_placed) continue;
        auto& sheet = nearestTo (b.role, now.tool (b.role), sheets);
        if (b.kind == Kind::ridges)
            addOnce (sheet.ridges, { b.number (&Appearance::frequency, 0.0), b.number (&Appearance::angle, 0.0), b.number (&Appearance::phase, 0.0),
                                     originOf (i, now) });
        if (b.kind == Kind::relief) addOnce (sheet.grains, { b.relief, originOf (i, now) });
    }
    for (const auto& touch : touches (now))
    {
        if (! (touch.depth > 0.0)) continue;
        for (auto& sheet : sheets)
            if (std::abs (sheet.normal.dot (touch.at) - sheet.offset) < 1e-5) sheet.dents.push_back ({ touch.at, touch.tool - touch.at });
    }
    return sheets;
}

std::vector<Touch> Scene::touches (const SceneState& now) const
{
    std::vector<Touch> found;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const auto& b = all[i];
        const auto* tool = now.tool (b.role);
        if (tool == nullptr) continue;
        if (b.kind == Kind::body)
        {
            const auto at = now.of (i, &Appearance::touch), depth = now.of (i, &Appearance::depth);
            if (at && depth && depth->x() > 0.0) found.push_back ({ b.role, *at, tool->position, depth->x() });
        }
        if (const auto sheet = planeOf (b))
        {
            double depth = sheet->offset - sheet->normal.dot (tool->position);
            const Vec3 foot = tool->position + depth * sheet->normal;
            if (b.kind == Kind::blade) depth -= now.of (i, &Appearance::crack).value_or (Vec3::Zero()).x();   // a cut surface closes again
            const bool is_known = std::ranges::any_of (found, [&] (const Touch& t) { return t.role == b.role; });
            if (depth > 0.0 && ! is_known) found.push_back ({ b.role, foot, foot - depth * sheet->normal, depth, sheet->normal });
        }
    }
    for (auto& touch : found)   // what friction holds on to is dragged along the plane
        for (std::size_t i = 0; i < all.size(); ++i)
        {
            const auto stretch = now.of (i, &Appearance::stretch);
            if (! stretch || all[i].kind != Kind::contact || all[i].role != touch.role || touch.normal.isZero()) continue;
            touch.at -= *stretch - stretch->dot (touch.normal) * touch.normal;
            break;
        }
    return found;
}

bool Scene::hasUnfeltTool (const SceneState& now) const
{
    return std::ranges::any_of (solids, [&] (const auto& s) {
        const auto depth = now.of (s.first, &Appearance::depth);
        const auto* tool = now.tool (all[s.first].role);
        return depth && ! (depth->x() > 0.0) && tool != nullptr && s.second->contains (now.of (s.first, &Appearance::tool).value_or (tool->position));
    });
}

std::vector<Crack> Scene::cracks (const SceneState& now) const
{
    std::vector<Crack> found;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const auto& b = all[i];
        const auto* tool = now.tool (b.role);
        const auto crack = now.of (i, &Appearance::crack);
        const auto sheet = planeOf (b);
        if (b.kind != Kind::blade || tool == nullptr || ! crack || ! (crack->x() > 0.0) || ! sheet) continue;
        const auto along = bladeDirection (b, i, now, sheet->normal);
        const Vec3 foot = tool->position + (sheet->offset - sheet->normal.dot (tool->position)) * sheet->normal;
        const double half = 0.5 * b.number (&Appearance::width, 0.02);
        found.push_back ({ foot - half * along, foot + half * along, -crack->x() * sheet->normal });
    }
    return found;
}

std::vector<RoundTool> Scene::roundTools (const SceneState& now) const
{
    std::vector<RoundTool> found;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const auto& radii = all[i].radii;
        const auto centre = now.of (i, &Appearance::tool);
        if (radii.empty() || ! centre) continue;
        const auto choice = now.of (i, &Appearance::choice);
        const double number = std::clamp (choice ? choice->x() : 0.0, 0.0, static_cast<double> (radii.size() - 1));
        const auto lower = static_cast<std::size_t> (number), upper = std::min (lower + 1, radii.size() - 1);
        const double radius = std::lerp (radii[lower], radii[upper], number - static_cast<double> (lower));
        if (radius > 0.0) found.push_back ({ *centre, radius });
    }
    return found;
}

std::vector<StuckBound> Scene::stuckBounds (const SceneState& now) const
{
    std::vector<StuckBound> found;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const auto& b = all[i];
        const auto at = now.of (i, &Appearance::touch), depth = now.of (i, &Appearance::depth), normal = now.of (i, &Appearance::normal);
        if (b.kind != Kind::body || ! b.surface || b.surface->mu.size() != 1 || ! at || ! depth || ! (depth->x() > 0.0) || ! normal) continue;
        const double radius = b.surface->mu[0](depth->x()) * depth->x();
        if (radius > 0.0 && ! normal->isZero()) found.push_back ({ *at, direction (*normal), radius });
    }
    return found;
}

void Scene::draw (Raster& raster, const Camera& camera, const Paint& paint, const SceneState& now) const
{
    auto sheets = sheetsOf (now);
    constexpr double most_cells = 8192.0, pixels_per_cell = 7.0;   // the first in all sheets together, the second on average
    const auto cells = static_cast<int> (std::sqrt (most_cells / static_cast<double> (std::max<std::size_t> (1, sheets.size()))));
    for (auto& sheet : sheets)
    {
        sheet.grid = gridFor (camera);
        for (const auto& tool : now.tools)
            if (isFinite (tool.position)) sheet.cover (tool.position);
        // In a small picture, cells that are smaller than a pixel would cost time and show nothing.
        const auto across = static_cast<int> (std::min (1e4, 2.0 * sheet.half * camera.scaleAt (camera.distance) / pixels_per_cell));
        sheet.cells = std::clamp (std::min (cells, across), 2, sheet.cells);
        sheet.draw (raster, camera, paint);
    }
    const auto felt = touches (now);
    for (const auto& [i, solid] : solids)
    {
        std::vector<Dent> dents;
        for (const auto& t : felt)
            if (t.role == all[i].role) dents.push_back ({ t.at, t.tool - t.at });
        solid->draw (raster, camera, paint, dents);
    }
    std::vector<std::string> with_blade;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        if (all[i].kind == Kind::scissors) drawScissors (raster, camera, paint, all[i], i, now);
        if (all[i].kind == Kind::blade) drawBlade (raster, camera, paint, all[i], i, now);
        if (all[i].kind == Kind::scissors || all[i].kind == Kind::blade) with_blade.push_back (all[i].role);
    }
    for (const auto& tool : now.tools)
        if (std::ranges::count (with_blade, tool.role) == 0) drawTool (raster, camera, paint, tool);
}

}   // namespace tactus::host::scene
