// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>

#include <cstddef>
#include <optional>

namespace tactus
{

/// The motion of a tool, and the effort on it, in a loop whose steps last longer than a tick, such as that of a physics engine. A device of your own
/// owns one, and lets its readings and efforts pass through it. See Stepper, and docs/steps.md for the delay of each rule.
///
///     readings      tick i of the n of a step gets
///     hold          the new reading, on all ticks
///     linear        the way from the last reading to the new one: i/n of it, so the last tick gets the new reading
///     by_velocity   where the tool will be if it keeps its velocity from the new reading on: (i - 1) periods of it
///
///     efforts       the effort of a step is
///     last          that of its last tick
///     mean          the mean over its ticks, of force, torque, axes and brake; signals are those of the last tick
///
/// Buttons, pressure, signals and everything else of a reading are those of the new one. A reading that is not valid, and one that was
/// not renewed, is held. One that was not renewed gets older with each tick, so a watchdog in the limits of the device (Run::RoleDevice), which has none
/// of its own accord, ends the effort of a program that no longer moves the tool. What was rendered before a stop of the guard does not count in a mean,
/// so the stop is not late.
class StepMotion
{
public:
    enum class Readings
    {
        hold,
        linear,
        by_velocity
    };

    enum class Efforts
    {
        last,
        mean
    };

    StepMotion() = default;
    StepMotion (Readings r, Efforts e) noexcept : readings (r), efforts (e) {}

    /// The velocity of a tool: m/s, and rad/s about the axes of space.
    struct Velocity
    {
        Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    };

    /// Begins a step of so many ticks, which are `period_s` apart. Before it, and after its last tick, readings and efforts pass as they are. [tick thread]
    void begin (std::size_t ticks_, double period_s) noexcept;

    /// The reading of the next tick. `is_new`: it was renewed since the last tick. Without a velocity, by_velocity takes the way since the last step.
    /// Call it once per tick, from Device::read. [tick thread]
    Reading move (const Reading& latest, bool is_new, const std::optional<Velocity>& = std::nullopt) noexcept;

    /// The same for a device that counts the age of its readings itself. [tick thread]
    Reading moveAged (const Reading& latest, bool is_new, const std::optional<Velocity>& = std::nullopt) noexcept;

    /// Takes the effort of the tick. Call it once per tick, from Device::write. [tick thread]
    void take (const Effort&) noexcept;

    /// From Device::withhold. [tick thread]
    void withhold() noexcept { taken = 0; }

    /// True from begin() until take() has got the effort of the last tick of the step. [tick thread]
    bool isInStep() const noexcept { return at < ticks; }

    /// The effort of the step so far. [tick thread]
    Effort effort() const noexcept;

    /// A state with other rules is refused.
    void serialize (auto& archive)
    {
        auto of_readings = readings;
        auto of_efforts = efforts;
        archive (of_readings, of_efforts);
        if (of_readings != readings || of_efforts != efforts)
            return archive.refuse ("has a device with other rules for steps (`between` or `step_effort`) than when it was saved");
        archive (ticks, at, period, before, has_before, age, moves, velocity, silent, taken, last, sum);
    }

private:
    void blend (Reading&) const noexcept;
    void lead (Reading&) const noexcept;

    Readings readings = Readings::hold;
    Efforts efforts = Efforts::last;
    std::size_t ticks = 0, at = 0;   // of the step, and how many of them are over
    double period = 0.0;             // in s
    Reading before {};               // of the last step
    bool has_before = false;
    double age = 0.0;       // of the reading of this step, when it came, in s
    bool moves = false;     // the reading of this step is new
    Velocity velocity {};   // of this step
    double silent = 0.0;    // time since the reading was renewed, in s
    std::size_t taken = 0;
    Effort last {}, sum {};
};

}   // namespace tactus
