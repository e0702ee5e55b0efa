// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/devices/fields.hpp>
#include <host/devices/guard_limits.hpp>

#include <utility>

namespace tactus::host
{
namespace
{
constexpr Unit force_rate { Quantity::any, { 1, 1, -3 }, "N/s" };
constexpr Unit torque_rate { Quantity::any, { 2, 1, -3 }, "N*m/s" };
}   // namespace

GuardLimits readGuardLimits (const Json& json, std::string where, Messages& messages)
{
    constexpr auto any = Bounds::notNegative();
    constexpr auto some = Bounds::positive();

    Fields in (json, std::move (where), messages);
    GuardLimits limits;
    limits.max_force = in.number ("max_force", unit::newton, any, limits.max_force);
    limits.max_torque = in.number ("max_torque", unit::torque, any, limits.max_torque);
    limits.max_slew = in.number ("max_slew", force_rate, some, limits.max_slew);
    limits.max_torque_slew = in.number ("max_torque_slew", torque_rate, some, limits.max_torque_slew);
    limits.ramp = in.number ("ramp", unit::second, any, limits.ramp);
    limits.watchdog = in.number ("watchdog", unit::second, some, limits.watchdog);
    in.finish();
    return limits;
}

}   // namespace tactus::host
