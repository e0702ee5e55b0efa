// SPDX-License-Identifier: MIT
#include "motor_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host::hid
{

namespace
{
const OutputField* fieldOf (const Profile& profile, const std::string& name)
{
    for (const auto& report : profile.outputs)
        for (const auto& field : report.fields)
            if (field.source == OutputField::Source::effort && field.name == name) return &field;
    return nullptr;
}
}   // namespace

MotorLimiter::MotorLimiter (const Profile& profile, const std::vector<std::string>& names, const std::vector<std::string>& units, const EffortValues& rest)
    : at_rest (rest), last (rest)
{
    Group force { {}, profile.limits.guard.max_slew }, torque { {}, profile.limits.guard.max_torque_slew };
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        const auto isI = [&] (const std::string& name) { return name == names[i]; };
        const bool renders_force = std::ranges::any_of (profile.force, isI), renders_torque = std::ranges::any_of (profile.torque, isI);
        if (! renders_force && ! renders_torque && ! isMechanical (units[i])) continue;
        Motor motor { i };
        if (const auto* field = fieldOf (profile, names[i]); field != nullptr && field->encoding.law == Encoding::Law::linear)
        {
            motor.least = field->min;
            motor.most = field->max;
        }
        if (renders_force)
        {
            motor.least = std::max (motor.least, -profile.limits.max_motor);
            motor.most = std::min (motor.most, profile.limits.max_motor);
            motor.slew = profile.limits.max_motor_slew;
        }
        motors.push_back (motor);
        if (renders_torque)
            torque.efforts.push_back (i);
        else if (! renders_force)
            groups.push_back ({ { i }, profile.limits.guard.max_axis_slew });
        else if (std::holds_alternative<DirectKinematics> (profile.kinematics))
            force.efforts.push_back (i);
    }
    groups.push_back (std::move (force));
    groups.push_back (std::move (torque));
}

void MotorLimiter::tighten (double force, double torque, double axis) noexcept
{
    const auto axes = groups.size() - 2;
    for (std::size_t i = 0; i < groups.size(); ++i)
        groups[i].slew = std::min (groups[i].slew, i < axes ? axis : i == axes ? force
                                                                               : torque);
}

/// A motor that cannot pull, for example on a string, does not reduce the others' force: its own field is clamped later.
double MotorLimiter::shrink (EffortValues& values) const noexcept
{
    double share = 1.0;
    for (const auto& [effort, least, most, slew] : motors)
    {
        const double limit = values[effort] < 0.0 ? -least : most, size = std::abs (values[effort]);
        if (limit > 0.0 && size > limit && std::isfinite (size)) share = std::min (share, limit / size);
    }
    if (share == 1.0) return share;
    for (const auto& motor : motors)
        values[motor.effort] *= share;
    return share;
}

/// The factor s.
double MotorLimiter::stepShare (const EffortValues& values, double passed_s) const noexcept
{
    double share = 1.0;
    for (const auto& [effort, least, most, slew] : motors)
    {
        const double step = std::abs (values[effort] - last[effort]);
        if (step > slew * passed_s && std::isfinite (step)) share = std::min (share, slew * passed_s / step);
    }
    for (const auto& [efforts, slew] : groups)
    {
        double square = 0.0;
        for (const auto i : efforts)
            square += (values[i] - last[i]) * (values[i] - last[i]);
        const double step = std::sqrt (square);
        if (step > slew * passed_s && std::isfinite (step)) share = std::min (share, slew * passed_s / step);
    }
    return share;
}

MotorLimiter::ScaleFactors MotorLimiter::operator() (EffortValues& values, double passed_s) noexcept
{
    const double size = shrink (values), share = stepShare (values, passed_s);
    for (const auto& motor : motors)
    {
        double& value = values[motor.effort];
        if (share < 1.0) value = last[motor.effort] + share * (value - last[motor.effort]);
        last[motor.effort] = std::isfinite (value) ? value : at_rest[motor.effort];
    }
    return { size, share };
}

}   // namespace tactus::host::hid
