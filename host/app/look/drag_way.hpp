// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <utility>

namespace tactus::host
{

/// How far a number has been dragged, in pixels: to the right and up counts, as on the knobs of JUCE. With Shift, it goes a tenth as far. One may
/// press and release Shift during the drag.
class DragWay
{
public:
    double to (const juce::MouseEvent& e) noexcept
    {
        constexpr double fine = 0.1;
        const auto now = e.getOffsetFromDragStart(), by = now - std::exchange (before, now);
        way += (by.x - by.y) * (e.mods.isShiftDown() ? fine : 1.0);
        return way;
    }

private:
    juce::Point<int> before;
    double way = 0.0;
};

}   // namespace tactus::host
