// SPDX-License-Identifier: GPL-3.0-or-later
#include "remarks.hpp"
#include "sound_text.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/devices/audio/audio_rig.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/sessions/numbers_device.hpp>

#include <algorithm>

namespace tactus::host
{

Remark DeviceRemarks::fit (const std::string& role) const
{
    const auto* fits = bindings.fitOf (role);
    if (fits == nullptr) return {};
    Remark r { filled (TRANS ("Needs %1."), fromUtf8 (describe (fits->needs))), false };
    const auto addLine = [&] (const juce::String& what) { r.text << "\n" + what; };
    const auto addProblem = [&] (const juce::String& what) {
        addLine (what);
        r.is_problem = true;
    };
    for (const auto& m : fits->messages)
        addProblem (fromUtf8 (m.text));
    if (! fits->lacking.empty()) addProblem (TRANS ("The device does not fit:"));
    for (const auto& l : fits->lacking)
        addProblem (fromUtf8 (l));
    if (const auto* choice = bindings.choiceNow (role); choice != nullptr && ! choice->numbers.empty())
        if (const auto profile = hid::profileNamed (setup.profiles(), choice->numbers))
        {
            addLine (filled (TRANS ("Only simulated, with the numbers of %1."), profile->name));
            if (const auto guesses = guessesOf (hid::numbersOf (*profile)); ! guesses.empty()) addLine (filled (TRANS ("Guessed: %1."), guesses));
        }
    if (run.isMovedOtherwise (role))
    {
        addLine (run.hand() == LiveRun::Hand::pointer() ? TRANS ("Not in use: the mouse or pen moves this tool.")
                                                        : TRANS ("Not in use: a gesture or a recording moves this tool."));
        addLine (TRANS ("To use this device, choose one here, or Its own device in the panel Hand."));
        return r;
    }
    if (fits->from == RoleFit::From::graph) addLine (filled (TRANS ("The device described in the graph is used: %1."), fromUtf8 (nameOf (fits->description))));
    if (fits->from == RoleFit::From::none) addLine (TRANS ("No device is set. A simulated tool at rest is used."));
    return r;
}

Remark DeviceRemarks::status (const std::string& role) const
{
    Remark r;
    const auto* fits = bindings.fitOf (role);
    const auto health = std::ranges::find (run.health(), role, &DeviceHealth::role);
    if (health != run.health().end())
    {
        r.text = fromUtf8 (describe (*health));
        r.is_problem = ! health->connected;
    }
    else if (fits != nullptr && fits->connected && ! run.isRunning())
        r = *fits->connected ? Remark { TRANS ("Connected."), false }
                             : Remark { TRANS ("Not connected. A run waits for the device and applies no force until then."), true };
    else if (fits != nullptr && ! run.isRunning() && fits->description.value ("driver", Json()) == Json (event_driver))
        r = ofEvents (fits->description);
    const auto status = run.status();
    if (! status || ! run.isRunning()) return r;
    for (const auto& now : status->shown())
        if (now.name == role && now.stop != Guard::Stop::none)
        {
            r.text << (r.text.isEmpty() ? "" : "\n") << filled (TRANS ("Stopped by its guard: %1."), fromUtf8 (describe (now.latestEvent())));
            r.is_problem = true;
        }
    return r;
}

/// The remark about whether an event device is there, and may be opened. The driver finds it by its path, its name, or a part of that.
Remark DeviceRemarks::ofEvents (const Json& description) const
{
    const auto named = description.value ("port", Json());
    const auto port = named.is_string() ? named.asString() : std::string();
    const auto events = setup.events();
    const auto isMeant = [&] (const ConnectedEvents& e) { return e.path == port || e.name.find (port) != std::string::npos; };
    const auto at = std::ranges::find_if (events, isMeant);
    if (port.empty() || at == events.end()) return { TRANS ("Not connected. The graph does not start without it."), true };
    if (! at->trouble.empty()) return { filled (TRANS ("This user may not open it: %1."), at->trouble), true };
    return { TRANS ("Connected. While it runs, this line says how many new forces per second reach it."), false };
}

Remark DeviceRemarks::clock() const
{
    auto r = tick();
    if (run.isRunning() && run.drivesDevice())
        for (const auto& refusal : run.refusals())
        {
            r.text << "\n" + fromUtf8 (refusal);
            r.is_problem = true;
        }
    return r;
}

Remark DeviceRemarks::tick() const
{
    const auto status = run.status();
    if (! status || ! run.isRunning()) return { TRANS ("Not running."), false };
    const auto wanted = setup.session().session.clock();
    const auto& role = run.clockRole();
    const bool by_card = wanted == "audio" && run.audioStatus();
    if (status->clock_replaced && (by_card || ! role.empty()))
    {
        const auto by_timer = by_card ? TRANS ("The sound card has stalled: a timer ticks instead, and all forces are held at zero.")
                                      : TRANS ("%1 is disconnected: a timer ticks instead, and all forces are held at zero.");
        return { filled (by_timer, role), true };
    }
    const juce::String rate (run.rate());
    if (by_card) return { filled (TRANS ("Ticked by the sound card, at %1 Hz."), rate), false };
    if (! role.empty()) return { filled (TRANS ("Ticked by %1, at %2 Hz."), role, rate), false };
    if (wanted.empty() || wanted == "timer") return { filled (TRANS ("Ticked by a timer, at %1 Hz."), rate), false };
    if (wanted == "audio") return { filled (TRANS ("Ticked by a timer, at %1 Hz: the sound card is missing."), rate), true };
    const auto why = bindings.fitOf (wanted) == nullptr ? TRANS ("Ticked by a timer, at %1 Hz: this graph has no role %2.")
                                                        : TRANS ("Ticked by a timer, at %1 Hz: the device of %2 cannot tick the run at the moment.");
    return { filled (why, rate, wanted), false };
}

Remark DeviceRemarks::sound() const
{
    const auto now = run.isRunning() ? run.audioStatus() : std::nullopt;
    if (! now) return { bindings.routes().empty() ? TRANS ("No routes. Add one, such as mix.out=1@4 N.") : TRANS ("Not running."), false };
    if (now->card.type.empty()) return { now->trouble.empty() ? TRANS ("No sound card.") : fromUtf8 (now->trouble), true };
    const auto sound = fromUtf8 (audio::statusOf (*now)).trim();
    if (! now->is_open) return { sound + (now->trouble.empty() ? juce::String() : ": " + fromUtf8 (now->trouble)), true };
    const auto& card = now->card;
    const auto format = filled (TRANS ("%1 Hz, blocks of %2"), juce::String (card.rate_hz), card.block);
    return { fromUtf8 (card.type + ": " + card.name + ", ") + format + "\n" + sound, now->clipped > 0 };
}

}   // namespace tactus::host
