// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/async_query.hpp>
#include <tactus/kit/placed_surface.hpp>
#include <tactus/kit/surface_check.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// An elastic body of any shape, as uneven as flesh. Measured or computed force-deflection curves are stored at the nodes of a
/// mesh, and everything between them is interpolated.
///
///     u^nu = sum_i n_i (c) u_i^nu             frame at the contact point c, by its barycentric weights n_i   (5)
///     d^nu = (p - c) . u^nu                   deflection along u^x, u^y and u^z, which points into the body
///     f^nu = sum_i n_i (c) f_i^nu (d^nu)      force along each; odd along x and y, along z only if d^z > 0   (6)
///     f    = - sum_nu f^nu u^nu               force on the tool
///     |(d^x, d^y)| <= mu_c d^z                else c is dragged along until it is                            (7)
///     f^nu = sum_t w_t f_t^nu (d^nu)          interpolated between the shapes of tools t                     (8) (9)
///
/// A touch begins where the vector from the nearest point of the mesh to p turns inward. c stays there, and the tool pulls on it
/// as on a leaning bristle: flesh sticks, stretches, slips and lets go without a second model. mu_c is a ratio of deflections: a
/// body of stiffnesses k_t across and k_n along the normal has mu_c = mu k_n / k_t. mu_c may be a law of depth. With
/// `friction: frictionless`, or mu 0 everywhere, c follows the tool instead and the force includes -dU/dc, U the stored energy:
/// without that term, a slide from soft to stiff would create energy.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 4, eq. (5) to (9), Fig. 8 and 9;
/// Mahvash & Hayward 2004.
///
/// Departures from the printed chapter
///  - Interpolated frames are neither of unit length nor orthogonal: u^z is normalised, u^x made orthogonal to it, and
///    u^y = u^z x u^x.
///  - Eq. (7) is printed upside down: with more mu_c the contact would slip earlier.
///  - The weights of the tools are latched at contact onset: changing them in contact would add energy.
///  - The chapter does not say what a move of c costs. Each slip turns (f_t - dU/dc) . dc into heat. Where stiffness rises
///    steeply over the mesh and friction is small, this amount is negative, so a slip creates energy. The node warns of such a
///    mesh and reports the depth at which this begins; dissipated_energy then falls.
///
/// Good to know
///  - With c fixed, the force is the gradient of stored_energy, whatever the frames: along a closed path on which the contact
///    sticks, it does no work.
///  - Without friction the force has a potential where frames are orthogonal to their triangles. Frames made of smooth normals
///    tilt the force, as shading does: coarse triangles then feel curved, but a part of the force, about the tilt times the
///    force, has no potential.
///  - Finding the patch: with search_ticks 0 every triangle is searched within the tick, while nothing is touched. With
///    search_ticks above 0, a thread searches and answers that many ticks later; meanwhile the node walks over neighbouring
///    triangles. In contact it only walks: a search never moves c. Nothing can be touched before the first answer.
///  - `depth` is 0 while apart. contact.impact needs a signed depth, so wire `hit` of this node instead.
///  - `normal` and `contact` are meant for friction and texture nodes that follow this one. While apart, contact is p, and normal
///    is the normal of the nearest patch.
///  - A slip is one step of eq. (7). Where mu_c or the frames change over the mesh it ends near the bound, not on it. The rest
///    follows on the next ticks, even for a tool at rest; this takes about ten ticks.
///  - A tool that is farther past the rim of an open mesh than it is above or below it is outside the body: a contact that is
///    dragged there opens. A tool that came in past the rim, or was inside when the first search ended, feels nothing until it
///    has been outside the body once.
///  - Energy in the sideways stretch at the moment the tool lets go is dissipated.
struct ElasticSurface
{
    enum class Friction
    {
        bound,
        frictionless
    };

    struct Inputs
    {
        Vec3 position = Vec3::Zero();
        double tool = 0.0;
    };

    struct Params
    {
        Friction friction = Friction::bound;
    };

    struct Settings
    {
        std::shared_ptr<const Surface> surface = pad();
        double scale = 1.0;
        Vec3 origin = Vec3::Zero();
        Vec3 rotation = Vec3::Zero();
        int search_ticks = 0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double resistance = 0.0;
        double depth = 0.0;
        Vec3 normal = Vec3::Zero();
        Vec3 contact = Vec3::Zero();
        double triangle = -1.0;
        double hit = 0.0;
        double stored_energy = 0.0;
        double dissipated_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "deform.surface",
        .name = "Elastic surface",
        .summary = "A body of any shape, with force curves interpolated over a mesh.",
        .source = "Hayward 2007, section 4, eq. (5) to (9)",
    };

    static constexpr std::string_view friction_names[] { "bound", "frictionless" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::tool, "tool", unit::count, "number of the tool's shape, 0…n-1; a fraction blends two shapes; read at the start of a contact"),
        choice (&Params::friction, "friction", friction_names, "the contact point sticks within a bound, or follows freely"),
        setting (&Settings::surface, "surface", unit::count, "mesh, frames, curves of each tool, deflection ratios mu"),
        setting (&Settings::scale, "scale", unit::metre, "length of one unit of the mesh", { .hard = { 1e-9, inf }, .usual = { 1e-3, 1.0 } }),
        setting (&Settings::origin, "origin", unit::metre, "position of the mesh's origin"),
        setting (&Settings::rotation, "rotation", unit::radian, "rotation of the mesh: axis times angle"),
        setting (&Settings::search_ticks, "search_ticks", unit::count, "ticks that the search for the nearest patch takes; 0: within the tick",
                 { .hard = { 0, 1000 }, .usual = { 0, 40 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::resistance, "resistance", unit::newton, "part of the force along the inward normal, f^z"),
        output (&Outputs::depth, "depth", unit::metre, "deflection along the inward normal, d^z; 0 while apart"),
        output (&Outputs::normal, "normal", unit::count, "direction out of the body at the contact point, -u^z"),
        output (&Outputs::contact, "contact", unit::metre, "contact point c; while apart, the tool's position"),
        output (&Outputs::triangle, "triangle", unit::count, "number of the triangle with the contact point; -1 while apart"),
        output (&Outputs::hit, "hit", unit::hit, "impact speed on the tick of the first touch"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "elastic energy U"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy lost by slipping since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 stuck, 2 slipping or frictionless"),
    };

    Params params;
    Settings settings;

    /// If the curves of a tool differ from node to node, each triangle is searched for slips that gain energy.
    Cost cost() const
    {
        constexpr double work_per_triangle = 500.0, work_per_search = 10'000.0, bytes_per_triangle = 200.0;
        if (! settings.surface || ! settings.surface->mesh) return {};
        const auto searched = std::ranges::count_if (settings.surface->curves, [] (const auto& tool) { return tool.size() > 1; });
        const auto triangles = static_cast<double> (settings.surface->mesh->triangles.size());
        return { .work = triangles * (work_per_triangle + work_per_search * static_cast<double> (searched)), .memory = triangles * bytes_per_triangle };
    }

    std::string problem() const { return settings.surface ? problemOf (*settings.surface) : "no surface is given"; }

    std::string warning (const Setup&) const
    {
        const auto& surface = *settings.surface;
        if (const auto triangles = surface.mesh->triangles.size(); settings.search_ticks == 0 && triangles > 2000)
            return std::to_string (triangles) + " triangles are searched within each tick; set search_ticks to let the search take several ticks";
        if (auto facing = wrongSide (surface); ! facing.empty()) return facing;
        return isFrictionless() ? leaning (surface) : slipGain (surface, settings.scale);
    }

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        body = std::make_shared<const PlacedSurface> (settings.surface, settings.scale, settings.origin, settings.rotation);
        touch = {};
        near = {};
        last = {};
        behind = false;
        until_asked = 0;
        search.reset();
        if (settings.search_ticks == 0) return;

        std::shared_ptr<const NearestTriangle> index;
        if (setup.services.nearest_triangle) index = setup.services.nearest_triangle (std::shared_ptr<const Mesh> (body, &body->walk().mesh()));
        const auto find = [held = body, index] (const Vec3& p) noexcept { return index ? (*index) (p) : nearestOfAll (held->walk().mesh(), p); };
        search = std::make_shared<Search> (find, settings.search_ticks, setup.services.answers);
    }

    /// The contact continues if the mesh, its scale, its origin and its rotation are the same.
    void adopt (const ElasticSurface& old) noexcept
    {
        dissipated = old.dissipated;
        if (! old.body || settings.surface->mesh != old.settings.surface->mesh) return;
        if (settings.scale != old.settings.scale || settings.origin != old.settings.origin || settings.rotation != old.settings.rotation) return;
        touch = old.touch;
        near = old.near;
        behind = old.behind;
        last = old.last;
        if (touch.tool.upper >= static_cast<int> (settings.surface->curves.size())) touch = {};
    }

    Claims claims() const
    {
        double stiffest = 0.0;
        for (const auto& tool : settings.surface->curves)
            for (const auto& curves : tool)
                for (const auto& law : curves)
                    stiffest = std::max (stiffest, law.steepest());
        return { .passive = ! isFrictionless() && shallowestGain (*settings.surface, settings.scale).depth == inf, .stiffness = stiffest };
    }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.position, in.tool)) return fault();
        const auto followed = follow (in, searched (in.position));

        Outputs out { .normal = Vec3::UnitZ(), .contact = in.position, .dissipated_energy = dissipated };
        const Spot& spot = touch.spot.triangle >= 0 ? touch.spot : near;
        if (spot.triangle >= 0)
        {
            const Felt felt = followed ? *followed : body->feel (spot, in.position, touch.tool);
            out.normal = -felt.frame.row (2).transpose();
            if (touch.spot.triangle >= 0) report (felt, in.position, out);
            last.depth = felt.d.z();
        }
        last.known = spot.triangle >= 0;
        return isFinite (out.force, out.stored_energy, out.dissipated_energy) ? out : fault();
    }

private:
    using Search = AsyncQuery<Vec3, int>;
    using Tool = PlacedSurface::Tool;
    using Felt = PlacedSurface::Felt;

    struct Touch
    {
        Spot spot {};   // contact point c; no triangle while apart
        Tool tool {};
        bool frictionless = false;
        bool slipped = false;   // on this tick
        double hit = 0.0;       // on this tick
    };

    struct Sample
    {
        double depth = 0.0;   // signed
        bool known = false;   // whether depth is valid
    };

    /// Updates the contact for a tool at p: the contact begins, sticks, slips or ends. Returns what is felt at the resulting spot,
    /// if that was computed on the way.
    std::optional<Felt> follow (const Inputs& in, std::optional<int> found) noexcept
    {
        touch.slipped = false;
        touch.hit = 0.0;
        if (touch.spot.triangle < 0) return open (in, found);
        return touch.frictionless ? glide (in.position) : stick (in.position);
    }

    std::optional<Felt> open (const Inputs& in, std::optional<int> found) noexcept
    {
        const auto& p = in.position;
        const bool found_late = search && near.triangle < 0;
        near = nearestFrom (found, p);
        if (near.triangle < 0) return {};

        touch.tool = body->toolAt (in.tool);
        const Felt felt = body->feel (near, p, touch.tool);
        const double depth = felt.d.z();
        if (! (depth > 0.0))
            behind = false;
        else if (found_late || body->walk().isBeyondRim (near, p))
            behind = true;
        if (! (depth > 0.0) || behind) return felt;
        touch.spot = near;
        touch.frictionless = isFrictionless();
        touch.hit = last.known ? std::max (0.0, finiteOrZero ((depth - last.depth) / dt)) : 0.0;
        return touch.frictionless ? felt : stick (p);
    }

    /// The search's answer is only a starting point for a walk. Walking on from the previous nearest point may lead to a nearer one,
    /// so the nearer of the two results is returned.
    Spot nearestFrom (std::optional<int> found, const Vec3& p) const noexcept
    {
        if (! search) return body->walk().nearestOfAll (p, near.triangle);
        const Spot walked = near.triangle >= 0 ? body->walk().nearest (near.triangle, p) : Spot {};
        if (! found) return walked;
        const Spot there = body->walk().nearest (*found, p);
        return walked.triangle < 0 || (there.on.point - p).squaredNorm() < (walked.on.point - p).squaredNorm() ? there : walked;
    }

    std::optional<Felt> glide (const Vec3& p) noexcept
    {
        touch.spot = body->walk().nearest (touch.spot.triangle, p);
        const Felt felt = body->feel (touch.spot, p, touch.tool);
        if (felt.d.z() > 0.0 && ! body->walk().isBeyondRim (touch.spot, p)) return felt;
        letGo (p);
        return {};
    }

    std::optional<Felt> stick (const Vec3& p) noexcept
    {
        // Relative; a steady slip ends exactly on the bound, so without this tolerance rounding would make the contact chatter.
        constexpr double guard = 1e-9;
        // Relative; after a slip, the stretch exceeds the bound by more than this only if the rim holds the contact point back.
        constexpr double past_rim = 1e-3;
        bool off = false;
        Felt felt = body->feel (touch.spot, p, touch.tool);
        const double bound = std::max (0.0, body->ratio (touch.spot, felt.d.z()) * felt.d.z());
        const double across = std::hypot (felt.d.x(), felt.d.y());
        if (felt.d.z() > 0.0 && across > bound * (1.0 + guard))
        {
            const Vec3 drag = (felt.d.x() * felt.frame.row (0) + felt.d.y() * felt.frame.row (1)).transpose();
            const double before = felt.energy;
            touch.spot = body->walk().nearest (touch.spot.triangle, touch.spot.on.point + drag * (1.0 - bound / across));
            touch.slipped = true;
            felt = body->feel (touch.spot, p, touch.tool);
            dissipate (before - felt.energy);
            off = std::hypot (felt.d.x(), felt.d.y()) > bound * (1.0 + past_rim) && body->walk().isBeyondRim (touch.spot, p);
        }
        if (felt.d.z() > 0.0 && ! off) return felt;
        dissipate (felt.energy);
        letGo (p);
        return {};
    }

    void letGo (const Vec3& p) noexcept
    {
        near = body->walk().nearest (touch.spot.triangle, p);
        touch = {};
    }

    void dissipate (double energy) noexcept
    {
        if (isFinite (dissipated + energy)) dissipated += energy;
    }

    /// The answer that is due on this tick, if any: the triangle nearest to where the tool was when the search began. Only one
    /// search runs at a time, and only while apart.
    std::optional<int> searched (const Vec3& p) noexcept
    {
        if (! search) return {};
        const bool apart = touch.spot.triangle < 0, asks = apart && until_asked == 0;
        until_asked = asks ? settings.search_ticks - 1 : std::max (0, until_asked - 1);
        const auto found = (*search) (asks ? std::optional<Vec3> (p) : std::nullopt);
        return apart ? found : std::nullopt;
    }

    void report (const Felt& felt, const Vec3& p, Outputs& out) const noexcept
    {
        out.force = -(felt.frame.transpose() * felt.f);
        if (touch.frictionless) out.force -= body->slope (touch.spot, felt, p);
        out.resistance = felt.f.z();
        out.depth = felt.d.z();
        out.contact = touch.spot.on.point;
        out.triangle = static_cast<double> (touch.spot.triangle);
        out.hit = touch.hit;
        out.stored_energy = felt.energy;
        out.state = touch.frictionless || touch.slipped ? 2.0 : 1.0;
    }

    Outputs fault() noexcept
    {
        touch = {};
        behind = false;
        last = {};
        if (search) (*search) (std::nullopt);
        return { .dissipated_energy = dissipated, .state = -1.0 };
    }

    /// If mu is 0 everywhere, the contact follows freely, whatever `friction` says.
    bool isFrictionless() const noexcept
    {
        const auto isNone = [] (const Ratio& mu) { return ! mu.law && mu.number == 0.0; };
        return params.friction == Friction::frictionless || std::ranges::all_of (settings.surface->mu, isNone);
    }

    /// The default surface: a soft square of 10 cm that faces upwards.
    static std::shared_ptr<const Surface> pad()
    {
        static const auto made = [] {
            const Law across { .kind = Law::Kind::power, .a = 500.0, .b = 1.0 }, along { .kind = Law::Kind::power, .a = 1000.0, .b = 1.0 };
            Surface s;
            const std::vector<Vec3> corners { { -0.05, -0.05, 0.0 }, { 0.05, -0.05, 0.0 }, { 0.05, 0.05, 0.0 }, { -0.05, 0.05, 0.0 } };
            s.mesh = std::make_shared<const Mesh> (Mesh { corners, { { 0, 1, 2 }, { 0, 2, 3 } } });
            s.curves.push_back ({ Surface::Curves { across, across, along } });
            s.mu.push_back ({ .number = 0.5 });
            return std::make_shared<const Surface> (std::move (s));
        }();
        return made;
    }

    double dt = 1.0 / Setup {}.rate_hz;   // s
    std::shared_ptr<const PlacedSurface> body;
    std::shared_ptr<Search> search;   // null: the node searches within the tick
    int until_asked = 0;              // ticks until the next search may begin
    Touch touch;
    // The tool went in past the rim of an open mesh, or was already inside when first found; it feels nothing
    // until it has been outside.
    bool behind = false;
    Spot near;   // the nearest point of the mesh while apart, if known
    Sample last;
    double dissipated = 0.0;   // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::ElasticSurface);
