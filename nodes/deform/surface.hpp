// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/patch_search.hpp>
#include <tactus/kit/geometry/placed_surface.hpp>
#include <tactus/kit/geometry/surface_check.hpp>
#include <tactus/kit/geometry/surface_contact.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/threads/async_query.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
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
///     u^nu = sum_t w_t u_t^nu                 interpolated between the shapes of tools t                     (8)
///     f^nu = sum_t w_t f_t^nu (d^nu)          the same for mu_c                                              (9)
///
/// A touch begins where the vector from the nearest point of the mesh to p turns inward. c stays there, and the tool pulls on it
/// as on a leaning bristle: flesh sticks, stretches, slips and lets go without a second model. mu_c is a ratio of deflections: a
/// body of stiffnesses k_t across and k_n along the normal has mu_c = mu k_n / k_t. mu_c may be a law or a curve of depth. Any
/// adhesion function of Fig. 2 may move c, with d_max = mu_c d^z and d_stick = static_ratio d_max: see friction.elasto_plastic.
///
/// c moves only downhill: it moves along its path only while the stored energy U (c, p) does not rise. Where the path leads uphill,
/// as from soft to stiff or over an edge, c stays where it is, even beyond its bound. On an edge a real contact catches, too. Where a body
/// becomes stiffer it does not, but here c may stop for good, and the stiffer place is not felt (docs/decisions/surface_slips.md). With
/// `friction: frictionless`, or mu 0 everywhere, c slides down to a local minimum of U. On a flat body c is then the projection of
/// p, and the force includes -dU/dc: without that term, a slide from soft to stiff would create energy.
///
/// A tool is inside if the straight line from its last sample outside crosses the surface. c is then on the side through which the
/// tool entered, even in a thin plate where another side is nearer.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 4, eq. (5) to (9), Fig. 2, 8 and 9;
/// Mahvash & Hayward 2004; smooth weights: Clough & Tocher 1965.
///
/// Departures from the printed chapter
///  - Interpolated frames are neither of unit length nor orthogonal: u^z is normalised, u^x made orthogonal to it, and
///    u^y = u^z x u^x.
///  - Eq. (7) is printed upside down: with more mu_c the contact would slip earlier.
///  - The weights of the tools are latched at contact onset: changing them during contact would add energy. If they are given per
///    node, they are interpolated at the point where the contact began.
///  - The chapter does not say what a move of c costs. At fixed c the force is the gradient of U in p, so energy can come only from
///    a move of c at fixed p that raises U: by eq. (7) alone a box of 40 x 40 x 20 mm gives 5 mJ back. Here no move raises U, so
///    the node is passive for every mesh, frame, curve and mu. dissipated_energy is the fall of U, and never falls. The fall is
///    computed with the tool where it is in the middle of the move of c. At the end of a tick the springs are stretched too far by half
///    a step, so a fall computed there would grow with the length of the ticks (by a fifth at 1 kHz on the preset `liver`).
///  - c moves at most twice as far as the tool, or farther where the tool is about to leave while the contact is still stretched. So
///    the force does not step where c would drop from one minimum of U to another, as between the triangles of a sphere.
///  - Without friction the barycentric weights n_i are replaced by smooth ones (framework/kit/geometry/smooth_weights.hpp). The gradient of
///    barycentric weights steps at the edges, and so would the force. The exception is a flat body whose given frames lean: there
///    the weights stay barycentric, and dU/dc neglects that the frames turn. This is the law of the golden set `deformation`. Its
///    force steps at edges, and it is not passive; the node warns if the frames lean by more than 5 degrees.
///  - The golden set also applies eq. (7) once per tick, at rest too. So with friction, on a body whose frames are given, c may move any
///    distance in a tick, and the rest of a slip follows on the next ticks, even for a tool at rest: about five ticks. On a body whose
///    frames come from its mesh, a slip ends within its tick, and a repeated sample changes nothing.
///
/// Good to know
///  - With c fixed, the force is the gradient of stored_energy, whatever the frames: along a closed path on which the contact
///    sticks, it does no work.
///  - Without friction on a curved body, the minimum of U may vanish under the tool, at the edges of a box and also between the
///    triangles of a sphere. c then slides to the next minimum while the tool moves on, and some energy is dissipated. While it
///    slides, the tool feels a little drag.
///  - The force changes by less than twice the steepest slope of the curves times the step of the tool, or by more where the tool is
///    about to leave while the contact is still stretched. It steps in three cases: where a contact ends while it is stretched; where
///    the tool passes the rim of an open mesh; and at the collapses of stick-slip.
///  - A contact ends while it is stretched if it had caught: on an edge that is as sharp as the bound is wide, or between coarse bumps, also
///    without friction. The tool then snaps off, as a finger off a corner. A law without time cannot say how long that takes: the force
///    ends on one tick, and what the contact had stored is dissipated. On random straight strokes over a box with 1 N/mm, this happens
///    to one contact in six with a mu_c of 1 and to one in fifty with 0.5, and the steps reach 12 N and 5.4 N. Over bumps of 6 mm in a
///    mesh of 7 mm they reach 0.85 N. A finer mesh makes bumps smooth, and the guard's limit of slew bounds how fast the device follows.
///  - dissipated_energy of a contact that slides is the same at 1, 4 and 20 kHz within 2 %. Where a contact catches and comes free, on coarse
///    bumps or with a mu of 0.01, a longer tick pulls it over a higher barrier: at 1 kHz and 0.15 m/s up to a quarter less energy is lost.
///  - To make the ratio of drag to push the same at every depth, give the curves along x and y the shape of those along z:
///    f^x (mu_c d) = mu f^z (d).
///  - Finding the patch: with search_ticks 0 every triangle is searched within the tick, while nothing is touched. With
///    search_ticks above 0, a thread searches and answers that many ticks later; meanwhile the node walks over neighbouring
///    triangles. In contact it only walks: a search never moves c. Nothing can be touched before the first answer.
///  - `depth` is 0 while apart. contact.impact needs a signed depth, so wire `hit` of this node instead.
///  - `normal` and `contact` are meant for friction and texture nodes that follow this one. While apart, contact is p, and normal
///    is the normal of the nearest patch.
///  - A tool that is farther past the rim of an open mesh than above or below the mesh is outside the body: a contact that is
///    dragged that far ends. A tool that entered around the rim, was inside when the first search ended, or has let go inside the
///    body feels nothing until it has been outside the body once: a contact that begins inside would create energy.
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
        Bristle::Adhesion adhesion = Bristle::Adhesion::stick;
        double static_ratio = 1.0;
        double break_away = 0.7;
    };

    struct Settings
    {
        std::shared_ptr<const Surface> surface = pad();
        double scale = 1.0;
        Vec3 origin = Vec3::Zero();
        Vec3 rotation = Vec3::Zero();
        int search_ticks = 0;
        Curve adhesion_curve { { 0.0, 0.7, 1.0 }, { 0.0, 0.0, 1.0 } };
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
        .keywords = "mesh body organ tissue stiffness",
    };

    static constexpr std::string_view friction_names[] { "bound", "frictionless" };
    static constexpr std::string_view adhesion_names[] { "stick", "dupont", "ramp", "dahl", "curve" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::tool, "tool", unit::count, "number of the tool, 0…n-1; a fraction blends two tools; read at the start of a contact"),
        choice (&Params::friction, "friction", friction_names, "the contact point sticks within a bound, or follows freely"),
        choice (&Params::adhesion, "adhesion", adhesion_names, "how the contact point yields within the bound, Fig. 2; only for friction bound"),
        param (&Params::static_ratio, "static_ratio", unit::gain, "d_stick / d_max, d_max = mu_c d^z; above 1: stick-slip",
               { .hard = { 1, inf }, .usual = { 1, 5 } }),
        param (&Params::break_away, "break_away", unit::gain, "d_ba / d_max, where adhesion dupont begins to yield", { .hard = { 0, 1 } }),
        setting (&Settings::surface, "surface", unit::count, "mesh; frames, curves and deflection ratios mu for each tool shape; tools as mixes of the shapes"),
        setting (&Settings::scale, "scale", unit::metre, "length of one unit of the mesh", { .hard = { 1e-9, inf }, .usual = { 1e-3, 1.0 } }),
        setting (&Settings::origin, "origin", unit::metre, "position of the mesh's origin"),
        setting (&Settings::rotation, "rotation", unit::radian, "rotation of the mesh: axis times angle"),
        setting (&Settings::search_ticks, "search_ticks", unit::count, "ticks that the search for the nearest patch takes; 0: within the tick",
                 { .hard = { 0, 1000 }, .usual = { 0, 40 } }),
        setting (&Settings::adhesion_curve, "adhesion_curve", unit::gain, unit::gain, "zeta d_max as a curve over |d| / d_max; only for adhesion curve"),
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

    static constexpr Appearance appearance {
        .kind = Appearance::Kind::body,
        .tool = "position",
        .normal = "normal",
        .depth = "depth",
        .touch = "contact",
        .surface = "surface",
        .scale = "scale",
        .origin = "origin",
        .rotation = "rotation",
    };

    Params params;
    Settings settings;

    Cost cost() const
    {
        constexpr double work_per_triangle = 500.0, bytes_per_triangle = 200.0;
        if (! settings.surface || ! settings.surface->mesh) return {};
        const auto triangles = static_cast<double> (settings.surface->mesh->triangles.size());
        return { .work = triangles * work_per_triangle, .memory = triangles * bytes_per_triangle };
    }

    std::string problem() const
    {
        const auto inside = [] (double zeta) { return zeta >= 0.0 && zeta <= 1.0; };
        if (settings.adhesion_curve.empty()) return "adhesion_curve needs at least one point";
        if (! std::ranges::all_of (settings.adhesion_curve.y, inside)) return "adhesion_curve must stay between 0 (sticks) and 1 (slides)";
        return settings.surface ? problemOf (*settings.surface) : "no surface is given";
    }

    std::string warning (const Setup&) const
    {
        const auto& surface = *settings.surface;
        if (const auto triangles = surface.mesh->triangles.size(); settings.search_ticks == 0 && triangles > 2000)
            return std::to_string (triangles) + " triangles are searched within each tick; set search_ticks to let the search take several ticks";
        if (auto facing = wrongSide (surface); ! facing.empty()) return facing;
        return isFrictionless() ? leaning (surface) : "";
    }

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        body = std::make_shared<const PlacedSurface> (settings.surface, settings.scale, settings.origin, settings.rotation);
        tool = body->noTool();
        slippery = isSlippery();
        projects = isFlat (*settings.surface);
        leans = isPatchThatLeans (*settings.surface);
        once_per_tick = ! settings.surface->frames.empty();
        touch = {};
        near = {};
        last = {};
        behind = false;
        std::shared_ptr<const NearestTriangle> index;
        if (settings.search_ticks > 0 && setup.services.nearest_triangle)
            index = setup.services.nearest_triangle (std::shared_ptr<const Mesh> (body, &body->walk().mesh()));
        search = PatchSearch (body, settings.search_ticks, index, setup.services.answers);
    }

    /// The contact continues if the mesh, its scale, its origin and its rotation are the same.
    void adopt (const ElasticSurface& old) noexcept
    {
        dissipated = old.dissipated;
        if (! old.body || settings.surface->mesh != old.settings.surface->mesh) return;
        if (settings.scale != old.settings.scale || settings.origin != old.settings.origin || settings.rotation != old.settings.rotation) return;
        if (settings.surface->curves.size() == old.settings.surface->curves.size())
        {
            touch = old.touch;
            tool = old.tool;
        }
        near = old.near;
        behind = old.behind;
        last = old.last;
    }

    Claims claims() const
    {
        double stiffest = 0.0;
        for (const auto& shape : settings.surface->curves)
            for (const auto& curves : shape)
                for (const auto& law : curves)
                    stiffest = std::max (stiffest, law.steepest());
        return { .passive = ! isFrictionless() || ! isPatchThatLeans (*settings.surface), .stiffness = stiffest };
    }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.position, in.tool)) return fault();
        const auto followed = follow (in, search.answer (in.position, ! isTouching()));

        Outputs out { .normal = Vec3::UnitZ(), .contact = in.position, .dissipated_energy = dissipated };
        const Spot& spot = isTouching() ? touch.spot : near;
        if (spot.triangle >= 0)
        {
            const ContactSample felt = followed ? *followed : body->feel (spot, in.position, tool);
            out.normal = -felt.frame.row (2).transpose();
            if (isTouching()) report (felt, in.position, out);
            last.depth = felt.d.z();
        }
        last.known = spot.triangle >= 0;
        last.position = in.position;
        return isFinite (out.force, out.stored_energy, out.dissipated_energy) ? out : fault();
    }

    /// The stored energy if the tool went to p while the contact point stays where it is, or, without friction on a flat body, stays
    /// the projection of p; 0 while apart. The hand's work between two samples is the difference between this energy at the two
    /// positions. So a test can check the energy balance however far apart the samples are.
    double energyAt (const Vec3& p) const noexcept
    {
        if (! isTouching()) return 0.0;
        const bool projected = touch.frictionless && projects;
        return body->feel (projected ? body->walk().nearest (touch.spot.triangle, p) : touch.spot, p, tool).energy;
    }

    /// Where on its last step the tool is taken to be when its contact point moves, in the energy balance: 0 at the start, 1 at the end. A
    /// test computes the hand's work with energyAt() in two parts, before and after the move of the contact point.
    double movedAt() const noexcept { return moved_at; }

private:
    using ContactSample = PlacedSurface::ContactSample;

    struct Touch
    {
        Spot spot {};   // contact point c; no triangle while apart
        bool frictionless = false;
        Bristle::Adhesion adhesion {};
        bool slipped = false;   // on this tick
        double hit = 0.0;       // on this tick
    };

    struct Sample
    {
        Vec3 position = Vec3::Zero();
        double depth = 0.0;   // signed, at the contact point; while apart, at the nearest point
        bool known = false;   // whether position and depth are valid
    };

    bool isTouching() const noexcept { return touch.spot.triangle >= 0; }

    /// Updates the contact for a tool at p: the contact begins, sticks, slips or ends. Returns what is felt at the resulting spot,
    /// if that was computed on the way.
    std::optional<ContactSample> follow (const Inputs& in, std::optional<int> found) noexcept
    {
        touch.slipped = false;
        touch.hit = 0.0;
        if (! isTouching()) return open (in, found);
        return move ({ .from = last.position, .to = in.position, .free = once_per_tick && ! touch.frictionless, .once = once_per_tick });
    }

    std::optional<ContactSample> open (const Inputs& in, std::optional<int> found) noexcept
    {
        const auto& p = in.position;
        const bool found_late = search.takesTime() && near.triangle < 0;
        const Spot before = near;
        near = search.nearest (found, before, p);
        if (near.triangle < 0) return {};

        const int entered = enteredFrom (before, p);
        Spot spot = near;
        tool.smooth = isFrictionless() && ! leans;
        body->choose (in.tool, spot, tool);
        ContactSample felt = body->feel (spot, p, tool);
        if (entered >= 0) belongTo (entered, in, spot, felt);

        const bool past_rim = entered < 0 && last.known && last.depth <= 0.0 && body->walk().isOpen();
        if (! (felt.d.z() > 0.0))
            behind = false;
        else if (found_late || past_rim || body->walk().isBeyondRim (spot, p))
            behind = true;
        const bool repeats = last.known && p == last.position && ! once_per_tick;   // a repeated sample changes nothing
        if (! (felt.d.z() > 0.0) || behind || repeats) return felt;

        touch.spot = spot;
        touch.frictionless = isFrictionless();
        touch.adhesion = params.adhesion;
        touch.hit = last.known ? std::max (0.0, finiteOrZero ((felt.d.z() - last.depth) / dt)) : 0.0;
        return move ({ .from = p, .to = p, .free = true, .once = once_per_tick });
    }

    /// The triangle through which the tool has entered since the last sample; negative if there is none. A move that is shorter than
    /// the distance to the mesh crosses nothing.
    int enteredFrom (const Spot& before, const Vec3& p) const noexcept
    {
        if (! last.known || behind || before.triangle < 0) return -1;
        const double gap2 = (before.on.point - last.position).squaredNorm();
        return (p - last.position).squaredNorm() < gap2 * (1.0 - margin (1e-9)) ? -1 : body->walk().entered (last.position, p);
    }

    /// Puts the contact point of a tool that entered through a triangle on that side of the body, even if another side is nearer. If
    /// the tool is already outside again, this happens only if it is below that side, as behind a thin plate, and not off to its side.
    void belongTo (int entered, const Inputs& in, Spot& spot, ContactSample& felt) noexcept
    {
        const Spot there = body->walk().nearestFacing (entered, in.position, in.position - last.position);
        body->choose (in.tool, there, tool);
        const ContactSample now = body->feel (there, in.position, tool);
        const bool through = ! (felt.d.z() > 0.0), beside = math::hypot (now.d.x(), now.d.y()) > now.d.z();
        if (through && beside) return;
        spot = there;
        felt = now;
    }

    /// Moves the contact point while the tool moves. At the start of a contact, the path has no length.
    ContactSample move (const SurfacePath& path) noexcept
    {
        const SurfaceStep step = stepped (path);
        moved_at = step.share;
        touch.spot = step.spot;
        touch.slipped = step.slips;
        dissipate (step.lost);
        return step.ends ? letGo (step.felt, path.to) : step.felt;
    }

    SurfaceStep stepped (const SurfacePath& path) const noexcept
    {
        if (touch.frictionless) return projects ? projectOn (*body, tool, touch.spot, path.to) : slideOn (*body, tool, touch.spot, path);
        const Bristle unit {
            .adhesion = touch.adhesion, .d_max = 1.0, .d_stick = params.static_ratio, .d_ba = params.break_away, .own = &settings.adhesion_curve
        };
        return stickOn (*body, tool, touch.spot, unit, path);
    }

    /// Ends the contact. A tool that is still inside another part of the body must leave the body before it can touch again: a touch
    /// that begins inside would create energy. A tool that is no deeper than the length of this step counts as outside.
    ContactSample letGo (const ContactSample& felt, const Vec3& p) noexcept
    {
        dissipate (felt.energy);
        near = body->walk().nearest (touch.spot.triangle, p);
        touch = {};
        const ContactSample now = body->feel (near, p, tool);
        behind = now.d.z() > (last.known ? (p - last.position).norm() : 0.0);
        return now;
    }

    void dissipate (double energy) noexcept
    {
        if (isFinite (dissipated + energy)) dissipated += energy;
    }

    void report (const ContactSample& felt, const Vec3& p, Outputs& out) const noexcept
    {
        out.force = -(felt.frame.transpose() * felt.f);
        if (touch.frictionless && projects) out.force -= body->slope (touch.spot, felt, p, tool);
        out.resistance = felt.f.z();
        out.depth = felt.d.z();
        out.contact = touch.spot.on.point;
        out.triangle = static_cast<double> (touch.spot.triangle);
        out.hit = touch.hit;
        out.stored_energy = felt.energy;
        out.state = touch.slipped ? 2.0 : 1.0;
    }

    Outputs fault() noexcept
    {
        touch = {};
        behind = false;
        last = {};
        search.skip();
        return { .dissipated_energy = dissipated, .state = -1.0 };
    }

    /// If mu is 0 everywhere, the contact follows freely, whatever `friction` says.
    bool isFrictionless() const noexcept
    {
        return params.friction == Friction::frictionless || (body ? slippery : isSlippery());
    }

    bool isSlippery() const noexcept { return std::ranges::all_of (settings.surface->mu, &Ratio::isNone); }

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
    PatchSearch search;
    Touch touch;
    PlacedSurface::Tool tool;     // latched while touching
    bool slippery = false;        // mu is 0 everywhere
    bool projects = false;        // the body is flat: without friction, c is the projection of p
    bool leans = false;           // the body is flat, but its frames are not level
    bool once_per_tick = false;   // the frames are given: with friction, eq. (7) is applied once per tick, as in the golden set
    // The tool is inside, but did not enter through the surface: it went around the rim of an open mesh, was already inside when the
    // first search ended, or has let go inside. It feels nothing until it has been outside once.
    bool behind = false;
    double moved_at = 1.0;   // see movedAt()
    Spot near;               // the nearest point of the mesh while apart, if known
    Sample last;
    double dissipated = 0.0;   // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::ElasticSurface);
