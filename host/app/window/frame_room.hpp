// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <cmath>
#include <cstdint>
#include <optional>

namespace tactus::host
{

/// Brings a window that opens as large as the screen to its place, so that the title bar and the lower edge are on the screen, too.
/// A window manager answers late: it tells only after a while how large the title bar is, and on a busy machine it may still move or resize the window
/// after the first requests. So the place is asked for again until the window has stayed there. A window manager that has its own idea, such as one that
/// tiles, is asked a few times.
class OpeningPlace
{
public:
    static constexpr std::uint32_t patience = 250;   ///< ms between two requests
    static constexpr int most_requests = 20;
    static constexpr std::uint32_t settled = 1000;              ///< ms at the place, once the frame is known
    static constexpr std::uint32_t settled_unframed = 10'000;   ///< ms at the place if no frame is ever known: there may be no window manager

    /// The place to move the window to now; empty: it stays. `frame`: empty or zero as long as it is not known; `scale`: pixels of the frame per unit
    /// of the other rectangles; `now`: ms. [main thread]
    std::optional<juce::Rectangle<int>> next (juce::Rectangle<int> window, juce::Rectangle<int> screen, std::optional<juce::BorderSize<int>> frame,
                                              double scale, std::uint32_t now)
    {
        if (is_done) return {};
        const bool has_frame = frame && *frame != juce::BorderSize<int> {};
        const auto units = [scale] (int pixels) { return static_cast<int> (std::ceil (pixels / scale)); };
        const auto edge = has_frame ? *frame : juce::BorderSize<int> {};
        const juce::BorderSize<int> inside { units (edge.getTop()), units (edge.getLeft()), units (edge.getBottom()), units (edge.getRight()) };
        const auto place = inside.subtractedFrom (screen);
        if (window == place)
        {
            if (! there_since) there_since = now;
            is_done = now - *there_since >= (has_frame ? settled : settled_unframed);
            return {};
        }
        there_since.reset();
        if (asked_at && now - *asked_at < patience) return {};
        is_done = ++requests > most_requests;
        if (is_done) return {};
        asked_at = now;
        return place;
    }

private:
    bool is_done = false;
    int requests = 0;
    std::optional<std::uint32_t> there_since, asked_at;
};

}   // namespace tactus::host
