// SPDX-License-Identifier: GPL-3.0-or-later
#include "appearance.hpp"

#include <host/app/storage/settings.hpp>

namespace tactus::host
{

namespace
{
void colourDialogs (Look& look)
{
    using Browser = juce::FileBrowserComponent;
    using Files = juce::DirectoryContentsDisplayComponent;
    const auto& theme = look.theme();
    const auto set = [&look] (std::initializer_list<int> ids, juce::Colour colour) {
        for (const int id : ids)
            look.setColour (id, colour);
    };
    set ({ juce::AlertWindow::backgroundColourId }, theme.panel);
    set ({ juce::ListBox::backgroundColourId, juce::ComboBox::backgroundColourId }, theme.raised);
    set ({ juce::TextButton::buttonColourId, juce::TextButton::buttonOnColourId }, theme.raised);
    set ({ Browser::currentPathBoxBackgroundColourId, Browser::filenameBoxBackgroundColourId }, theme.raised);
    set ({ juce::ListBox::outlineColourId, juce::AlertWindow::outlineColourId, juce::ComboBox::outlineColourId }, theme.hairline);
    set ({ juce::ListBox::textColourId, juce::AlertWindow::textColourId, juce::DrawableButton::textColourId }, theme.text);
    set ({ juce::TextButton::textColourOffId, juce::TextButton::textColourOnId, juce::FileChooserDialogBox::titleTextColourId }, theme.text);
    set ({ Files::textColourId, Files::highlightedTextColourId, Browser::currentPathBoxTextColourId, Browser::filenameBoxTextColourId }, theme.text);
    set ({ Browser::currentPathBoxArrowColourId }, theme.dim);
    set ({ Files::highlightColourId }, theme.accent.withAlpha (0.25f));
}

void recolourEditors (juce::Component& c, const Theme& theme)
{
    if (auto* editor = dynamic_cast<juce::TextEditor*> (&c))
    {
        editor->applyColourToAllText (theme.text);
        editor->setTextToShowWhenEmpty (editor->getTextToShowWhenEmpty(), theme.dim);
    }
    for (auto* child : c.getChildren())
        recolourEditors (*child, theme);
}
}   // namespace

void applyTheme (juce::Component& window, const Theme& theme)
{
    auto& look = lookOf (window);
    look.setTheme (theme);
    colourDialogs (look);
    window.sendLookAndFeelChange();
    recolourEditors (window, look.theme());
    window.repaint();
}

void applyScale (double scale)
{
    auto& desktop = juce::Desktop::getInstance();
    const auto* display = desktop.getDisplays().getPrimaryDisplay();
    if (display == nullptr) return;
    const auto height = juce::roundToInt (static_cast<float> (display->totalArea.getHeight()) * desktop.getGlobalScaleFactor());
    desktop.setGlobalScaleFactor (static_cast<float> (scale > 0.0 ? scale : automaticScale (height)));
}

}   // namespace tactus::host
