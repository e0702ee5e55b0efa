// SPDX-License-Identifier: GPL-3.0-or-later
// What the cards of the devices panel say about fit and status.
#include "devices_panel.hpp"
#include "sound_text.hpp"

#include <host/app/look/text.hpp>
#include <host/audio/audio_rig.hpp>
#include <host/hid/physics.hpp>
#include <host/sessions/numbers_device.hpp>

#include <algorithm>

namespace tactus::host
{

/// What the role needs, and what its device lacks.
Remark DevicesPanel::fitRemark (const std::string& role) const
{
    const auto* fit = fitOf (role);
    if (fit == nullptr) return {};
    Remark r { fromUtf8 ("Needs " + describe (fit->needs) + "."), false };
    const auto addProblem = [&] (const std::string& what) {
        r.text << "\n"
               << fromUtf8 (what);
        r.is_problem = true;
    };
    for (const auto& m : fit->messages)
        addProblem (m.text);
    if (! fit->lacking.empty()) addProblem ("The device does not fit:");
    for (const auto& l : fit->lacking)
        addProblem (l);
    if (const auto* choice = choiceNow (role); choice != nullptr && ! choice->numbers.empty())
        if (const auto profile = hid::profileNamed (setup.profiles(), choice->numbers))
        {
            r.text << fromUtf8 ("\nOnly simulated: Tactus has no driver for " + profile->name + ", but knows its numbers.");
            if (const auto guesses = guessesOf (hid::numbersOf (*profile)); ! guesses.empty()) r.text << fromUtf8 ("\nGuessed: " + guesses + ".");
        }
    if (fit->from == RoleFit::From::graph) r.text << fromUtf8 ("\nThe device described in the graph is used: " + nameOf (fit->description) + ".");
    if (fit->from == RoleFit::From::none) r.text << "\nNo device is set. A simulated tool at rest is used.";
    return r;
}

/// Says whether the device of a role is connected and works, and whether its guard has stopped it.
Remark DevicesPanel::statusRemark (const std::string& role) const
{
    Remark r;
    const auto* fit = fitOf (role);
    const auto health = std::ranges::find (run.health(), role, &DeviceHealth::role);
    if (health != run.health().end())
    {
        r.text = fromUtf8 (describe (*health));
        r.is_problem = ! health->connected;
    }
    else if (fit != nullptr && fit->connected && ! run.isRunning())
        r = *fit->connected ? Remark { "Connected.", false } : Remark { "Not connected. A run waits for the device and applies no force until then.", true };
    const auto status = run.status();
    if (! status || ! run.isRunning()) return r;
    for (const auto& now : status->shown())
        if (now.name == role && now.stop != Guard::Stop::none)
        {
            r.text << (r.text.isEmpty() ? "" : "\n") << "Stopped by its guard: " << fromUtf8 (describe (now.latestEvent())) << ".";
            r.is_problem = true;
        }
    return r;
}

Remark DevicesPanel::clockRemark() const
{
    const auto status = run.status();
    if (! status || ! run.isRunning()) return { "Not running.", false };
    const auto wanted = setup.session().session.clock();
    const auto& role = run.clockRole();
    const bool by_card = wanted == "audio" && run.audioStatus();
    if (status->clock_replaced && (by_card || ! role.empty()))
    {
        const auto why = by_card ? juce::String ("The sound card has stalled") : fromUtf8 (role) + " is disconnected";
        return { why + ": a timer ticks instead, and all forces are held at zero.", true };
    }
    const auto rate = ", at " + juce::String (run.rate()) + " Hz";
    if (by_card) return { "Ticked by the sound card" + rate + ".", false };
    if (! role.empty()) return { "Ticked by " + fromUtf8 (role) + rate + ".", false };
    if (wanted.empty() || wanted == "timer") return { "Ticked by a timer" + rate + ".", false };
    const auto why = fitOf (wanted) == nullptr ? "this graph has no role " + fromUtf8 (wanted)
                                               : "the device of " + fromUtf8 (wanted) + " cannot tick the run at the moment";
    return { "Ticked by a timer" + rate + ": " + why + ".", false };
}

Remark DevicesPanel::soundRemark() const
{
    const auto now = run.isRunning() ? run.audioStatus() : std::nullopt;
    if (! now) return { routes().empty() ? "No routes. Add one, such as mix.out=1@4 N." : "Not running.", false };
    if (now->card.type.empty()) return { now->trouble.empty() ? "No sound card." : fromUtf8 (now->trouble), true };
    const auto sound = fromUtf8 (audio::statusOf (*now)).trim();
    if (! now->is_open) return { sound + (now->trouble.empty() ? juce::String() : ": " + fromUtf8 (now->trouble)), true };
    const auto& card = now->card;
    const auto format = juce::String (card.rate_hz) + " Hz, blocks of " + juce::String (card.block);
    return { fromUtf8 (card.type + ": " + card.name + ", ") + format + "\n" + sound, now->clipped > 0 };
}

}   // namespace tactus::host
