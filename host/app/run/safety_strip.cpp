// SPDX-License-Identifier: GPL-3.0-or-later
#include "safety_strip.hpp"

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr int button_width = 112;

juce::String inNewton (double force) { return juce::String (force, 3) + " N"; }

juce::String inNewtonPerMillimetre (double stiffness) { return stiffness >= 1000.0 ? juce::String (stiffness / 1000.0, 1) + " N/mm" : juce::String (std::round (stiffness)) + " N/m"; }

/// Why a run ended, in words.
juce::String reason (const RunStatus& s, Performance& p)
{
    switch (s.end)
    {
    case RunStatus::End::overrun:
    {
        const auto costs = p.costs();
        return "stopped: a tick takes longer than it may" + (costs.empty() ? juce::String() : "; " + juce::String (costs.front().node) + " takes " + juce::String (juce::roundToInt (100.0 * costs.front().share)) + " % of it");
    }
    case RunStatus::End::length:
        return "came to its end";
    case RunStatus::End::asked:
    case RunStatus::End::none:
        break;
    }
    return "stopped";
}
}   // namespace

/// Red while it stops, and then the way to start again.
class SafetyStrip::StopButton final : public juce::Button
{
public:
    StopButton() : Button ("STOP") {}

    void paintButton (juce::Graphics& g, bool over, bool down) override
    {
        const auto& look = lookOf (*this);
        const bool stops = getButtonText() == "STOP";
        const auto colour = stops ? look.theme().stop : look.theme().accent;
        g.setColour (colour.withMultipliedBrightness (down ? 0.8f : over ? 1.15f
                                                                         : 1.0f));
        g.fillRoundedRectangle (getLocalBounds().toFloat().reduced (0.5f), 4.0f);
        g.setColour (look.theme().is_dark && ! stops ? look.theme().canvas : juce::Colours::white);
        g.setFont (look.font (14.0f, true));
        g.drawText (getButtonText(), getLocalBounds(), juce::Justification::centred, false);
    }
};

SafetyStrip::SafetyStrip() : button (std::make_unique<StopButton>()), rearm (std::make_unique<StopButton>())
{
    rearm->setButtonText ("REARM");
    rearm->setTooltip ("Once nobody can be hurt: lets the forces rise again, slowly.");
    rearm->onClick = [this]
    {
        if (onRearm) onRearm();
    };
    addChildComponent (*rearm);
    button->onClick = [this]
    {
        const auto& act = shown.running ? onStop : onStart;
        if (act) act();
    };
    button->setTooltip ("Brings all forces to zero at once, smoothly. Esc does the same; Shift+Esc does it and goes on without forces.");
    addAndMakeVisible (*button);
}

SafetyStrip::~SafetyStrip() = default;

void SafetyStrip::show (Performance& p)
{
    Shown now;
    const auto status = p.status();
    now.running = p.isRunning();
    now.stopped_for_good = p.isStoppedForGood();
    if (! status)
    {
        now.alarmed = hasErrors (p.messages());
        now.state = now.alarmed ? "cannot run: see Problems" : "stopped";
    }
    else
    {
        const bool halting = status->phase == RunStatus::Phase::halting;
        now.state = now.running ? halting ? juce::String ("stopping") : "running at " + juce::String (p.rate()) + " Hz" + (p.clockRole().empty() ? juce::String() : " by " + juce::String (p.clockRole())) : reason (*status, p);
        now.alarmed = status->end == RunStatus::End::overrun;
        if (hasErrors (p.messages())) now.state = now.running && ! halting ? "running as before the last edits" : "cannot run: see Problems";
        now.warned = now.warned || hasErrors (p.messages());
        if (now.running) now.guard = "guard ready";
        if (const auto most = p.mostForce(); most && status->peak >= *most * (1.0 - 1e-9))
        {
            now.guard = "limited to " + inNewton (*most);
            now.warned = true;
        }
        for (const auto& role : status->shown())
            if (role.latest != Guard::Stop::none && role.latest != Guard::Stop::halted)
            {
                now.guard = juce::String (std::string (role.name)) + ": " + describe (role.latestEvent());
                now.alarmed = now.alarmed || role.stop != Guard::Stop::none;
            }
        if (now.running && status->clock_replaced)
        {
            now.guard = juce::String (p.clockRole()) + " does not tick: forces are held at zero";
            now.alarmed = true;
        }
        now.force = inNewton (status->force) + "  |  peak " + inNewton (status->peak);
        now.misses = juce::String (static_cast<juce::int64> (status->misses)) + " missed";
        if (const auto d = p.delay())
        {
            now.delay = "delay " + juce::String (*d) + (*d == 1 ? " tick" : " ticks");
            if (const auto k = p.stiffnessLeft()) now.delay += ", stiff up to " + inNewtonPerMillimetre (*k);
        }
        else
            now.delay = "nothing leads from a hand to a motor";
    }
    if (now == shown) return;
    button->setButtonText (now.running ? "STOP" : "START");
    rearm->setVisible (now.stopped_for_good);
    shown = std::move (now);
    repaint();
}

void SafetyStrip::resized()
{
    auto area = getLocalBounds();
    button->setBounds (area.removeFromRight (button_width).reduced (8, 7));
    rearm->setBounds (area.removeFromRight (button_width).reduced (8, 7));   // not where STOP is: who clicks there wants no force
}

void SafetyStrip::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    g.setColour (theme.hairline);
    g.drawHorizontalLine (getHeight() - 1, 0.0f, static_cast<float> (getWidth()));

    auto area = getLocalBounds().withTrimmedRight (shown.stopped_for_good ? 2 * button_width : button_width).reduced (16, 0).toFloat();
    g.setColour (shown.alarmed ? theme.stop : shown.warned ? theme.warning
                                          : shown.running  ? theme.of (Quantity::energy)
                                                           : theme.dim);
    g.fillEllipse (juce::Rectangle<float> (10.0f, 10.0f).withCentre ({ area.getX() + 5.0f, area.getCentreY() }));
    area.removeFromLeft (22.0f);

    constexpr float gap = 24.0f;
    const auto say = [&] (const juce::String& text, float least, juce::Colour colour, bool bold = false)
    {
        const auto font = look.font (13.0f, bold);
        g.setFont (font);
        g.setColour (colour);
        const float width = std::max (least, font.getStringWidthFloat (text) + 4.0f);
        g.drawText (text, area.removeFromLeft (std::min (width, area.getWidth())), juce::Justification::centredLeft, true);
        area.removeFromLeft (std::min (gap, area.getWidth()));
    };
    say (shown.state, 140.0f, theme.text, true);
    say (shown.guard, 80.0f, shown.alarmed ? theme.stop : shown.warned ? theme.warning
                                                                       : theme.dim);
    constexpr float force_width = 200.0f;
    if (shown.force.isNotEmpty() && area.getWidth() > force_width)
    {
        g.setFont (look.font (13.0f));
        g.setColour (theme.text);
        drawNumber (g, shown.force, area.removeFromLeft (force_width));
        area.removeFromLeft (gap);
    }
    say (shown.misses, 76.0f, theme.dim);
    say (shown.delay, 0.0f, theme.dim);
}

}   // namespace tactus::host
