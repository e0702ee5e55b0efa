// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/device.hpp>
#include <framework/guard.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>

#include <memory>

namespace tactus::host
{

/// Where a device's workspace lies in that of a graph, and how large it is there:
///
///     graph position = scale * device position + offset
///
/// Rotation, pressure, axes and signals stay as they are, and so does the force: what a graph asks for in N is what the hand
/// gets. So with `scale` a wall of K N/m is felt as one of K * scale: at 2 the hand goes half as far for the same depth.
/// A loop that is stable up to K on the device is so up to K / scale in the graph.
struct Workspace
{
    double scale = 1.0;           ///< more than 0
    Vec3 offset = Vec3::Zero();   ///< m, in the graph

    bool isPlain() const noexcept { return scale == 1.0 && offset.isZero (0.0); }
    Vec3 toGraph (const Vec3& device) const noexcept { return scale * device + offset; }

    bool operator== (const Workspace&) const = default;
};

/// `{"scale": 2, "offset": [0, 0, "1 cm"]}`; what is not there is as it is without. A scale is from 0.001 to 1000. Ids as of
/// Fields.
Workspace readWorkspace (const Json&, std::string where, Messages&);

/// The limits of a device as its guard has to keep them, which sees positions of the graph. Speeds there are `scale` times
/// those of the device, and so is the energy that EnergyWatch counts; efforts and times are the same in both. So what the
/// hand meets is limited as the device's profile has it, whatever the scale.
GuardLimits inWorkspace (GuardLimits ofDevice, const Workspace&) noexcept;

/// A device whose readings are in a graph's workspace.
class WorkspaceDevice final : public Device
{
public:
    WorkspaceDevice (std::unique_ptr<Device> d, const Workspace& w) : device (std::move (d)), workspace (w) {}

    void prepare (double dt_s) override { device->prepare (dt_s); }                     // [main thread]
    Reading read() noexcept override;                                                   // [tick thread]
    void write (const Effort& guarded) noexcept override { device->write (guarded); }   // [tick thread]
    DeviceLayout layout() const override { return device->layout(); }
    double duration() const noexcept override { return device->duration(); }

private:
    std::unique_ptr<Device> device;
    const Workspace workspace;
};

}   // namespace tactus::host
