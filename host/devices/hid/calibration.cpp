// SPDX-License-Identifier: MIT
#include "calibration.hpp"

#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <string_view>

namespace tactus::host::hid
{
namespace
{
// Assumptions about an uncalibrated device. The force may turn out weaker than requested, but not stronger.
constexpr double assumed_force = 10.0;   // N
constexpr double assumed_travel = 0.1;   // m
constexpr double assumed_turn = 15.7;    // rad, 900 degrees
constexpr double assumed_usable = 0.1;   // fraction of the full force

// The limits of a calibrated device. They are guesses: no device was measured.
constexpr double slew_per_s = 250.0;                          // from 0 to full effort in 4 ms, so a stop stays within the guard's fade
constexpr double max_speed = 2.0, max_angular_speed = 20.0;   // m/s, rad/s
constexpr double longest_push = 0.1, longest_turn = 1.0;      // m, rad
constexpr double energy_window = 1.0;                         // s
constexpr double still_share = 0.25;                          // of the full effort
constexpr double still_for = 1.0, still_for_coarse = 5.0;     // s
constexpr double fine_quantum = 10e-6, fine_turn = 100e-6;    // m, rad: a hand that holds against a force trembles by more

PidCalibration assumed()
{
    return { .full_force = assumed_force, .usable = assumed_usable, .travel = { { "x", assumed_travel }, { "y", assumed_travel }, { "z", assumed_travel } } };
}

/// Gives a driven axis a travel if the calibration has none: without it, neither speed nor energy could be limited.
void assumeTravel (PidCalibration& c, const std::string& driven, const std::string& product, Messages& messages)
{
    const double travel = c.turns ? assumed_turn : assumed_travel;
    const std::string example = "\"" + driven + "\": \"" + (c.turns ? "900 deg" : "12 cm") + '"';
    c.travel[driven] = travel;
    messages.push_back (Message::warning ("pid/no_travel", "/calibration",
                                          "the calibration of " + product + " has no travel of the axis " + quote (driven) + ", so it is taken to be "
                                              + numberText (travel) + (c.turns ? " rad" : " m"),
                                          "measure it from end to end, and write \"travel\": {" + example + "}"));
}

/// True for a string with a unit of torque.
bool isTorque (const Json& json)
{
    if (! json.is_string()) return false;
    const auto measure = parseMeasure (json.get<std::string>());
    return measure && measure->dimension == unit::torque.dimension;
}
}   // namespace

std::string drivenAxis (const PidCalibration& c) { return c.turns && c.travel.contains ("steering") ? "steering" : "x"; }

std::optional<PidCalibration> readCalibration (const Json& description, Messages& messages, bool needs_force)
{
    const auto written = description.find ("calibration");
    if (written == description.end()) return {};

    ObjectReader in (*written, "/calibration", messages);
    PidCalibration c;
    if (needs_force) in.require ("full_force", "write the device's largest force: \"full_force\": \"4 N\", or \"2.5 N*m\" for a wheel");
    c.turns = in.has ("full_force") && isTorque (written->at ("full_force"));
    c.full_force = in.number ("full_force", c.turns ? unit::torque : unit::newton, Bounds::positive(), needs_force ? 1.0 : 0.0);
    if (needs_force && in.has ("full_force_y"))
    {
        c.full_force_y = in.number ("full_force_y", unit::newton, Bounds::positive(), 1.0);
        if (c.turns) in.error ("full_force_y", "device/kind", "a wheel is driven about one axis", "leave it out, or write both forces in N");
    }
    in.ignore ("reversed");
    if (in.has ("reversed"))
    {
        const auto& reversed = written->at ("reversed");
        c.is_reversed = reversed.is_boolean() && reversed.get<bool>();
        if (! reversed.is_boolean()) in.error ("reversed", "device/kind", "expected true or false", "write true if the device pushes left instead of right");
    }
    if (in.has ("travel"))
    {
        const auto& travel = in.object ("travel");
        ObjectReader each (travel, "/calibration/travel", messages);
        if (travel.is_object())
            for (const auto& [axis, length] : travel.items())
                c.travel[axis] = each.number (axis, c.turns ? unit::radian : unit::metre, Bounds::positive(), 1.0);
    }
    in.finish();
    return c;
}

PidCalibration calibrationOf (const std::string& product, const std::vector<std::string>& axes, const std::optional<PidCalibration>& calibration,
                              Messages& messages)
{
    if (calibration)
        for (const auto& [axis, length] : calibration->travel)
            if (std::ranges::count (axes, axis) == 0)
                messages.push_back (
                    Message::error ("pid/no_axis", "/calibration/travel/" + axis, product + " has no axis " + quote (axis), suggestion (axis, axes)));
    if (hasErrors (messages)) return {};

    if (! calibration)
    {
        messages.push_back (Message::warning ("pid/uncalibrated", "",
                                              product + " does not report its strength, so it is treated as a stick with "
                                                  + numberText (100.0 * assumed_travel) + " cm of travel and " + numberText (assumed_force)
                                                  + " N of force, of which at most " + numberText (100.0 * assumed_usable) + " % is used",
                                              "measure its force and travel, and write "
                                              "\"calibration\": {\"full_force\": \"4 N\", \"travel\": {\"x\": \"12 cm\"}}"));
    }
    auto used = calibration.value_or (assumed());
    const auto lacksTravel = [&] (const std::string& axis) { return std::ranges::count (axes, axis) > 0 && ! used.travel.contains (axis); };
    const std::string driven = used.turns && std::ranges::count (axes, "steering") > 0 && ! used.travel.contains ("x") ? "steering" : "x";
    if (lacksTravel (driven) && ! used.travel.contains (drivenAxis (used))) assumeTravel (used, driven, product, messages);
    if (used.full_force_y > 0.0 && lacksTravel ("y")) assumeTravel (used, "y", product, messages);
    return used;
}

void limitForce (GuardLimits& g, const PidCalibration& c, double travel, double quantum)
{
    const double most = c.full_force * c.usable;
    (c.turns ? g.max_torque : g.max_force) = most;
    (c.turns ? g.max_torque_slew : g.max_slew) = slewOf (most);
    if (travel <= 0.0) return;
    (c.turns ? g.max_angular_speed : g.max_speed) = c.turns ? max_angular_speed : max_speed;
    g.max_energy = most * std::min (0.5 * travel, c.turns ? longest_turn : longest_push);
    g.energy_window = energy_window;
    limitStill (g, c, quantum);
}

void limitStill (GuardLimits& g, const PidCalibration& c, double quantum)
{
    (c.turns ? g.still_torque : g.still_force) = still_share * c.full_force * c.usable;
    g.max_still = quantum <= (c.turns ? fine_turn : fine_quantum) ? still_for : still_for_coarse;
}

double slewOf (double effort) { return slew_per_s * effort; }

}   // namespace tactus::host::hid
