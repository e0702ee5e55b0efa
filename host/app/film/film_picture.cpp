// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_picture.hpp"

#include <host/app/scene/overlay.hpp>

#include <algorithm>

namespace tactus::host
{

FilmPicture::FilmPicture (const Theme& theme, juce::Rectangle<int> view, int width)
    : look (Look::apart (theme)), area (view.withZeroOrigin().toFloat()), across (width - width % 2)
{
    area.setSize (std::max (area.getWidth(), 16.0f), std::max (area.getHeight(), 16.0f));
    const int height = juce::roundToInt (static_cast<float> (across) * area.getHeight() / area.getWidth());
    down = std::clamp (height - height % 2, 16, 2 * across);   // even, as video formats require
}

juce::Image FilmPicture::draw (const FilmState& state)
{
    constexpr int fineness = 2;
    auto camera = state.camera;
    camera.setSize (static_cast<float> (across), static_cast<float> (down));
    raster.begin (across, down, fineness);
    state.stage->draw (raster, camera, scene::Paint (look->theme()), state.now);
    juce::Image surfaces (juce::Image::ARGB, across, down, true, juce::SoftwareImageType());
    raster.write (surfaces);

    juce::Image picture (juce::Image::RGB, across, down, true, juce::SoftwareImageType());
    juce::Graphics g (picture);
    g.fillAll (look->theme().canvas);
    g.addTransform (juce::AffineTransform::scale (static_cast<float> (across) / area.getWidth(), static_cast<float> (down) / area.getHeight()));
    auto in_units = state.camera;
    in_units.setSize (area.getWidth(), area.getHeight());
    scene::Overlay overlay (g, *look, in_units, area);
    overlay.drawGround (*state.stage);
    g.drawImage (surfaces, area);
    overlay.drawMarks (*state.stage, state.now);
    overlay.drawScale (*state.stage, state.now);
    return picture;
}

const FilmState* stateAt (const Film& film, double seconds)
{
    if (film.states.empty() || film.ticks.empty()) return nullptr;
    const auto tick = film.ticks.front().tick + static_cast<std::uint64_t> (std::max (0.0, seconds) * film.rate_hz);
    auto after = std::ranges::upper_bound (film.states, tick, {}, &FilmState::tick);
    return after == film.states.begin() ? &film.states.front() : &*(after - 1);
}

}   // namespace tactus::host
