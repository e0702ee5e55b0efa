// SPDX-License-Identifier: GPL-3.0-or-later
// How the devices panel changes the binding of a role, and what of it undo takes back.
#include "devices_panel.hpp"

#include <host/app/text/filled.hpp>

#include <cmath>
#include <utility>

namespace tactus::host
{

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

/// Changes a binding if it has no errors. A change of the workspace is a step that can be undone. Nothing else in the panel is: undo takes back no limit
/// and no device that you have chosen.
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
