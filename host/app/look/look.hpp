// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "theme.hpp"

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// How everything in the window looks: its colours and its typeface. Set it as the default before there is a component.
class Look final : public juce::LookAndFeel_V4
{
public:
    Look();

    const Theme& theme() const noexcept { return *current; }
    void setTheme (const Theme&);   ///< the caller repaints

    juce::Font font (float size, bool bold = false) const;

    juce::Typeface::Ptr getTypefaceForFont (const juce::Font&) override;
    void drawScrollbar (juce::Graphics&, juce::ScrollBar&, int x, int y, int width, int height, bool vertical, int thumb_start, int thumb_size, bool over, bool down) override;
    void fillTextEditorBackground (juce::Graphics&, int width, int height, juce::TextEditor&) override;
    void drawTextEditorOutline (juce::Graphics&, int width, int height, juce::TextEditor&) override;
    void drawComboBox (juce::Graphics&, int width, int height, bool down, int, int, int, int, juce::ComboBox&) override;
    juce::Font getComboBoxFont (juce::ComboBox&) override { return font (12.0f); }
    juce::Font getPopupMenuFont() override { return font (13.0f); }

    /// Menus open inside the window: they cannot come to lie behind it, and need no window manager.
    juce::Component* getParentComponentForMenuOptions (const juce::PopupMenu::Options&) override;

    juce::Font getLabelFont (juce::Label&) override { return font (12.0f); }
    void positionComboBoxText (juce::ComboBox&, juce::Label&) override;
    void drawLinearSlider (juce::Graphics&, int x, int y, int width, int height, float at, float, float, juce::Slider::SliderStyle, juce::Slider&) override;

private:
    const Theme* current = &Theme::dark();
    juce::Typeface::Ptr regular, bold_face;
};

/// The look of a component, which must be one of ours.
Look& lookOf (const juce::Component&);
inline const Theme& themeOf (const juce::Component& c) { return lookOf (c).theme(); }

/// A number in a text whose digits are all as wide as the widest, so that it does not dance; what is no digit is as it is.
/// Right aligned in its area.
void drawNumber (juce::Graphics&, const juce::String&, juce::Rectangle<float>);

}   // namespace tactus::host
