// SPDX-License-Identifier: MIT
#pragma once

#include "bench.hpp"
#include "measure.hpp"

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace tactus::check
{

/// The value of a param or choice as it is set, without wires; the fallback if the node has no such param.
double valueInFile (const Plan&, std::size_t node, std::string_view id, double fallback);

/// The value of a setting that is a number; the fallback if the node has no such setting.
double settingInFile (const Plan&, std::size_t node, std::string_view id, double fallback);

/// Finds the shortest stretch s at which the contact of a friction node slides while at least half of its largest drag is felt. A light
/// touch slides at a shorter stretch, but its drag is weaker, too. What counts as s depends on the node:
///
///  - A friction with a normal_force and load `bound`: s = (mu f_n/sigma) (d_max/d_max0).
///  - Any other node with a param d_max in m: s = d_max.
///  - A surface with a contact, a normal and a depth, such as deform.surface: s is mu_c times the depth; mu_c is the largest
///    ratio of sideways to normal deflection while the contact slips.
class StretchWatch
{
public:
    /// Empty if the node does not stretch like this.
    static std::optional<StretchWatch> of (const Plan&, std::size_t node);

    void poll (const Plan&, std::size_t tick);   ///< call after each tick

    std::size_t node() const noexcept { return its_node; }
    double shortest() const noexcept;                          ///< s, in m; infinite if the node gave no force
    bool wasFelt() const noexcept { return ! seen.empty(); }   ///< the node gave a force
    double teeth() const noexcept;                             ///< length of the teeth of stick-slip at this stretch, in m; 0 without stick-slip
    Stretch::Softer softer() const noexcept { return its_softer; }
    std::vector<std::size_t> feltTicks() const;   ///< the ticks at which at least half of its largest drag is felt

private:
    enum class Kind
    {
        fixed,
        bound,
        surface
    };

    StretchWatch (const Plan&, std::size_t node, Kind);

    double input (const Plan&, std::string_view id, int component = 0) const;
    double output (const Plan&, std::string_view id, int component = 0) const;
    Vec3 vectorOutput (const Plan&, std::string_view id) const;
    double param (const Plan&, std::string_view id) const;
    void lookAtFriction (const Plan&);
    void lookAtSurface (const Plan&);

    std::size_t its_node;
    Kind kind;
    Stretch::Softer its_softer = Stretch::Softer::unknown;
    NodeForces forces;
    /// A tick with a force.
    struct Seen
    {
        std::size_t tick;
        double drag;      // N
        double stretch;   // m; of a surface, its depth
    };

    double largestDrag() const noexcept;

    std::vector<Seen> seen {};
    std::size_t now = 0;         // the tick of the last poll
    double ratio = 0.0;          // of a surface: mu_c
    double static_ratio = 1.0;   // 1: no stick-slip
};

}   // namespace tactus::check
