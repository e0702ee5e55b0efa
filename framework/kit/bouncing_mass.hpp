// SPDX-License-Identifier: MIT
#pragma once

namespace tactus
{

/// A mass with viscous damping that a constant force pushes against a one-sided spring, solved exactly:
///
///     M e'' = F - B e'           apart, e <= 0
///     M e'' = F - B e' - K e     in the spring, e > 0
///
/// The instants at which it enters and leaves the spring are looked for in steps, by bisection to 2^-45 of a step. A touch within a
/// step is found too, from the change of direction. A step is a 16th of the time asked for, or in the spring less than a sixth of
/// a bounce. Work is bounded: after 64 steps, what is left is one step, without looking.
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
        bool touched = false;   ///< true if it was in the spring at any time
    };

    /// The state after `time`, in s. [any thread; allocates nothing]
    Result after (State, double time) const noexcept;

private:
    State moved (State, double time, bool in_spring) const noexcept;
    bool leaves (State& from, State to, double& time, bool in_spring) const noexcept;
};

}   // namespace tactus
