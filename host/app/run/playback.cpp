// SPDX-License-Identifier: GPL-3.0-or-later
#include "playback.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

Playback::Playback (Document& document, const Catalogue& c, Sound& sound, DeviceSetup& setup, std::function<void()> b)
    : catalogue (c), before_run (std::move (b)), live_run (document, c, &sound), devices (setup)
{
    live_run.obey (stop_switch);
    live_run.use (setup);
    setup.onChange = [this] { live_run.setupChanged(); };
}

void Playback::start (LiveRun::Hand hand)
{
    before_run();
    live_run.start (std::move (hand));
}

void Playback::startOther (LiveRun::Hand hand)
{
    before_run();
    live_run.startOther (std::move (hand));
}

void Playback::moveBy (LiveRun::Hand hand)
{
    before_run();
    live_run.moveBy (std::move (hand));
}

void Playback::changeHand (LiveRun::Hand hand)
{
    before_run();
    live_run.changeHand (std::move (hand));
}

void Playback::moveTool (std::string role)
{
    before_run();
    live_run.moveTool (std::move (role));
}

void Playback::stop (By who) noexcept
{
    resumes = false;
    current().stop (who);
}

bool Playback::sessionChanged() noexcept
{
    const bool stops = (live_run.isWanted() || resumes) && live_run.wouldGetOtherDevices();
    if (stops) stop();
    return stops;
}

void Playback::emergencyStop (By who) noexcept
{
    resumes = false;
    live_run.emergencyStop (who);   // also if it does not run: a preview ends, and then only START or REARM lets it have forces
    if (preview_run) preview_run->emergencyStop (who);
}

void Playback::preview (graph::Graph g) { runInstead (std::move (g), false); }

void Playback::runInstead (graph::Graph g, bool on_devices)
{
    endPreview();
    resumes = live_run.isWanted() && ! live_run.isStoppedForGood();
    live_run.letGo();
    preview_document = std::make_unique<Document> (std::move (g));
    preview_run = std::make_unique<LiveRun> (*preview_document, catalogue);
    preview_run->obey (stop_switch);
    if (on_devices) preview_run->use (devices);
    before_run();
    if (on_devices) preview_run->keepLimits (live_run.keptLimits());
    preview_run->startAgain (By::program);   // a start of a preview is none of the document
}

void Playback::endPreview()
{
    if (! isPreviewing()) return;
    const bool was_on_devices = trial.has_value();
    trial.reset();
    preview_run->letGo();
    if (was_on_devices && preview_run->isHeld()) live_run.hold();
    preview_run.reset();
    preview_document.reset();
    if (resumes) startAgain (By::program);
}

void Playback::startAgain (By who)
{
    before_run();
    live_run.startAgain (who);
}

Result<> Playback::tryDevice (const std::string& role)
{
    if (isPreviewing() || ! live_run.isRunning() || live_run.isStoppedForGood())
        return Message::error ("device_trial/stopped", {}, TRANS ("a test needs the forces to be on, and they are off").toStdString(),
                               TRANS ("press START first").toStdString());
    const auto& needs = live_run.needs();
    const auto of = std::ranges::find (needs, role, &RoleNeeds::role);
    auto made = of == needs.end() ? std::nullopt : DeviceTrial::of (live_run.edited(), *of);
    if (! made)
        return Message::error ("device_trial/no_motor", {}, filled (TRANS ("the graph neither pushes nor shakes anything with %1"), role).toStdString(),
                               TRANS ("wire something into one of its outputs").toStdString());
    auto graph = made->graph;
    runInstead (std::move (graph), true);
    trial = Trial { *std::move (made), juce::Time::getMillisecondCounterHiRes() };
    return {};
}

/// The pulse comes once the guard has ramped up. STOP ends the trial, and then nothing runs.
void Playback::attendTrial()
{
    constexpr double ramp_ms = 1000.0, most_ms = 5000.0;
    if (! trial || ! preview_run) return;
    const double now = juce::Time::getMillisecondCounterHiRes();
    const bool is_over = trial->pulsed_ms > 0.0 && now - trial->pulsed_ms > 2000.0 * DeviceTrial::length_s;
    if (is_over || ! preview_run->isWanted() || preview_run->isStoppedForGood() || now - trial->began_ms > most_ms) return endPreview();
    if (trial->pulsed_ms > 0.0 || ! preview_run->isRunning() || now - trial->began_ms < ramp_ms) return;
    const double level = trial->of.level (preview_run->mostForce(), preview_run->mostSignal());
    if (! preview_run->turn ("level.value", Json (level)) || ! preview_run->turn ("start.value", Json (1.0))) return;
    trial->pulsed_ms = now;
}

void Playback::poll()
{
    if (stop_switch.isAhead())   // counted as a stop of a person: a program's press is an emergency stop, after which no program may start anyway
    {
        const auto before = stop_switch.notice();
        stop_switch.noticed().emergencies != before.emergencies ? emergencyStop() : stop();
    }
    live_run.poll();
    if (preview_run) preview_run->poll();
    attendTrial();
}

}   // namespace tactus::host
