// SPDX-License-Identifier: MIT
#include "guard_limits.hpp"

#include <tactus/node/device_parts.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/units.hpp>

#include <utility>

namespace tactus
{
namespace
{
constexpr Unit force_rate { Quantity::any, { 1, 1, -3 }, "N/s" };
constexpr Unit torque_rate { Quantity::any, { 2, 1, -3 }, "N*m/s" };
constexpr Unit brake_rate { Quantity::any, { 0, 1, -2 }, "N/m" };   // N s/m per s
constexpr Unit per_second { Quantity::any, { 0, 0, -1 }, "1/s" };
constexpr Unit angular_speed { Quantity::any, { 0, 0, -1 }, "rad/s" };
constexpr Unit impulse { Quantity::any, { 1, 1, -1 }, "N*s" };
constexpr Unit angular_impulse { Quantity::any, { 2, 1, -1 }, "N*m*s" };

constexpr auto any = Bounds::notNegative();
constexpr auto some = Bounds::positive();

/// Reads the window of some limits. If any of them is set, the window is required, because the limit has no meaning without it.
double window (ObjectReader& in, std::initializer_list<std::string_view> limits, std::string_view key)
{
    for (const auto limit : limits)
        if (in.has (limit)) in.require (key, "give the time window of " + std::string (limit) + ", such as \"1 s\"");
    return in.number (key, unit::second, some, 0.0);
}

/// Reads a limit for axes that slide or rotate; the unit of the value decides which of the two is meant.
double either (ObjectReader& in, std::string_view key, const Unit& sliding, const Unit& turning, Bounds bounds, double otherwise)
{
    const auto& json = in.json();
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
        number = in.whole (key, 0, Reading::most_buttons - 1, -1);
    else if (const auto name = in.text (key); ! name.empty())
    {
        number = partNamed (name, device.buttons);
        if (number >= Reading::most_buttons) number = -1;
        if (number < 0)
            in.error (key, "device/unknown_button", "the device has " + lacking ("button", "buttons", name, device.buttons),
                      "name one of its buttons, or give the number of the button, counted from 0");
    }
    // If the button is unknown, no force may pass.
    return number >= 0 ? std::uint64_t { 1 } << number : ~std::uint64_t { 0 };
}
}   // namespace

GuardLimits readGuardLimits (const Json& json, std::string where, Messages& messages, const DeviceLayout& device)
{
    ObjectReader in (json, std::move (where), messages);
    GuardLimits limits;
    readEffortLimits (in, limits);
    limits.ramp = in.number ("ramp", unit::second, any, limits.ramp);
    limits.watchdog = in.number ("watchdog", unit::second, some, limits.watchdog);
    limits.dead_man_pressure = in.number ("dead_man_pressure", unit::newton, any, limits.dead_man_pressure);
    limits.dead_man_buttons = button (json, in, device);
    in.finish();
    checkStops (limits, in.where(), messages, Unlimited::may_be_limited_elsewhere);
    return limits;
}

void readEffortLimits (ObjectReader& in, GuardLimits& limits)
{
    limits.max_force = in.number ("max_force", unit::newton, any, limits.max_force);
    limits.max_torque = in.number ("max_torque", unit::torque, any, limits.max_torque);
    limits.max_slew = in.number ("max_slew", force_rate, some, limits.max_slew);
    limits.max_torque_slew = in.number ("max_torque_slew", torque_rate, some, limits.max_torque_slew);
    limits.max_axis_effort = either (in, "max_axis_effort", unit::newton, unit::torque, any, limits.max_axis_effort);
    limits.max_axis_slew = either (in, "max_axis_slew", force_rate, torque_rate, some, limits.max_axis_slew);
    limits.max_signal = in.number ("max_signal", unit::gain, any, limits.max_signal);
    limits.max_signal_slew = in.number ("max_signal_slew", per_second, some, limits.max_signal_slew);
    limits.max_brake = in.number ("max_brake", unit::damping, any, limits.max_brake);
    limits.max_brake_slew = in.number ("max_brake_slew", brake_rate, some, limits.max_brake_slew);
    limits.brake_at_stop = in.number ("brake_at_stop", unit::damping, any, limits.brake_at_stop);
    limits.max_speed = in.number ("max_speed", unit::speed, some, limits.max_speed);
    limits.max_angular_speed = in.number ("max_angular_speed", angular_speed, some, limits.max_angular_speed);
    limits.max_axis_speed = either (in, "max_axis_speed", unit::speed, angular_speed, some, limits.max_axis_speed);
    limits.max_impulse = in.number ("max_impulse", impulse, some, limits.max_impulse);
    limits.max_angular_impulse = in.number ("max_angular_impulse", angular_impulse, some, limits.max_angular_impulse);
    limits.max_axis_impulse = either (in, "max_axis_impulse", impulse, angular_impulse, some, limits.max_axis_impulse);
    limits.impulse_window = window (in, { "max_impulse", "max_angular_impulse", "max_axis_impulse" }, "impulse_window");
    limits.max_energy = in.number ("max_energy", unit::joule, some, limits.max_energy);
    limits.energy_window = window (in, { "max_energy" }, "energy_window");
    if (in.has ("max_still") && ! in.has ("still_torque"))   // of a wheel, only the torque is known
        in.require ("still_force", "give the smallest force at which max_still applies, such as \"0.5 N\", or still_torque");
    limits.max_still = in.number ("max_still", unit::second, some, limits.max_still);
    limits.still_force = in.number ("still_force", unit::newton, some, limits.still_force);
    limits.still_torque = in.number ("still_torque", unit::torque, some, limits.still_torque);
}

void checkStops (const GuardLimits& limits, const std::string& where, Messages& messages, Unlimited unlimited)
{
    struct Pair
    {
        const char *most_key, *slew_key;
        double most, slew;
    };
    const Pair pairs[] { { "max_force", "max_slew", limits.max_force, limits.max_slew },
                         { "max_torque", "max_torque_slew", limits.max_torque, limits.max_torque_slew },
                         { "max_axis_effort", "max_axis_slew", limits.max_axis_effort, limits.max_axis_slew },
                         { "max_signal", "max_signal_slew", limits.max_signal, limits.max_signal_slew },
                         { "max_brake", "max_brake_slew", limits.max_brake, limits.max_brake_slew } };
    for (const auto& p : pairs)
    {
        if (p.slew == GuardLimits::none || p.most <= longest_stop_s * p.slew) continue;
        if (p.most == GuardLimits::none)
        {
            if (unlimited == Unlimited::is_refused)
                messages.push_back (Message::error ("device/slow_stop", where + "/" + p.slew_key,
                                                    std::string ("without ") + p.most_key + ", " + p.slew_key + " " + numberText (p.slew)
                                                        + " could prolong a stop indefinitely; a stop may take at most " + numberText (longest_stop_s) + " s",
                                                    std::string ("add ") + p.most_key + ", at most " + numberText (longest_stop_s * p.slew)));
            continue;
        }
        const auto least = numberText (p.most / longest_stop_s);
        messages.push_back (Message::error ("device/slow_stop", where + "/" + p.slew_key,
                                            std::string (p.slew_key) + " " + numberText (p.slew) + " would take " + numberText (p.most / p.slew)
                                                + " s to bring " + p.most_key + " " + numberText (p.most) + " to zero; a stop may take at most "
                                                + numberText (longest_stop_s) + " s",
                                            "raise " + std::string (p.slew_key) + " to at least " + least + ", or lower " + p.most_key));
    }
}

}   // namespace tactus
