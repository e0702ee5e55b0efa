// SPDX-License-Identifier: GPL-3.0-or-later
// How the devices panel changes the binding of a role, and what of it undo takes back.
#include "devices_panel.hpp"

#include <host/app/text/filled.hpp>
#include <host/devices/sessions/audio_settings.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace tactus::host
{

void DevicesPanel::bind (const std::string& role, const std::string& label)
{
    if (const auto* choice = choiceOf (role, label)) bindTo (role, BindingChoice (*choice));   // a copy, because the choices are rebuilt
}

void DevicesPanel::bindAddress (const std::string& role, const juce::String& address)
{
    refused_addresses.erase (role);
    const auto text = address.trim();
    if (text.isEmpty()) return;
    auto device = readAddress (text.toStdString(), setup.profiles());
    const auto wrong = device ? checkBinding (*device, setup.session().file.parent_path(), setup.profiles()) : Messages { device.error() };
    if (complain (wrong))
        refused_addresses[role] = text;
    else
        bindTo (role, { text.toStdString(), *std::move (device) });
}

/// Binds a role in a step that can be undone. Redo brings back the binding that undo has left, so a limit that was changed in between stays.
void DevicesPanel::bindTo (const std::string& role, const BindingChoice& choice)
{
    const auto profile = choice.numbers.empty() ? nullptr : hid::profileNamed (setup.profiles(), choice.numbers);
    const auto before = boundNow (role);
    edit ([role, to = choice.description, profile] (DeviceSession& s) {
        const auto* now = s.binding (role);
        if (to.is_null())
            s.unbind (role);
        else
            s.bind (role, rebound (now, profile ? simulationOf (*profile, now) : to));
    });
    if (boundNow (role) == before) return;
    const auto along = std::make_shared<std::function<void()>>();
    const auto exchange = [safe = SafePointer (this), role, along, other = std::make_shared<Json> (before)] {
        if (safe == nullptr) return;
        *other = safe->putDevice (role, *other);
        if (*along) (*along)();
    };
    document.addWindowStep (filled (TRANS ("device of %1"), role).toStdString(), exchange, exchange);
    if (onBind) *along = onBind (role);
}

/// Gives a role an earlier device; null: that of the graph. Returns the binding before. Its guard stays, unless one of the two is of another kind.
Json DevicesPanel::putDevice (const std::string& role, Json binding)
{
    const auto before = boundNow (role);
    edit ([&] (DeviceSession& s) {
        if (binding.is_null()) return s.unbind (role);
        const bool is_same_kind = before.is_object() && ! audio::isAudio (before) && ! audio::isAudio (binding);
        if (is_same_kind) binding.erase ("guard");
        s.bind (role, rebound (is_same_kind ? &before : nullptr, std::move (binding)));
    });
    return before;
}

void DevicesPanel::moveOrigin (const std::string& role, const Vec3& origin)
{
    const auto* before = bindingOf (role);
    if (before == nullptr) return;
    auto binding = *before;
    constexpr double steps_per_metre = 1e4;   // a drag is not finer
    Json offset = Json::array();
    for (const double metres : { origin.x(), origin.y(), origin.z() })
        offset.push_back (std::round (metres * steps_per_metre) / steps_per_metre);
    binding[JsonPointer ("/workspace/offset")] = offset;
    change (role, std::move (binding), TRANS ("offset"));
}

/// Changes a binding if it has no errors. A change of the workspace is a step that can be undone. That of a limit is not: undo takes back no limit.
void DevicesPanel::change (const std::string& role, Json binding, const juce::String& what)
{
    if (complain (checkBinding (binding, setup.session().file.parent_path(), setup.profiles()))) return;
    const auto workspaceIn = [] (const Json* b) { return b != nullptr ? b->value ("workspace", Json()) : Json(); };
    const auto before = workspaceIn (bindingOf (role));
    edit ([&] (DeviceSession& s) { s.bind (role, binding); });
    const auto after = workspaceIn (bindingOf (role));
    if (after == before) return;
    const auto to = [&, safe = SafePointer (this)] (const Json& workspace) {
        return [safe, role, workspace] {
            if (safe != nullptr) safe->putWorkspace (role, workspace);
        };
    };
    document.addWindowStep (filled (TRANS ("%1 of %2"), what, role).toStdString(), to (before), to (after));
}

/// Gives a role an earlier workspace; null: none. What else is set for the role stays, and a role that is no longer bound, too.
void DevicesPanel::putWorkspace (const std::string& role, const Json& workspace)
{
    edit ([&] (DeviceSession& s) {
        const auto* now = s.binding (role);
        if (now == nullptr) return;
        auto binding = *now;
        if (workspace.is_null())
            binding.erase ("workspace");
        else
            binding["workspace"] = workspace;
        s.bind (role, std::move (binding));
    });
}

}   // namespace tactus::host
