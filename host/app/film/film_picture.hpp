// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "film_tape.hpp"

#include <host/app/look/look.hpp>

namespace tactus::host
{

/// Draws the pictures of a film. Created and destroyed on the main thread; draws on any thread, but on one at a time.
class FilmPicture
{
public:
    /// `view`: the size of the scene in the window, in its units. `width`: of the pictures, in pixels; the height is in proportion.
    FilmPicture (const Theme&, juce::Rectangle<int> view, int width);

    juce::Image draw (const FilmState&);

    int width() const noexcept { return across; }
    int height() const noexcept { return down; }

private:
    std::unique_ptr<Look> look;
    juce::Rectangle<float> area;
    int across, down;
    scene::Raster raster;
};

/// The state that a film shows at a time, in s from its start; null if it has none.
const FilmState* stateAt (const Film&, double seconds);

}   // namespace tactus::host
