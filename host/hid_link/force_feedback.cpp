// SPDX-License-Identifier: MIT
#include "force_feedback.hpp"
#include <host/hid/report_descriptor.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/object_reader.hpp>

#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{
namespace
{
// Assumptions about an uncalibrated device. The force may turn out weaker than requested, but not stronger.
constexpr double assumed_force = 10.0;   // N
constexpr double assumed_travel = 0.1;   // m
constexpr double assumed_turn = 15.7;    // rad, 900 degrees
constexpr double assumed_usable = 0.1;   // fraction of the full force

PidCalibration assumed()
{
    return { .full_force = assumed_force, .usable = assumed_usable, .travel = { { "x", assumed_travel }, { "y", assumed_travel }, { "z", assumed_travel } } };
}

/// Gives the driven axis a travel if the calibration has none: without it, neither speed nor energy could be limited.
void assumeTravel (PidCalibration& c, const std::vector<std::string>& axes, const std::string& product, Messages& messages)
{
    const auto has = [&] (std::string_view axis) { return std::ranges::count (axes, axis) > 0; };
    const std::string driven = c.turns && has ("steering") && ! c.travel.contains ("x") ? "steering" : "x";
    if (! has (driven) || c.travel.contains (driven) || c.travel.contains (drivenAxis (c))) return;
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

bool hasForceFeedback (HidSystem& system, const ConnectedDevice& device)
{
    const auto read = readDescriptor (system.reportDescriptor (device));
    return ! hasErrors (read.messages) && PidDevice::isMeantBy (read.descriptor);
}

std::optional<PidCalibration> readCalibration (const Json& description, Messages& messages)
{
    const auto written = description.find ("calibration");
    if (written == description.end()) return {};

    ObjectReader in (*written, "/calibration", messages);
    PidCalibration c;
    in.require ("full_force", "write the device's largest force: \"full_force\": \"4 N\", or \"2.5 N*m\" for a wheel");
    c.turns = in.has ("full_force") && isTorque (written->at ("full_force"));
    c.full_force = in.number ("full_force", c.turns ? unit::torque : unit::newton, Bounds::positive(), 1.0);
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

std::shared_ptr<const Profile> profileOf (HidSystem& system, const ConnectedDevice& device, const std::optional<PidCalibration>& calibration,
                                          Messages& messages)
{
    const auto begin = messages.size();
    auto read = readDescriptor (system.reportDescriptor (device));
    std::ranges::move (read.messages, std::back_inserter (messages));
    const auto pid = hasErrors (messages) ? std::nullopt : PidDevice::from (read.descriptor, messages);
    for (auto i = begin; i < messages.size(); ++i)
    {
        messages[i].text = device.path + " (" + device.product + "), " + messages[i].where + ": " + messages[i].text;
        messages[i].where.clear();
    }
    if (! pid) return nullptr;

    if (calibration)
        for (const auto& [axis, length] : calibration->travel)
            if (const auto names = pid->axisNames(); std::ranges::count (names, axis) == 0)
                messages.push_back (
                    Message::error ("pid/no_axis", "/calibration/travel/" + axis, device.product + " has no axis " + quote (axis), suggestion (axis, names)));
    if (hasErrors (messages)) return nullptr;

    if (! calibration)
    {
        messages.push_back (Message::warning ("pid/uncalibrated", "",
                                              device.product + " does not report its strength, so it is treated as a stick with "
                                                  + numberText (100.0 * assumed_travel) + " cm of travel and " + numberText (assumed_force)
                                                  + " N of force, of which at most "
                                                  + numberText (100.0 * assumed_usable) + " % is used",
                                              "measure its force and travel, and write "
                                              "\"calibration\": {\"full_force\": \"4 N\", \"travel\": {\"x\": \"12 cm\"}}"));
    }

    auto used = calibration.value_or (assumed());
    assumeTravel (used, pid->axisNames(), device.product, messages);
    auto profile = pid->profile (used);
    MatchRule rule;
    rule.vid = { device.vid };
    rule.pid = { device.pid };
    if (device.interface_number >= 0) rule.interface_number = device.interface_number;
    profile.match.push_back (std::move (rule));
    return std::make_shared<const Profile> (std::move (profile));
}

}   // namespace tactus::host::hid
