// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_audio.hpp"

#include <framework/run/device/guard_limits.hpp>

#include <algorithm>

namespace tactus::host::audio
{
namespace
{
constexpr double default_ramp = 0.2;   // s

/// The limit on signals may be given in the unit that all outputs are calibrated in. Then this replaces it with the plain number.
Json withoutUnit (Json guard, const AudioRole& role)
{
    if (! guard.is_object()) return guard;
    const auto limit = guard.find ("max_signal");
    if (limit == guard.end() || ! limit->is_string()) return guard;
    const auto measure = parseMeasure (limit->asString());
    const auto fits = [&] (const ChannelUse& use) { return use.full_scale.dimension == measure->dimension; };
    if (measure && ! role.outputs.empty() && std::ranges::all_of (role.outputs, fits)) *limit = measure->value;
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
