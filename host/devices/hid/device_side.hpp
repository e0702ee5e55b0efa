// SPDX-License-Identifier: MIT
#pragma once

#include "hid_model.hpp"

#include <host/devices/hid/report/framing.hpp>

#include <tactus/node/device.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tactus::host::hid
{

/// A profile from the side of the device: readings to input reports, and output reports to the effort on the tool. It is the inverse of HidModel,
/// written apart from it, so that each can be tested against the other. For fakes and tests; allocates. [one thread]
class DeviceSide
{
public:
    explicit DeviceSide (std::shared_ptr<const Profile>);

    /// The n-th input report for a reading at a time in s, as the device sends it: with its id if it has one, the next sequence number, the marks,
    /// and no alarm. Values that no axis of the profile has are left out. `valid` is in the report, too. Where the arm cannot reach, it stays.
    Bytes input (std::size_t report, const Reading&, double time_s);

    std::size_t inputs() const noexcept { return profile->inputs.size(); }

    /// The effort that an output report asks for.
    struct Heard
    {
        std::size_t report = 0;
        bool pushes = false;   ///< true if the report has fields for the force or the torque on the tool
        bool enabled = true;   ///< false if an enable bit of the report is 0
        Effort effort;         ///< force and torque on the tool, in Tactus axes; 0 unless enabled
    };

    /// True if the n-th input report has a value or a button.
    bool tellsSomething (std::size_t report) const;

    /// Reads an output report, without the leading 0 of a report without an id. Empty if its id, its length, its CRC or a constant byte is wrong.
    std::optional<Heard> output (std::span<const std::uint8_t> report) const;

    /// From now on, the first of the values from which the position is computed, such as the count of an encoder, stays what it is, or moves
    /// again.
    void hold (bool on) noexcept { is_held = on; }

    /// Starts again, like a device that has been switched off and on.
    void restart() noexcept { number = 0; }

private:
    Vec3 countsAt (const Vec3& position);
    double valueOf (const InputReport&, const InputField&, const Reading&, double time_s) const;
    std::uint32_t rawOf (const InputReport&, const InputField&, const Reading&, double time_s) const;

    std::shared_ptr<const Profile> profile;
    std::vector<FrameReader::Shape> shapes;   // of the output reports
    Kinematics kinematics;
    Vec3 joints = Vec3::Zero();   // of the latest position
    Vec3 counts = Vec3::Zero();
    std::uint32_t number = 0;
    bool is_held = false;
};

}   // namespace tactus::host::hid
