// SPDX-License-Identifier: MIT
#pragma once

#include <framework/mesh_walk.hpp>
#include <framework/node.hpp>
#include <framework/rotation.hpp>
#include <framework/slow_question.hpp>
#include <framework/surface_check.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// A body that gives under the tool, of any shape and as uneven as flesh: measured or computed force-deflection curves
/// stand at the nodes of a mesh, and everything between them is interpolated.
///
///     u^nu = sum_i n_i (c) u_i^nu             frame at the contact point c, by its barycentric weights n_i   (5)
///     d^nu = (p - c) . u^nu                   deflection along u^x, u^y and u^z, which points into the body
///     f^nu = sum_i n_i (c) f_i^nu (d^nu)      force along each; x and y odd, z only while d^z > 0            (6)
///     f    = - sum_nu f^nu u^nu               force on the tool
///     |(d^x, d^y)| <= mu_c d^z                else c is dragged along until it is so                         (7)
///     f^nu = sum_t w_t f_t^nu (d^nu)          between the shapes of tools t                                  (8) (9)
///
/// A touch begins where the way from p to the nearest point of the mesh turns inward: there c stays, and the tool pulls
/// on it as on a bristle that leans; so flesh is felt to stick, stretch, slip and let go without a second model. mu_c is
/// a ratio of deflections: a body of stiffnesses k_t across and k_n along the normal has mu_c = mu k_n / k_t. It may be a
/// law of the depth. With `friction: frictionless`, or mu 0 everywhere, c follows the tool instead and the force has the
/// part -dU/dc as well, U the energy stored: without it a slide from soft to stiff would make energy.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 4, eq. (5) to (9), Fig. 8 and 9;
/// Mahvash & Hayward 2004.
///
/// Departures from the printed chapter
///  - Interpolated frames are neither of unit length nor square: u^z is normalised, u^x made square to it, u^y = u^z x u^x.
///  - Eq. (7) is printed upside down: with more mu_c the contact would slip earlier.
///  - Weights of tools are latched at the onset: changed in contact they would feed energy in.
///  - Where c moves, the chapter does not ask what it costs. Each slip turns (f_t - dU/dc) . dc into heat, which is
///    negative, energy out of nothing, where stiffness rises steeply over the mesh and friction is small. The node warns of
///    such a mesh and says from which depth on; dissipated_energy shows it.
///
/// Good to know
///  - With c fixed, the force is the gradient of stored_energy, whatever the frames: a closed path that sticks costs nothing.
///  - Frictionless, the force is that of a potential where frames stand square on their triangles. Frames of smooth normals
///    tilt it, as shading does: a felt curvature that costs the tilt times the force.
///  - Looking for the patch: with search_ticks 0 every triangle is looked at within the tick, while nothing is touched. With
///    more, a thread searches and answers that many ticks later; meanwhile the neighbours are walked. In contact only they
///    are: a search never moves c. Nothing can be touched before the first answer.
///  - A depth of 0 while apart is no food for contact.impact, which wants it signed: wire `hit` instead.
///  - `normal` and `contact` are made for friction and texture nodes behind this one. Apart, contact is p, and normal that of
///    the nearest patch.
///  - A slip is one step of eq. (7). Where mu_c or the frames change over the mesh it ends near the bound, not on it, and
///    the rest follows on the next ticks, also of a tool at rest: some ten of them.
///  - Past the rim of an open mesh, by more than the depth, there is nothing: a contact dragged there lets go. What has come
///    in behind the rim, or was inside when the first search ended, feels nothing until it has been outside.
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
        .summary = "A body of any shape whose force curves are interpolated over a mesh.",
        .source = "Hayward 2007, section 4, eq. (5) to (9)",
    };

    static constexpr std::string_view friction_names[] { "bound", "frictionless" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::tool, "tool", unit::count, "which shape of tool, 0…n-1, between two interpolated; latched at onset"),
        choice (&Params::friction, "friction", friction_names, "the contact point sticks within a bound, or follows freely"),
        setting (&Settings::surface, "surface", unit::count, "mesh, frames, curves of each tool, deflection ratios mu"),
        setting (&Settings::scale, "scale", unit::metre, "length of one unit of the mesh", { .hard = { 1e-9, inf }, .usual = { 1e-3, 1.0 } }),
        setting (&Settings::origin, "origin", unit::metre, "where the mesh's origin lies"),
        setting (&Settings::rotation, "rotation", unit::radian, "how the mesh is turned: axis times angle"),
        setting (&Settings::search_ticks, "search_ticks", unit::count, "how long the search for the nearest patch may take; 0: within the tick", { .hard = { 0, 1000 }, .usual = { 0, 40 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::resistance, "resistance", unit::newton, "the part along the inward normal, f^z"),
        output (&Outputs::depth, "depth", unit::metre, "deflection along it, d^z; 0 while apart"),
        output (&Outputs::normal, "normal", unit::count, "out of the body at the contact point, -u^z"),
        output (&Outputs::contact, "contact", unit::metre, "contact point c; while apart the tool's position"),
        output (&Outputs::triangle, "triangle", unit::count, "where the contact point lies; -1 while apart"),
        output (&Outputs::hit, "hit", unit::hit, "impact speed on the tick of the first touch"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "elastic energy U"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy lost by slipping since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 stuck, 2 slipping or frictionless"),
    };

    Params params;
    Settings settings;

    std::string problem() const { return settings.surface ? problemOf (*settings.surface) : "it has no surface"; }

    std::string warning (const Setup&) const
    {
        const auto& surface = *settings.surface;
        if (const auto triangles = surface.mesh->triangles.size(); settings.search_ticks == 0 && triangles > 2000)
            return std::to_string (triangles) + " triangles are searched within each tick; give the search some ticks of time with search_ticks";
        if (auto facing = wrongSide (surface); ! facing.empty()) return facing;
        return isFrictionless() ? leaning (surface) : slipGain (surface, settings.scale);
    }

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        body = std::make_shared<const Body> (settings);
        touch = {};
        near = {};
        last = {};
        behind = false;
        until_asked = 0;
        search.reset();
        if (settings.search_ticks == 0) return;

        std::shared_ptr<const NearestTriangle> index;
        if (setup.services.nearest_triangle) index = setup.services.nearest_triangle (std::shared_ptr<const Mesh> (body, &body->walk.mesh()));
        const auto find = [held = body, index] (const Vec3& p) noexcept
        { return index ? (*index) (p) : nearestOfAll (held->walk.mesh(), p); };
        search = std::make_shared<Search> (find, settings.search_ticks, setup.services.answers);
    }

    /// The contact lives on, if the mesh is the same.
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
        const auto found = searched (in.position);
        const auto followed = follow (in, found);

        Outputs out { .normal = Vec3::UnitZ(), .contact = in.position, .dissipated_energy = dissipated };
        const Spot& spot = touch.spot.triangle >= 0 ? touch.spot : near;
        if (spot.triangle >= 0)
        {
            const Felt felt = followed ? *followed : feel (spot, in.position, touch.tool);
            out.normal = -felt.frame.row (2).transpose();
            if (touch.spot.triangle >= 0) report (felt, in.position, out);
            last.depth = felt.d.z();
        }
        last.known = spot.triangle >= 0;
        return isFinite (out.force, out.stored_energy, out.dissipated_energy) ? out : fault();
    }

private:
    using Search = SlowQuestion<Vec3, int>;
    using Curves = Surface::Curves;

    /// The mesh and its frames where they are in the world.
    struct Body
    {
        explicit Body (const Settings& s) : walk (placed (s)), frames (s.surface->frames)
        {
            if (frames.empty())
                for (const auto& n : normalsOf (walk.mesh()))
                    frames.push_back (frameInto (-n));
            else
                for (auto& f : frames)
                    f *= rotationMatrix (s.rotation).transpose();
            for (const auto& f : frames)
                squared.push_back (square (f));
            for (const auto& corners : walk.mesh().triangles)
            {
                const auto at = [&] (std::size_t i) -> const Mat3&
                { return frames[static_cast<std::size_t> (corners[i])]; };
                even.push_back (at (0) == at (1) && at (0) == at (2));
            }
        }

        /// The frame at a spot: that of its corners where they are alike, as on a flat patch, else in between.
        Mat3 frameAt (const Spot& spot) const noexcept
        {
            const auto t = static_cast<std::size_t> (spot.triangle);
            const auto& corners = walk.mesh().triangles[t];
            if (even[t]) return squared[static_cast<std::size_t> (corners[0])];

            Mat3 sum = Mat3::Zero();
            for (std::size_t i = 0; i < 3; ++i)
                sum += spot.on.weights[i] * frames[static_cast<std::size_t> (corners[i])];
            return square (sum);
        }

        /// With u^z of length 1, u^x square to it, and u^y to both.
        static Mat3 square (const Mat3& frame) noexcept
        {
            const Vec3 z = direction (frame.row (2).transpose());
            Vec3 x = frame.row (0).transpose();
            x = direction (x - x.dot (z) * z);
            Mat3 squared_frame;
            squared_frame << x.transpose(), z.cross (x).transpose(), z.transpose();
            return squared_frame;
        }

        static Mesh placed (const Settings& s)
        {
            Mesh mesh = *s.surface->mesh;
            const Mat3 turn = rotationMatrix (s.rotation);
            for (auto& p : mesh.points)
                p = s.origin + turn * (s.scale * p);
            return mesh;
        }

        /// The frame with this u^z that comes from (x, -y, -z) by the shortest turn, so that neighbours have it alike.
        static Mat3 frameInto (const Vec3& z)
        {
            Mat3 frame;
            frame << Vec3::UnitX().transpose(), -Vec3::UnitY().transpose(), -Vec3::UnitZ().transpose();
            return z.isZero (0.0) ? frame : Mat3 { frame * Eigen::Quaterniond::FromTwoVectors (-Vec3::UnitZ(), z).toRotationMatrix().transpose() };
        }

        MeshWalk walk;
        std::vector<Mat3> frames, squared;
        std::vector<bool> even;   // of each triangle: its corners have the same frame
    };

    /// Two neighbouring shapes of tool, and how much there is of the second.
    struct Tool
    {
        int lower = 0, upper = 0;
        double amount = 0.0;
    };

    struct Touch
    {
        Spot spot {};   // contact point c; no triangle while apart
        Tool tool {};
        bool frictionless = false;
        bool slipped = false;   // on this tick
        double hit = 0.0;       // on this tick
    };

    /// What the curves say of a tool at p with its contact point at a spot.
    struct Felt
    {
        Mat3 frame = Mat3::Identity();       // rows u^x, u^y, u^z
        Vec3 d = Vec3::Zero();               // along them
        Vec3 f = Vec3::Zero();               // along them
        std::array<double, 3> energies {};   // sum_nu F_i^nu of each corner
        double energy = 0.0;
    };

    struct Sample
    {
        double depth = 0.0;   // signed
        bool known = false;   // the depth is
    };

    /// From a contact that holds to one that slipped, from apart to the first touch, or the other way. What is felt at
    /// the new spot comes back where it has been worked out; it need not be again.
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

        touch.tool = toolAt (in.tool);
        const Felt felt = feel (near, p, touch.tool);
        const double depth = felt.d.z();
        if (! (depth > 0.0))
            behind = false;
        else if (found_late || body->walk.isBeyondRim (near, p))
            behind = true;
        if (! (depth > 0.0) || behind) return felt;
        touch.spot = near;
        touch.frictionless = isFrictionless();
        touch.hit = last.known ? std::max (0.0, finiteOrZero ((depth - last.depth) / dt)) : 0.0;
        return touch.frictionless ? felt : stick (p);
    }

    /// An answer is a place to walk from; what was walked to meanwhile may be nearer.
    Spot nearestFrom (std::optional<int> found, const Vec3& p) const noexcept
    {
        if (! search) return body->walk.nearestOfAll (p, near.triangle);
        const Spot walked = near.triangle >= 0 ? body->walk.nearest (near.triangle, p) : Spot {};
        if (! found) return walked;
        const Spot there = body->walk.nearest (*found, p);
        return walked.triangle < 0 || (there.on.point - p).squaredNorm() < (walked.on.point - p).squaredNorm() ? there : walked;
    }

    std::optional<Felt> glide (const Vec3& p) noexcept
    {
        touch.spot = body->walk.nearest (touch.spot.triangle, p);
        const Felt felt = feel (touch.spot, p, touch.tool);
        if (felt.d.z() > 0.0 && ! body->walk.isBeyondRim (touch.spot, p)) return felt;
        letGo (p);
        return {};
    }

    std::optional<Felt> stick (const Vec3& p) noexcept
    {
        constexpr double guard = 1e-9;      // relative: a steady slip ends exactly on the bound, where rounding would chatter
        constexpr double past_rim = 1e-3;   // relative: a rim that holds the contact back, not a turn of the frame
        bool off = false;
        Felt felt = feel (touch.spot, p, touch.tool);
        const double bound = std::max (0.0, ratio (touch.spot, felt.d.z()) * felt.d.z());
        const double across = std::hypot (felt.d.x(), felt.d.y());
        if (felt.d.z() > 0.0 && across > bound * (1.0 + guard))
        {
            const Vec3 drag = (felt.d.x() * felt.frame.row (0) + felt.d.y() * felt.frame.row (1)).transpose();
            const double before = felt.energy;
            touch.spot = body->walk.nearest (touch.spot.triangle, touch.spot.on.point + drag * (1.0 - bound / across));
            touch.slipped = true;
            felt = feel (touch.spot, p, touch.tool);
            dissipate (before - felt.energy);
            off = std::hypot (felt.d.x(), felt.d.y()) > bound * (1.0 + past_rim) && body->walk.isBeyondRim (touch.spot, p);
        }
        if (felt.d.z() > 0.0 && ! off) return felt;
        dissipate (felt.energy);
        letGo (p);
        return {};
    }

    void letGo (const Vec3& p) noexcept
    {
        near = body->walk.nearest (touch.spot.triangle, p);
        touch = {};
    }

    void dissipate (double energy) noexcept
    {
        if (isFinite (dissipated + energy)) dissipated += energy;
    }

    /// The answer to where we were a while ago, while apart. One question is asked at a time.
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
        if (touch.frictionless) out.force -= slope (felt, p);
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

    Tool toolAt (double wanted) const noexcept
    {
        const int most = static_cast<int> (settings.surface->curves.size()) - 1;
        const double t = std::clamp (wanted, 0.0, static_cast<double> (most));
        const int lower = static_cast<int> (t);
        return { lower, std::min (lower + 1, most), t - lower };
    }

    Felt feel (const Spot& spot, const Vec3& p, const Tool& tool) const noexcept
    {
        Felt felt;
        felt.frame = body->frameAt (spot);
        felt.d = felt.frame * (p - spot.on.point);
        add (felt, spot, tool.lower, 1.0 - tool.amount);
        if (tool.amount > 0.0) add (felt, spot, tool.upper, tool.amount);
        for (std::size_t i = 0; i < 3; ++i)
            felt.energy += spot.on.weights[i] * felt.energies[i];
        return felt;
    }

    /// The part of one tool in the forces and energies.
    void add (Felt& felt, const Spot& spot, int tool, double amount) const noexcept
    {
        const auto& curves = settings.surface->curves[static_cast<std::size_t> (tool)];
        const auto& corners = body->walk.mesh().triangles[static_cast<std::size_t> (spot.triangle)];
        const bool alike = curves.size() == 1;
        for (std::size_t i = 0; i < 3; ++i)
        {
            const double share = alike ? amount : amount * spot.on.weights[i];
            const Curves& of = curves[alike ? 0 : static_cast<std::size_t> (corners[i])];
            double energy = 0.0;
            for (int axis = 0; axis < 3; ++axis)
            {
                const Law& law = of[static_cast<std::size_t> (axis)];
                const double d = axis < 2 ? std::abs (felt.d[axis]) : felt.d[axis];
                const auto [force, stored] = law.at (d);
                felt.f[axis] += share * (felt.d[axis] < 0.0 ? -force : force);
                energy += stored;
            }
            if (alike)
            {
                felt.energies = { felt.energies[0] + amount * energy, felt.energies[1] + amount * energy, felt.energies[2] + amount * energy };
                return;
            }
            felt.energies[i] += amount * energy;
        }
    }

    double ratio (const Spot& spot, double depth) const noexcept
    {
        const auto& mu = settings.surface->mu;
        if (mu.empty()) return 0.0;
        if (mu.size() == 1) return mu[0](depth);
        const auto& corners = body->walk.mesh().triangles[static_cast<std::size_t> (spot.triangle)];
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            sum += spot.on.weights[i] * mu[static_cast<std::size_t> (corners[i])](depth);
        return sum;
    }

    /// dU/dc of a contact point that follows the tool: on a triangle, or, where a crease or the rim holds it, along that.
    Vec3 slope (const Felt& felt, const Vec3& p) const noexcept
    {
        const auto& [triangle, on] = touch.spot;
        const auto corners = cornersOf (body->walk.mesh(), triangle);
        const auto gradients = gradientsOf (corners);
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i)
            sum += felt.energies[i] * gradients[i];

        const Vec3 away = p - on.point, normal = direction (areaNormal (corners));
        const Vec3 sideways = away - away.dot (normal) * normal;
        if (sideways.norm() <= 1e-9 * away.norm()) return sum;
        for (std::size_t i = 0; i < 3; ++i)
            if (on.weights[i] == 0.0 && on.weights[(i + 1) % 3] > 0.0 && on.weights[(i + 2) % 3] > 0.0)
            {
                const Vec3 edge = direction (corners[(i + 2) % 3] - corners[(i + 1) % 3]);
                return edge.dot (sum) * edge;
            }
        return Vec3::Zero();
    }

    /// With no friction anywhere, the contact follows freely whatever the choice.
    bool isFrictionless() const noexcept
    {
        return params.friction == Friction::frictionless || std::ranges::all_of (settings.surface->mu, [] (const Ratio& r)
                                                                                 { return ! r.law && r.number == 0.0; });
    }

    /// What a new node is: a soft square of 10 cm that faces upwards.
    static std::shared_ptr<const Surface> pad()
    {
        static const auto made = []
        {
            const Law across { .kind = Law::Kind::power, .a = 500.0, .b = 1.0 }, along { .kind = Law::Kind::power, .a = 1000.0, .b = 1.0 };
            Surface s;
            s.mesh = std::make_shared<const Mesh> (Mesh { { { -0.05, -0.05, 0.0 }, { 0.05, -0.05, 0.0 }, { 0.05, 0.05, 0.0 }, { -0.05, 0.05, 0.0 } }, { { 0, 1, 2 }, { 0, 2, 3 } } });
            s.curves.push_back ({ Surface::Curves { across, across, along } });
            s.mu.push_back ({ .number = 0.5 });
            return std::make_shared<const Surface> (std::move (s));
        }();
        return made;
    }

    double dt = 1.0 / Setup {}.rate_hz;   // s
    std::shared_ptr<const Body> body;
    std::shared_ptr<Search> search;   // none: within the tick
    int until_asked = 0;              // ticks
    Touch touch;
    bool behind = false;   // it came in where there is no surface: nothing until it has been outside
    Spot near;             // the nearest point of the mesh while apart, as far as known
    Sample last;
    double dissipated = 0.0;   // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::ElasticSurface);
