// SPDX-License-Identifier: MIT
#include "hid_model.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{

HidModel::HidModel (std::shared_ptr<const Profile> p)
    : description (std::move (p)), decoder (description), encoder (description, decoder), kinematics (description->kinematics),
      limiter (*description, encoder.effortNames(), encoder.effortUnits(), encoder.restEfforts()), encoders (description->limits.still_travel)
{
    for (std::size_t i = 0; i < 3; ++i)
    {
        position[i] = decoder.axis (description->position[i]);
        rotation[i] = decoder.axis (description->rotation[i]);
        force[i] = encoder.effort (description->force[i]);
        torque[i] = encoder.effort (description->torque[i]);
    }
    for (std::size_t i = 0; i < effortNames().size(); ++i)
    {
        const auto is_i = [i] (int effort) { return effort == static_cast<int> (i); };
        if (std::ranges::any_of (force, is_i) || std::ranges::any_of (torque, is_i)) continue;
        own.push_back (i);
        own_names.push_back (effortNames()[i]);
    }
    for (const auto& report : description->outputs)
    {
        auto& efforts = pushing.emplace_back();
        for (const auto& field : report.fields)
            if (field.source == OutputField::Source::effort && std::ranges::count (description->signals, field.name, &SignalEffort::frequency) == 0)
                efforts.push_back (static_cast<std::size_t> (encoder.effort (field.name)));
    }
    pressure = decoder.axis (description->pressure);
    valid = decoder.axis (description->valid);
    for (const auto& alarm : description->alarms)
        alarms.push_back (decoder.axis (alarm.field));
    forget();
}

void HidModel::forget() noexcept
{
    last = {};
    encoders.restart();
    pose = {};
    pose.strength = hasPosition() ? 0.0 : 1.0;
}

const HidSample& HidModel::decode (std::span<const std::uint8_t> report) noexcept
{
    last.refusal = decoder.decode (report);
    last.lost = decoder.lostBefore();
    last.report_order = decoder.reportOrder();
    if (last.refusal != Refusal::none) return last;

    last.axes = decoder.axes();
    last.buttons = decoder.buttons();
    last.time = decoder.time();
    if (pressure >= 0) last.pressure = last.axes[static_cast<std::size_t> (pressure)];
    place();
    return last;
}

/// Here a report becomes a position: decoded numbers to the pose of the tool, in Tactus axes.
void HidModel::place() noexcept
{
    const auto values = [&] (const std::array<int, 3>& of) {
        Vec3 v = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i)
            if (of[i] >= 0) v[static_cast<int> (i)] = last.axes[static_cast<std::size_t> (of[i])];
        return v;
    };

    const auto counted = values (position);
    pose = kinematics.pose (kinematics.joints (counted));
    last.problem = pose.problem;
    const bool placed = pose.problem == PoseProblem::none || pose.problem == PoseProblem::singular;
    if (placed)
    {
        last.position = description->axes * pose.position;
        encoders (counted, last.position);
    }
    last.rotation = description->axes * values (rotation);
    last.valid = placed && (valid < 0 || last.axes[static_cast<std::size_t> (valid)] != 0.0);
}

ReadingFault HidModel::fault (double driven_s) const noexcept
{
    if (last.problem == PoseProblem::unreachable || last.problem == PoseProblem::not_finite) return ReadingFault::impossible_pose;
    if (valid >= 0 && last.axes[static_cast<std::size_t> (valid)] == 0.0) return ReadingFault::not_homed;
    if (encoders.hasStopped()) return ReadingFault::frozen;
    for (std::size_t i = 0; i < alarms.size(); ++i)
    {
        const auto& alarm = description->alarms[i];
        if (driven_s >= alarm.while_driven && isOn (i)) return alarm.means;
    }
    return ReadingFault::none;
}

bool HidModel::isOn (std::size_t alarm) const noexcept
{
    if (alarms[alarm] < 0) return false;
    const auto raw = decoder.raw (static_cast<std::size_t> (alarms[alarm]));
    const auto& is = description->alarms[alarm].is;
    return is ? raw == *is : raw != 0;
}

bool HidModel::isStopped() const noexcept
{
    for (std::size_t i = 0; i < alarms.size(); ++i)
        if (description->alarms[i].means == ReadingFault::stopped && isOn (i)) return true;
    return false;
}

Reading HidModel::reading (double driven_s) const noexcept
{
    Reading r;
    r.position = last.position;
    r.rotation = last.rotation;
    r.pressure = last.pressure;
    r.buttons = last.buttons;
    r.fault = fault (driven_s);
    r.valid = last.valid && r.fault == ReadingFault::none;
    return r;
}

void HidModel::take (const Channels& axes, HidEffort& effort) const noexcept
{
    for (std::size_t i = 0; i < own.size(); ++i)
        if (const double asked = axes[static_cast<int> (i)]; asked != 0.0) effort.efforts[own[i]] = asked;
}

EffortValues HidModel::asked (const HidEffort& effort) const noexcept
{
    auto all = effort.efforts;
    const Vec3 turn = description->axes.transpose() * effort.torque;
    const Vec3 push = description->axes.transpose() * effort.force;
    const Vec3 motors = kinematics.motors (Kinematics::torques (pose, push));
    for (std::size_t i = 0; i < 3; ++i)
    {
        if (force[i] >= 0) all[static_cast<std::size_t> (force[i])] += motors[static_cast<int> (i)];
        if (torque[i] >= 0) all[static_cast<std::size_t> (torque[i])] += turn[static_cast<int> (i)];
    }
    return all;
}

/// The part of a force that the motors cannot render: the share that the pose or a current limit takes away, and the components along
/// axes without a motor. Both forces are in the device's own axes.
Vec3 HidModel::outOfReach (const Vec3& push) const noexcept
{
    const double share = pose.strength * kinematics.share (Kinematics::torques (pose, push));
    Vec3 lost = push;
    for (int axis = 0; axis < 3; ++axis)
        for (int motor = 0; motor < 3; ++motor)
            if (force[static_cast<std::size_t> (motor)] >= 0 && pose.jacobian (axis, motor) != 0.0) lost[axis] = push[axis] - share * push[axis];
    return lost;
}

EffortValues HidModel::drive (const HidEffort& effort, double passed_s) noexcept
{
    auto values = asked (effort);
    const auto [size, step] = limiter (values, passed_s);
    const auto& axes = description->axes;
    Vec3 no_turn = axes.transpose() * effort.torque;
    for (int i = 0; i < 3; ++i)
        if (torque[static_cast<std::size_t> (i)] >= 0) no_turn[i] = 0.0;

    const auto follow = [s = step] (Vec3& now, const Vec3& to) { now = s == 1.0 ? to : Vec3 (now + s * (to - now)); };
    follow (rendered_force, size * (effort.force - axes * outOfReach (axes.transpose() * effort.force)));
    follow (rendered_torque, size * (effort.torque - axes * no_turn));
    return values;
}

void HidModel::rest() noexcept
{
    limiter.forget();
    rendered_force = rendered_torque = Vec3::Zero();
}

std::span<const std::uint8_t> HidModel::encodeValues (std::size_t report, const EffortValues& values, std::span<const float> samples) noexcept
{
    return encoder.encode (report, values, samples, decoder);
}

std::span<const std::uint8_t> HidModel::encode (std::size_t report, const HidEffort& effort, std::span<const float> samples) noexcept
{
    auto values = asked (effort);
    limiter.shrink (values);
    return encodeValues (report, values, samples);
}

bool HidModel::rests (std::size_t report, const EffortValues& values) const noexcept
{
    return std::ranges::all_of (pushing[report], [&] (std::size_t i) { return values[i] == restEfforts()[i]; });
}

std::span<const std::uint8_t> HidModel::neutral (std::size_t report) noexcept { return encoder.neutral (report); }

std::span<const std::string> HidModel::channelNames (std::size_t report) const noexcept
{
    if (report >= outputs() || ! description->outputs[report].stream) return {};
    return description->outputs[report].stream->channels;
}

void HidModel::reset()
{
    decoder.reset();
    encoder.reset();
    rest();
    forget();
}

}   // namespace tactus::host::hid
