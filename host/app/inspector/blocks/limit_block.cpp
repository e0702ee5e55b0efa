// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_block.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr int heading = 26, bar_height = 10, bar_gap = 6;

juce::TextLayout layoutOf (const ContactLimit& c, const Look& look, int width)
{
    return wrapText (LimitBlock::textOf (c), look.font (12.0f), look.theme().dim, static_cast<float> (width));
}

std::string factorText (double v) { return std::isfinite (v) ? roundedText (v, 2) : "any"; }

/// The longest multiple on the bar: the mark at 1 and both limits are on it, unless they are far beyond.
double endOf (const ContactLimit& c)
{
    const double largest = std::max ({ 1.0, std::min (c.passive_up_to, 8.0), std::min (c.stable_up_to, 8.0) });
    return 1.25 * largest;
}
}   // namespace

LimitBlock::LimitBlock (std::function<std::vector<ContactLimit>()> g) : get (std::move (g)) {}

juce::String LimitBlock::textOf (const ContactLimit& c)
{
    using check::Verdict;
    const auto device = c.device == TRANS ("simulated").toStdString() ? TRANS ("the simulated device") : fromUtf8 (c.device);
    // The limit of the linear loop, unless only the trials show a swing, or what calms it.
    const bool is_known = c.verdict == Verdict::stable ? c.stable_up_to >= 1.0 : c.stable_up_to > 0.0 && c.stable_up_to < 1.0;
    if (c.verdict == Verdict::passive) return filled (TRANS ("Passive on %1, up to %2 times as stiff"), device, factorText (c.passive_up_to));
    if (c.verdict == Verdict::passive_here)
        return filled (TRANS ("Passive on %1 along this motion, up to %2 times as stiff"), device, factorText (c.passive_up_to));
    if (c.verdict == Verdict::stable && ! is_known)
        return filled (TRANS ("It comes to rest in a trial with %1; passive up to %2 times as stiff"), device, factorText (c.passive_up_to));
    if (c.verdict == Verdict::unstable && ! is_known) return filled (TRANS ("It does not come to rest in a trial with %1"), device);
    if (c.verdict == Verdict::stable)
        return filled (TRANS ("Stable on %1 with usual hands, up to %2 times as stiff; passive up to %3 times"), device, factorText (c.stable_up_to),
                       factorText (c.passive_up_to));
    if (c.verdict == Verdict::unstable)
        return filled (TRANS ("It swings on %1. Stable with usual hands up to %2 times as stiff, passive up to %3 times"), device,
                       factorText (c.stable_up_to), factorText (c.passive_up_to));
    return filled (TRANS ("Not passive on %1; passive up to %2 times as stiff"), device, factorText (c.passive_up_to));
}

void LimitBlock::refresh (const graph::Node*)
{
    auto now = get();
    if (now == shown) return;
    shown = std::move (now);
    repaint();
}

int LimitBlock::heightFor (int width)
{
    int height = shown.empty() ? 0 : heading;
    for (const auto& c : shown)
        height += bar_height + 2 * bar_gap + static_cast<int> (std::ceil (layoutOf (c, lookOf (*this), width).getHeight()));
    return height;
}

void LimitBlock::paint (juce::Graphics& g)
{
    if (shown.empty()) return;
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = getLocalBounds();
    g.setFont (look.font (12.0f, true));
    g.setColour (theme.dim);
    g.drawText (TRANS ("Limits of the contact"), area.removeFromTop (heading).withTrimmedTop (8), juce::Justification::topLeft, true);
    for (const auto& c : shown)
    {
        const auto bar = area.removeFromTop (bar_height).toFloat();
        const double end = endOf (c);
        const auto at = [&] (double multiple) { return bar.getX() + bar.getWidth() * static_cast<float> (std::clamp (multiple / end, 0.0, 1.0)); };
        const auto part = [&] (double from, double to, juce::Colour colour) {
            g.setColour (colour);
            if (to > from) g.fillRect (juce::Rectangle<float>::leftTopRightBottom (at (from), bar.getY(), at (to), bar.getBottom()));
        };
        const bool is_known = c.stable_up_to > 0.0 || c.verdict == check::Verdict::unstable;
        const bool swings_in_trials = c.verdict == check::Verdict::unstable && ! (c.stable_up_to > 0.0 && c.stable_up_to < 1.0);
        const double stable = swings_in_trials ? 0.0 : std::max (c.passive_up_to, c.stable_up_to);
        part (0.0, std::min (c.passive_up_to, stable), theme.of (Quantity::energy).withAlpha (0.7f));
        part (c.passive_up_to, stable, theme.of (Quantity::length).withAlpha (0.7f));
        part (stable, end, is_known ? theme.stop.withAlpha (0.7f) : theme.hairline);
        g.setColour (theme.text);
        g.fillRect (juce::Rectangle<float> (2.0f, bar.getHeight() + 6.0f).withCentre ({ at (1.0), bar.getCentreY() }));
        area.removeFromTop (bar_gap);
        const auto text = layoutOf (c, look, area.getWidth());
        const auto height = static_cast<int> (std::ceil (text.getHeight()));
        text.draw (g, area.removeFromTop (height).toFloat());
        area.removeFromTop (bar_gap);
    }
}

}   // namespace tactus::host
