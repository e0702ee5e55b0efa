// SPDX-License-Identifier: MIT
#include "open_audio.hpp"
#include <host/devices/sessions/check_audio.hpp>

#include <tactus/text/message.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::audio
{
namespace
{
/// The highest channel used by nodes of this type and role.
int highestChannel (const Plan& plan, const std::string& type, const std::string& role)
{
    int highest = 0;
    for (const auto& node : plan.flat().nodes)
    {
        if (node.type == nullptr || node.type->info.id != type || node.role != role) continue;
        for (const auto& setting : node.settings)
            if (const auto* channel = std::get_if<double> (&setting)) highest = std::max (highest, static_cast<int> (*channel));
    }
    return highest;
}

Json channelsUpTo (int highest)
{
    auto list = Json::array();
    for (int c = 1; c <= highest; ++c)
        list.push_back ({ { "channel", c } });
    return list;
}
}   // namespace

MadeDevice openAudio (const Json& description, AudioRig& rig)
{
    MadeDevice made;
    auto role = readAudioRole (description, made.messages);
    made.limits = readGuard (description, role, made.messages);
    if (role.outputs.empty() && role.inputs.empty() && ! hasErrors (made.messages))
        made.messages.push_back (Message::error ("audio/no_channels", "", "the role has neither outputs nor inputs",
                                                 "write \"outputs\": [{\"channel\": 1, \"full_scale\": \"4 N\"}]"));
    if (const auto card = description.value ("card", Json()); card.is_string())
        if (auto named = rig.nameCard (card.get<std::string>()); ! named) made.messages.push_back (std::move (named).error());
    if (hasErrors (made.messages)) return made;

    made.about = std::to_string (role.outputs.size()) + " outputs and " + std::to_string (role.inputs.size()) + " inputs of a sound card.";
    made.device = rig.open (std::move (role), made.messages);
    return made;
}

MadeDevice AudioRig::open (const Json& description, const std::string& role, const Plan& plan)
{
    return openAudio (withChannels (description, plan, role), *this);
}

Json withChannels (const Json& description, const Plan& plan, const std::string& role)
{
    auto full = description;
    if (full.contains ("outputs") || full.contains ("inputs")) return full;
    const int outputs = highestChannel (plan, "device.signal_out", role), inputs = highestChannel (plan, "device.signal_in", role);
    if (outputs > 0 || inputs == 0) full["outputs"] = channelsUpTo (std::max (outputs, 1));
    if (inputs > 0) full["inputs"] = channelsUpTo (inputs);
    return full;
}

}   // namespace tactus::host::audio
