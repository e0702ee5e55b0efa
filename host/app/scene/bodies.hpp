// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/plan/plan.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host::scene
{

/// The parts of an Appearance by number, in the order of appearance_parts.
constexpr std::size_t partNumber (std::string_view Appearance::*row) noexcept
{
    for (std::size_t i = 0; i < appearance_parts.size(); ++i)
        if (appearance_parts[i].row == row) return i;
    return appearance_parts.size();
}

/// True if the part is a vector.
constexpr bool isVector (std::size_t part) noexcept { return appearance_parts[part].width == 3; }

using PartValues = std::array<std::optional<Vec3>, appearance_parts.size()>;   ///< a number is in x

/// A relief as its node has it in the setting `map`.
struct Relief
{
    std::shared_ptr<const Grid> grid;
    double pitch = 1e-4, height = 1.0;   ///< m; m per unit of the grid
    bool is_picture = false;             ///< the last row is at y = 0, not the first

    bool operator== (const Relief&) const = default;
};

/// A node that has an appearance, in a compiled graph.
struct Body
{
    Appearance::Kind kind {};
    std::string path {};   ///< "finger[0]/face"
    std::string role {};   ///< of the tool that it follows; empty: of none

    /// True if its input `tool` follows the position of a tool by whole vectors: it has a place in the world.
    bool is_placed = false;

    PartValues fixed {};                                         ///< values of params and settings, as the graph stores them
    std::array<std::string, appearance_parts.size()> ports {};   ///< names of the ports that hold the other parts: "face.depth"
    std::shared_ptr<const Surface> surface {};
    Relief relief {};
    std::vector<double> radii {};   ///< m, of its tools; empty: they are points

    double number (std::string_view Appearance::*part, double otherwise) const noexcept
    {
        const auto& v = fixed[partNumber (part)];
        return v ? v->x() : otherwise;
    }
    Vec3 vector (std::string_view Appearance::*part, const Vec3& otherwise) const noexcept { return fixed[partNumber (part)].value_or (otherwise); }
};

/// The bodies of a compiled graph, in file order; bypassed nodes are left out. [main thread]
std::vector<Body> bodiesOf (const Plan&);

/// The ports that a picture of these bodies needs while they are touched. The more important ones come first, because only
/// `most` components are recorded.
std::vector<std::string> portsOf (const std::vector<Body>&, std::size_t most);

/// The values of the ports of these bodies, by body. `valueOf` returns the latest value of a component such as "face.touch.x", or nothing.
/// A vector of which a component is unknown or not finite is left out.
std::vector<PartValues> liveOf (const std::vector<Body>&, const std::function<std::optional<double> (const std::string&)>& valueOf);

}   // namespace tactus::host::scene
