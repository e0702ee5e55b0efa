// SPDX-License-Identifier: MIT
#pragma once

#include "path.hpp"
#include <tactus/node/device.hpp>

#include <cstdint>

namespace tactus
{

/// A hand that moves exactly along a gesture, whatever the force. It shows how an effect responds if the hand does not react.
/// Repeats after duration().
///
/// Reports a pressure as a pen would, as if there were a pad of 500 N/m under the surface: 2 mm give 1 N.
class GestureDevice final : public Device
{
public:
    static constexpr double pad_stiffness = 500.0;   ///< N/m

    explicit GestureDevice (const Gesture&, const Placement& = {});

    void prepare (double dt_s) override;
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    bool serialize (StateArchive&) override;
    double duration() const noexcept override { return path.duration(); }

private:
    GesturePath path;
    double surface;   // z at which the gesture touches the surface, in m
    double dt = 1e-3;
    std::int64_t tick = 0;
};

}   // namespace tactus
