// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <memory>

namespace tactus::host
{

/// The position and scale of a device's workspace in a graph:
///
///     graph position = scale * device position + offset
///
/// Rotation, pressure, axes, signals and force are unchanged: a force in N in the graph is the same force on the hand. With
/// `scale`, a wall of K N/m therefore feels like one of K * scale: at 2 the hand moves half as far for the same depth. A
/// loop that is stable up to K on the device is stable up to K / scale in the graph. In the graph, the tool's mass and damping
/// are those on the device divided by scale.
struct Workspace
{
    double scale = 1.0;           ///< graph position divided by device position; above 0
    Vec3 offset = Vec3::Zero();   ///< position of the device's origin in the graph, in m

    bool isPlain() const noexcept { return scale == 1.0 && offset.isZero (0.0); }
    Vec3 toGraph (const Vec3& device) const noexcept { return scale * device + offset; }

    bool operator== (const Workspace&) const = default;
};

/// Reads `{"scale": 2, "offset": [0, 0, "1 cm"]}`; both keys are optional. The scale is from 0.001 to 1000. Ids: those of ObjectReader.
Workspace readWorkspace (const Json&, std::string where, Messages&);

/// Tells the guard of a device, which sees positions in the graph, how the graph scales them. The guard then watches the motion of
/// the device itself, so limits of speed and energy are those of the hand, whether they come from the profile, the session or the
/// graph.
GuardLimits inWorkspace (GuardLimits ofDevice, const Workspace&) noexcept;

/// A device whose readings are converted to a graph's workspace.
class WorkspaceDevice final : public Device
{
public:
    WorkspaceDevice (std::unique_ptr<Device> d, const Workspace& w) : device (std::move (d)), workspace (w) {}

    void prepare (double dt_s) override { device->prepare (dt_s); }   // [main thread]
    Reading read() noexcept override;                                 // [tick thread]
    void write (const Effort& guarded) noexcept override;             // [tick thread]
    void withhold() noexcept override { device->withhold(); }         // [tick thread]
    void limitSignals (double max, double max_slew) override { device->limitSignals (max, max_slew); }
    void limitSlews (double force, double torque, double axis) override { device->limitSlews (force, torque, axis); }
    DeviceLayout layout() const override;
    double duration() const noexcept override { return device->duration(); }

private:
    std::unique_ptr<Device> device;
    const Workspace workspace;
};

}   // namespace tactus::host
