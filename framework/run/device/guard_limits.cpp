// SPDX-License-Identifier: MIT
#include "guard_limits.hpp"

#include <framework/node/device_parts.hpp>
#include <framework/text/object_reader.hpp>
#include <framework/text/units.hpp>

#include <utility>

namespace tactus
{
namespace
{
constexpr Unit force_rate { Quantity::any, { 1, 1, -3 }, "N/s" };
constexpr Unit torque_rate { Quantity::any, { 2, 1, -3 }, "N*m/s" };
constexpr Unit impulse { Quantity::any, { 1, 1, -1 }, "N*s" };
constexpr int most_buttons = 32;

constexpr auto any = Bounds::notNegative();
constexpr auto some = Bounds::positive();

/// Without a window, the limit would have no meaning.
double window (ObjectReader& in, std::string_view limit, std::string_view key)
{
    if (in.has (limit)) in.require (key, "give the time window of " + std::string (limit) + ", such as \"1 s\"");
    return in.number (key, unit::second, some, 0.0);
}

/// An axis slides or rotates; the unit in the text decides which.
double either (const Json& json, ObjectReader& in, std::string_view key, const Unit& sliding, const Unit& turning, Bounds bounds, double otherwise)
{
    const auto written = json.is_object() ? json.find (key) : json.end();
    const auto read = written != json.end() && written->is_string() ? parseMeasure (written->get<std::string>()) : Measure {};
    return in.number (key, read && read->dimension == turning.dimension ? turning : sliding, bounds, otherwise);
}

std::uint64_t button (const Json& json, ObjectReader& in, const DeviceLayout& device)
{
    constexpr std::string_view key = "dead_man_button";
    if (! in.has (key)) return 0;

    int number = -1;
    if (! json.at (key).is_string())
        number = in.whole (key, 0, most_buttons - 1, -1);
    else if (const auto name = in.text (key); ! name.empty())
    {
        number = partNamed (name, device.buttons);
        if (number >= most_buttons) number = -1;
        if (number < 0)
            in.error (key, "device/unknown_button", "the device has " + lacking ("button", "buttons", name, device.buttons),
                      "name one of its buttons, or give its number from 0");
    }
    // If the button is unknown, no force may pass.
    return number >= 0 ? std::uint64_t { 1 } << number : ~std::uint64_t { 0 };
}
}   // namespace

GuardLimits readGuardLimits (const Json& json, std::string where, Messages& messages, const DeviceLayout& device)
{
    ObjectReader in (json, std::move (where), messages);
    GuardLimits limits;
    limits.max_force = in.number ("max_force", unit::newton, any, limits.max_force);
    limits.max_torque = in.number ("max_torque", unit::torque, any, limits.max_torque);
    limits.max_slew = in.number ("max_slew", force_rate, some, limits.max_slew);
    limits.max_torque_slew = in.number ("max_torque_slew", torque_rate, some, limits.max_torque_slew);
    limits.ramp = in.number ("ramp", unit::second, any, limits.ramp);
    limits.watchdog = in.number ("watchdog", unit::second, some, limits.watchdog);
    limits.max_axis_effort = either (json, in, "max_axis_effort", unit::newton, unit::torque, any, limits.max_axis_effort);
    limits.max_axis_slew = either (json, in, "max_axis_slew", force_rate, torque_rate, some, limits.max_axis_slew);
    limits.max_signal = in.number ("max_signal", unit::gain, any, limits.max_signal);
    limits.max_speed = in.number ("max_speed", unit::speed, some, limits.max_speed);
    limits.max_impulse = in.number ("max_impulse", impulse, some, limits.max_impulse);
    limits.impulse_window = window (in, "max_impulse", "impulse_window");
    limits.max_energy = in.number ("max_energy", unit::joule, some, limits.max_energy);
    limits.energy_window = window (in, "max_energy", "energy_window");
    limits.dead_man_pressure = in.number ("dead_man_pressure", unit::newton, any, limits.dead_man_pressure);
    limits.dead_man_buttons = button (json, in, device);
    in.finish();
    return limits;
}

}   // namespace tactus
