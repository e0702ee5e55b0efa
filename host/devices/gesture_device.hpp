// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/device.hpp>
#include <host/devices/path.hpp>

#include <cstdint>

namespace tactus::host
{

/// A hand that moves exactly as a gesture says, whatever the force: how an effect answers, without what the hand then
/// does. Repeats after duration().
///
/// Tells a pressure as a pen would: that of a pad of 500 N/m under the surface, so that 2 mm are 1 N.
class GestureDevice final : public Device
{
public:
    static constexpr double pad_stiffness = 500.0;   ///< N/m

    explicit GestureDevice (const Gesture&, const Placement& = {});

    void prepare (double dt_s) override;
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    double duration() const noexcept override { return path.duration(); }

private:
    GesturePath path;
    double surface;   // m, z at which the gesture touches
    double dt = 1e-3;
    std::int64_t tick = 0;
};

}   // namespace tactus::host
