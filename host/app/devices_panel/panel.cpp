// SPDX-License-Identifier: GPL-3.0-or-later
// The devices in the window.
#include "devices_panel.hpp"
#include "reach.hpp"
#include "session_change.hpp"

#include <host/app/desk/panel.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

Panel devicesPanel (Desk& desk)
{
    auto made = std::make_unique<DevicesPanel> (desk.document, desk.playback.run(), desk.devices);
    auto* devices = made.get();
    auto& bindings = devices->bindings();
    bindings.onHint = [&desk] (const juce::String& text) { desk.hint (text); };
    devices->onTry = [&desk] (const std::string& role) { return desk.playback.tryDevice (role); };
    bindings.onBind = [&desk] (const std::string& role) -> std::function<void()> {
        if (! desk.playback.run().isMovedOtherwise (role)) return {};
        auto exchange = desk.useDevice();
        desk.notify (filled (TRANS ("The device of %1 moves its tool from now on. Press and drag on the surface of the hand, and the mouse does."), role));
        return exchange;
    };
    desk.devices.onChangedElsewhere = [&desk] (const DeviceSession& before) {
        const bool has_stopped = desk.playback.sessionChanged();
        const auto what = changeText (before, desk.devices.session().session);
        desk.refuse (filled (has_stopped ? TRANS ("Another program has changed your devices: %1. The run has stopped, and START uses them.")
                                         : TRANS ("Another program has changed your devices: %1."),
                             what));
    };
    desk.moveOrigin = [&bindings] (const std::string& role, const Vec3& origin) { bindings.moveOrigin (role, origin); };
    desk.reaches = [&desk, of_devices = Reaches (desk.devices)]() mutable {
        return desk.playback.isPreviewing() ? std::vector<scene::Reach>() : of_devices.of (desk.playback.run());
    };
    const auto actions = [&bindings] {
        std::vector<Panel::Action> all;
        for (const auto& [role, labels] : bindings.choices())
            for (const auto& label : labels)
                all.push_back ({ filled (TRANS ("Device of %1: %2"), role, label), TRANS ("The device for this role, in every graph"),
                                 [&bindings, of = role, to = label] { bindings.bind (of, to); } });
        return all;
    };
    return { .name = TRANS ("Devices"), .component = std::move (made), .actions = actions, .refresh = [devices] { devices->refresh(); } };
}

}   // namespace tactus::host
