// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_store.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/text/caught.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
std::filesystem::file_time_type timeOf (const std::filesystem::path& file)
{
    std::error_code failed;
    const auto time = std::filesystem::last_write_time (file, failed);
    return failed ? std::filesystem::file_time_type {} : time;
}
}   // namespace

PictureStore::PictureStore (const Catalogue& c) : Thread ("force pictures"), catalogue (c) {}

PictureStore::~PictureStore()
{
    cancelled = true;
    stopThread (-1);
}

void PictureStore::use (const Catalogue& c)
{
    const std::scoped_lock guard (lock);
    catalogue = c;
}

std::shared_ptr<const ForcePicture> PictureStore::get (const std::filesystem::path& file)
{
    std::shared_ptr<const ForcePicture> earlier;
    {
        const auto written = timeOf (file);
        const std::scoped_lock guard (lock);
        if (const auto found = pictures.find (file); found != pictures.end())
        {
            if (found->second.written == written) return found->second.picture;
            earlier = found->second.picture;
        }
        if (! wanted.empty() && wanted.front() == file) return earlier;
        std::erase (wanted, file);
        wanted.push_front (file);
    }
    if (! isThreadRunning()) startThread (Priority::low);
    notify();
    return earlier;
}

void PictureStore::run()
{
    while (! threadShouldExit())
    {
        std::filesystem::path file;
        Catalogue types;
        {
            const std::scoped_lock guard (lock);
            if (! wanted.empty()) file = wanted.front();
            types = file.empty() ? Catalogue {} : catalogue;   // while the thread waits, it keeps no types loaded
        }
        if (file.empty())
        {
            wait (-1);
            continue;
        }
        const auto written = timeOf (file);
        auto picture = std::make_shared<ForcePicture>();
        if (auto drawn = caught (file.string(), [&] { return pictureOf (file, types, cancelled); }))
            *picture = std::move (*drawn);
        else
            picture->problem = drawn.error().text;
        const std::scoped_lock guard (lock);
        pictures[file] = { std::move (picture), written };
        std::erase (wanted, file);
        ++finished;
    }
}

namespace
{
/// Draws the picture of the material, and cuts its place off the area. As wide as the picture is, but never more than a third.
void drawMaterial (juce::Graphics& g, const Theme& theme, juce::Rectangle<float>& area, const MaterialPicture& material)
{
    const float full = area.getHeight() * MaterialPicture::width / MaterialPicture::height;
    const auto place = area.removeFromLeft (std::round (std::min (full, area.getWidth() / 3.0f)));
    area.removeFromLeft (4.0f);
    const juce::Graphics::ScopedSaveState state (g);
    juce::Path frame;
    frame.addRoundedRectangle (place, 4.0f);
    g.setColour (theme.canvas);
    g.fillPath (frame);
    g.reduceClipRegion (frame);
    g.drawImage (material.of (theme), place, juce::RectanglePlacement::fillDestination);
}
}   // namespace

void drawPicture (juce::Graphics& g, const Look& look, juce::Rectangle<float> area, const ForcePicture* picture)
{
    const auto& theme = look.theme();
    if (picture != nullptr && ! picture->material.isEmpty()) drawMaterial (g, theme, area, picture->material);
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (area, 4.0f);
    g.setFont (look.font (11.0f));
    g.setColour (theme.dim);
    if (picture == nullptr || ! picture->problem.empty() || picture->peak <= 0.0)
    {
        auto text = TRANS ("Computing...");
        if (picture != nullptr) text = picture->problem.empty() ? TRANS ("No force in this preview.") : juce::String (picture->problem);
        g.drawFittedText (text, area.reduced (8.0f, 2.0f).toNearestInt(), juce::Justification::centredLeft, 2);
        return;
    }
    // The label goes above the plot, or next to it if there is no room above.
    auto peak = juce::String (picture->peak, picture->peak < 0.1 ? 3 : 2) + " " + picture->unit;
    auto plot = area.reduced (6.0f, 4.0f);
    const bool is_low = area.getHeight() < 44.0f;
    if (! is_low) peak = filled (TRANS ("%1 peak, %2 s"), peak, juce::String (picture->seconds, 1));
    const auto place = is_low ? plot.removeFromRight (56.0f).withTrimmedLeft (8.0f) : plot.removeFromTop (16.0f);
    g.drawText (peak, place, is_low ? juce::Justification::centredRight : juce::Justification::centredLeft, true);
    juce::Path shape;
    shape.startNewSubPath (plot.getBottomLeft());
    for (std::size_t i = 0; i < picture->peaks.size(); ++i)
    {
        const float x = static_cast<float> (i) / static_cast<float> (picture->peaks.size() - 1), y = picture->peaks[i] / static_cast<float> (picture->peak);
        shape.lineTo (plot.getX() + plot.getWidth() * x, plot.getBottom() - plot.getHeight() * y);
    }
    auto outline = shape;
    shape.lineTo (plot.getBottomRight());
    shape.closeSubPath();
    const auto colour = theme.of (Quantity::force);
    g.setColour (colour.withAlpha (0.25f));
    g.fillPath (shape);
    g.setColour (colour);
    g.strokePath (outline, juce::PathStrokeType (1.2f));
}

}   // namespace tactus::host
