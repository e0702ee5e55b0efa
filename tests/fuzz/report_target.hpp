// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/bits.hpp>
#include <host/devices/hid/hid_model.hpp>

#include <cstdlib>
#include <cstring>
#include <string_view>

namespace tactus::fuzz
{

/// Decodes the bytes as a report. Either the values are finite, or the report is refused and changes nothing. Also encodes the
/// bytes as efforts, which must give reports of the right length. Aborts otherwise.
inline void tryReport (std::shared_ptr<const host::hid::Profile> profile, std::string_view data)
{
    using namespace host::hid;
    HidModel model (std::move (profile));
    const std::span bytes (reinterpret_cast<const std::uint8_t*> (data.data()), data.size());

    // Tries the data as one report, and split into reports of every length in the profile, with ids prepended.
    const auto decode = [&] (std::span<const std::uint8_t> report) {
        const auto before = model.sample();
        const auto& after = model.decode (report);
        if (! isFinite (after.position, after.rotation) || ! isFinite (after.pressure, after.time)) std::abort();
        for (const double value : after.axes)
            if (! isFinite (value)) std::abort();
        const bool changed = after.position != before.position || after.axes != before.axes || after.buttons != before.buttons || after.time != before.time;
        if (after.refusal != Refusal::none && changed) std::abort();
    };
    decode (bytes);
    for (const auto& input : model.profile().inputs)
        for (std::size_t at = 0; at + input.length <= bytes.size() && at < 64 * input.length; at += input.length)
        {
            Bytes report (bytes.begin() + static_cast<std::ptrdiff_t> (at), bytes.begin() + static_cast<std::ptrdiff_t> (at + input.length));
            if (input.id) report[0] = *input.id;
            for (const auto& field : input.fields)
                if (field.expect) putBits (field.bits, static_cast<std::uint32_t> (static_cast<std::int64_t> (*field.expect)), report);
            decode (report);
        }

    HidEffort effort;
    std::vector<float> samples (data.size() / sizeof (float));
    if (! samples.empty()) std::memcpy (samples.data(), data.data(), samples.size() * sizeof (float));
    const auto take = [&] (double& value) {
        if (data.size() < sizeof value) return;
        std::memcpy (&value, data.data(), sizeof value);
        data.remove_prefix (sizeof value);
    };
    for (int i = 0; i < 3; ++i)
    {
        take (effort.force[i]);
        take (effort.torque[i]);
    }
    for (auto& value : effort.efforts)
        take (value);
    for (std::size_t i = 0; i <= model.outputs(); ++i)
    {
        std::size_t length = 0;
        if (i < model.outputs()) length = model.profile().outputs[i].body.size() + (model.profile().outputs[i].id ? 0u : 1u);
        if (model.encode (i, effort, samples).size() != length || model.neutral (i).size() != length) std::abort();
    }
}

}   // namespace tactus::fuzz
