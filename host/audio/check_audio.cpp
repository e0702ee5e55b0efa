// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_audio.hpp"

#include <host/devices/guard_limits.hpp>

namespace tactus::host::audio
{
namespace
{
constexpr double usual_ramp = 0.2;   // s
}

GuardLimits readGuard (const Json& description, const AudioRole& role, Messages& messages)
{
    const auto guard = description.find ("guard");
    const DeviceLayout layout { .signal_inputs = static_cast<int> (role.inputs.size()), .signal_outputs = static_cast<int> (role.outputs.size()) };
    auto limits = guard == description.end() ? GuardLimits {} : readGuardLimits (*guard, "/guard", messages, layout);
    if (limits.ramp == 0.0) limits.ramp = usual_ramp;
    return limits;
}

Messages checkAudio (const Json& description)
{
    Messages messages;
    readGuard (description, readAudioRole (description, messages), messages);
    return messages;
}

}   // namespace tactus::host::audio
