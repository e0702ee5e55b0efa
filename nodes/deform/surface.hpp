// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/patch_search.hpp>
#include <tactus/kit/geometry/placed_surface.hpp>
#include <tactus/kit/geometry/surface_check.hpp>
#include <tactus/kit/geometry/surface_contact.hpp>
#include <tactus/kit/geometry/tool_faces.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/threads/async_query.hpp>
#include <tactus/node/node.hpp>
#include <tactus/node/prepared_data.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::nodes
{

/// An elastic body of any shape, as uneven as flesh. Measured or computed force-deflection curves are stored at the nodes of a
/// mesh, and everything between them is interpolated.
///
///     r    = the point of the body nearest to the tool p, the foot
///     w    = rho - (p - r) . n                depth; n the normal at the foot, out of the body, rho the tool's radius
///     q    = r + rho n                        the foot on the body grown by rho
///     s^nu = (q - c) . u^nu, nu = x, y        sideways stretch from the anchor c
///     u^z  = -n, u^x from sum_i n_i (r) u_i^x, u^y = u^z x u^x                                               (5)
///     U    = sum_i n_i (r) [F_i^z (w) + F_i^x (s^x) + F_i^y (s^y)], F^nu the energy of the curve f^nu        (6)
///     f    = - dU/dp                          force on the tool, c fixed
///     |s| <= mu_c w                           else c is dragged along until it is                            (7)
///     U, n of a mixed tool: sum_t w_t of those of the shapes t; rho likewise                                 (8), (9)
///
/// The body is the smooth surface of framework/kit/geometry/smooth_body.hpp. It passes through all nodes, and n_i are its weights.
///
/// So a contact has two points. The springs along the normal belong to the foot, and only the sideways stretch has a memory, the anchor. A touch
/// begins where the path of the tool crosses the surface. The anchor stays there, and the tool pulls on it as on a leaning bristle:
/// flesh sticks, stretches, slips and lets go without a second model. mu_c is a ratio of deflections: a body of stiffnesses k_t across
/// and k_n along the normal has mu_c = mu k_n / k_t. mu_c may be a law or a curve of depth. Any adhesion function of Fig. 2 may move
/// c, with d_max = mu_c w and d_stick = static_ratio d_max: see friction.elasto_plastic. With `friction: frictionless`, or mu 0
/// everywhere, c is q.
///
/// A slip only shortens s, and so it only lowers U. It is never blocked: c is never farther behind than its bound, however stiff the
/// place ahead is, and over a nodule the tool feels what it feels if it presses there. The force includes - dU/dr dr/dp: from soft to
/// stiff, the tool is pushed back, and without this term the slide would create energy. See docs/decisions/surface_slips.md.
///
/// A tool with a radius is a ball. It rolls over sharp edges as over round ones, and does not enter holes narrower than itself.
///
/// A tool is inside if its way from its last place outside crosses the surface. It belongs to the side through which it
/// entered, even in a thin plate where another side is nearer.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 4, eq. (5) to (9), Fig. 2, 8 and 9;
/// Mahvash & Hayward 2004; the surface: Ohtake et al. 2003.
///
/// Departures from the printed chapter
///  - The chapter has one contact point c, which all springs hang on. In that model a contact stops for good where the body becomes stiffer.
///  - u^z is the normal of the body. If frames are given, only their u^x counts. With an interpolated u^z, normals turn up to 1.7 times too
///    fast, and the force has a pole at 0.58 of the radius of curvature.
///  - Eq. (7) is printed upside down: with more mu_c the contact would slip earlier.
///  - The weights of the tools are latched at contact onset: changing them during contact would add energy. If they are given per
///    node, they are interpolated at the point where the contact began.
///  - The barycentric weights n_i are replaced by those of the smooth body. They mix more than three nodes: on a regular mesh, a node has a
///    share of 0.43 of its own curve. So a stiffness that changes over fewer than three cells is smoothed.
///  - A slip also moves c along the normal, towards the depth of the tool, which does not change U. So after a slide by a few times mu_c w, the drag
///    on a curved body is that of a flat one, and it does not step where a round tool rolls onto an edge.
///  - A move of c costs the energy that it lowers: energy can come only from a move of c at fixed p that raises U. No move does, so the
///    node is passive for every mesh, frame, curve and mu. dissipated_energy is the fall of U, and never falls. The fall is computed with
///    the tool where it is in the middle of the move of c.
///
/// Good to know
///  - With c fixed, the force is the gradient of stored_energy, whatever the frames: along a closed path on which the contact
///    sticks, it does no work.
///  - To make the ratio of drag to push the same at every depth, give the curves along x and y the shape of those along z:
///    f^x (mu_c d) = mu f^z (d).
///  - Pressing straight down on a slope of stiffness k' also gives the sideways force - k' w^2 / 2, as on a bed of springs.
///  - Without friction, and with the same curves at all nodes, the force changes by at most max (k, f / (R - w)) per distance moved: k the
///    steepest slope of the curve, R the smallest radius of curvature, up to w = 0.9 R. A tool with a radius feels a sharp edge like this with R = rho.
///  - An edge is sharp where triangles meet at more than `crease` degrees, if it parts the body into faces. The centre of a tool that is inside,
///    deeper than rho, keeps the face that it is on, and feels a step where it passes the edge of that face. The difference of U is
///    dissipated. `crease` 180 makes all edges round, as in files of version 1; a mesh with few nodes is a poor surface then.
///  - Deeper than 0.95 of the radius of curvature there is no foot. The contact then keeps the last one, with its force along the normal only,
///    until the tool has a foot again at which U is not higher, or leaves. A step of the force there is bounded by the energy, not by a pole.
///  - A tool in a hollow edge or in a slot touches only one of both sides from outside.
///  - Finding the patch: with search_ticks 0 every triangle is searched within the tick, while nothing is touched. With
///    search_ticks above 0, a thread searches and answers that many ticks later; meanwhile the node walks over neighbouring
///    triangles. In contact it only walks. Nothing can be touched before the first answer.
///  - `depth` is 0 while apart. contact.impact needs a signed depth, so wire `hit` of this node instead.
///  - `normal` and `contact` are meant for friction and texture nodes that follow this one. `normal` belongs to the foot; `contact`
///    is the point of the mesh nearest to c. While apart, contact is p, and normal is the normal of the nearest patch.
///  - A contact ends when its foot passes the rim of an open mesh, and the force steps. A tool that starts inside, or came in around a
///    rim, feels nothing until it has been outside once: a contact that begins inside would create energy. A contact that cannot begin
///    at once, such as at a thin corner, is tried again for eight ticks. After a fault, a contact goes on unstretched.
///  - Energy in the sideways stretch at the moment the tool lets go is dissipated.
struct ElasticSurface
{
    enum class Friction
    {
        bound,
        frictionless
    };

    enum class Blend
    {
        latched,
        follows
    };

    struct Inputs
    {
        Vec3 position = Vec3::Zero();
        double tool = 0.0;
        Vec3 turn = Vec3::Zero();
    };

    struct Params
    {
        Friction friction = Friction::bound;
        Blend blend = Blend::latched;
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
        double crease = 30.0;
        std::vector<double> tool_radius { 0.0 };
        Curve adhesion_curve { { 0.0, 0.7, 1.0 }, { 0.0, 0.0, 1.0 } };
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        Vec3 torque = Vec3::Zero();
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
    static constexpr std::string_view blend_names[] { "latched", "follows" };
    static constexpr std::string_view adhesion_names[] { "stick", "dupont", "ramp", "dahl", "curve" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::tool, "tool", unit::count, "number of the tool, 0…n-1; a fraction blends two tools; read at the start of a contact"),
        input (&Inputs::turn, "turn", Unit { Quantity::any, { 0, 0, 0 }, "1/rad" },
               "gradient of tool when the tool turns, from deform.tool; only for blend follows"),
        choice (&Params::friction, "friction", friction_names, "the contact point sticks within a bound, or follows freely"),
        choice (&Params::blend, "blend", blend_names, "the tool is fixed at the first touch, or follows its number; a change then acts as a torque"),
        choice (&Params::adhesion, "adhesion", adhesion_names, "how the contact point yields within the bound, Fig. 2; only for friction bound"),
        param (&Params::static_ratio, "static_ratio", unit::gain, "d_stick / d_max, d_max = mu_c w; above 1: stick-slip",
               { .hard = { 1, inf }, .usual = { 1, 5 } }),
        param (&Params::break_away, "break_away", unit::gain, "d_ba / d_max, where adhesion dupont begins to yield", { .hard = { 0, 1 } }),
        setting (&Settings::surface, "surface", unit::count,
                 "mesh; frames, curves and deflection ratios mu for each tool shape; tools as mixes of the shapes"),
        setting (&Settings::scale, "scale", unit::metre, "length of one unit of the mesh", { .hard = { 1e-9, inf }, .usual = { 1e-3, 1.0 } }),
        setting (&Settings::origin, "origin", unit::metre, "position of the mesh's origin"),
        setting (&Settings::rotation, "rotation", unit::radian, "rotation of the mesh: axis times angle"),
        setting (&Settings::search_ticks, "search_ticks", unit::count, "ticks that the search for the nearest patch takes; 0: within the tick",
                 { .hard = { 0, 1000 }, .usual = { 0, 40 } }),
        setting (&Settings::crease, "crease", unit::count,
                 "in degrees: triangles that meet at a larger angle meet at a sharp edge; others are parts of one smooth face",
                 { .hard = { 0, 180 }, .usual = { 10, 180 } }),
        setting (&Settings::tool_radius, "tool_radius", unit::metre, "radius of a round tool, one for each tool or one for all; 0: a point"),
        setting (&Settings::adhesion_curve, "adhesion_curve", unit::gain, unit::gain, "zeta d_max as a curve over |d| / d_max; only for adhesion curve"),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::torque, "torque", unit::torque, "torque on the tool, - dU / d tool times turn; only for blend follows"),
        output (&Outputs::resistance, "resistance", unit::newton, "force of the springs along the normal, f^z"),
        output (&Outputs::depth, "depth", unit::metre, "depth below the surface, w; 0 while apart"),
        output (&Outputs::normal, "normal", unit::count, "direction out of the body at the foot, n"),
        output (&Outputs::contact, "contact", unit::metre, "point of the mesh nearest to the anchor c; while apart, the tool's position"),
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
        .radius = "tool_radius",
        .choice = "tool",
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
        if (! settings.surface) return "no surface is given";
        const auto& radii = settings.tool_radius;
        if (const auto tools = toolsOf (*settings.surface); radii.size() > 1 && radii.size() != tools)
            return "tool_radius has " + std::to_string (radii.size()) + " values for " + std::to_string (tools) + " tools; give one for each, or one for all";
        if (! std::ranges::all_of (radii, [] (double radius) { return radius >= 0.0 && radius < 1.0; }))
            return "each tool_radius must be at least 0, and less than 1 m";
        return problemOf (*settings.surface);
    }

    std::string warning (const Setup& setup) const
    {
        const auto& surface = *settings.surface;
        const auto key = [&] {
            auto numbers = settings.tool_radius;
            numbers.push_back (creaseAngle());
            return keyOf (numbers);
        };
        const auto faults = [&] { return std::make_shared<const std::string> (faultsOf (surface, creaseAngle(), settings.tool_radius)); };
        std::string all = *prepared<std::string> (setup.services.prepared, settings.surface, key, faults, PreparedData::Until::no_source);
        const auto add = [&] (const std::string& more) { all += (all.empty() ? "" : "; ") + more; };
        if (const auto triangles = surface.mesh->triangles.size(); settings.search_ticks == 0 && triangles > 2000)
            add (std::to_string (triangles) + " triangles are searched within each tick; set search_ticks to let the search take several ticks");
        return all;
    }

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        const auto &o = settings.origin, &r = settings.rotation;
        const auto key = [&] {
            std::vector<double> numbers { settings.scale, o.x(), o.y(), o.z(), r.x(), r.y(), r.z(), creaseAngle() };
            for (const double radius : settings.tool_radius)
                numbers.push_back (radius);
            return keyOf (numbers);
        };
        body = prepared<PlacedSurface> (setup.services.prepared, settings.surface, key, [&] {
            return std::make_shared<const PlacedSurface> (settings.surface, settings.scale, o, r, creaseAngle(), settings.tool_radius);
        });
        tool = trial = body->noTool();
        slippery = isSlippery();
        touch = {};
        near = {};
        contact = {};
        last = {};
        clear = {};
        entry = {};
        resumes = false;
        std::shared_ptr<const NearestTriangle> index;
        if (settings.search_ticks > 0 && setup.services.nearest_triangle)
            index = setup.services.nearest_triangle (std::shared_ptr<const Mesh> (body, &body->walk().mesh()));
        search = PatchSearch (body, settings.search_ticks, index, setup.services.answers);
    }

    /// The contact continues if the mesh, its scale, its origin, its rotation and its creases are the same.
    void adopt (const ElasticSurface& old) noexcept
    {
        dissipated = old.dissipated;
        if (! old.body || settings.surface->mesh != old.settings.surface->mesh) return;
        if (settings.scale != old.settings.scale || settings.origin != old.settings.origin || settings.rotation != old.settings.rotation) return;
        if (settings.crease != old.settings.crease) return;
        if (settings.surface->curves.size() == old.settings.surface->curves.size())
        {
            touch = old.touch;
            tool = old.tool;
            adhesion = old.adhesion;
            blend = old.blend;
            began = old.began;
            contact = old.contact;
        }
        near = old.near;
        clear = old.clear;
        resumes = old.resumes;
        last = old.last;
    }

    Claims claims() const
    {
        double stiffest = 0.0;
        for (const auto& shape : settings.surface->curves)
            for (const auto& curves : shape)
                for (const auto& law : curves)
                    stiffest = std::max (stiffest, law.steepest());
        return { .passive = true, .stiffness = stiffest };
    }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.position, in.tool, in.turn)) return fault();
        const auto& p = in.position;
        const auto found = search.answer (p, ! isTouching());
        const bool touched = isTouching();
        slips = false;
        if (touched && blend == Blend::follows) body->choose (in.tool, began, tool);
        const SurfaceSample felt = touched ? move (last.position, p) : open (in, found);

        Outputs out { .normal = Vec3::UnitZ(), .contact = p, .dissipated_energy = dissipated };
        if (isTouching())
        {
            report (felt, p, out);
            if (blend == Blend::follows) out.torque = -slopeOfTool (in.tool, p) * in.turn;
            if (! touched && last.known) out.hit = std::max (0.0, finiteOrZero ((out.depth - last.depth) / dt));
            last.depth = out.depth;
        }
        else if (near.triangle >= 0)
        {
            out.normal = apart.normal;
            last.depth = tool.radius - apart.distance;
        }
        last.known = isTouching() || near.triangle >= 0;
        last.position = p;
        return isFinite (out.force, out.stored_energy, out.dissipated_energy) ? out : fault();
    }

    /// The stored energy if the tool went to p while the anchor stays where it is; 0 while apart. The hand's work between two samples is the
    /// difference between this energy at the two positions. So a test can check the energy balance however far apart the samples are.
    double energyAt (const Vec3& p) const noexcept
    {
        return isTouching() ? followed (*body, tool, touch, last.position, p).felt.energy : 0.0;
    }

    /// Where on its last step the tool is taken to be when its anchor moves, in the energy balance: 0 at the start, 1 at the end. A test
    /// computes the hand's work with energyAt() in two parts, before and after the move of the anchor.
    double movedAt() const noexcept { return moved_at; }

    /// The length of the sideways stretch s, m; 0 while apart.
    double lag() const noexcept
    {
        if (! isTouching() || touch.frictionless) return 0.0;
        return body->feel (touch.foot, &touch.anchor, tool).d.head<2>().norm();
    }

    /// Where the last contact began. A test computes the hand's work of that step from there.
    const SurfaceEntry& begunAt() const noexcept { return entry; }

    void serialize (auto& archive)
    {
        archive (search, touch, tool, blend, began, adhesion, contact, slips, resumes, moved_at, near, apart, clear, entry, last, dissipated);
        const auto isOnBody = [this] (int triangle) { return triangle >= -1 && triangle < (body ? body->smooth().size() : 0); };
        for (const int triangle : { began.triangle, contact.triangle, near.triangle })
            if (! isOnBody (triangle)) archive.refuse ("touches a triangle that does not exist");
        for (const auto* foot : { &touch.foot, &apart, &entry.touch.foot })
        {
            bool fits = foot->faces >= 0 && foot->faces <= SmoothBody::most && std::ranges::all_of (foot->triangles, isOnBody) && isOnBody (foot->beyond);
            for (int i = 0; fits && i < foot->faces; ++i)
                fits = foot->triangles[at (i)] >= 0;
            if (! fits) archive.refuse ("touches a face that does not exist");
        }
        const auto shapes = static_cast<int> (tool.shares.size());
        const auto isShape = [shapes] (const PlacedSurface::Share& s) { return s.shape >= 0 && s.shape < shapes; };
        if (tool.count < 0 || tool.count > shapes || ! std::ranges::all_of (tool.shares, isShape)) archive.refuse ("has a shape that does not exist");
    }

private:
    struct Sample
    {
        Vec3 position = Vec3::Zero();
        double depth = 0.0;   // below the foot; while apart, below the nearest point, and mostly negative
        bool known = false;   // whether position and depth are valid
    };

    /// A place where the tool was outside, and how many ticks ago.
    struct Clear
    {
        Vec3 position = Vec3::Zero();
        int age = -1;   // negative: none
    };
    static constexpr int oldest = 8;   // ticks in which a contact that could not begin is tried again

    bool isTouching() const noexcept { return touch.foot.faces > 0; }

    double creaseAngle() const noexcept { return settings.crease * std::numbers::pi / 180.0; }   // rad
    static std::size_t toolsOf (const Surface& s) { return s.weights.empty() ? s.curves.size() : s.weights.size(); }

    /// The foot while apart. If there is none, the nearest point of the mesh takes its place.
    PlacedSurface::Foot apartAt (const Vec3& p) const noexcept
    {
        const auto& [triangle, on] = near;
        const Vec3 away = p - on.point, normal = direction (areaNormal (cornersOf (body->walk().mesh(), triangle)));
        PlacedSurface::Foot foot = body->smooth().footOn (triangle, on.point);
        if (away.norm() < tool.radius + body->smooth().reachAt (triangle)) foot = body->smooth().followed (foot, p);
        if (foot.found) return foot;
        foot.normal = normal;
        foot.distance = std::copysign (away.norm(), away.dot (normal));
        return foot;
    }

    /// The contact begins where the path of the tool crosses the surface.
    SurfaceSample open (const Inputs& in, std::optional<int> found) noexcept
    {
        const auto& p = in.position;
        const Spot before = near;
        near = search.nearest (found, before, p);
        if (near.triangle < 0) return {};
        body->choose (in.tool, near, tool);
        apart = apartAt (p);
        const auto& foot = apart;
        if (std::exchange (resumes, false))
        {
            const auto from = before.triangle < 0 ? foot : body->smooth().footOn (before.triangle, before.on.point);
            const SurfaceSample there = begun (*body, tool, from, isFrictionless(), p);
            if (there.touch.foot.faces > 0) begin ({ there.touch, p }, before.triangle < 0 ? near : before);
            return there;
        }
        const bool outside = tool.radius - foot.distance <= 0.0;
        if (clear.age >= 0 && ++clear.age > oldest) clear.age = -1;
        std::optional<SurfaceEntry> crossed;
        if (! outside && foot.found && clear.age >= 0) crossed = entryOf (*body, tool, foot, 1.0, clear.position, p, isFrictionless());
        Spot entered = near;
        const Vec3& from = clear.age >= 0 ? clear.position : last.position;
        const double gap2 = (before.on.point - last.position).squaredNorm();   // a shorter move crosses nothing
        if (! crossed && last.known && before.triangle >= 0 && (clear.age > 1 || (p - last.position).squaredNorm() >= gap2 * (1.0 - margin (1e-9))))
        {
            entered = body->walk().entered (from, p);
            if (entered.triangle >= 0)
            {
                const double share = std::clamp ((entered.on.point - from).dot (p - from) / (p - from).squaredNorm(), 0.0, 1.0);
                body->choose (in.tool, entered, tool);
                crossed = entryOf (*body, tool, body->footFrom (entered, entered.on.point), share, from, p, isFrictionless());
            }
        }
        if (outside) clear = { p, 0 };
        if (! crossed) return {};
        const auto first = followed (*body, tool, crossed->touch, crossed->tool, p);
        if (first.touch.held) return {};   // too far in, or through and out again
        begin (*crossed, entered);
        return move (entry.tool, p);
    }

    void begin (const SurfaceEntry& there, const Spot& spot) noexcept
    {
        entry = there;
        touch = there.touch;
        contact = spot;
        adhesion = params.adhesion;
        blend = params.blend;
        began = spot;
        clear = {};
    }

    SurfaceSample move (const Vec3& from, const Vec3& to) noexcept
    {
        const Bristle unit {
            .adhesion = adhesion, .d_max = 1.0, .d_stick = params.static_ratio, .d_ba = params.break_away, .own = &settings.adhesion_curve
        };
        const SurfaceStep step = stepped (*body, tool, touch, unit, from, to);
        moved_at = step.share;
        slips = step.slips;
        if (isFinite (dissipated + step.lost)) dissipated += step.lost;
        if (step.ends)
        {
            near = search.nearest ({}, contact, to);
            apart = apartAt (to);
            if (! step.after.left && ! (step.after.felt.d.z() > 0.0)) clear = { to, 0 };
        }
        touch = step.ends ? SurfaceTouch {} : step.after.touch;
        return step.after;
    }

    void report (const SurfaceSample& felt, const Vec3& p, Outputs& out) noexcept
    {
        contact = body->walk().nearest (contact.triangle, touch.frictionless ? touch.foot.point : touch.anchor);
        out.force = forceOf (*body, tool, felt, p);
        out.resistance = felt.felt.f.z();
        out.depth = felt.felt.d.z();
        out.normal = -felt.felt.frame.row (2).transpose();
        out.contact = contact.on.point;
        out.triangle = static_cast<double> (contact.triangle);
        out.stored_energy = felt.felt.energy;
        out.state = slips || touch.frictionless ? 2.0 : 1.0;
    }

    /// dU / d tool, J, with the anchor where it is.
    double slopeOfTool (double number, const Vec3& p) noexcept
    {
        const auto tools = static_cast<double> (toolsOf (*settings.surface));
        return toolSlope (number, tools - 1.0, [&] (double n) {
            body->choose (n, began, trial);
            return followed (*body, trial, touch, p, p).felt.energy;
        });
    }

    Outputs fault() noexcept
    {
        resumes = resumes || isTouching();
        if (isTouching()) near = contact;
        touch = {};
        last = {};
        clear = {};
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
    SurfaceTouch touch;
    PlacedSurface::Tool tool;        // latched while touching, or follows
    PlacedSurface::Tool trial;       // room to try another tool
    Blend blend {};                  // latched while touching
    Spot began;                      // where the contact began
    Bristle::Adhesion adhesion {};   // the same
    Spot contact;                    // the point of the mesh nearest to the anchor
    bool slippery = false;           // mu is 0 everywhere
    bool slips = false;              // on this tick
    bool resumes = false;            // a fault has interrupted a contact
    double moved_at = 1.0;           // see movedAt()
    Spot near;                       // the nearest point of the mesh while apart, if known
    PlacedSurface::Foot apart;       // the foot while apart
    Clear clear;                     // where a contact can begin from
    SurfaceEntry entry;              // where the last one began
    Sample last;
    double dissipated = 0.0;   // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::ElasticSurface);
