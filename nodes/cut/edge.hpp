// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/cut_places.hpp>
#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/kit/signal/line_over_columns.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace tactus::nodes
{

/// A straight edge that is pressed into a flat body at any angle. It cuts the body where it is pressed in, and the cut stays there.
///
/// The edge lies along the x axis of the tool. It slides over the surface until it cracks the body. From then on the cut has a plane,
/// spanned by the edge and the normal of the surface. In this plane the edge is a line from (x_a, delta_a) to (x_b, delta_b), where
/// x is the position along the surface and delta the depth. The body consists of columns of width h = `grid`. Column j has a crack
/// of depth c_j, and behaves like a strip of the sample of cut.blade:
///
///     E      = sum_j (h / L) w_j V (delta_j, c_j)   V: work of a slow blade from the tip of the crack to delta_j, with rupture and cutting
///     force  = - dE / dp                            w_j: share of column j that is under the edge; delta_j: mean depth there
///     torque = - dE / dphi                          L: length of the edge, `width`
///
/// The derivatives are exact and taken with the cracks fixed. Then each crack follows the edge by the rules of cut.blade. This turns V
/// into elastic energy, plus J_c L times the growth of the crack, plus the loss at rupture.
///
/// A level edge behaves like cut.blade. The resistance of an edge that is tilted by an angle rises over a depth of L sin (angle).
/// Then the edge cuts with the force J_c L cos (angle): J_c times the surface that it opens per metre of depth.
///
/// An edge that is drawn along itself enters columns from the side. The crack of such a column follows only when the edge is over the
/// whole column; until then the column only yields, with all of V. So at a crack of depth c, the edge is held back by the force J_c c
/// plus the loss at rupture per length of edge: Griffith's balance again. If the hand lets go, the edge is pushed back by at most 2 h.
///
/// There is no force across the plane: an edge in its cut feels as if it were projected onto the plane. The edge can cut elsewhere only
/// after all of it has left the body. If it comes back with both ends within h of the plane of an old cut, it enters this cut
/// again and feels nothing down to the tip of the crack. Everywhere else the body is whole.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 3, Fig. 5; Mahvash & Hayward 2001.
///
/// Departures from the printed chapter
///  - Fig. 5 shows an edge and does not say how it may move. Here the force is a gradient, and cracks change only where this lowers E.
///    So for every movement, the work of the hand is the growth of stored plus dissipated energy, and no movement generates energy.
///  - A part of the edge gets a share of rupture_force and of the laws: its length along the surface divided by `width`.
///
/// Good to know
///  - As with cut.blade, only movement counts, not time: if one tick takes the edge from the air to deep inside, the cracks end where
///    they would with a slow edge.
///  - The columns under a tilted edge burst one after another. Each causes the share h / L of the drop in force. If the skin is tougher
///    than the flesh, this feels like a crunch, which is finer with a finer grid.
///  - If the edge ends over a column, the whole column cracks, but the hand does only the work for the part under the edge. So the
///    surface of a cut is right to within one column at each end.
///  - The node remembers the last 16 cuts. A new cut replaces the one that has been unused for longest. The node remembers 512 columns
///    of each cut: once the edge is 512 columns further on, the cut has healed behind it. If `width` is above 250 h, columns are
///    width / 250 wide.
///  - Cuts that cross each other do not feel each other. An edge that slides over the surface passes over old cuts.
///  - An edge that enters upright opens no surface, and feels nothing.
///  - For friction on the flanks, and for walls that keep the blade in its cut, add friction nodes whose normal force is proportional
///    to the crack.
///  - Params are read when the edge touches uncut material. `state` is 5 while all columns under the edge are cut through.
///  - Over random loops that tilt the edge, turn it and move it aside, the work of the hand, integrated by the trapezoid rule, is the
///    growth of stored plus dissipated energy to within the error of the rule: on each tick, half the change of the force times the step.
///  - The end of an edge that is drawn along itself feels a stiffness of about J_c c / h, which grows with the depth of the cut.
struct Edge
{
    struct Inputs
    {
        Position position = Position::Zero();
        Vec3 rotation = Vec3::Zero();
    };

    struct Params
    {
        double width = 0.02;
        double toughness = 200.0;
        double rupture_force = 6.0;
        double thickness = 0.0;
    };

    struct Settings
    {
        Law law { .kind = Law::Kind::power, .a = 2000.0, .b = 1.0 };
        Law cracked_law {};
        double grid = 1e-3;
        Vec3 normal = Vec3::UnitZ();
        double offset = 0.0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        Vec3 torque = Vec3::Zero();
        double resistance = 0.0;
        double crack = 0.0;
        double stored_energy = 0.0;
        double dissipated_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "cut.edge",
        .name = "Edge",
        .summary = "A straight edge that cuts a body at any angle; each cut stays in its place.",
        .source = "Hayward 2007, section 3, Fig. 5; Mahvash & Hayward 2001",
        .keywords = "knife scalpel fracture crack",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "middle of the edge"),
        input (&Inputs::rotation, "rotation", unit::radian, "rotation of the tool: axis times angle; the edge is along its x axis"),
        param (&Params::width, "width", unit::metre, "length of the edge", { .hard = { 0, inf }, .usual = { 0, 0.1 }, .latch = true }),
        param (&Params::toughness, "toughness", unit::toughness, "J_c, energy per area of new surface",
               { .hard = { 0, inf }, .usual = { 0, 5000 }, .latch = true }),
        param (&Params::rupture_force, "rupture_force", unit::newton,
               "force at which a level edge bursts the sample open; at least width times toughness",
               { .hard = { 0, inf }, .usual = { 0, 50 }, .latch = true }),
        param (&Params::thickness, "thickness", unit::metre, "length of the crack at which the sample is cut through; 0: never",
               { .hard = { 0, inf }, .usual = { 0, 0.2 }, .latch = true }),
        setting (&Settings::law, "law", unit::metre, unit::newton, "force on a level edge against depth, while there is no crack"),
        setting (&Settings::cracked_law, "cracked_law", unit::metre, unit::newton, "force against depth beyond the crack; if not given, the same as law"),
        setting (&Settings::grid, "grid", unit::metre, "width of a column, which has one crack depth; an edge this near to an old cut enters it again",
                 { .hard = { 1e-6, 1 }, .usual = { 1e-4, 1e-2 } }),
        setting (&Settings::normal, "normal", unit::gain, "direction out of the body; any length but 0"),
        setting (&Settings::offset, "offset", unit::metre, "position of the surface along the unit normal", { .usual = { -0.1, 0.1 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::torque, "torque", unit::torque, "torque on the tool about the middle of the edge"),
        output (&Outputs::resistance, "resistance", unit::newton, "part of the force along the normal"),
        output (&Outputs::crack, "crack", unit::metre, "deepest crack under the edge"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "elastic energy"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy spent on cracks since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 virgin, 2 rupture, 3 elastic with crack, 4 cutting, 5 cut through"),
    };

    static constexpr Appearance appearance {
        .kind = Appearance::Kind::blade,
        .tool = "position",
        .normal = "normal",
        .offset = "offset",
        .rotation = "rotation",
        .width = "width",
        .crack = "crack",
        .thickness = "thickness",
    };

    Params params;
    Settings settings;

    std::string problem() const
    {
        if (settings.normal.isZero (0.0)) return "normal must have a direction; it is 0";
        return Cutting::problem (params.width, params.toughness, params.rupture_force, settings.law, cracked());
    }

    Cost cost() const { return { .memory = static_cast<double> (sizeof (CutPlaces::Column)) * CutPlaces::cuts * CutPlaces::columns }; }

    void prepare (const Setup&) { n = direction (settings.normal); }

    /// Keeps the cuts unless the normal of the surface has changed.
    void adopt (const Edge& old) noexcept
    {
        memory = old.memory;
        if (n != old.n) return;
        places.adopt (old.places);
        contact = old.contact;
        if (contact.touching) contact.cutting = read (contact.params);
    }

    /// The stiffness at the end of an edge that is drawn along itself grows with the depth of the cut, without a bound.
    Claims claims() const { return { .passive = true, .stiffness = inf }; }

    Outputs tick (const Inputs&) noexcept;

    void serialize (auto& archive)
    {
        archive (places, contact, memory);
        if (contact.cut >= CutPlaces::cuts) archive.refuse ("has a cut that does not exist");
    }

private:
    using Line = LineOverColumns;
    using Part = LineOverColumns::Part;

    /// Sums over the columns under the edge.
    struct Sum
    {
        double by_depth[2] {};                          // derivative of E by the depth of a and b, N
        double by_place[2] {};                          // derivative of E by the position of a and b if the ends slide along the line, N
        double stored = 0.0, lost = 0.0, crack = 0.0;   // J, J, m
        int columns = 0, in_two = 0;
        bool bursts = false, cuts = false, presses = false, cracked = false;
    };

    struct Contact
    {
        Params params;   // read when the edge touches uncut material
        Cutting cutting;
        bool inside = false, touching = false;
        bool floats = false;   // the cut has no crack yet
        std::size_t cut = 0;
        std::int32_t first = 0, end = 0;   // the columns that were under the edge on the last tick inside are first to end - 1
    };

    struct Memory
    {
        double crack = 0.0, dissipated = 0.0;   // m, J
    };

    const Law& cracked() const noexcept { return settings.cracked_law ? settings.cracked_law : settings.law; }
    double depthOf (const Position& p) const noexcept { return settings.offset - n.dot (p); }
    static double stateOf (const Sum&) noexcept;

    Cutting read (const Params&) const noexcept;
    CutPlaces::Cut* cutUnder (const Vec3& a, const Vec3& b, bool inside) noexcept;
    static bool touches (const CutPlaces::Cut&, const Line&) noexcept;
    static void lookAt (const CutPlaces::Cut&, const Line&, Sum&) noexcept;
    void press (CutPlaces::Cut&, const Line&, bool enters, Sum&) noexcept;
    Law::Point pressColumn (CutPlaces::Column&, const Part&, double share, Sum&) const noexcept;
    void follow (CutPlaces::Cut&, const Vec3& a, const Vec3& b) const noexcept;
    static void release (CutPlaces::Cut&, std::int32_t first, std::int32_t end) noexcept;
    void leave() noexcept;
    Outputs fault() noexcept;

    Vec3 n = Vec3::UnitZ();
    CutPlaces places;
    Contact contact;
    Memory memory;
};

//==============================================================================
// Implementation below.

inline Edge::Outputs Edge::tick (const Inputs& in) noexcept
{
    if (! isFinite (in.position, in.rotation) || n.isZero (0.0)) return fault();

    double width = contact.touching ? contact.params.width : params.width;
    if (contact.inside) width = std::min (width, CutPlaces::longest * places[contact.cut].spacing());
    const Vec3 edge = rotationMatrix (in.rotation).col (0);
    const Position a = in.position - 0.5 * width * edge, b = in.position + 0.5 * width * edge;
    Line line { .depth = { depthOf (a), depthOf (b) } };
    if (! isFinite (a, b, line.depth[0], line.depth[1])) return fault();

    const bool inside = std::max (line.depth[0], line.depth[1]) > 0.0, enters = inside && ! contact.inside;
    if (! inside) leave();
    auto* const cut = cutUnder (a, b, inside);
    contact.inside = inside;

    Sum sum { .lost = memory.dissipated };
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    if (cut)
    {
        if (inside && contact.floats) follow (*cut, a, b);
        line.x[0] = cut->place (a);
        line.x[1] = cut->place (b);
        if (! (std::max (std::abs (line.x[0]), std::abs (line.x[1])) < CutPlaces::furthest * cut->spacing())) return fault();
        if (inside)
        {
            press (*cut, line, enters, sum);
            contact.floats = contact.floats && ! sum.bursts;
        }
        else
            lookAt (*cut, line, sum);
        const double by_a = sum.by_place[0] - line.slope() * sum.by_depth[0], by_b = sum.by_place[1] - line.slope() * sum.by_depth[1];
        const double common = contact.floats ? 0.5 * (by_a + by_b) : 0.0;   // a cut that floats follows the edge: only the distance of a and b counts
        const Vec3 f_a = sum.by_depth[0] * n - (by_a - common) * cut->along(), f_b = sum.by_depth[1] * n - (by_b - common) * cut->along();
        force = f_a + f_b;
        torque = 0.5 * width * edge.cross (f_b - f_a);
    }
    const Outputs out {
        .force = force,
        .torque = torque,
        .resistance = sum.by_depth[0] + sum.by_depth[1],
        .crack = sum.crack,
        .stored_energy = sum.stored,
        .dissipated_energy = sum.lost,
        .state = stateOf (sum),
    };
    if (! isFinite (out.force, out.torque, out.resistance, out.crack, out.stored_energy, out.dissipated_energy)) return fault();
    memory = { .crack = out.crack, .dissipated = out.dissipated_energy };
    return out;
}

inline Cutting Edge::read (const Params& p) const noexcept
{
    return { { .cost = p.width * p.toughness, .rupture_force = p.rupture_force, .thickness = p.thickness }, settings.law, cracked() };
}

/// The cut that the edge is in or above; null if the material below it is whole. An edge that enters whole material begins a cut, which
/// floats with the edge until it cracks.
inline CutPlaces::Cut* Edge::cutUnder (const Vec3& a, const Vec3& b, bool inside) noexcept
{
    if (contact.inside && inside) return &places[contact.cut];

    auto* cut = places.find (a, b);
    if (! inside) return cut;

    contact.floats = ! cut;
    if (! cut) cut = &places.begin (std::max (settings.grid, params.width / CutPlaces::longest));
    places.use (*cut);
    contact.cut = places.indexOf (*cut);
    contact.first = contact.end = 0;
    return cut;
}

/// Moves a cut that has no crack yet to the position of the edge.
inline void Edge::follow (CutPlaces::Cut& cut, const Vec3& a, const Vec3& b) const noexcept
{
    const Vec3 edge = direction (b - a), flat = edge - n * n.dot (edge);
    const Vec3 along = flat.norm() > margin (1e-9) ? flat.normalized() : perpendicularTo (n);
    CutPlaces::place (cut, 0.5 * (a + b), along, n.cross (along));
}

/// True if the edge presses on uncut material.
inline bool Edge::touches (const CutPlaces::Cut& cut, const Line& line) noexcept
{
    const double h = cut.spacing();
    for (auto j = line.first (h); j < line.end (h); ++j)
        if (const Part part = line.over (j, h))
            if (const auto crack = cut.crackAt (j); ! crack.in_two && part.depth > crack.length) return true;
    return false;
}

/// Counts the columns under an edge that is above the surface, and finds the deepest crack.
inline void Edge::lookAt (const CutPlaces::Cut& cut, const Line& line, Sum& sum) noexcept
{
    for (auto j = line.first (cut.spacing()); j < line.end (cut.spacing()); ++j)
    {
        if (! line.over (j, cut.spacing())) continue;
        const auto crack = cut.crackAt (j);
        ++sum.columns;
        sum.in_two += crack.in_two;
        sum.crack = std::max (sum.crack, crack.length);
    }
}

/// Moves the edge to this line, and lets the cracks under it follow. `enters` is true if the edge was outside the body on the last tick.
inline void Edge::press (CutPlaces::Cut& cut, const Line& line, bool enters, Sum& sum) noexcept
{
    const double h = cut.spacing();
    const std::int32_t first = line.first (h), end = line.end (h);
    release (cut, contact.first, std::min (contact.end, first));
    release (cut, std::max (contact.first, end), contact.end);
    contact.first = first;
    contact.end = end;

    const bool touching = touches (cut, line);
    if (touching && ! contact.touching)
    {
        contact.params = params;
        contact.cutting = read (params);
    }
    contact.touching = touching;

    const double width = contact.params.width;
    for (auto j = first; j < end; ++j)
    {
        auto& column = cut[j];
        const Part part = line.over (j, h);
        column.follows = part && (column.follows || enters || part.share >= 1.0 || part.depth <= column.crack.length);
        if (! part) continue;

        const Law::Point point = touching ? pressColumn (column, part, h / width, sum) : Law::Point {};
        ++sum.columns;
        sum.in_two += column.crack.in_two;
        sum.crack = std::max (sum.crack, column.crack.length);
        if (point.energy == 0.0 && point.force == 0.0) continue;

        const double f = h / width * part.share * point.force;
        sum.stored += h / width * part.share * point.energy;
        sum.by_depth[0] += f * (1.0 - part.along);
        sum.by_depth[1] += f * part.along;
        for (int i = 0; i < 2; ++i)
            sum.by_place[i] += (i ? 1.0 : -1.0) * line.sign() / width * part.hat[i] * (point.energy + point.force * (line.depth[i] - part.depth));
    }
}

/// V and its derivative by depth, after the crack has followed the edge. A column that the edge enters from the side keeps its crack.
inline Law::Point Edge::pressColumn (CutPlaces::Column& column, const Part& part, double share, Sum& sum) const noexcept
{
    Cutting::Crack crack = column.crack;
    if (crack.length >= contact.cutting.last()) crack.in_two = true;

    double lost = 0.0;
    Cutting::Event event;
    if (! crack.in_two && part.depth > crack.length) event = contact.cutting.press (crack, part.depth, cracked(), lost);
    Law::Point point = Cutting::answer (crack, part.depth, settings.law, cracked());

    const bool loaded = ! crack.in_two && part.depth > crack.length;
    sum.presses = sum.presses || loaded;
    sum.cracked = sum.cracked || (loaded && ! crack.virgin);
    if (! column.follows)
    {
        point.energy += lost;
        return point;
    }
    column.crack = crack;
    sum.lost += share * part.share * lost;
    sum.bursts = sum.bursts || event.bursts;
    sum.cuts = sum.cuts || (event.cuts && ! crack.in_two);
    return point;
}

inline double Edge::stateOf (const Sum& s) noexcept
{
    if (s.bursts) return 2.0;
    if (s.cuts) return 4.0;
    if (s.presses) return s.cracked ? 3.0 : 1.0;
    return s.columns > 0 && s.in_two == s.columns ? 5.0 : 0.0;
}

/// Marks columns that are no longer under the edge. If the edge later enters them from the side, they only yield at first.
inline void Edge::release (CutPlaces::Cut& cut, std::int32_t first, std::int32_t end) noexcept
{
    for (auto j = first; j < end; ++j)
        cut[j].follows = false;
}

/// Ends the contact, because the edge has left the body or its position is unknown.
inline void Edge::leave() noexcept
{
    if (! contact.inside) return;
    auto& cut = places[contact.cut];
    release (cut, contact.first, contact.end);
    if (contact.floats) CutPlaces::forget (cut);
    contact.inside = contact.touching = contact.floats = false;
}

inline Edge::Outputs Edge::fault() noexcept
{
    leave();
    return { .crack = memory.crack, .dissipated_energy = memory.dissipated, .state = -1.0 };
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Edge);
