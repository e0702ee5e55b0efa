// SPDX-License-Identifier: MIT
#pragma once

#include "report_target.hpp"

#include <host/devices/hid/answer.hpp>
#include <host/devices/hid/pid_device.hpp>

namespace tactus::fuzz
{

/// Parses the bytes as a report descriptor. Either its fields do not overlap, or parsing reports errors, each with its location.
/// If the bytes describe a force feedback device, its profile accepts any report. Aborts otherwise.
inline void tryDescriptor (std::string_view data)
{
    using namespace host::hid;
    const auto read = readDescriptor ({ reinterpret_cast<const std::uint8_t*> (data.data()), data.size() });
    for (const auto& m : read.messages)
        if (m.id.empty() || m.where.empty() || m.text.empty() || m.remedy.empty()) std::abort();

    const auto& d = read.descriptor;
    for (const auto& f : d.fields)
    {
        if (f.size == 0 || f.count == 0 || f.collection >= static_cast<int> (d.collections.size())) std::abort();
        if (8 * d.length (f.kind, f.report) < f.bit + f.size * f.count) std::abort();
    }
    for (std::size_t i = 0; i < d.collections.size(); ++i)
        if (d.collections[i].parent >= static_cast<int> (i)) std::abort();
    if (hasErrors (read.messages)) return;

    Messages messages;
    const auto device = PidDevice::from (d, messages);
    if (device.has_value() == hasErrors (messages)) std::abort();
    if (! device) return;
    const auto answer = device->blockLoad();
    if (device->createEffect().empty() || answer.empty()) std::abort();
    const std::span bytes (reinterpret_cast<const std::uint8_t*> (data.data()), std::min (data.size(), answer.size()));
    const auto number = numberIn (device->answer(), bytes);
    if (! number && number.error().remedy.empty()) std::abort();

    const PidCalibration calibration { .full_force = 3.0, .turns = data.size() % 2 == 0, .travel = { { "x", 0.1 }, { "steering", 8.0 } } };
    tryReport (std::make_shared<const Profile> (device->profile (calibration)), data);
}

}   // namespace tactus::fuzz
