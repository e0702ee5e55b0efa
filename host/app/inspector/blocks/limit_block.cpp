// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_block.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

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

std::string factorText (double v)
{
    if (! std::isfinite (v)) return "any";
    return v < 100.0 || v > 1e6 ? roundedText (v, 2) : std::to_string (std::lround (v));
}

/// True if the limit of the linear loop is where it swings: not if only the trials show a swing, or what calms it.
bool isLimitKnown (const ContactLimit& c)
{
    if (c.verdict == check::Verdict::stable || ! c.swinging.empty()) return c.stable_up_to >= 1.0;
    return c.stable_up_to > 0.0 && c.stable_up_to < 1.0;
}
}   // namespace

LimitBlock::Parts LimitBlock::partsOf (const ContactLimit& c)
{
    const bool swings = c.verdict == check::Verdict::unstable, rests = c.verdict == check::Verdict::stable, is_by_trial = ! isLimitKnown (c);
    Parts p { .passive = swings && is_by_trial && c.passive_up_to >= 1.0 ? 0.0 : c.passive_up_to };
    p.stable = std::max (p.passive, rests && is_by_trial ? 1.0 : 0.0);
    if ((swings || rests) && ! is_by_trial) p.swings = p.stable = std::max (p.passive, c.stable_up_to);
    if (swings && is_by_trial) p.swings = 1.0;
    p.end = 1.25 * std::max (1.0, std::min (p.stable, 8.0));   // the mark at 1 and the limits are on it, unless they are far beyond
    return p;
}

LimitBlock::LimitBlock (std::function<std::vector<ContactLimit>()> g) : get (std::move (g)) {}

juce::String LimitBlock::textOf (const ContactLimit& c)
{
    using check::Verdict;
    const auto device = c.device == TRANS ("simulated").toStdString() ? TRANS ("the simulated device") : fromUtf8 (c.device);
    const bool is_known = isLimitKnown (c);
    if (c.verdict == Verdict::passive) return filled (TRANS ("Passive on %1, up to %2 times this stiffness and damping"), device, factorText (c.passive_up_to));
    if (c.verdict == Verdict::passive_here)
        return filled (TRANS ("Passive on %1 along this motion, up to %2 times this stiffness and damping"), device, factorText (c.passive_up_to));
    if (c.verdict == Verdict::stable && ! is_known)
        return filled (TRANS ("It comes to rest in a trial with %1; passive up to %2 times this stiffness and damping"), device, factorText (c.passive_up_to));
    if (c.verdict == Verdict::unstable && ! is_known)
        return filled (TRANS ("The contact does not come to rest in a trial with %1"), device)
               + (c.passive_up_to < 1.0 ? filled (TRANS ("; passive up to %1 times this stiffness and damping"), factorText (c.passive_up_to))
                                        : juce::String());
    if (c.verdict == Verdict::stable)
        return filled (TRANS ("Stable on %1 with usual hands. The linear loop (no bounces) is stable up to %2 times this stiffness and damping; passive up to "
                              "%3 times"),
                       device, factorText (c.stable_up_to), factorText (c.passive_up_to));
    if (! c.swinging.empty())
        return filled (TRANS ("%1 swings on %2, but %3 does not: its linear loop (no bounces) rests up to %4 times this stiffness and damping; passive up to "
                              "%5 times"),
                       printableName (c.swinging), device, printableName (c.node), factorText (c.stable_up_to), factorText (c.passive_up_to));
    if (c.verdict == Verdict::unstable)
        return filled (TRANS ("It swings on %1. The linear loop (no bounces) rests up to %2 times this stiffness and damping; passive up to %3 times"),
                       device, factorText (c.stable_up_to), factorText (c.passive_up_to));
    return filled (TRANS ("Not passive on %1; passive up to %2 times this stiffness and damping"), device, factorText (c.passive_up_to));
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
        const auto p = partsOf (c);
        const auto at = [&] (double multiple) { return bar.getX() + bar.getWidth() * static_cast<float> (std::clamp (multiple / p.end, 0.0, 1.0)); };
        const auto part = [&] (double from, double to, juce::Colour colour) {
            g.setColour (colour);
            if (to > from) g.fillRect (juce::Rectangle<float>::leftTopRightBottom (at (from), bar.getY(), at (to), bar.getBottom()));
        };
        part (0.0, p.passive, theme.of (Quantity::energy).withAlpha (0.7f));
        part (p.passive, p.stable, theme.of (Quantity::length).withAlpha (0.7f));
        part (p.stable, p.end, theme.hairline);
        part (p.swings, p.end, theme.stop.withAlpha (0.7f));
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
