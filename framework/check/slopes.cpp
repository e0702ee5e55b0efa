// SPDX-License-Identifier: MIT
#include "slopes.hpp"

#include <tactus/kit/at.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tactus::check
{

namespace
{
using Matrix = Eigen::Matrix3d;

constexpr double nudge = 1e-9;              // m; far below any quantum or d_max, far above the rounding of a position
constexpr std::size_t least_hold = 24;      // ticks; longer than the window of motion.velocity
constexpr std::size_t longest_hold = 240;   // ticks

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

/// The response of the force to a shift in one direction, per metre.
struct Response
{
    Vec3 settled = Vec3::Zero();   // N/m
    Vec3 late = Vec3::Zero();      // N s/m
    Vec3 excess = Vec3::Zero();    // N s/m
};

class Pair
{
public:
    Pair (const Subject& subject, const HandMotion& m, const SlopeWork& work) : motion (m), role (work.role), still (subject, m), nudged (subject, m)
    {
        still.silence (work.without);
        nudged.silence (work.without);
        for (std::size_t n = 0; n < still.plan().instances().size(); ++n)
        {
            forces.emplace_back (still.plan(), n);
            nudged_forces.emplace_back (nudged.plan(), n);
        }
        for (const auto& f : forces)
            numbers += f.size();
        settled.resize (numbers);
        before.resize (numbers);
    }

    std::size_t nodes() const noexcept { return forces.size(); }

    /// Advances both copies to a tick of the motion.
    void moveTo (std::size_t tick) noexcept
    {
        for (; now < tick; ++now)
        {
            still.follow (motion, now);
            nudged.follow (motion, now);
            step();
        }
    }

    /// Measures the response to a small shift in a direction, with both tools at rest, and shifts the tool back. Empty if a shift of twice
    /// the size gives a different response per metre: the shift then set off an event, such as a click, and an event has no slope.
    std::optional<Response> respond (const Vec3& direction, std::size_t hold) noexcept
    {
        constexpr double tolerance = 0.2;
        const auto once = respondTo (nudge, direction, hold), twice = respondTo (2.0 * nudge, direction, hold);
        const double most = std::max (once.settled.norm(), twice.settled.norm());
        if ((once.settled - twice.settled).norm() > tolerance * most) return std::nullopt;
        return once;
    }

    /// Waits, with both tools at rest.
    void wait (std::size_t ticks) noexcept
    {
        for (std::size_t j = 0; j < ticks; ++j)
            step();
    }

    /// The responses of all nodes' own forces to the last shift, per metre, one component after another.
    std::vector<double> ownResponses() const
    {
        std::vector<double> all (numbers);
        for (std::size_t i = 0; i < numbers; ++i)
            all[i] = (settled[i] - before[i]) / last_size;
        return all;
    }

    /// Calls f (node, i) for each component i of ownResponses().
    template <typename F>
    void eachForce (F&& f) const
    {
        std::size_t i = 0;
        for (std::size_t n = 0; n < forces.size(); ++n)
            for (std::size_t c = 0; c < forces[n].size(); ++c)
                f (n, i++);
    }

    std::size_t numberOfForces() const noexcept { return numbers; }

    /// Raises each entry of `by_node` to the largest response of that node's forces to the last shift, in N/m.
    void raise (std::vector<double>& by_node) const
    {
        std::size_t i = 0;
        for (std::size_t n = 0; n < forces.size(); ++n)
            for (const auto width : forces[n].widths())
            {
                double square = 0.0;
                for (const auto end = i + width; i < end; ++i)
                    square += (settled[i] - before[i]) * (settled[i] - before[i]);
                by_node[n] = std::max (by_node[n], std::sqrt (square) / last_size);
            }
    }

    void reserve (std::size_t hold) { path.reserve (hold + longest_hold); }
    const Vec3& position() const noexcept { return motion.roles[role].readings[now > 0 ? now - 1 : 0].position; }
    double time() const noexcept { return static_cast<double> (now > 0 ? now - 1 : 0) / motion.rate_hz; }

private:
    Response respondTo (double size, const Vec3& direction, std::size_t hold) noexcept
    {
        const Vec3 offset = difference();
        note (before);
        nudged.shift (role, size * direction);
        path.clear();
        while (path.size() < hold || (path.size() < hold + longest_hold && ! hasSettled()))
        {
            step();
            path.push_back ((difference() - offset) / size);
        }
        note (settled);
        last_size = size;
        nudged.shift (role, Vec3::Zero());
        wait (path.size());
        return summary();
    }

    void step() noexcept
    {
        still.tick();
        nudged.tick();
    }

    /// True if the response has hardly changed over the last ticks.
    bool hasSettled() const noexcept
    {
        constexpr std::size_t recent = 12;
        constexpr double tolerance = 1e-4;
        const auto& last = path.back();
        return std::all_of (path.end() - recent, path.end(), [&] (const Vec3& then) { return (then - last).norm() <= tolerance * last.norm(); });
    }

    Vec3 difference() const noexcept { return nudged.force (role) - still.force (role); }

    /// For each force of each node, the difference between the two copies.
    void note (std::vector<double>& all) const noexcept
    {
        std::size_t i = 0;
        for (std::size_t n = 0; n < forces.size(); ++n)
            for (std::size_t c = 0; c < forces[n].size(); ++c)
                all[i++] = nudged_forces[n][c] - forces[n][c];
    }

    /// A response that comes late has too little force at first. Damping responds to the speed of the shift, so it has too much.
    Response summary() const noexcept
    {
        Response r;
        r.settled = path.back();
        const double dt = 1.0 / motion.rate_hz;
        for (const auto& then : path)
            for (int i = 0; i < 3; ++i)
            {
                const double rest = then[i] - r.settled[i];
                (rest * r.settled[i] < 0.0 ? r.late : r.excess)[i] += dt * rest;
            }
        return r;
    }

    const HandMotion& motion;
    std::size_t role;
    Bench still, nudged;
    std::vector<NodeForces> forces, nudged_forces;
    std::size_t numbers = 0, now = 0;
    double last_size = nudge;   // m
    std::vector<double> before, settled;
    std::vector<Vec3> path;
};

/// The responses to shifts along each axis. Of the responses to the two directions of an axis, the larger one is kept.
struct Jacobians
{
    Matrix settled = Matrix::Zero(), late = Matrix::Zero(), excess = Matrix::Zero();

    void take (int axis, double sign, const Response& r)
    {
        const auto keep = [&] (Matrix& m, const Vec3& column) {
            if (column.norm() > m.col (axis).norm()) m.col (axis) = sign * column;
        };
        keep (settled, r.settled);
        keep (late, r.late);
        keep (excess, r.excess);
    }
};
}   // namespace

std::vector<Slope> measureSlopes (const Subject& subject, const HandMotion& motion, const SlopeWork& work, Directions& directions)
{
    Pair pair { subject, motion, work };
    const auto hold = std::min (longest_hold + least_hold, least_hold + static_cast<std::size_t> (std::max<std::int64_t> (work.longest_delay, 0)));
    pair.reserve (hold);
    directions.assign (pair.nodes(), Matrix::Zero());

    std::vector<Slope> slopes;
    const auto count = std::min (work.places, motion.ticks);
    for (std::size_t i = 0; i < count; ++i)
    {
        pair.moveTo ((2 * i + 1) * motion.ticks / (2 * count) + 1);
        pair.wait (hold);
        Jacobians all;
        Slope slope { .t_s = pair.time(), .position = pair.position(), .by_node = std::vector<double> (pair.nodes(), 0.0) };
        std::array<std::vector<double>, 3> own;
        for (int axis = 0; axis < 3; ++axis)
        {
            own[at (axis)].assign (pair.numberOfForces(), 0.0);
            for (const double sign : { -1.0, 1.0 })
                if (const auto response = pair.respond (sign * Vec3::Unit (axis), hold))
                {
                    all.take (axis, sign, *response);
                    own[at (axis)] = pair.ownResponses();
                    pair.raise (slope.by_node);
                }
        }
        pair.eachForce ([&] (std::size_t node, std::size_t component) {
            const Vec3 gradient { own[0][component], own[1][component], own[2][component] };
            directions[node] += gradient * gradient.transpose();
        });
        // No matrix describes a nonlinear response, such as that of friction. So the stiffness is measured again in the steepest direction.
        const Vec3 steepest = mostStretched (all.settled).direction;
        for (int axis = 0; axis < 3; ++axis)
            slope.stiffness = std::max (slope.stiffness, all.settled.col (axis).norm());
        for (const double sign : { -1.0, 1.0 })
            if (const auto response = pair.respond (sign * steepest, hold)) slope.stiffness = std::max (slope.stiffness, response->settled.norm());
        slope.lag = mostStretched (all.late).factor;
        slope.damping = mostStretched (all.excess).factor;
        slopes.push_back (std::move (slope));
    }
    return slopes;
}

}   // namespace tactus::check
