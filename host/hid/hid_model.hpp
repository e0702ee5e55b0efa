// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/kinematics.hpp>
#include <host/hid/report_decoder.hpp>
#include <host/hid/report_encoder.hpp>

#include <framework/device.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// What a device said last, in SI and in Tactus' axes.
struct HidSample
{
    Vec3 position = Vec3::Zero();              ///< m
    Vec3 rotation = Vec3::Zero();              ///< rotation vector, rad
    double pressure = 0.0;                     ///< N
    std::uint32_t buttons = 0;                 ///< bit i: buttonNames()[i] is down
    std::array<double, most_axes> axes {};     ///< as axisNames()
    double time = 0.0;                         ///< s by the device's clock since its first report, if hasTime
    std::uint32_t lost = 0;                    ///< reports that were lost just before this one
    bool valid = false;                        ///< the device says so, and kinematics have an answer
    Refusal refusal = Refusal::none;           ///< why the last report changed nothing
    PoseProblem problem = PoseProblem::none;   ///< of the pose
};

/// What is asked of a device; Tactus' axes.
struct HidEffort
{
    Vec3 force = Vec3::Zero();                     ///< N on the tool
    Vec3 torque = Vec3::Zero();                    ///< N m
    std::array<double, most_efforts> efforts {};   ///< as effortNames(); restEfforts() at first
};

/// A profile at work: bytes in, values out, and back. After construction nothing is allocated, and nothing throws,
/// whatever the bytes and values are. For one thread at a time.
class HidModel
{
public:
    explicit HidModel (std::shared_ptr<const Profile>);

    const Profile& profile() const noexcept { return *description; }

    /// A report as hid_read gives it. A report that is refused leaves all values as they were.
    const HidSample& decode (std::span<const std::uint8_t> report) noexcept;
    const HidSample& sample() const noexcept { return last; }

    /// As framework nodes want it; age is for the caller to say, who knows when it came.
    Reading reading() const noexcept;

    /// The n-th output report of the profile, ready for hid_write (or hid_send_feature_report): one that has no id
    /// begins with a 0. Force and torque go through kinematics at the pose decoded last; until a place was told there is
    /// no force. A value that is not finite
    /// leaves its field neutral, and so does a pose without an answer. The span is good until the next call.
    std::span<const std::uint8_t> encode (std::size_t report, const HidEffort&) noexcept;

    /// The same for a report with a stream: frames after each other, one sample a channel, -1…1; missing ones are 0.
    std::span<const std::uint8_t> encode (std::size_t report, const HidEffort&, std::span<const float> samples) noexcept;

    /// The report that makes the device do nothing, with counters and checksum as the device wants them.
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

    /// Of the n-th output report's stream; empty if it has none.
    std::span<const std::string> channelNames (std::size_t report) const noexcept;

    const std::vector<Step>& init() const noexcept { return description->init; }

    /// To be sent after the neutral reports.
    const std::vector<Step>& exit() const noexcept { return description->exit; }
    const GuardLimits& limits() const noexcept { return description->limits.guard; }

    const ReportDecoder::Counts& counts() const noexcept { return decoder.counts(); }

    /// Forgets counters, clocks and sequence numbers: after the device was opened again. [main thread]
    void reset();

private:
    void place() noexcept;
    void forget() noexcept;
    std::array<double, most_efforts> asked (const HidEffort&) const noexcept;

    std::shared_ptr<const Profile> description;
    ReportDecoder decoder;
    ReportEncoder encoder;
    Kinematics kinematics;
    Kinematics::Pose pose;
    HidSample last;
    std::array<int, 3> position {}, rotation {}, force {}, torque {};   // indices among axes and efforts; -1: none
    int pressure = -1, valid = -1;
};

}   // namespace tactus::host::hid
