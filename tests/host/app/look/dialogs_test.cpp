// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/look.hpp>

#include "host/app/support/contrast.hpp"
#include "host/app/support/window_rig.hpp"

#include <catch2/catch.hpp>

using namespace tactus::host;
using tactus::host::test::contrast;
using tactus::host::test::WindowRig;

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

TEST_CASE ("the dialog for files has a border all around, and the window behind it is dimmed while it is open, but not STOP", "[app][look]")
{
    WindowRig w ("dry_wood.json");
    const auto brightness = [] (const juce::Image& image, juce::Rectangle<int> area) {
        double sum = 0.0;
        for (int y = area.getY(); y < area.getBottom(); ++y)
            for (int x = area.getX(); x < area.getRight(); ++x)
                sum += static_cast<double> (image.getPixelAt (x, y).getBrightness());
        return sum / (area.getWidth() * area.getHeight());
    };
    const auto safety = w.stage->getLocalBounds().withHeight (SafetyStrip::height), corner = w.stage->getLocalBounds().withTop (660).withRight (300);
    const auto before = w.stage->painted();

    juce::FileBrowserComponent files (juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles,
                                      juce::File (TACTUS_SOURCE_DIR "/graphs"), nullptr, nullptr);
    juce::FileChooserDialogBox box ("Open", {}, files, false, themeOf (*w.view).panel, w.stage.get());
    box.setBounds (340, 110, 600, 500);
    box.enterModalState (false);
    WindowRig::settle (200);
    const auto open = w.stage->painted();
    CHECK (brightness (open, corner) < 0.7 * brightness (before, corner));
    CHECK (brightness (open, safety) > 0.9 * brightness (before, safety));

    const auto picture = box.createComponentSnapshot (box.getLocalBounds());
    const auto inside = themeOf (*w.view).panel;
    for (const auto at : { juce::Point (0, 250), juce::Point (599, 250), juce::Point (300, 0), juce::Point (300, 499) })
        CHECK (contrast (picture.getPixelAt (at.x, at.y), inside) > 1.5);
    CHECK (contrast (picture.getPixelAt (2, 250), inside) < 1.05);

    box.exitModalState (0);
    box.setVisible (false);
    WindowRig::settle (200);
    CHECK (brightness (w.stage->painted(), corner) > 0.9 * brightness (before, corner));   // pictures of presets may have come meanwhile
}
