// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

#include <array>
#include <limits>

namespace tactus::host::hid
{

/// Notices that one of the values that the position is computed from has stopped while the tool moves: its encoder has failed, or its
/// wire is broken. The tool then seems to move along a surface, with forces that do not belong to the place where it is.
///
/// A value has stopped if it is the same to the last bit although the tool is further than `most` from where the value last changed. No hand
/// keeps to the line or surface on which one joint does not turn at all: over 10 cm it strays by millimetres, and an encoder sees
/// far less than that. A value that has never changed is not measured, such as the height of a device that moves in a plane.
class EncoderWatch
{
public:
    /// `most` in m; infinite: watches nothing.
    explicit EncoderWatch (double most_m = std::numeric_limits<double>::infinity()) : most (most_m) {}

    /// Takes a report: the values as the device sends them, and the position in m that follows from them. [tick thread]
    void operator() (const Vec3& values, const Vec3& position) noexcept
    {
        stopped = false;
        for (int i = 0; i < 3; ++i)
        {
            auto& [before, since, has_changed] = all[static_cast<std::size_t> (i)];
            if (! known || values[i] != before)
            {
                has_changed = known;
                since = position;
            }
            before = values[i];
            stopped = stopped || (has_changed && (position - since).norm() > most);
        }
        known = true;
    }

    /// True until the value changes, or the tool returns to where the value last changed.
    bool hasStopped() const noexcept { return stopped; }

    /// For a device that starts again. [tick thread]
    void restart() noexcept { known = stopped = false; }

private:
    struct Value
    {
        double before = 0.0;
        Vec3 since = Vec3::Zero();   // position of the tool when the value last changed
        bool has_changed = false;
    };

    double most;
    std::array<Value, 3> all {};
    bool known = false, stopped = false;
};

}   // namespace tactus::host::hid
