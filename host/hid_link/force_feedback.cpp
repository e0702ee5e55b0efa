// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/devices/fields.hpp>
#include <host/devices/problem.hpp>
#include <host/hid/report_descriptor.hpp>
#include <host/hid_link/force_feedback.hpp>

#include <framework/in_quotes.hpp>
#include <framework/number_text.hpp>
#include <framework/units.hpp>

#include <algorithm>
#include <utility>
#include <variant>

namespace tactus::host::hid
{
namespace
{
// Of a device that nobody has measured: weaker than what is asked for rather than stronger.
constexpr double assumed_force = 10.0;   // N
constexpr double assumed_travel = 0.1;   // m
constexpr double assumed_usable = 0.1;   // of the force that it has

PidCalibration assumed()
{
    return { .full_force = assumed_force, .usable = assumed_usable, .travel = { { "x", assumed_travel }, { "y", assumed_travel }, { "z", assumed_travel } } };
}

/// Says of a text with a unit whether it is a torque.
bool isTorque (const Json& json)
{
    if (! json.is_string()) return false;
    const auto read = parseMeasure (json.get<std::string>());
    const auto* measure = std::get_if<Measure> (&read);
    return measure != nullptr && measure->dimension == unit::torque.dimension;
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

    Fields in (*written, "/calibration", messages);
    PidCalibration c;
    in.require ("full_force", "write what it gives at the most: \"full_force\": \"4 N\", or \"2.5 N*m\" of a wheel");
    c.turns = in.has ("full_force") && isTorque (written->at ("full_force"));
    c.full_force = in.number ("full_force", c.turns ? unit::torque : unit::newton, Bounds::positive(), 1.0);
    in.ignore ("reversed");
    if (in.has ("reversed"))
    {
        const auto& reversed = written->at ("reversed");
        c.is_reversed = reversed.is_boolean() && reversed.get<bool>();
        if (! reversed.is_boolean()) in.error ("reversed", "device/kind", "expected true or false", "write true where it pushes to the left instead of to the right");
    }
    if (in.has ("travel"))
    {
        const auto& travel = in.object ("travel");
        Fields each (travel, "/calibration/travel", messages);
        if (travel.is_object())
            for (const auto& [axis, length] : travel.items())
                c.travel[axis] = each.number (axis, c.turns ? unit::radian : unit::metre, Bounds::positive(), 1.0);
    }
    in.finish();
    return c;
}

std::shared_ptr<const Profile> profileOf (HidSystem& system, const ConnectedDevice& device, const std::optional<PidCalibration>& told, Messages& messages)
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

    if (told)
        for (const auto& [axis, length] : told->travel)
            if (const auto names = pid->axisNames(); std::ranges::count (names, axis) == 0)
                messages.push_back (problem ("pid/no_axis", "/calibration/travel/" + axis, device.product + " has no axis " + inQuotes (axis), suggestion (axis, names)));
    if (hasErrors (messages)) return nullptr;

    if (! told)
    {
        auto m = problem ("pid/uncalibrated", "", device.product + " does not tell how strong it is: it is taken for a stick of " + numberText (100.0 * assumed_travel) + " cm and " + numberText (assumed_force) + " N, and gives at most " + numberText (100.0 * assumed_usable) + " % of what it can",
                          "measure it, and write \"calibration\": {\"full_force\": \"4 N\", \"travel\": {\"x\": \"12 cm\"}}");
        m.severity = Message::Severity::warning;
        messages.push_back (std::move (m));
    }

    auto profile = pid->profile (told.value_or (assumed()));
    MatchRule rule;
    rule.vid = { device.vid };
    rule.pid = { device.pid };
    if (device.interface_number >= 0) rule.interface_number = device.interface_number;
    profile.match.push_back (std::move (rule));
    return std::make_shared<const Profile> (std::move (profile));
}

}   // namespace tactus::host::hid
