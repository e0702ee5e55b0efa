// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/check/sampled_loop.hpp>

#include <tactus/node/device.hpp>
#include <tactus/run/device/sim.hpp>

#include <array>
#include <vector>

namespace tactus::check
{

/// A simulated tool that is held at a place until it is let go. Then the forces of the graph and of a hand move it, each axis on its own.
///
/// The force is held for a tick, and comes late by the delay of the device. Position and force have quanta, and the motor has dry friction and a brake.
/// With a first mode, the hand is on the other side of the structure, as in a simulated device. The spring, the damper and the mass of the hand also act
/// between the ticks, because a spring or damper with a held force would add energy.
class FreeTool final : public Device
{
public:
    /// Mass and damping must be known. `simulated` has the axes that move in addition to the tool, or is null; other axes stay where they are held.
    FreeTool (const DeviceNumbers&, const DeviceLayout&, const Simulation* simulated, double rate_hz);

    /// Holds the tool where the reading says.
    void hold (const Reading& at) noexcept;

    /// The release of a tool from where it is held.
    struct Start
    {
        Vec3 off = Vec3::Zero();     ///< m, from where it is held; the spring of the hand is relaxed there
        Vec3 speed = Vec3::Zero();   ///< m/s
        Vec3 push = Vec3::Zero();    ///< constant force of the hand, in N
        double axis_off = 0.0;       ///< of all axes, in m or rad
        std::vector<double> axis_push {};
        bool moves = true;   ///< false: only its axes are let go
        HeldHand hand {};
    };
    void letGo (const Start&);   // [main thread]

    Vec3 motor() const noexcept { return home + Vec3 { moving[0].x, moving[1].x, moving[2].x }; }
    double axis (std::size_t i) const noexcept { return free_axes[i].x; }
    bool moves (std::size_t axis_of) const noexcept { return axis_of < free_axes.size() && free_axes[axis_of].moves; }
    std::size_t axes() const noexcept { return free_axes.size(); }
    const Effort& effort() const noexcept { return got; }       ///< the last one from the graph
    const Effort& acting() const noexcept { return arrived; }   ///< the one that moved the tool in the last tick
    const Start& pushes() const noexcept { return start; }      ///< the last release

    void prepare (double) override {}
    Reading read() noexcept override;
    void write (const Effort&) noexcept override;
    DeviceLayout layout() const override { return has; }

private:
    /// The state of one direction: x and v are position and speed of the motor, y and w those of the end. Positions count from where the tool was held.
    struct Track
    {
        double x = 0.0, v = 0.0, y = 0.0, w = 0.0;
    };

    struct Axis
    {
        double mass = 1.0, damping = 0.0, stiffness = 0.0, rest = 0.0;   // of its own spring
        bool moves = false;
        double x = 0.0, v = 0.0, push = 0.0, home = 0.0;
    };

    DeviceNumbers numbers;
    DeviceLayout has;
    double period_s, brake_share = 1.0, dry, quantum, force_quantum;
    bool bends;
    int parts = 1;                                          // of a tick
    Eigen::Matrix<double, 4, 5, Eigen::DontAlign> slips;    // of a structure that bends, in a part of a tick; see heldMotion()
    Eigen::Matrix<double, 2, 3, Eigen::DontAlign> sticks;   // of its end while the motor sticks
    double k = 0.0, c = 0.0;                                // of the structure
    Start start;
    bool is_free = false;
    Reading now;
    Vec3 home = Vec3::Zero();
    std::array<Track, 3> moving;
    std::vector<Axis> free_axes;
    std::vector<Effort> on_the_way;
    std::size_t oldest = 0;
    double braking = 0.0;
    Effort got, arrived;

    void moveRigid (Track&, double force, double push) const noexcept;
    void moveBending (Track&, double force) const noexcept;
    void moveAxis (Axis&, double force) const noexcept;
};

}   // namespace tactus::check
