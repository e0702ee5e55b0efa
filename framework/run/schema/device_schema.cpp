// SPDX-License-Identifier: MIT
// What makeDevice() and readGuardLimits() read. A test compares the keys, the units and the ranges.
#include "schema_parts.hpp"

#include <tactus/run/device/gestures.hpp>

namespace tactus::schema
{

namespace
{
constexpr Unit force_rate { Quantity::any, { 1, 1, -3 }, "N/s" }, torque_rate { Quantity::any, { 2, 1, -3 }, "N*m/s" };
constexpr Unit impulse { Quantity::any, { 1, 1, -1 }, "N*s" }, angular_impulse { Quantity::any, { 2, 1, -1 }, "N*m*s" };
constexpr Interval any {}, not_negative { 0.0, inf };

/// A key with a unit. A second one is for axes that turn.
struct Row
{
    std::string_view key;
    const Unit* unit;
    Interval range = not_negative;
    const Unit* turning = nullptr;
};

constexpr Row guard_rows[] {
    { "max_force", &unit::newton },
    { "max_torque", &unit::torque },
    { "max_slew", &force_rate },
    { "max_torque_slew", &torque_rate },
    { "max_axis_effort", &unit::newton, not_negative, &unit::torque },
    { "max_axis_slew", &force_rate, not_negative, &torque_rate },
    { "max_signal", &unit::gain },
    { "max_signal_slew", &unit::per_second },
    { "max_brake", &unit::damping },
    { "max_brake_slew", &unit::stiffness },
    { "brake_at_stop", &unit::damping },
    { "max_speed", &unit::speed },
    { "max_angular_speed", &unit::per_second },
    { "max_axis_speed", &unit::speed, not_negative, &unit::per_second },
    { "max_impulse", &impulse },
    { "max_angular_impulse", &angular_impulse },
    { "max_axis_impulse", &impulse, not_negative, &angular_impulse },
    { "impulse_window", &unit::second },
    { "max_energy", &unit::joule },
    { "energy_window", &unit::second },
    { "max_still", &unit::second },
    { "still_force", &unit::newton },
    { "still_torque", &unit::torque },
    { "ramp", &unit::second },
    { "watchdog", &unit::second },
    { "dead_man_pressure", &unit::newton },
};

constexpr Row sim_rows[] {
    { "mass", &unit::kilogram },
    { "damping", &unit::damping },
    { "quantum", &unit::metre },
    { "force_quantum", &unit::newton },
    { "coulomb", &unit::newton },
    { "first_mode", &unit::hertz },
    { "first_mode_damping", &unit::gain, { 0.0, 1.0 } },
    { "end_mass", &unit::kilogram },
    { "brake", &unit::damping },
    { "brake_time", &unit::second },
};

constexpr Row axis_rows[] {
    { "mass", &unit::kilogram },
    { "damping", &unit::damping },
    { "stiffness", &unit::stiffness },
    { "position", &unit::metre, any },
    { "hand_force", &unit::newton, any },
};

constexpr Row hand_rows[] { { "stiffness", &unit::stiffness }, { "damping", &unit::damping } };

Json properties (std::span<const Row> rows, Quantities& quantities)
{
    auto all = Json::object();
    for (const auto& row : rows)
    {
        auto one = quantities.of (row.unit, row.range);
        all[std::string (row.key)] = row.turning == nullptr ? one : Json { { "anyOf", Json::array ({ one, quantities.of (row.turning, row.range) }) } };
    }
    return all;
}

Json closed (Json keys) { return { { "type", "object" }, { "properties", std::move (keys) }, { "additionalProperties", false } }; }

Json whole (int most) { return { { "type", "integer" }, { "minimum", 0 }, { "maximum", most } }; }

Json guard (Quantities& quantities)
{
    auto keys = properties (guard_rows, quantities);
    keys["dead_man_button"] = { { "anyOf", Json::array ({ whole (Reading::most_buttons - 1), { { "type", "string" }, { "minLength", 1 } } }) } };
    auto schema = closed (std::move (keys));
    schema["description"] = "Limits in front of the device, which no graph can bypass. They add to those of the device and of its user.";
    schema["dependentRequired"] = { { "max_impulse", Json::array ({ "impulse_window" }) },
                                    { "max_angular_impulse", Json::array ({ "impulse_window" }) },
                                    { "max_axis_impulse", Json::array ({ "impulse_window" }) },
                                    { "max_energy", Json::array ({ "energy_window" }) },
                                    { "max_still", Json::array ({ "still_force" }) } };
    return schema;
}

/// The name of a gesture, or the path of a file, which has a dot or a slash.
Json path (bool gesture, bool file)
{
    std::string names;
    for (const auto& g : gestures())
        names += (names.empty() ? "" : "|") + std::string (g.id);
    const auto pattern = ! gesture ? std::string (".") : "^(?:" + names + ")$" + (file ? "|[./\\\\]" : "");
    return { { "type", "string" }, { "pattern", pattern }, { "description", gesture ? "a gesture: " + names : std::string ("a CSV file with t,x,y,z") } };
}

void addPlacement (Json& keys, Quantities& quantities)
{
    keys["offset"] = listOf (quantities.of (&unit::metre), 3, 3);
    keys["scale"] = quantities.of (&unit::gain, not_negative);
}

Json simulated (Quantities& quantities)
{
    auto keys = properties (sim_rows, quantities);
    keys["delay"] = whole (1'000'000);
    keys["signal_outputs"] = whole (Channels::most);
    const auto addVector = [&] (const char* key, const Unit& unit) { keys[key] = listOf (quantities.of (&unit), 3, 3); };
    addVector ("position", unit::metre);
    addVector ("velocity", unit::speed);
    addVector ("rotation", unit::radian);
    addVector ("hand_force", unit::newton);

    auto hand = properties (hand_rows, quantities);
    hand["path"] = path (true, true);
    addPlacement (hand, quantities);
    keys["hand"] = closed (std::move (hand));
    keys["hand"]["required"] = Json::array ({ "path" });

    keys["axes"] = { { "type", "object" }, { "propertyNames", reference ("id") }, { "additionalProperties", closed (properties (axis_rows, quantities)) } };
    return keys;
}

/// A driver: which keys its description may have, beside those of all drivers.
Json driver (const char* id, Json keys, std::initializer_list<Json> required, Quantities& quantities)
{
    keys["driver"] = { { "const", id } };
    keys["guard"] = guard (quantities);
    for (const auto* free : { "about", "ui" })
        keys[free] = true;
    auto then = closed (std::move (keys));
    if (required.size() > 0) then["required"] = Json::array (required);
    return { { "if", { { "properties", { { "driver", { { "const", id } } } } }, { "required", Json::array ({ "driver" }) } } }, { "then", std::move (then) } };
}
}   // namespace

Json deviceOf (Quantities& quantities)
{
    Json recorded { { "path", path (false, true) } }, moved { { "path", path (true, false) } };
    addPlacement (recorded, quantities);
    addPlacement (moved, quantities);
    return { { "type", "object" },
             { "required", Json::array ({ "driver" }) },
             { "properties",
               { { "driver",
                   { { "enum", Json::array ({ "sim", "trace", "gesture", "hid", "serial", "udp", "audio" }) },
                     { "description", "sim: a simulated tool; trace: a recording; gesture: a hand that does not yield. A graph cannot choose real devices: "
                                      "hid, serial, udp and audio become a simulated tool at rest." } } },
                 { "guard", guard (quantities) } } },
             { "allOf", Json::array ({ driver ("sim", simulated (quantities), {}, quantities), driver ("trace", recorded, { "path" }, quantities),
                                       driver ("gesture", moved, { "path" }, quantities) }) } };
}

}   // namespace tactus::schema
