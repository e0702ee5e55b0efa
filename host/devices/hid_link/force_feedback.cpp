// SPDX-License-Identifier: MIT
#include "force_feedback.hpp"
#include <host/devices/hid/open_ffboard.hpp>
#include <host/devices/hid/report_descriptor.hpp>
#include <tactus/text/message.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{
bool hasForceFeedback (HidSystem& system, const ConnectedDevice& device)
{
    const auto read = readDescriptor (system.reportDescriptor (device));
    return ! hasErrors (read.messages) && PidDevice::isMeantBy (read.descriptor);
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

    const auto used = calibrationOf (device.product, pid->axisNames(), calibration, messages);
    if (used.full_force_y > 0.0 && ! pid->hasForceAlongY())
        messages.push_back (Message::error ("pid/no_axis", "/calibration/full_force_y", device.product + " has no force along y", "leave full_force_y out"));
    if (hasErrors (messages)) return nullptr;
    auto profile = pid->profile (used);
    if (isOpenFFBoard (device.vid, device.pid)) addOpenFFBoard (profile, read.descriptor, pid->hasForceAlongY());
    MatchRule rule;
    rule.vid = { device.vid };
    rule.pid = { device.pid };
    if (device.interface_number >= 0) rule.interface_number = device.interface_number;
    profile.match.push_back (std::move (rule));
    return std::make_shared<const Profile> (std::move (profile));
}

}   // namespace tactus::host::hid
