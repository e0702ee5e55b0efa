// SPDX-License-Identifier: MIT
#include "slopes.hpp"
#include "pair.hpp"
#include "side_by_side.hpp"

#include <tactus/kit/at.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace tactus::check
{

namespace
{
using MatrixXd = Jacobian;
using Eigen::VectorXd;
using Matrix = Eigen::Matrix3d;

constexpr std::size_t least_hold = 24;       // ticks; longer than the window of motion.velocity
constexpr std::size_t longest_watch = 264;   // ticks
constexpr double narrowest = 2e-8;           // m; a change of force over less is a jump

Eigen::Index first (std::size_t role) noexcept { return static_cast<Eigen::Index> (3 * role); }

/// The largest factor by which the matrix stretches a vector, and that vector.
struct Stretched
{
    double factor;
    Vec3 direction;
};

Stretched mostStretched (const Matrix& m)
{
    const Matrix square = m.transpose() * m;
    const Eigen::SelfAdjointEigenSolver<Matrix> parts (square);
    return { std::sqrt (std::max (0.0, parts.eigenvalues()[2])), parts.eigenvectors().col (2) };
}

/// By node: true if its vectors reach the motors in the directions of the tool: added, scaled or filtered as a whole, but not turned.
std::vector<bool> unturned (const Plan& plan)
{
    const auto& flat = plan.flat();
    const auto keepsDirections = [] (std::string_view type) {
        return type == "vector.add" || type == "vector.scale" || type == "layer.mix_vectors" || type.starts_with ("filter.") || type.starts_with ("safety.");
    };
    std::vector<bool> are (flat.nodes.size(), true);
    for (bool changes = true; changes;)
    {
        changes = false;
        for (const auto& w : flat.wires)
        {
            if (! w.from || ! are[at (w.from->node)]) continue;
            const auto& from = flat.node (w.from->node).type->outputs[at (w.from->port)];
            const auto& to = flat.node (w.to.node);
            const bool is_sink = to.type->effort != nullptr, is_whole = w.from->component < 0 && w.to.component < 0;
            if (from.width != 3 || (is_whole && (is_sink || (keepsDirections (to.type->info.id) && are[at (w.to.node)])))) continue;
            are[at (w.from->node)] = false;
            changes = true;
        }
    }
    return are;
}

/// Does the work of measureSlopes().
class SlopeSurvey
{
public:
    SlopeSurvey (const Subject& subject, const HandMotion& m, const SlopeWork& w)
        : motion (m), work (w), pair (subject, m, w.without, holdFor (w.longest_delay)), roles (m.roles.size()), are_unturned (unturned (pair.plan()))
    {
        found.by_role.resize (roles);
        found.directions.assign (roles, Directions (pair.nodes(), Matrix::Zero()));
    }

    Slopes measure()
    {
        for (const auto& spot : work.spots)
        {
            pair.moveTo (spot.middle());
            const double slope = measureHere();
            if (work.looks_for_jumps && spot.to > spot.from) lookCloser (spot, slope);
        }
        return std::move (found);
    }

private:
    const HandMotion& motion;
    const SlopeWork& work;
    Pair pair;
    std::size_t roles;
    std::vector<bool> are_unturned;   // by node
    Slopes found {};

    static std::size_t holdFor (std::int64_t delay)
    {
        return std::min (longest_watch, least_hold + static_cast<std::size_t> (std::max<std::int64_t> (delay, 0)));
    }

    /// Adds the slopes at the place where the pair is. Returns the Frobenius norm of the Jacobian of all forces, in N/m.
    double measureHere()
    {
        const auto size = first (roles);
        const MatrixXd zero = MatrixXd::Zero (size, size);
        Linked all { .t_s = pair.time(), .settled = zero, .late = zero, .excess = zero, .by_node = std::vector<double> (pair.nodes(), 0.0) };
        for (std::size_t r = 0; r < roles; ++r)
            found.by_role[r].push_back (slopeOf (r, all));
        // So far, the matrices describe the force on the tool. In Linked, a positive number pulls the tool back.
        for (auto* m : { &all.settled, &all.late, &all.excess })
            *m = -*m;
        shorten (all.responses);
        for (std::size_t r = 0; r < roles; ++r)
            for (std::size_t n = 0; n < pair.nodes(); ++n)
                all.by_node[n] = std::max (all.by_node[n], found.by_role[r].back().by_node[n]);
        const double steepest = all.settled.norm();
        found.linked.push_back (std::move (all));
        return steepest;
    }

    /// Leaves out the ticks at the end at which nothing changes; all of them if the rest is too long for a loop.
    static void shorten (std::vector<MatrixXd>& responses)
    {
        constexpr std::size_t longest = 64;   // ticks
        constexpr double matters = 1e-6;      // relative
        for (auto& m : responses)
            m = -m;
        double most = 0.0;
        for (const auto& m : responses)
            most = std::max (most, m.norm());
        while (responses.size() > 1 && (responses[responses.size() - 2] - responses.back()).norm() <= matters * most)
            responses.pop_back();
        if (responses.size() > longest) responses.clear();
    }

    /// Fills in the column of a shift in the responses of all forces, tick by tick.
    void keepPath (Linked& all, Eigen::Index column, double sign, const Pair::Response& response) const
    {
        const auto path = pair.lastPath();
        if (path.size() > all.responses.size())
            all.responses.resize (path.size(), all.responses.empty() ? MatrixXd (MatrixXd::Zero (first (roles), first (roles))) : all.responses.back());
        for (std::size_t k = 0; k < all.responses.size() && ! path.empty(); ++k)
            for (std::size_t r = 0; r < roles; ++r)
            {
                // respond() leaves out the forces of a role that do not grow in proportion to the shift.
                const auto its = [&] (const VectorXd& v) { return v.segment<3> (first (r)); };
                const bool counts = its (response.settled).squaredNorm() + its (response.excess).squaredNorm() + its (response.late).squaredNorm() > 0.0;
                all.responses[k].block<3, 1> (first (r), column) = counts ? Vec3 (sign * its (path[std::min (k, path.size() - 1)])) : Vec3 (Vec3::Zero());
            }
    }

    /// Shifts the tool of a role along each axis, in both directions, and fills in the columns of the role in the matrices. The
    /// larger of the two responses is kept.
    Slope slopeOf (std::size_t role, Linked& all)
    {
        Slope slope { .t_s = pair.time(),
                      .position = pair.position (role),
                      .force = pair.force (role),
                      .brake = pair.brake (role),
                      .by_node = std::vector<double> (pair.nodes(), 0.0),
                      .pulls = std::vector<Matrix> (pair.nodes(), Matrix::Zero()) };
        std::array<std::vector<double>, 3> own;
        own.fill (std::vector<double> (pair.numberOfForces(), 0.0));
        for (int axis = 0; axis < (motion.roles[role].axis ? 1 : 3); ++axis)
        {
            const auto column = first (role) + axis;
            own[at (axis)].assign (pair.numberOfForces(), 0.0);
            double most_felt = -1.0;
            std::array<VectorXd, 2> sides { VectorXd::Zero (first (roles)), VectorXd::Zero (first (roles)) };
            for (const double sign : { -1.0, 1.0 })
                if (const auto response = pair.respond (role, sign * Vec3::Unit (axis)))
                {
                    const auto keep = [&] (MatrixXd& m, const VectorXd& v) {
                        for (std::size_t r = 0; r < roles; ++r)
                            if (const Vec3 part = v.segment<3> (first (r)); part.norm() > m.block<3, 1> (first (r), column).norm())
                                m.block<3, 1> (first (r), column) = sign * part;
                    };
                    keep (all.settled, response->settled);
                    keep (all.late, response->late);
                    keep (all.excess, response->excess);
                    const double felt = response->settled.norm() * holding_s() + response->late.norm() + response->excess.norm();
                    if (felt > most_felt)
                    {
                        keepPath (all, column, sign, *response);
                        own[at (axis)] = pair.ownResponses();
                        for (double& v : own[at (axis)])
                            v *= sign;
                    }
                    most_felt = std::max (most_felt, felt);
                    pair.raise (slope.by_node);
                    sides[sign > 0.0] = sign * response->settled;
                }
            const double most = std::max (sides[0].norm(), sides[1].norm());
            if ((sides[0] - sides[1]).norm() > 0.05 * most) all.is_smooth = false;
        }
        addForces (slope, role, own);
        summarise (slope, role, all);
        return slope;
    }

    /// Adds the directions in which the nodes' own forces change, and those in which they feel a displacement.
    void addForces (Slope& slope, std::size_t role, const std::array<std::vector<double>, 3>& own)
    {
        std::vector<Matrix> felt (pair.nodes(), Matrix::Zero());
        pair.eachForce ([&] (std::size_t node, std::size_t first_of, std::size_t width) {
            Eigen::MatrixXd jacobian (static_cast<Eigen::Index> (width), 3);
            for (std::size_t i = 0; i < width; ++i)
                jacobian.row (static_cast<Eigen::Index> (i)) << own[0][first_of + i], own[1][first_of + i], own[2][first_of + i];
            felt[node] += jacobian.transpose() * jacobian;
            if (width == 3 && are_unturned[node] && ! motion.roles[role].axis) slope.pulls[node] += jacobian * jacobian.transpose();
        });
        for (std::size_t n = 0; n < felt.size(); ++n)
        {
            found.directions[role][n] += felt[n];
            if (slope.pulls[n].isZero (0.0)) slope.pulls[n] = felt[n];
        }
    }

    void summarise (Slope& slope, std::size_t role, const Linked& all)
    {
        const auto own = [&] (const MatrixXd& m) { return Matrix (m.block<3, 3> (first (role), first (role))); };
        // No matrix describes a nonlinear response, such as that of friction. So the stiffness is measured again in the steepest direction.
        const Matrix settled = own (all.settled), excess = own (all.excess);
        const Vec3 steepest = mostStretched (settled).direction, most_damped = mostStretched (excess).direction;
        for (int axis = 0; axis < 3; ++axis)
            slope.stiffness = std::max (slope.stiffness, settled.col (axis).norm());
        const bool is_steep = slope.stiffness > 0.0, is_damped = excess.norm() > 0.0;
        const auto keep = [&] (std::vector<double> response) {
            if (! response.empty()) slope.responses.push_back (std::move (response));
        };
        if (all.is_smooth && ! all.responses.empty() && (is_steep || is_damped))   // a linear response is known from its columns
        {
            slope.stiffness = mostStretched (settled).factor;
            const auto along = [&] (const Vec3& d) {
                std::vector<double> response;
                for (const auto& m : all.responses)
                    response.push_back (-d.dot (own (m) * d));
                return response;
            };
            if (is_steep) keep (along (steepest));
            if (is_damped && (! is_steep || std::abs (steepest.dot (most_damped)) < 1.0 - 1e-6)) keep (along (most_damped));
            slope.lag = mostStretched (own (all.late)).factor;
            slope.damping = mostStretched (excess).factor;
            return;
        }
        if (is_steep) keep (largestResponse (slope, role, steepest, [] (const Pair::Response& r) { return &r.settled; }));
        const bool is_another = ! is_steep || std::abs (steepest.dot (most_damped)) < 1.0 - 1e-6;
        if (is_damped && is_another) keep (largestResponse (slope, role, most_damped, [] (const Pair::Response& r) { return &r.excess; }));
        if (slope.responses.size() < std::size_t { is_steep } + std::size_t { is_damped && is_another }) slope.responses.clear();
        slope.lag = mostStretched (own (all.late)).factor;
        slope.damping = mostStretched (excess).factor;
    }

    /// The force that pulls back after a step in a direction, or in the opposite one if that has the larger part, tick by tick. The stiffness is
    /// raised to what is found. Empty if there is no response.
    template <typename Part>
    std::vector<double> largestResponse (Slope& slope, std::size_t role, const Vec3& direction, Part&& part)
    {
        std::vector<double> found_most;
        double most = 0.0;
        for (const double sign : { -1.0, 1.0 })
            if (const auto response = pair.respond (role, sign * direction))
            {
                slope.stiffness = std::max (slope.stiffness, response->of (role).norm());
                const double now = part (*response)->template segment<3> (first (role)).norm();
                if (now < most) continue;
                most = now;
                found_most = pair.pullBack (role, sign * direction);
            }
        return found_most;
    }

    double holding_s() const noexcept { return 0.5 / motion.rate_hz; }

    VectorXd positionsAt (double tick) const
    {
        VectorXd all (first (roles));
        for (std::size_t r = 0; r < roles; ++r)
        {
            const auto& readings = motion.roles[r].readings;
            const auto k = std::min (static_cast<std::size_t> (tick), readings.size() - 1), next = std::min (k + 1, readings.size() - 1);
            all.segment<3> (first (r)) = readings[k].position + (tick - static_cast<double> (k)) * (readings[next].position - readings[k].position);
        }
        return all;
    }

    /// Narrows down where along a spot the forces change most, unless the slope in the middle explains the change.
    void lookCloser (const Spot& spot, double slope)
    {
        constexpr double unexplained = 1.5;
        const VectorXd way = positionsAt (spot.to) - positionsAt (spot.from);
        if (! (way.norm() > narrowest)) return;
        const auto start = pair.changeAt (spot.from);
        const VectorXd end = start + pair.changeAt (spot.to);
        const double change = (end - start).norm();
        if (change > unexplained * slope * way.norm()) narrow (spot, start, end, way);
        pair.meet();
    }

    /// A spot that becomes narrower, and the forces at its ends and at the place of the last changeAt(), in N, relative to those at one place.
    struct Narrowed
    {
        Spot spot;
        VectorXd start, end, now;
    };

    /// Halves the spot, which is `width` wide, until it is this narrow. The half with the larger change stays.
    void halve (Narrowed& n, double width, double until)
    {
        for (; width > until; width *= 0.5)
        {
            n.now += pair.changeAt (n.spot.middle());
            if ((n.now - n.start).norm() >= (n.end - n.now).norm())
            {
                n.spot.to = n.spot.middle();
                n.end = n.now;
            }
            else
            {
                n.spot.from = n.spot.middle();
                n.start = n.now;
            }
        }
    }

    void narrow (const Spot& whole, const VectorXd& start, const VectorXd& end, const VectorXd& way)
    {
        const VectorXd all = end - start;
        Narrowed n { whole, start, end, end };
        halve (n, way.norm(), narrowest);
        n.now += pair.changeAt (n.spot.from);
        const VectorXd step = pair.changeAt (n.spot.to);
        std::vector<double> by_node (pair.nodes(), 0.0);
        pair.raise (by_node);
        n.now += step;
        n.now += pair.changeAt (whole.from);
        const VectorXd back = n.now;
        n.now += pair.changeAt (whole.to);
        // A change that does not repeat when the tools go back and forth again is an event, such as a rupture, or friction.
        constexpr double same = 0.25;
        const bool repeats = (n.now - back - all).norm() <= same * all.norm();
        const bool jumps = repeats && step.norm() >= same * all.norm() && staysAStep (n.spot, step);
        pair.meet();
        if (! repeats) return;
        if (jumps) return addJump (n.spot, step, way.normalized(), by_node);
        pair.moveTo (n.spot.middle());
        measureHere();
    }

    /// True if the forces still step over a sixteenth of the narrowest spot. A slope that bends near the end of a spot, such as that of a limited force, steps
    /// less the narrower the spot is.
    bool staysAStep (const Spot& narrow, const VectorXd& step)
    {
        constexpr double narrower = 1.0 / 16.0, stays = 0.5;
        pair.changeAt (narrow.from);
        const VectorXd zero = VectorXd::Zero (step.size());
        Narrowed n { narrow, zero, step, step };
        n.now += pair.changeAt (narrow.to) - step;
        halve (n, 1.0, narrower);
        return (n.end - n.start).norm() >= stays * step.norm();
    }

    /// A jump F across a surface with the normal n has the slope -F n^T, whose symmetric part has the largest eigenvalue (|F| - F.n)/2 (per
    /// width). The path crosses the surface at an unknown angle; all that is known of n is that it points to the same side as the
    /// path. So a jump against the movement counts in full, one across it by half, and one with it not at all.
    void addJump (const Spot& spot, const VectorXd& step, const VectorXd& way, const std::vector<double>& by_node)
    {
        constexpr double across = 0.1;
        const double along = step.dot (way) / step.norm();
        if (along > across) return;
        const double force = (along < -across ? 1.0 : 0.5) * step.norm();
        std::size_t role = 0;
        for (std::size_t r = 1; r < roles; ++r)
            if (step.segment<3> (first (r)).norm() > step.segment<3> (first (role)).norm()) role = r;
        const auto node = std::ranges::max_element (by_node);
        found.jumps.push_back ({ .role = motion.roles[role].role,
                                 .node = node != by_node.end() && *node > 0.0 ? std::optional (static_cast<std::size_t> (node - by_node.begin()))
                                                                              : std::nullopt,
                                 .t_s = spot.middle() / motion.rate_hz,
                                 .position = positionsAt (spot.middle()).segment<3> (first (role)),
                                 .force = force });
    }
};
}   // namespace

namespace
{
/// The parts of a work that run side by side. Neither they nor the result depend on the number of threads. Each part follows the whole motion up
/// to its last spot, which takes about as long as measuring at all spots. So the first part gets two thirds of them.
std::vector<SlopeWork> partsOf (const SlopeWork& work)
{
    constexpr std::size_t least = 16;   // spots
    if (work.spots.size() < least) return { work };
    const auto middle = work.spots.begin() + static_cast<std::ptrdiff_t> (2 * work.spots.size() / 3);
    auto first = work, second = work;
    first.spots.assign (work.spots.begin(), middle);
    second.spots.assign (middle, work.spots.end());
    return { first, second };
}

/// Adds the slopes of the next part.
void add (Slopes& all, Slopes&& more)
{
    const auto append = [] (auto& to, auto& from) { std::ranges::move (from, std::back_inserter (to)); };
    for (std::size_t r = 0; r < all.by_role.size(); ++r)
    {
        append (all.by_role[r], more.by_role[r]);
        for (std::size_t n = 0; n < all.directions[r].size(); ++n)
            all.directions[r][n] += more.directions[r][n];
    }
    append (all.linked, more.linked);
    append (all.jumps, more.jumps);
}
}   // namespace

std::vector<Slopes> measureSlopes (const Subject& subject, const HandMotion& motion, std::span<const SlopeWork> works, std::size_t threads)
{
    std::vector<SlopeWork> parts;
    std::vector<std::size_t> work_of;
    for (std::size_t w = 0; w < works.size(); ++w)
        for (auto& part : works.size() > 1 ? std::vector { works[w] } : partsOf (works[w]))
        {
            parts.push_back (std::move (part));
            work_of.push_back (w);
        }
    std::vector<std::unique_ptr<SlopeSurvey>> surveys;
    for (const auto& part : parts)
        surveys.push_back (std::make_unique<SlopeSurvey> (subject, motion, part));
    std::vector<Slopes> found (parts.size()), all (works.size());
    sideBySide (parts.size(), threads, [&] (std::size_t i) { found[i] = surveys[i]->measure(); });
    for (std::size_t i = 0; i < found.size(); ++i)
        if (i == 0 || work_of[i] != work_of[i - 1])
            all[work_of[i]] = std::move (found[i]);
        else
            add (all[work_of[i]], std::move (found[i]));
    return all;
}

}   // namespace tactus::check
