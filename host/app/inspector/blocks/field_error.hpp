// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/look.hpp>

namespace tactus::host
{

/// Red text next to a field: why what was typed there is refused. It lies over the window, and clicks pass through it.
class FieldError final : public juce::Component
{
public:
    FieldError() { setInterceptsMouseClicks (false, false); }

    /// Shows the text below the field, or above it where there is no room.
    void show (const juce::Component& field, const juce::String& why)
    {
        said = why;
        setTitle (why);
        auto* window = field.getTopLevelComponent();
        if (window == &field) return;   // the field is in no window
        window->addAndMakeVisible (*this);
        const int width = std::min (std::max (field.getWidth(), 260), window->getWidth() - 2 * margin);
        const auto height = layout (width).getHeight();
        const auto place = window->getLocalArea (&field, field.getLocalBounds());
        const int h = static_cast<int> (std::ceil (height)) + 2 * inset;
        const bool fits_below = place.getBottom() + gap + h <= window->getHeight();
        const auto top = fits_below ? place.getBottom() + gap : place.getY() - gap - h;
        setBounds (juce::Rectangle<int> (place.getRight() - width, top, width, h).constrainedWithin (window->getLocalBounds().reduced (margin)));
        toFront (false);
        repaint();
    }

    void hide()
    {
        said.clear();
        fold();
    }

    /// Removes it from the window, but keeps the text.
    void fold()
    {
        if (auto* parent = getParentComponent()) parent->removeChildComponent (this);
    }

    const juce::String& text() const noexcept { return said; }

    void paint (juce::Graphics& g) override
    {
        const auto& theme = themeOf (*this);
        const auto area = getLocalBounds().toFloat();
        g.setColour (theme.panel);
        g.fillRoundedRectangle (area, 4.0f);
        g.setColour (theme.stop);
        g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);
        layout (getWidth()).draw (g, area.reduced (inset));
    }

private:
    static constexpr int margin = 8, gap = 2, inset = 6;

    juce::TextLayout layout (int width) const
    {
        const auto& look = lookOf (*this);
        return wrapText (said, look.font (12.0f), look.theme().stop.interpolatedWith (look.theme().text, 0.35f), static_cast<float> (width - 2 * inset));
    }

    juce::String said;
};

}   // namespace tactus::host
