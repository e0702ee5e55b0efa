// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace tactus
{

/// A tool on a structure that bends: a mass at the motor and a mass at the end, with a spring and a damper between them. The
/// motor pushes the first, the hand the second. Viscous and Coulomb friction act on the first.
///
///     m_m v_m' = F_m - B v_m - f_f sgn (v_m) + k s + c (v_e - v_m)      s = x_e - x_m
///     m_e v_e' = F_h - k s - c (v_e - v_m)
///     k = m_e (2 pi F_0)^2,  c = 2 zeta m_e 2 pi F_0                    so that the end swings at F_0 while the motor is held
///
/// Axis by axis: each axis has its own dry friction, as if driven by a motor of its own.
///
/// The forces are held for a tick. Between two changes of the dry friction, the motion is that of a linear system, and is computed
/// exactly by the matrix exponential: the motor sticks, or slips in one direction. The instant at which a phase ends is found by
/// halving to less than 1e-12 s (for a tick of more than 1 s, to 2^-40 of the tick).
///
/// Good to know
///  - Work per tick and axis is bounded: one step without dry friction. With it, at most 256 + 64 * 40 steps, and at most 80 more for
///    each end of a phase that is looked for; each is a product of a 4 x 5 matrix and a vector. Usual are 16 steps per period of the
///    structure and 40 for each change between stick and slip.
///  - After the 64th phase of a tick, the motor sticks to the end of the tick. If a tick is longer than 16 periods of the two free
///    masses, a phase shorter than a period can be missed.
class FlexibleTool
{
public:
    /// In SI units; all positive, but damping, damping ratio and Coulomb friction may be 0.
    struct Properties
    {
        double motor_mass = 0.05, end_mass = 0.05, damping = 0.0, coulomb = 0.0, first_mode_hz = 100.0, first_mode_damping = 0.05;
    };

    struct Axis
    {
        double x = 0.0;         ///< of the motor, in m
        double v = 0.0;         ///< of the motor, in m/s; exactly 0 while it sticks
        double stretch = 0.0;   ///< of the end beyond the motor, in m
        double end_v = 0.0;     ///< of the end, in m/s
    };

    FlexibleTool() = default;
    FlexibleTool (const Properties&, double dt_s);   ///< [main thread]

    void start (const Vec3& position, const Vec3& velocity) noexcept;   ///< unstretched
    void step (const Vec3& motor_force, const Vec3& hand_force) noexcept;

    Vec3 motor() const noexcept { return { axes[0].x, axes[1].x, axes[2].x }; }
    Vec3 end() const noexcept { return { axes[0].x + axes[0].stretch, axes[1].x + axes[1].stretch, axes[2].x + axes[2].stretch }; }
    Vec3 endVelocity() const noexcept { return { axes[0].end_v, axes[1].end_v, axes[2].end_v }; }

    const Axis& axis (int i) const noexcept { return axes[static_cast<std::size_t> (i)]; }
    double energy() const noexcept;                                ///< kinetic and elastic, in J
    double stiffness() const noexcept { return k; }                ///< of the structure, in N/m
    int mostPhases() const noexcept { return most_phases_seen; }   ///< in any tick since the start; a phase is a stick or a slip

private:
    struct Held
    {
        double motor = 0.0, hand = 0.0;   // N
    };

    /// What the motor does in a phase: sticks, or slips to one side.
    enum class Phase
    {
        stick = 0,
        forward = 1,
        backward = -1
    };

    /// The change of (x, v, stretch, end_v) in a stretch of time, for v, stretch, end_v, motor force and hand force.
    using Change = Eigen::Matrix<double, 4, 5>;

    /// A margin that is negative outside the phase, and its rate of change.
    struct Margin
    {
        double value = 0.0, rate = 0.0;
    };

    Axis advanced (const Axis&, Phase, Held, int level) const noexcept;
    Margin margin (const Axis&, Phase, Held, int side) const noexcept;
    Phase phaseOf (const Axis&, Held) const noexcept;
    std::int64_t run (Axis&, Phase, Held, std::int64_t units) const noexcept;
    std::int64_t unitsToEnd (Axis&, const Axis& next, Phase, Held, int level) const noexcept;
    int stepDryAxis (Axis&, Held) const noexcept;

    Properties what;
    double k = 0.0, c = 0.0;
    std::vector<Change> slips, sticks;   // by level: for the tick divided by 2^level
    int finest = 0, grid = 0;            // levels of the finest step, and of the steps between which phases are looked for
    std::array<Axis, 3> axes {};
    int most_phases_seen = 0;
};

}   // namespace tactus
