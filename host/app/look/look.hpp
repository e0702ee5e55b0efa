// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "theme.hpp"

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// The look and feel of the window: colours and typeface. Make it the default before creating any component.
class Look final : public juce::LookAndFeel_V4
{
public:
    Look();

    /// A Look for pictures that another thread draws while the window is drawn. It shares no typeface and no cached text with others:
    /// JUCE tells fonts apart by name and size, so its fonts are a thousandth wider. Created and destroyed on the main thread.
    static std::unique_ptr<Look> apart (const Theme&);

    const Theme& theme() const noexcept { return *current; }
    void setTheme (const Theme&);   ///< the caller has to repaint

    juce::Font font (float size, bool bold = false) const;

    juce::Typeface::Ptr getTypefaceForFont (const juce::Font&) override;
    void drawScrollbar (juce::Graphics&, juce::ScrollBar&, int x, int y, int width, int height, bool vertical, int thumb_start,
                        int thumb_size, bool over, bool down) override;
    void fillTextEditorBackground (juce::Graphics&, int width, int height, juce::TextEditor&) override;
    juce::CaretComponent* createCaretComponent (juce::Component* field) override;
    void drawTextEditorOutline (juce::Graphics&, int width, int height, juce::TextEditor&) override;
    void drawComboBox (juce::Graphics&, int width, int height, bool down, int, int, int, int, juce::ComboBox&) override;
    juce::Font getComboBoxFont (juce::ComboBox&) override { return font (12.0f); }

    // The dialog for files, see file_dialog.cpp.
    void drawResizableWindowBorder (juce::Graphics&, int width, int height, const juce::BorderSize<int>&, juce::ResizableWindow&) override;
    void drawCornerResizer (juce::Graphics&, int width, int height, bool over, bool dragging) override;
    void layoutFileBrowserComponent (juce::FileBrowserComponent&, juce::DirectoryContentsDisplayComponent* list, juce::FilePreviewComponent*,
                                     juce::ComboBox* folder, juce::TextEditor* name, juce::Button* up) override;
    void drawFileBrowserRow (juce::Graphics&, int width, int height, const juce::File&, const juce::String& name, juce::Image* icon,
                             const juce::String& size, const juce::String& time, bool is_folder, bool is_selected, int row,
                             juce::DirectoryContentsDisplayComponent&) override;
    juce::Font getPopupMenuFont() override { return font (13.0f); }
    void drawPopupMenuBackground (juce::Graphics&, int width, int height) override;

    /// Menus open inside the window, so they need no window manager and cannot end up behind it. If a component around the target has a child with the id
    /// `menu_area`, they open inside this child.
    juce::Component* getParentComponentForMenuOptions (const juce::PopupMenu::Options&) override;
    static constexpr const char* menu_area = "menus";

    /// Lets a component around a menu that listens to keys get them before the menu, which would swallow Esc.
    void preparePopupMenuWindow (juce::Component& menu) override;

    juce::Font getLabelFont (juce::Label&) override { return font (12.0f); }
    void positionComboBoxText (juce::ComboBox&, juce::Label&) override;
    void drawLinearSlider (juce::Graphics&, int x, int y, int width, int height, float at, float, float, juce::Slider::SliderStyle, juce::Slider&) override;

private:
    const Theme* current = &Theme::dark();
    juce::Typeface::Ptr regular, bold_face;
    float font_width = 1.0f;   // of the letters, in proportion
};

/// The Look of a component, which must use one.
Look& lookOf (const juce::Component&);
inline const Theme& themeOf (const juce::Component& c) { return lookOf (c).theme(); }

/// Draws a number right-aligned with tabular digits, so that it does not jitter while it changes.
void drawNumber (juce::Graphics&, const juce::String&, juce::Rectangle<float>);

/// Dims what is behind a dialog.
void dimWindow (juce::Graphics&, const Theme&);

/// Draws a box over the window.
void drawCard (juce::Graphics&, const Theme&, juce::Rectangle<int> box);

/// Dims the window, and draws the box of a dialog over it.
void drawDialog (juce::Graphics&, const Theme&, juce::Rectangle<int> box);

}   // namespace tactus::host
