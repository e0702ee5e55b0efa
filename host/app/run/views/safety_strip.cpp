// SPDX-License-Identifier: GPL-3.0-or-later
#include "safety_strip.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr int button_width = 112;
constexpr double pause_before_start_s = 1.0;

/// Less than half a millinewton is not felt, and its digits would only flicker. What a simulated tool without a guard gets while it runs away is no
/// force of any motor.
juce::String newtonText (double force)
{
    constexpr double of_no_motor = 1e6;
    if (force < 0.5e-3) return "0 N";
    return force > of_no_motor ? TRANS ("over 1000 kN") : juce::String (fromUtf8 (withPrefix (force, "N")));
}

juce::String stiffnessText (double stiffness)
{
    return stiffness >= 1000.0 ? juce::String (stiffness / 1000.0, 1) + " N/mm" : juce::String (std::round (stiffness)) + " N/m";
}

/// The reason why a run ended.
juce::String reason (const RunStatus& s, LiveRun& run)
{
    switch (s.end)
    {
    case RunStatus::End::overrun:
    {
        const auto costs = run.costs();
        if (costs.empty()) return TRANS ("stopped: a tick takes too long");
        const auto percent = juce::roundToInt (100.0 * costs.front().share);
        return filled (TRANS ("stopped: a tick takes too long; %1 takes %2 % of it"), costs.front().node, percent);
    }
    case RunStatus::End::length:
        return TRANS ("finished");
    case RunStatus::End::asked:
    case RunStatus::End::none:
        break;
    }
    return TRANS ("stopped");
}

juce::String runningText (const LiveRun& run)
{
    const auto running = run.clockRole().empty() ? TRANS ("running at %1 Hz") : TRANS ("running at %1 Hz, ticked by %2");
    auto text = filled (running, juce::String (run.rate()), run.clockRole());
    if (const auto fusion = run.fusion(); ! fusion.empty()) text += ", " + juce::String (fusion);
    return text;
}

juce::String firstError (const LiveRun& run)
{
    const auto& all = run.messages();
    const auto error = std::ranges::find (all, Message::Severity::error, &Message::severity);
    return error == all.end() ? juce::String() : fromUtf8 (error->text).replaceCharacters ("\n", " ");
}

/// Of a graph with errors that does not run.
juce::String whyNot (const LiveRun& run)
{
    return filled (run.isWaiting() ? TRANS ("cannot run: %1 (starts once this is solved)") : TRANS ("cannot run: %1"), firstError (run));
}

juce::String delayText (const LiveRun& run)
{
    const auto d = run.delay();
    if (! d) return TRANS ("no path from hand to motor");
    if (d->shortest < d->longest) return filled (TRANS ("delay %1 to %2 ticks"), d->shortest, d->longest);
    return filled (d->longest == 1 ? TRANS ("delay %1 tick") : TRANS ("delay %1 ticks"), d->longest);
}

juce::String wallsText (const LiveRun& run)
{
    const auto stiffness = run.delay() ? run.stiffnessLeft() : std::nullopt;
    return stiffness ? filled (TRANS ("undamped walls passive up to %1"), stiffnessText (*stiffness)) : juce::String();
}
}   // namespace

/// STOP in red, or START or REARM in the accent colour.
class SafetyStrip::StopButton final : public juce::Button, juce::Timer
{
public:
    StopButton (const juce::String& label, bool in_red) : Button (label), stops (in_red) {}

    void show (const juce::String& label, bool in_red)
    {
        if (label == getButtonText()) return;
        setButtonText (label);
        stops = in_red;
        shown_at = juce::Time::getCurrentTime();
        startTimer (juce::roundToInt (1e3 * pause_before_start_s) + 1);   // until then it is dim, as it ignores a click
    }

    /// True if the latest click came so soon after a change of the text that it was meant for the old text.
    bool isTooSoon() const noexcept { return too_soon; }

    /// JUCE's event times can lie in the future if the first event had to wait.
    void mouseDown (const juce::MouseEvent& e) override
    {
        too_soon = isFresh (std::min (e.eventTime, juce::Time::getCurrentTime()));
        if (stops || e.mods.isLeftButtonDown()) Button::mouseDown (e);   // any click stops
    }

    void mouseDrag (const juce::MouseEvent& e) override
    {
        if (isDown()) Button::mouseDrag (e);
    }

    void paintButton (juce::Graphics& g, bool over, bool down) override
    {
        const auto& look = lookOf (*this);
        const auto colour = stops ? look.theme().stop : look.theme().accent;
        const float lit = over ? 1.15f : 1.0f, opacity = stops || (isEnabled() && ! isTimerRunning()) ? 1.0f : 0.4f;
        g.setColour (colour.withMultipliedBrightness (down ? 0.8f : lit).withMultipliedAlpha (opacity));
        g.fillRoundedRectangle (getLocalBounds().toFloat().reduced (0.5f), 4.0f);
        g.setColour (look.theme().is_dark && ! stops ? look.theme().canvas : juce::Colours::white);
        g.setFont (look.font (14.0f, true));
        g.drawText (getButtonText(), getLocalBounds(), juce::Justification::centred, false);
    }

private:
    void timerCallback() override
    {
        stopTimer();
        repaint();
    }

    bool isFresh (juce::Time now) const noexcept { return now < shown_at + juce::RelativeTime (pause_before_start_s); }

    juce::Time shown_at;   // when the text last changed
    bool stops;
    bool too_soon = false;
};

SafetyStrip::SafetyStrip (Playback& p)
    : playback (p), button (std::make_unique<StopButton> (TRANS ("START"), false)), rearm (std::make_unique<StopButton> (TRANS ("REARM"), false))
{
    setOpaque (true);
    setTitle (TRANS ("Safety"));
    rearm->setTooltip (TRANS ("Lets the forces rise again, over the ramp of the limits, or within 0.2 s if they have none. Press it only when it is safe."));
    rearm->onClick = [this] { playback.current().rearm(); };
    addChildComponent (*rearm);
    button->onClick = [this] {
        if (shown.running)
            playback.stop();
        else if (! button->isTooSoon())   // the second click of a double click on STOP must not restart the run
            playback.restart();
    };
    addAndMakeVisible (*button);
    addChildComponent (limits);
}

SafetyStrip::~SafetyStrip() = default;

void SafetyStrip::refresh()
{
    rearm->setEnabled (playback.current().canRearm());
    auto now = stateOf (playback.current());
    if (now == shown) return;
    button->show (now.running ? TRANS ("STOP") : TRANS ("START"), now.running);
    button->setTooltip (now.running ? TRANS ("Ramps all forces to zero. So does Esc, unless it closes a page, a dialog or a field, and always while a device "
                                             "runs. With Shift+Esc, the graph keeps running.")
                                    : TRANS ("Runs the graph. So does F5. The forces rise slowly."));
    rearm->setVisible (now.stopped_for_good);
    shown = std::move (now);
    repaint();
}

SafetyStrip::Status SafetyStrip::stateOf (LiveRun& run)
{
    const bool has_errors = hasErrors (run.messages());
    Status now;
    now.running = run.isRunning() || run.isWaiting();   // STOP also ends the waiting
    now.stopped_for_good = run.isStoppedForGood();
    const auto status = run.status();
    if (! status)
    {
        now.alarmed = now.has_errors = has_errors;
        now.state = has_errors ? whyNot (run) : TRANS ("stopped");
        return now;
    }
    now.has_errors = has_errors;
    const bool halting = status->phase == RunStatus::Phase::halting;
    if (has_errors && run.isRunning() && ! run.isOfOpenGraph())
        now.state = filled (TRANS ("this graph cannot run: %1; the one before is felt until it stops"), firstError (run));
    else if (has_errors && run.isRunning() && ! halting && run.lacksDevice())
        now.state = filled (TRANS ("runs without a device: %1"), firstError (run));
    else if (has_errors)
        now.state = run.isRunning() && ! halting ? TRANS ("edit has errors; still running the last valid version") : whyNot (run);
    else if (! now.running)
        now.state = reason (*status, run);
    else
        now.state = halting ? TRANS ("stopping") : runningText (run);
    now.alarmed = status->end == RunStatus::End::overrun;
    now.warned = has_errors;
    showGuards (run, *status, now);
    now.force = newtonText (status->force) + "  |  " + filled (TRANS ("peak %1"), newtonText (status->peak));
    now.misses = filled (TRANS ("late ticks: %1"), status->misses);
    if (! run.isRunning()) return now;   // an edit may have changed the delay and the rate since it stopped
    now.delay = delayText (run);
    now.walls = wallsText (run);
    return now;
}

void SafetyStrip::showGuards (const LiveRun& run, const RunStatus& status, Status& now)
{
    const bool halting = status.phase == RunStatus::Phase::halting;
    if (now.running) now.guard = TRANS ("guard ready");
    if (const auto most = run.mostForce(); most && status.peak >= *most * (1.0 - 1e-9))
    {
        now.guard = filled (TRANS ("limited to %1"), newtonText (*most));
        now.warned = true;
    }
    for (const auto& role : status.shown())
        if (now.running && role.is_clipping)
        {
            now.guard = filled (TRANS ("%1: the guard clips most ticks"), juce::String (std::string (role.name)));
            now.warned = true;
        }
    for (const auto& role : status.shown())
        if (role.latest != Guard::Stop::none && role.latest != Guard::Stop::halted)
        {
            const auto event = role.latestEvent();
            const bool is_over = Guard::latches (role.latest) && ! role.is_latched;   // somebody has seen it, and rearmed
            const bool is_stopped = role.stop != Guard::Stop::none, is_meant = event.why == Guard::Stop::stale && event.fault == ReadingFault::moved;
            // This stop ends by itself. No device has a reading before its first one, or after it is closed.
            const bool is_past = event.why == Guard::Stop::stale && ! (is_stopped && now.running && ! halting);
            if (is_over || (is_meant && ! is_stopped) || is_past) continue;
            const bool is_from_before = event.why == Guard::Stop::emergency && run.beganHeld();
            const auto why = is_from_before ? TRANS ("stopped before this graph began; REARM gives it forces") : fromUtf8 (describe (event));
            now.guard = juce::String (std::string (role.name)) + ": " + why;
            (is_meant ? now.warned : now.alarmed) |= is_stopped;
        }
    if (now.running && status.clock_replaced)
    {
        now.guard = filled (TRANS ("the clock %1 has stopped: forces are held at zero"), run.clockRole());
        now.alarmed = true;
    }
}

juce::Rectangle<int> SafetyStrip::stopPlace() const { return shown.running ? button->getBounds() : juce::Rectangle<int> {}; }

void SafetyStrip::resized()
{
    auto area = getLocalBounds();
    button->setBounds (area.removeFromRight (button_width).reduced (8, 7));
    limits.setBounds (area.removeFromRight (LimitLight::width));
    rearm->setBounds (area.removeFromRight (button_width).reduced (8, 7));   // away from STOP, so that a click meant for STOP cannot rearm
}

void SafetyStrip::mouseMove (const juce::MouseEvent& e)
{
    const bool is_link = shown.has_errors && state_place.contains (e.getPosition());
    setMouseCursor (is_link ? juce::MouseCursor::PointingHandCursor : juce::MouseCursor::NormalCursor);
}

void SafetyStrip::mouseUp (const juce::MouseEvent& e)
{
    if (shown.has_errors && state_place.contains (e.getPosition()) && onProblems) onProblems();
}

juce::String SafetyStrip::tooltipAt (juce::Point<int> at) const
{
    for (const auto& [place, meaning] : meanings)
        if (place.contains (at)) return meaning;
    return {};
}

void SafetyStrip::paint (juce::Graphics& g)
{
    meanings.clear();
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    g.setColour (theme.hairline);
    g.drawHorizontalLine (getHeight() - 1, 0.0f, static_cast<float> (getWidth()));

    const auto colourFor = [&] (juce::Colour unless_alarmed) { return shown.alarmed ? theme.stop : unless_alarmed; };
    auto area = getLocalBounds().withRight (shown.stopped_for_good ? rearm->getX() : limits.getX()).reduced (16, 0).toFloat();
    const auto calm = shown.running ? theme.of (Quantity::energy) : theme.dim;
    g.setColour (colourFor (shown.warned ? theme.warning : calm));
    g.fillEllipse (juce::Rectangle<float> (10.0f, 10.0f).withCentre ({ area.getX() + 5.0f, area.getCentreY() }));
    area.removeFromLeft (22.0f);

    constexpr float gap = 24.0f;
    const auto add = [&] (const juce::String& text, float least, juce::Colour colour, const juce::String& meaning, bool bold = false) {
        const auto font = look.font (13.0f, bold);
        g.setFont (font);
        g.setColour (colour);
        const float width = std::max (least, font.getStringWidthFloat (text) + 4.0f);
        const auto place = area.removeFromLeft (std::min (width, area.getWidth()));
        g.drawText (text, place, juce::Justification::centredLeft, true);
        if (text.isNotEmpty()) meanings.emplace_back (place.toNearestInt(), meaning);
        area.removeFromLeft (std::min (gap, area.getWidth()));
    };
    state_place = area.withWidth (look.font (13.0f, true).getStringWidthFloat (shown.state) + 4.0f).toNearestInt();
    // The force is worth more than a guard that has done nothing, and the reason of a stop more than the rate.
    const bool is_narrow = area.getWidth() < 420.0f;
    const bool has_reason = is_narrow && shown.running && ! shown.has_errors && (shown.alarmed || shown.warned);
    if (has_reason)
        state_place = {};
    else
        add (shown.state, is_narrow ? 0.0f : 140.0f, theme.text, TRANS ("Whether the graph runs, at how many ticks per second, and what ticks it"), true);
    if (shown.has_errors) g.fillRect (state_place.withTop (state_place.getCentreY() + 8).withHeight (1).withTrimmedRight (4));   // a link
    if (! is_narrow || shown.warned || shown.alarmed)
        add (has_reason && shown.guard.contains (": ") ? shown.guard.fromFirstOccurrenceOf (": ", false, false) : shown.guard, 80.0f,
             colourFor (shown.warned ? theme.warning : theme.dim),
             TRANS ("The guard stands between the graph and the motors. It limits force, and stops the motors if speed, impulse or energy exceed the "
                    "limits of the device. Ready: it has not had to stop anything."));
    const float force_width = is_narrow ? 60.0f : 200.0f;
    if (shown.force.isNotEmpty() && area.getWidth() >= force_width)
    {
        g.setFont (look.font (13.0f));
        g.setColour (theme.text);
        const auto place = area.removeFromLeft (force_width);
        drawNumber (g, is_narrow ? shown.force.upToFirstOccurrenceOf ("  |", false, false) : shown.force, place);
        meanings.emplace_back (place.toNearestInt(), TRANS ("The force on the tool now, and the largest since the start"));
        area.removeFromLeft (gap);
    }
    const std::pair<juce::String, juce::String> rest[] {
        { shown.misses,
          TRANS ("Ticks that were not finished in time since the start. A few are not felt; many mean that the computer is too slow for the rate. "
                 "C shows what each node costs.") },
        { shown.delay,
          TRANS ("How many ticks pass from a movement of the hand to its effect on the motor, in the graph and in the device as far as its delay is "
                 "known. Each tick of delay makes a stiff wall less stable.") },
        { shown.walls,
          TRANS ("The largest stiffness with which a wall without damping returns no energy, whatever the hand does, with the longest delay and the damping "
                 "of the device. A stiffer one may rest, vibrate or kick. Problems has what the check says about this graph.") },
    };
    for (const auto& [text, meaning] : rest)   // left out rather than cut off
        if (look.font (13.0f).getStringWidthFloat (text) + 4.0f <= area.getWidth()) add (text, 0.0f, theme.dim, meaning);
}

}   // namespace tactus::host
