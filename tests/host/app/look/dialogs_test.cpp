// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/look.hpp>

#include "host/app/support/contrast.hpp"

#include <catch2/catch.hpp>

using namespace tactus::host;
using tactus::host::test::contrast;

TEST_CASE ("the text of dialogs can be read in both themes, also in the list of files", "[app][look]")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    for (const auto* theme : { &Theme::dark(), &Theme::light() })
    {
        look.setTheme (*theme);
        const auto check = [&] (int text, int background) {
            INFO (std::hex << text << " on " << background << (theme->is_dark ? " dark" : " light"));
            CHECK (look.findColour (background).isOpaque());
            CHECK (contrast (look.findColour (text), look.findColour (background)) >= 4.5);
        };
        using Files = juce::DirectoryContentsDisplayComponent;
        using Browser = juce::FileBrowserComponent;
        check (Files::textColourId, juce::ListBox::backgroundColourId);
        check (Files::textColourId, juce::ResizableWindow::backgroundColourId);
        check (Files::highlightedTextColourId, Files::highlightColourId);
        check (Browser::currentPathBoxTextColourId, Browser::currentPathBoxBackgroundColourId);
        check (Browser::filenameBoxTextColourId, Browser::filenameBoxBackgroundColourId);
        check (juce::TextButton::textColourOffId, juce::TextButton::buttonColourId);
        check (juce::TextButton::textColourOnId, juce::TextButton::buttonOnColourId);
        check (juce::AlertWindow::textColourId, juce::AlertWindow::backgroundColourId);
        check (juce::TextEditor::textColourId, juce::TextEditor::backgroundColourId);
        check (juce::ComboBox::textColourId, juce::ComboBox::backgroundColourId);
        check (juce::PopupMenu::textColourId, juce::PopupMenu::backgroundColourId);
        check (juce::FileChooserDialogBox::titleTextColourId, juce::ResizableWindow::backgroundColourId);
        check (juce::Label::textColourId, juce::ResizableWindow::backgroundColourId);
    }
}
