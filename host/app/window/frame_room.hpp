// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <cmath>
#include <optional>

namespace tactus::host
{

/// Where a window that opened as large as the screen goes when its frame is known, so that the title bar and the lower edge are on the screen, too.
/// The window manager may have moved the window by then. Empty if the window no longer has the size of the screen: then the user or the window manager
/// has resized it. `scale`: pixels of the frame per unit of the other arguments.
inline std::optional<juce::Rectangle<int>> besideFrame (juce::Rectangle<int> window, juce::Rectangle<int> screen, juce::BorderSize<int> frame, double scale)
{
    if (window.withZeroOrigin() != screen.withZeroOrigin()) return {};
    const auto units = [scale] (int pixels) { return static_cast<int> (std::ceil (pixels / scale)); };
    return juce::BorderSize<int> (units (frame.getTop()), units (frame.getLeft()), units (frame.getBottom()), units (frame.getRight())).subtractedFrom (screen);
}

}   // namespace tactus::host
