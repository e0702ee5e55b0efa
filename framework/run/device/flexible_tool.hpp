// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace tactus
{

/// A tool on a structure that bends: a mass at the motor and a mass at the end, with a spring and a damper between them. The
/// motor pushes the mass at the motor, and the hand pushes the mass at the end. Viscous and Coulomb friction act on the mass at the
/// motor.
///
///     m_m v_m' = F_m - B v_m - f_f sgn (v_m) + k s + c (v_e - v_m)      s = x_e - x_m
///     m_e v_e' = F_h - k s - c (v_e - v_m)
///     k = m_e (2 pi F_0)^2,  c = 2 zeta m_e 2 pi F_0                    so that the end swings at F_0 while the motor is held
///
/// Each axis moves by itself and has its own dry friction, as if it had its own motor.
///
/// The forces are held for a tick. In each phase of the motion, the motor either sticks or slips in one direction. The system is then
/// linear, and its motion is computed exactly by the matrix exponential. The end of a phase is found by bisection, to within 1e-12 s
/// (for a tick of more than 1 s, to 2^-40 of the tick).
///
/// Good to know
///  - The work per tick and axis is bounded. Without dry friction it is one step, which is a product of a 4 x 5 matrix and a
///    vector. With dry friction it is at most 256 + 64 * 40 steps, plus at most 80 for each search for the end of a phase.
///    Typically, it is 16 steps per period of the structure, and 40 for each change between stick and slip.
///  - After the 64th phase of a tick, the motor sticks until the tick ends. If a tick is longer than 16 periods of the two free
///    masses, a phase shorter than a period can be missed.
class FlexibleTool
{
public:
    /// The properties of the tool, in SI units. All are positive, but damping, damping ratio and Coulomb friction may be 0.
    struct Properties
    {
        double motor_mass = 0.05, end_mass = 0.05, damping = 0.0, coulomb = 0.0, first_mode_hz = 100.0, first_mode_damping = 0.05;
    };

    struct Axis
    {
        double x = 0.0;         ///< position of the motor, in m
        double v = 0.0;         ///< velocity of the motor, in m/s; exactly 0 while the motor sticks
        double stretch = 0.0;   ///< position of the end minus that of the motor, in m
        double end_v = 0.0;     ///< velocity of the end, in m/s
    };

    FlexibleTool() = default;
    FlexibleTool (const Properties&, double dt_s);   ///< [main thread]

    void start (const Vec3& position, const Vec3& velocity) noexcept;   ///< of both masses; the spring is not stretched
    void step (const Vec3& motor_force, const Vec3& hand_force) noexcept;

    Vec3 motor() const noexcept { return { axes[0].x, axes[1].x, axes[2].x }; }
    Vec3 end() const noexcept { return { axes[0].x + axes[0].stretch, axes[1].x + axes[1].stretch, axes[2].x + axes[2].stretch }; }
    Vec3 endVelocity() const noexcept { return { axes[0].end_v, axes[1].end_v, axes[2].end_v }; }

    const Axis& axis (int i) const noexcept { return axes[static_cast<std::size_t> (i)]; }
    double energy() const noexcept;                                ///< kinetic and elastic energy of all axes, in J
    double stiffness() const noexcept { return k; }                ///< k, in N/m
    int mostPhases() const noexcept { return most_phases_seen; }   ///< the largest number of phases that an axis has had in one tick since the start

    void serialize (auto& archive) { archive (axes); }

private:
    struct AppliedForces
    {
        double motor = 0.0, hand = 0.0;   // N
    };

    /// The state of the motor in a phase: it sticks, or slips to one side.
    enum class Phase
    {
        stick = 0,
        forward = 1,
        backward = -1
    };

    /// Multiplied by (v, stretch, end_v, motor force, hand force), gives the change of (x, v, stretch, end_v) in one time step.
    using Change = Eigen::Matrix<double, 4, 5, Eigen::DontAlign>;   // so that its layout does not depend on flags

    /// A value that is negative once the phase is over, and its rate of change.
    struct Margin
    {
        double value = 0.0, rate = 0.0;
    };

    Axis advanced (const Axis&, Phase, AppliedForces, int level) const noexcept;
    Margin margin (const Axis&, Phase, AppliedForces, int side) const noexcept;
    Phase phaseOf (const Axis&, AppliedForces) const noexcept;
    std::int64_t run (Axis&, Phase, AppliedForces, std::int64_t units) const noexcept;
    std::int64_t unitsToEnd (Axis&, const Axis& next, Phase, AppliedForces, int level) const noexcept;
    int stepDryAxis (Axis&, AppliedForces) const noexcept;

    Properties what;
    double k = 0.0, c = 0.0;
    std::vector<Change> slips, sticks;   // by level: for a time step of the tick divided by 2^level
    int finest = 0, grid = 0;            // level of the finest step; level of the steps after which the end of a phase is checked
    std::array<Axis, 3> axes {};
    int most_phases_seen = 0;
};

}   // namespace tactus
