// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Scroll position and zoom of a canvas.
struct View
{
    static constexpr float smallest = 0.1f, largest = 4.0f;
    static constexpr float smallest_framed = 0.002f;   ///< shows all of some thousand nodes
    static constexpr float readable = 0.5f;            ///< the zoom from which on the labels of ports can be read: they have 6 pixels

    static constexpr float too_small_to_read = 0.35f;    ///< the zoom below which text is too small: a node is a coloured box with its name
    static constexpr float too_small_for_names = 0.2f;   ///< the zoom below which the names do not fit, either: a node is a coloured box

    float zoom = 1.0f;
    juce::Point<float> origin;   ///< where the canvas has its origin, in pixels of the component

    bool operator== (const View&) const = default;

    juce::Point<float> toCanvas (juce::Point<float> pixel) const noexcept { return (pixel - origin) / zoom; }
    juce::Point<float> toPixels (juce::Point<float> p) const noexcept { return p * zoom + origin; }
    juce::AffineTransform transform() const noexcept { return juce::AffineTransform::scale (zoom).translated (origin); }

    /// Zooms around a pixel, whose canvas position stays fixed.
    void zoomAt (juce::Point<float> pixel, float factor) noexcept
    {
        const auto fixed = toCanvas (pixel);
        zoom = std::clamp (zoom * factor, std::min (smallest, zoom), largest);
        origin = pixel - fixed * zoom;
    }

    void centreOn (juce::Point<float> place, juce::Rectangle<float> window) noexcept { origin = window.getCentre() - place * zoom; }

    /// Fits an area into the window, centred, at no more than 100 %.
    void frame (juce::Rectangle<float> area, juce::Rectangle<float> window) noexcept
    {
        if (area.isEmpty() || window.isEmpty()) return;
        const auto inside = withoutMargin (window);
        zoom = std::clamp (std::min ({ 1.0f, inside.getWidth() / area.getWidth(), inside.getHeight() / area.getHeight() }), smallest_framed, largest);
        origin = inside.getCentre() - area.getCentre() * zoom;
    }

    /// As frame(), but never smaller than readable. If the area is larger than the window then, the window shows the part of it around `focus`.
    void frameReadably (juce::Rectangle<float> area, juce::Rectangle<float> focus, juce::Rectangle<float> window) noexcept
    {
        frame (area, window);
        if (area.isEmpty() || window.isEmpty() || zoom >= readable) return;
        constexpr float least_margin = 4.0f;
        if (const auto all = window.reduced (least_margin); area.getWidth() * readable <= all.getWidth() && area.getHeight() * readable <= all.getHeight())
        {
            zoom = readable;
            return centreOn (area.getCentre(), window);
        }
        zoom = 1.1f * readable;   // as it does not fit anyway
        const auto inside = withoutMargin (window);
        const auto along = [this] (juce::Range<float> all, float middle, juce::Range<float> seen) {
            const float centred = (seen.getStart() + seen.getEnd()) / 2.0f;
            if (all.getLength() * zoom <= seen.getLength()) return centred - zoom * (all.getStart() + all.getEnd()) / 2.0f;
            return std::clamp (centred - zoom * middle, seen.getEnd() - zoom * all.getEnd(), seen.getStart() - zoom * all.getStart());
        };
        origin = { along (area.getHorizontalRange(), focus.getCentreX(), inside.getHorizontalRange()),
                   along (area.getVerticalRange(), focus.getCentreY(), inside.getVerticalRange()) };
    }

private:
    static juce::Rectangle<float> withoutMargin (juce::Rectangle<float> window) noexcept
    {
        constexpr float margin = 48.0f, share = 0.06f;   // of a small window
        return window.reduced (std::min (margin, share * window.getWidth()), std::min (margin, share * window.getHeight()));
    }
};

}   // namespace tactus::host
