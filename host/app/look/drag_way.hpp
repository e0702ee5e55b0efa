// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <utility>

namespace tactus::host
{

/// The distance by which a number has been dragged, in pixels: to the right and up, as on the knobs of JUCE, or only up, as on a fader. With Shift,
/// it goes a tenth as far. Shift may be pressed and released during the drag.
class DragWay
{
public:
    enum class Along
    {
        both,
        up
    };

    DragWay() = default;
    explicit DragWay (Along a) : along (a) {}

    double to (const juce::MouseEvent& e) noexcept
    {
        constexpr double fine = 0.1;
        const auto now = e.getOffsetFromDragStart(), by = now - std::exchange (before, now);
        way += ((along == Along::both ? by.x : 0) - by.y) * (e.mods.isShiftDown() ? fine : 1.0);
        return way;
    }

private:
    Along along = Along::both;
    juce::Point<int> before;
    double way = 0.0;
};

}   // namespace tactus::host
