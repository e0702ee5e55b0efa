// SPDX-License-Identifier: MIT
#pragma once

#include "bench.hpp"
#include "spots.hpp"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tactus::check
{

/// Two copies of a graph that run side by side. The tools of one copy are shifted; the difference between the forces of the two copies
/// is the response to the shift alone: vibrations, noise and sounds are the same in both.
class Pair
{
public:
    /// The response of the forces of all roles to a shift, per metre: three numbers for each role.
    struct Response
    {
        Eigen::VectorXd settled;   ///< N/m
        Eigen::VectorXd late;      ///< N s/m
        Eigen::VectorXd excess;    ///< N s/m

        auto of (std::size_t role) const { return settled.segment<3> (static_cast<Eigen::Index> (3 * role)); }
    };

    /// Nodes in `without` are silent. `hold_ticks`: the shortest time for which a response is watched.
    Pair (const Subject&, const HandMotion&, const std::vector<std::size_t>& without, std::size_t hold_ticks);

    /// Advances both copies to a time of the motion, in ticks, and waits there.
    void moveTo (double tick);

    /// Measures the response to a small shift of a role in a direction, with all tools at rest, and shifts the tool back. The forces of
    /// a role count as 0 if a shift of twice the size gives a different force per metre: the shift then set off an event, such as a click,
    /// or crossed a jump, and neither has a slope. Empty if this holds for all roles. Sections that do not run on every tick
    /// respond sooner or later, depending on the tick of the shift: late and excess are means over several such ticks.
    std::optional<Response> respond (std::size_t role, const Vec3& direction);

    /// The part of the last response() of a role that pulls back along the direction, tick by tick, in N/m. Empty if sections do not run on
    /// every tick: the response then depends on the tick of the shift.
    std::vector<double> pullBack (std::size_t role, const Vec3& direction) const;

    /// The last response(), per metre, at each tick after the shift. Empty if sections do not run on every tick.
    std::span<const Eigen::VectorXd> lastPath() const noexcept { return period > 1 ? std::span<const Eigen::VectorXd>() : path; }

    /// The change of the forces of all roles, in N, if the tools of one copy move to their positions at another time of the motion, while those of
    /// the other copy stay.
    Eigen::VectorXd changeAt (double tick);

    /// Moves the tools of both copies back to the same positions, and waits.
    void meet();

    std::size_t nodes() const noexcept { return forces.size(); }
    const Plan& plan() const noexcept { return still.plan(); }
    std::size_t roles() const noexcept { return motion.roles.size(); }

    /// The responses of all nodes' own forces to the last shift, one component after another: per metre after respond(), in N after
    /// changeAt().
    std::vector<double> ownResponses() const;
    std::size_t numberOfForces() const noexcept { return settled.size(); }

    /// Calls f (node, i, width) for each force of a node: its components are the `width` entries of ownResponses() from i on.
    template <typename F>
    void eachForce (F&& f) const
    {
        std::size_t i = 0;
        for (std::size_t n = 0; n < forces.size(); ++n)
            for (const auto width : forces[n].widths())
                f (n, std::exchange (i, i + width), width);
    }

    /// Raises each entry of `by_node` to the largest of that node's ownResponses().
    void raise (std::vector<double>& by_node) const;

    Vec3 position (std::size_t role) const noexcept { return still.position (role); }   ///< of the tool that stays, in m
    Vec3 force (std::size_t role) const noexcept { return still.force (role); }         ///< on the tool that stays, in N
    double brake (std::size_t role) const noexcept { return still.brake (role); }       ///< on the tool that stays, in N s/m
    double time() const noexcept { return here / motion.rate_hz; }                      ///< s

private:
    Response respondTo (double size, std::size_t role, const Vec3& direction);
    std::optional<Response> respondOnce (std::size_t role, const Vec3& direction);
    Response summary() const;
    void step();
    void wait (std::size_t ticks);
    bool hasSettled() const;
    Eigen::VectorXd difference() const;
    void note (std::vector<double>& all) const noexcept;

    const HandMotion& motion;
    std::size_t hold;
    Bench still, nudged;
    std::size_t period = 1;   // ticks after which all sections run on the same tick again
    std::vector<NodeForces> forces, nudged_forces;
    std::size_t now = 0;   // the next tick of the motion
    double here = 0.0;     // ticks since the start of the motion
    double last_size = 1.0;
    std::vector<double> before, settled;   // differences between the copies in the forces of the nodes, before and after the last shift
    std::vector<Eigen::VectorXd> path;     // the response, per metre, at each tick after the shift
};

}   // namespace tactus::check
