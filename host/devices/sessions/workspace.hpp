// SPDX-License-Identifier: MIT
#pragma once

#include "clutch.hpp"

#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/node/device.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/run/guard/effort_watch.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <Eigen/LU>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tactus::host
{

/// The place of a device's workspace in a graph:
///
///     position = scale * axes * p + offset        p: on the device
///     rotation = d * axes * r                     d: the determinant of `axes`, -1 for a mirror; r: rotation vector on the device
///     force on the device  = axes^T * force       in the graph; as large as there
///     torque on the device = d * axes^T * torque
///
/// Turned and mirrored back like this, force and torque do the same work on the device as in the graph with a scale of 1. Pressure, axes,
/// efforts, signals and buttons are unchanged. A force of 1 N in the graph is 1 N on the hand at any scale. With `scale`, a wall of K N/m
/// therefore feels like one of K * scale: at 2 the hand moves half as far for the same depth. A loop that is stable up to K on the device is stable
/// up to K / scale in the graph. In the graph, the tool's mass and damping are those on the device divided by scale.
struct Workspace
{
    static constexpr double farthest = 1e3;   ///< in m; farther away, rounding would hide the motion of the tool from the guard

    double scale = 1.0;             ///< graph position divided by device position; above 0
    Vec3 offset = Vec3::Zero();     ///< position of the device's origin in the graph, in m
    Mat3 axes = Mat3::Identity();   ///< the axes of the graph by those of the device; orthogonal
    std::string clutch {};          ///< name or number of the button that moves the workspace while it is held; empty: none

    bool isTurned() const noexcept { return axes != Mat3::Identity(); }
    bool isMirrored() const noexcept { return axes.determinant() < 0.0; }
    bool isPlain() const noexcept { return scale == 1.0 && offset.isZero (0.0) && ! isTurned() && clutch.empty(); }
    Vec3 toGraph (const Vec3& device) const noexcept { return scale * (axes * device) + offset; }

    bool operator== (const Workspace&) const = default;
};

/// Reads `{"axes": ["y", "-x", "z"], "scale": 2, "offset": [0, 0, "1 cm"], "clutch": "a"}`; all keys are optional. The axes are as in a profile, or
/// three rows of numbers; they may mirror. The scale is from 0.001 to 1000. Ids: device/axes, and those of ObjectReader.
Workspace readWorkspace (const Json&, std::string where, Messages&);

/// Tells the guard of a device, which sees positions in the graph, how the graph scales them. The guard then watches the motion of
/// the device itself, so limits of speed and energy are those of the hand, whether they come from the profile, the session or the
/// graph.
GuardLimits inWorkspace (GuardLimits ofDevice, const Workspace&) noexcept;

/// The problem of the clutch on a device with these buttons; empty if there is none. Id: device/no_button; where: relative to the description of the
/// device.
std::optional<Message> wrongClutch (const Workspace&, const DeviceLayout&);

/// A device whose readings are converted to a graph's workspace. Its origin can be moved while it is in use: by the clutch, which is a button of the
/// device or hold(), and by moveTo(). Neither steps the force, see Clutch.
class WorkspaceDevice final : public Device
{
public:
    /// `limits`: those of the device. The guard sees no coordinate of the device if the axes are oblique, so then its limit of the
    /// time that one of them may stand still is kept here.
    WorkspaceDevice (std::unique_ptr<Device>, const Workspace&, const GuardLimits& limits = {});

    void prepare (double dt_s) override;                        // [main thread]
    Reading read() noexcept override;                           // [tick thread]
    void write (const Effort& guarded) noexcept override;       // [tick thread]
    void withhold() noexcept override { device->withhold(); }   // [tick thread]
    void limitSignals (double max, double max_slew) override { device->limitSignals (max, max_slew); }
    void limitSlews (double force, double torque, double axis) override { device->limitSlews (force, torque, axis); }
    DeviceLayout layout() const override;
    double duration() const noexcept override { return device->duration(); }

    /// The clutch is held, such as by a key, as if it were by its button. [any thread]
    void hold (bool h) noexcept { is_held.store (h, std::memory_order_relaxed); }

    /// The device's origin shall be there in the graph, in m, instead of at the offset of the workspace and where the clutch has moved it. Until
    /// nothing is on the device, and while it has no valid reading, the origin stays where it is. [main thread]
    void moveTo (const Vec3& origin) noexcept;

    /// The place of the device's origin in the graph, now or soon, in m. [main thread]
    Vec3 origin() const noexcept;

private:
    void watch (Reading&) noexcept;
    void takeGoal() noexcept;
    void showOrigin() noexcept;

    std::unique_ptr<Device> device;
    const Workspace workspace;
    const Mat3 spin;                              // axes of rotations and torques
    const bool is_turned, is_oblique, is_moved;   // is_moved: turned, scaled, or with an offset
    const int clutch_button;                      // -1: none
    const double max_still, still_force, still_torque;
    double dt = 1e-3;

    /// The place where moveTo() wants the origin. The tick thread must not wait, so the main thread writes the other of two values, and counts it
    /// then.
    std::array<std::array<std::atomic<double>, 3>, 2> goals {};
    std::atomic<std::uint32_t> goals_told = 0;
    struct Origin
    {
        std::array<double, 3> at {};
        std::uint64_t goals = 0;   // that have been reached
    };
    Snapshot<Origin> latest_origin;
    std::atomic<bool> is_held = false;

    // [tick thread]
    Origin shown;   // the latest one that the main thread was told
    std::uint32_t goals_taken = 0;
    Clutch clutch;
    StillWatch still, still_turn;                       // in the axes of the device
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();   // on the device
};

}   // namespace tactus::host
