// SPDX-License-Identifier: MIT
#include "check_audio.hpp"

#include <tactus/run/device/guard_limits.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::audio
{
namespace
{
constexpr double default_ramp = 0.2;   // s

/// The limits on signals may be given in the unit that all outputs are calibrated in, such as N, and N/s for the slew. Then this
/// replaces them with plain numbers.
Json withoutUnit (Json guard, const AudioRole& role)
{
    if (! guard.is_object() || role.outputs.empty()) return guard;
    constexpr std::pair<const char*, Dimension> keys[] { { "max_signal", {} }, { "max_signal_slew", { 0, 0, -1 } } };
    for (const auto& [key, per] : keys)
    {
        const auto limit = guard.find (key);
        if (limit == guard.end() || ! limit->is_string()) continue;
        const auto measure = parseMeasure (limit->asString());
        const auto fits = [&, per = per] (const ChannelUse& use) { return use.full_scale.dimension && *use.full_scale.dimension * per == measure->dimension; };
        if (measure && std::ranges::all_of (role.outputs, fits)) *limit = measure->value;
    }
    return guard;
}
}   // namespace

GuardLimits readGuard (const Json& description, const AudioRole& role, Messages& messages)
{
    const auto guard = description.find ("guard");
    const DeviceLayout layout { .signal_inputs = static_cast<int> (role.inputs.size()), .signal_outputs = static_cast<int> (role.outputs.size()) };
    auto limits = guard == description.end() ? GuardLimits {} : readGuardLimits (withoutUnit (*guard, role), "/guard", messages, layout);
    if (limits.ramp == 0.0) limits.ramp = default_ramp;
    return limits;
}

Messages checkAudio (const Json& description)
{
    Messages messages;
    readGuard (description, readAudioRole (description, messages), messages);
    return messages;
}

}   // namespace tactus::host::audio
