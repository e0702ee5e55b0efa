// SPDX-License-Identifier: MIT
#pragma once

#include "encoder_watch.hpp"
#include "kinematics.hpp"
#include "motor_limiter.hpp"
#include <host/devices/hid/report/report_decoder.hpp>
#include <host/devices/hid/report/report_encoder.hpp>

#include <tactus/node/device.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// The latest values of a device, in SI units and Tactus axes.
struct HidSample
{
    Vec3 position = Vec3::Zero();              ///< m
    Vec3 rotation = Vec3::Zero();              ///< rotation vector, rad
    double pressure = 0.0;                     ///< N
    std::uint32_t buttons = 0;                 ///< bit i: buttonNames()[i] is down
    std::array<double, most_axes> axes {};     ///< in the order of axisNames()
    double time = 0.0;                         ///< time since the device's first report, on its own clock, in s; 0 unless hasTime()
    std::uint32_t lost = 0;                    ///< reports lost just before this one
    ReportOrder report_order {};               ///< how the report relates to the previous one
    bool valid = false;                        ///< true if the device reports the values as valid and the kinematics have a solution
    Refusal refusal = Refusal::none;           ///< why the last report changed nothing
    PoseProblem problem = PoseProblem::none;   ///< why the pose cannot be used; none if it can
};

/// The effort requested from a device, in Tactus axes.
struct HidEffort
{
    Vec3 force = Vec3::Zero();                     ///< force on the tool, in N
    Vec3 torque = Vec3::Zero();                    ///< N m
    std::array<double, most_efforts> efforts {};   ///< in the order of effortNames(); initially restEfforts()
};

/// Runs a profile: report bytes to values, and back. Allocates nothing after construction and never throws, for any bytes
/// and values. For one thread at a time.
class HidModel
{
public:
    explicit HidModel (std::shared_ptr<const Profile>);

    const Profile& profile() const noexcept { return *description; }

    /// Decodes a report in the form that hid_read returns it. A refused report leaves all values unchanged.
    const HidSample& decode (std::span<const std::uint8_t> report) noexcept;
    const HidSample& sample() const noexcept { return last; }

    /// The reading for the framework, not valid while an alarm is on. The caller adds its age, since it knows when the report
    /// arrived. driven_s: for how long the motors have been driven; alarms with a longer `while_driven` are ignored.
    Reading reading (double driven_s = 0.0) const noexcept;

    /// True while the device says that its own emergency stop is on, by an alarm `stopped`.
    bool isStopped() const noexcept;

    /// The efforts that neither the force nor the torque drives. A graph can drive only these by name: if a motor could be
    /// driven both by the force and by name, the guard would limit the two separately, but not their sum.
    const std::vector<std::string>& ownEffortNames() const noexcept { return own_names; }

    /// Copies values, in the order of ownEffortNames(), into the effort. A value of 0 keeps the value of the neutral report.
    void take (const Channels& axes, HidEffort&) const noexcept;

    /// The values of all efforts for this tick. Force and torque are converted by the kinematics at the latest decoded pose, then
    /// limited motor by motor. Call once per tick. `passed_s`: the time since the last call, in s. [tick thread]
    EffortValues drive (const HidEffort&, double passed_s) noexcept;

    /// From now on, drive() also keeps these limits, per s: MotorLimiter::tighten. [main thread, before the first drive()]
    void limitSlews (double of_force, double of_torque, double of_axis) noexcept { limiter.tighten (of_force, of_torque, of_axis); }

    /// Neutral reports are sent on this tick, so the motors start from rest on the next one. [tick thread]
    void rest() noexcept;

    /// The part of the force and the torque of the last drive() or rest() that the motors render: on the tool, in Tactus axes, in N and N m. The
    /// force is smaller than requested if the pose, a current, a motor or a slew limits it, and 0 along an axis without a motor. This does not
    /// consider a field that clamps the value of a single motor, such as one that can only pull. [tick thread]
    const Vec3& renderedForce() const noexcept { return rendered_force; }
    const Vec3& renderedTorque() const noexcept { return rendered_torque; }

    /// The n-th output report of the profile, ready for hid_write (or hid_send_feature_report): without an id it begins
    /// with 0. A field stays neutral if its value is not finite or if the pose has no solution. A report with a stream carries the
    /// samples: interleaved frames, -1…1; missing samples are 0. The span is valid until the next call.
    std::span<const std::uint8_t> encodeValues (std::size_t report, const EffortValues&, std::span<const float> samples = {}) noexcept;

    /// The same for a single effort, without the limit on the change of the motors.
    std::span<const std::uint8_t> encode (std::size_t report, const HidEffort&, std::span<const float> samples = {}) noexcept;

    /// True if nothing in the n-th output report pushes or shakes: all its efforts, except the frequencies of signals, have the values
    /// of the neutral report. The samples of a stream are not considered. [tick thread]
    bool rests (std::size_t report, const EffortValues&) const noexcept;

    /// The report that makes the device do nothing, with the counters and the checksum that it requires.
    std::span<const std::uint8_t> neutral (std::size_t report) noexcept;

    std::size_t outputs() const noexcept { return description->outputs.size(); }
    bool hasTime() const noexcept { return decoder.hasTime(); }
    bool hasPosition() const noexcept { return ! description->position[0].empty() || ! description->position[1].empty() || ! description->position[2].empty(); }

    const std::vector<std::string>& axisNames() const noexcept { return decoder.axisNames(); }
    const std::vector<std::string>& axisUnits() const noexcept { return decoder.axisUnits(); }
    const std::vector<std::string>& buttonNames() const noexcept { return decoder.buttonNames(); }
    const std::vector<std::string>& effortNames() const noexcept { return encoder.effortNames(); }
    const std::vector<std::string>& effortUnits() const noexcept { return encoder.effortUnits(); }
    const std::array<double, most_efforts>& restEfforts() const noexcept { return encoder.restEfforts(); }

    /// Channels of the n-th output report's stream; empty if it has none.
    std::span<const std::string> channelNames (std::size_t report) const noexcept;

    const std::vector<Step>& init() const noexcept { return description->init; }

    /// The steps to perform after the neutral reports.
    const std::vector<Step>& exit() const noexcept { return description->exit; }
    /// True if any of the input reports has a number.
    bool hasSequence() const noexcept
    {
        return std::ranges::any_of (description->inputs, [] (const auto& r) { return ! r.sequence.empty(); });
    }

    const GuardLimits& limits() const noexcept { return description->limits.guard; }

    const ReportDecoder::Counts& counts() const noexcept { return decoder.counts(); }

    /// Resets counters, clocks and sequence numbers; for a device that has been opened again. [main thread]
    void reset();

private:
    void place() noexcept;
    void forget() noexcept;
    EffortValues asked (const HidEffort&) const noexcept;
    Vec3 outOfReach (const Vec3& force) const noexcept;
    ReadingFault fault (double driven_s) const noexcept;
    bool isOn (std::size_t alarm) const noexcept;

    std::shared_ptr<const Profile> description;
    ReportDecoder decoder;
    ReportEncoder encoder;
    Kinematics kinematics;
    MotorLimiter limiter;
    Kinematics::Pose pose;
    EncoderWatch encoders;
    HidSample last;
    Vec3 rendered_force = Vec3::Zero(), rendered_torque = Vec3::Zero();
    std::array<int, 3> position {}, rotation {}, force {}, torque {};   // indices of axes and efforts; -1: none
    std::vector<std::size_t> own;                                       // indices of the efforts in ownEffortNames()
    std::vector<std::string> own_names;
    std::vector<std::vector<std::size_t>> pushing;   // by report, the indices of the efforts that push or shake
    std::vector<int> alarms;                         // axes of the alarms in the profile
    int pressure = -1, valid = -1;
};

}   // namespace tactus::host::hid
