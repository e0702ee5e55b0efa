// SPDX-License-Identifier: MIT
#include "device_side.hpp"
#include "bits.hpp"

#include <host/devices/hid/report/crc32.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host::hid
{
namespace
{
/// The place of a name among three; empty if it is not there.
std::optional<int> placeOf (const std::array<std::string, 3>& names, const std::string& name)
{
    const auto at = name.empty() ? names.end() : std::ranges::find (names, name);
    return at == names.end() ? std::nullopt : std::optional (static_cast<int> (at - names.begin()));
}

/// The solution of J x = b with the smallest x, also where J has not full rank.
Vec3 solved (const Mat3& j, const Vec3& b) { return j.completeOrthogonalDecomposition().solve (b); }

std::uint32_t wrapped (const Bits& bits, double number)
{
    if (bits.is_float) return rawOf (bits, number);
    const double size = std::ldexp (1.0, static_cast<int> (bits.size)), whole = std::floor (number + 0.5);
    return static_cast<std::uint32_t> (static_cast<std::uint64_t> (whole - size * std::floor (whole / size)) & maskOf (bits));
}
}   // namespace

DeviceSide::DeviceSide (std::shared_ptr<const Profile> p) : profile (std::move (p)), shapes (outputShapes (*profile)), kinematics (profile->kinematics)
{
    joints = kinematics.joints (counts);
}

/// Newton's method, from where the arm was.
Vec3 DeviceSide::countsAt (const Vec3& position)
{
    constexpr int most_steps = 50;
    constexpr double close_enough = 1e-9, longest_step = 0.3;   // m; rad, or the unit of a linear map
    const Vec3 wanted = profile->axes.transpose() * position;
    const bool is_linear = ! std::holds_alternative<SerialArm> (profile->kinematics) && ! std::holds_alternative<FiveBar> (profile->kinematics);
    Vec3 q = joints;
    for (int i = 0; i < most_steps; ++i)
    {
        const auto pose = kinematics.pose (q);
        if (pose.problem == PoseProblem::unreachable || pose.problem == PoseProblem::not_finite) break;
        const Vec3 off = wanted - pose.position;
        if (off.norm() < close_enough || (is_linear && i == 1)) break;
        Vec3 step = solved (pose.jacobian, off);
        if (! is_linear && step.norm() > longest_step) step *= longest_step / step.norm();
        q += step;
    }
    const auto there = kinematics.pose (q);
    if (there.problem == PoseProblem::unreachable || there.problem == PoseProblem::not_finite) return counts;
    joints = q;
    return counts = kinematics.counts (q);
}

double DeviceSide::valueOf (const InputReport& report, const InputField& field, const Reading& reading, double time_s) const
{
    if (field.name == report.timestamp) return time_s;
    if (field.name == profile->pressure) return reading.pressure;
    if (const auto i = placeOf (profile->position, field.name)) return counts[*i];
    if (const auto i = placeOf (profile->rotation, field.name)) return (profile->axes.transpose() * reading.rotation)[*i];
    return 0.0;
}

std::uint32_t DeviceSide::rawOf (const InputReport& report, const InputField& field, const Reading& reading, double time_s) const
{
    if (field.expect) return static_cast<std::uint32_t> (*field.expect);
    if (! field.buttons.empty()) return field.is_hat ? 8 : 0;
    if (! report.sequence.empty() && field.name == report.sequence) return number & static_cast<std::uint32_t> (maskOf (field.bits));
    if (! profile->valid.empty() && field.name == profile->valid) return reading.valid ? 1 : 0;
    for (const auto& alarm : profile->alarms)
        if (alarm.field == field.name) return alarm.is && *alarm.is == 0 ? 1 : 0;
    const double count = (valueOf (report, field, reading, time_s) - field.offset) / field.scale;
    const bool wraps = field.unwrap || field.name == report.timestamp;
    return wraps ? wrapped (field.bits, count) : hid::rawOf (field.bits, count);
}

Bytes DeviceSide::input (std::size_t report, const Reading& reading, double time_s)
{
    const auto& shape = profile->inputs[report];
    Bytes bytes (shape.length);
    if (report == 0)
    {
        ++number;
        const double held = counts[0];
        countsAt (reading.position);
        if (is_held) counts[0] = held;
    }
    for (const auto& field : shape.fields)
        putBits (field.bits, rawOf (shape, field, reading, time_s), bytes);
    if (shape.id) bytes.front() = *shape.id;
    return bytes;
}

bool DeviceSide::tellsSomething (std::size_t report) const
{
    return std::ranges::any_of (profile->inputs[report].fields, [] (const auto& f) { return ! f.expect; });
}

std::optional<DeviceSide::Heard> DeviceSide::output (std::span<const std::uint8_t> report) const
{
    const auto fits = [&] (const OutputReport& r) {
        if (report.size() != r.neutral.size() || (r.id && report.front() != *r.id)) return false;
        const auto& marks = shapes[static_cast<std::size_t> (&r - profile->outputs.data())].marks;
        if (std::ranges::any_of (marks, [&] (const auto& mark) { return bitsAt (mark.first, report) != mark.second; })) return false;
        if (! r.checksum) return true;
        const auto sum = crc32 (report.first (r.checksum->at), crc32 (r.checksum->prefix));
        return bitsAt ({ .at = 8 * r.checksum->at, .size = 32 }, report) == sum;
    };
    const auto shape = std::ranges::find_if (profile->outputs, fits);
    if (shape == profile->outputs.end()) return std::nullopt;

    Heard heard { .report = static_cast<std::size_t> (shape - profile->outputs.begin()), .effort = {} };
    Vec3 motors = Vec3::Zero(), turn = Vec3::Zero();
    for (const auto& field : shape->fields)
    {
        const auto raw = bitsAt (field.bits, report);
        if (field.source == OutputField::Source::enable) heard.enabled = heard.enabled && raw != 0;
        if (field.source != OutputField::Source::effort) continue;
        const double value = decoded (field.encoding, numberOf (field.bits, raw));
        const auto along = placeOf (profile->force, field.name), about = placeOf (profile->torque, field.name);
        if (along) motors[*along] = value;
        if (about) turn[*about] = value;
        heard.pushes = heard.pushes || along || about;
    }
    if (! heard.enabled) return heard;

    // The currents of motors are proportional to the torques, up to the largest current.
    constexpr double small = 1e-6;   // N m
    const Vec3 gain = kinematics.motors (Vec3::Constant (small)) / small;
    const auto pose = kinematics.pose (joints);
    Vec3 torques = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
        torques[i] = gain[i] != 0.0 ? motors[i] / gain[i] : 0.0;
    heard.effort.force = profile->axes * solved (pose.jacobian.transpose(), torques);
    heard.effort.torque = profile->axes * turn;
    return heard;
}

}   // namespace tactus::host::hid
