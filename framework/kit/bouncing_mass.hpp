// SPDX-License-Identifier: MIT
#pragma once

namespace tactus
{

/// A mass with viscous damping that a constant force pushes against a one-sided spring, solved exactly:
///
///     M e'' = F - B e'           apart, e <= 0
///     M e'' = F - B e' - K e     in the spring, e > 0
///
/// The time is divided into steps. If the mass enters or leaves the spring within a step, bisection finds that instant to 2^-45 of
/// the step. A touch that begins and ends within a step is found too, from the change of direction. A step is a 16th of the
/// requested time, or in the spring less than a sixth of a bounce. The work is bounded: after 64 steps, the rest of the time is one
/// last step without this search.
struct BouncingMass
{
    struct State
    {
        double depth = 0.0;   ///< e, in m
        double speed = 0.0;   ///< e', in m/s; positive into the spring
    };

    double mass = 0.1;           ///< M, in kg, > 0
    double damping = 0.0;        ///< B, in N s/m
    double stiffness = 1000.0;   ///< K, in N/m
    double force = 0.0;          ///< F, in N; positive into the spring

    struct Result
    {
        State state;
        bool touched = false;   ///< true if the mass was in the spring at any time
    };

    /// The state after `time`, in s. [any thread; allocates nothing]
    Result after (State, double time) const noexcept;

private:
    State moved (State, double time, bool in_spring) const noexcept;
    bool leaves (State& from, State to, double& time, bool in_spring) const noexcept;
};

}   // namespace tactus
