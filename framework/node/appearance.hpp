// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tactus
{

/// The look of a node in a picture of the scene. This is data: each part names a row of the node's own datasheet, and a host draws from the values of
/// these rows. It does not affect the tick. Optional; a node declares it next to its `ports`:
///
///     static constexpr Appearance appearance { .kind = Appearance::Kind::plane, .tool = "position", .offset = "offset", .depth = "depth" };
///
/// All parts may be left out. A picture shows what the given parts describe.
struct Appearance
{
    enum class Kind
    {
        plane,      ///< a flat surface
        body,       ///< a mesh
        relief,     ///< heights on the nearest plane
        ridges,     ///< waves on the nearest plane
        blade,      ///< a blade over a plane, and the crack under it
        scissors,   ///< two blades that turn about the origin, and a plate between them
        contact,    ///< the place where a tool holds on to a surface, such as that of friction
    };

    Kind kind = Kind::plane;
    std::string_view tool {};        ///< input: position of the tool, in the coordinates of the node
    std::string_view normal {};      ///< direction out of the object, at the tool
    std::string_view offset {};      ///< position of a plane along its normal, m
    std::string_view depth {};       ///< depth of the tool in the object, m; negative or 0 while apart
    std::string_view touch {};       ///< point of the object that the tool touches, m
    std::string_view stretch {};     ///< from that point to the tool, m; instead of `touch`
    std::string_view surface {};     ///< setting: a Surface
    std::string_view scale {};       ///< length of one unit of the mesh, m
    std::string_view origin {};      ///< position of the mesh's origin, m
    std::string_view rotation {};    ///< rotation of the mesh or of the blade, rad
    std::string_view map {};         ///< setting: a record with `image` or `csv`, `pitch` and `height`
    std::string_view frequency {};   ///< ridges per metre
    std::string_view angle {};       ///< direction of the ridges from x towards y, or between the blades of scissors, rad
    std::string_view phase {};       ///< phase of the ridges at the origin, rad
    std::string_view width {};       ///< length of the edge of a blade, m
    std::string_view crack {};       ///< length of the crack, m; of scissors: distance from the pivot to its end
    std::string_view thickness {};   ///< thickness of what is cut, m; 0: unlimited
    std::string_view pivot {};       ///< distance from the pivot of scissors to the plate, m
    std::string_view radius {};      ///< setting: the radius of each round tool in m, or one radius for all
    std::string_view choice {};      ///< input: number of the tool; between two numbers, the radius is interpolated
};

/// A part of an Appearance by its name, for code that treats all of them alike.
struct AppearancePart
{
    std::string_view name;
    std::string_view Appearance::*row;
    std::size_t width;   ///< components of the row; 0: a setting that is not a number
};

inline constexpr std::array<std::string_view, 7> appearance_kinds { "plane", "body", "relief", "ridges", "blade", "scissors", "contact" };

// clang-format off
inline constexpr std::array appearance_parts {
    AppearancePart { "tool", &Appearance::tool, 3 },           AppearancePart { "normal", &Appearance::normal, 3 },
    AppearancePart { "offset", &Appearance::offset, 1 },       AppearancePart { "depth", &Appearance::depth, 1 },
    AppearancePart { "touch", &Appearance::touch, 3 },         AppearancePart { "stretch", &Appearance::stretch, 3 },
    AppearancePart { "surface", &Appearance::surface, 0 },     AppearancePart { "scale", &Appearance::scale, 1 },
    AppearancePart { "origin", &Appearance::origin, 3 },       AppearancePart { "rotation", &Appearance::rotation, 3 },
    AppearancePart { "map", &Appearance::map, 0 },             AppearancePart { "frequency", &Appearance::frequency, 1 },
    AppearancePart { "angle", &Appearance::angle, 1 },         AppearancePart { "phase", &Appearance::phase, 1 },
    AppearancePart { "width", &Appearance::width, 1 },         AppearancePart { "crack", &Appearance::crack, 1 },
    AppearancePart { "thickness", &Appearance::thickness, 1 }, AppearancePart { "pivot", &Appearance::pivot, 1 },
    AppearancePart { "radius", &Appearance::radius, 0 },       AppearancePart { "choice", &Appearance::choice, 1 },
};
// clang-format on

constexpr std::string_view name (Appearance::Kind k) noexcept { return appearance_kinds[static_cast<std::size_t> (k)]; }

}   // namespace tactus
