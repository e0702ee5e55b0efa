// SPDX-License-Identifier: GPL-3.0-or-later
// How JUCE's dialog for files looks.
#include "look.hpp"

namespace tactus::host
{

namespace
{
/// A sheet of paper, or a folder, in a square of 16 by 16.
juce::Path fileIcon (bool is_folder)
{
    juce::Path p;
    if (is_folder)
    {
        p.startNewSubPath (1.5f, 13.0f);
        p.lineTo (1.5f, 3.0f);
        p.lineTo (6.0f, 3.0f);
        p.lineTo (7.5f, 5.0f);
        p.lineTo (14.5f, 5.0f);
        p.lineTo (14.5f, 13.0f);
        p.closeSubPath();
        return p;
    }
    p.startNewSubPath (3.0f, 1.5f);
    p.lineTo (9.5f, 1.5f);
    p.lineTo (13.0f, 5.0f);
    p.lineTo (13.0f, 14.5f);
    p.lineTo (3.0f, 14.5f);
    p.closeSubPath();
    p.startNewSubPath (9.5f, 1.5f);
    p.lineTo (9.5f, 5.0f);
    p.lineTo (13.0f, 5.0f);
    return p;
}
}   // namespace

void Look::drawResizableWindowBorder (juce::Graphics& g, int width, int height, const juce::BorderSize<int>&, juce::ResizableWindow& window)
{
    if (const auto* document = dynamic_cast<juce::DocumentWindow*> (&window); document != nullptr && document->isUsingNativeTitleBar()) return;
    g.setColour (theme().hairline.interpolatedWith (theme().dim, 0.4f));   // what is behind has hairlines, too
    g.drawRect (0, 0, width, height);
}

void Look::drawCornerResizer (juce::Graphics& g, int width, int height, bool over, bool dragging)
{
    g.setColour (over || dragging ? theme().text : theme().dim);
    const float w = static_cast<float> (width), h = static_cast<float> (height);
    for (const float d : { 5.0f, 9.0f })
        g.drawLine (w - d, h - 3.0f, w - 3.0f, h - d, 1.0f);
}

void Look::layoutFileBrowserComponent (juce::FileBrowserComponent& all, juce::DirectoryContentsDisplayComponent* list, juce::FilePreviewComponent* preview,
                                       juce::ComboBox* folder, juce::TextEditor* name, juce::Button* up)
{
    constexpr int row = 28, gap = 8, label_width = 40;
    auto area = all.getLocalBounds().reduced (20, 4);
    auto top = area.removeFromTop (row), low = area.removeFromBottom (row);
    up->setBounds (top.removeFromRight (40));
    folder->setBounds (top.withTrimmedRight (gap));
    name->setIndents (8, 6);
    name->setBounds (low.withTrimmedLeft (label_width));   // its label is to the left
    if (preview != nullptr) preview->setBounds (area.removeFromRight (area.getWidth() / 3));
    if (auto* shown = dynamic_cast<juce::Component*> (list)) shown->setBounds (area.reduced (0, gap));
}

void Look::drawFileBrowserRow (juce::Graphics& g, int width, int height, const juce::File&, const juce::String& name, juce::Image*,
                               const juce::String& size, const juce::String& time, bool is_folder, bool is_selected, int,
                               juce::DirectoryContentsDisplayComponent&)
{
    constexpr int margin = 8, icon_width = 24, size_width = 72, time_width = 128, least_name = 200;
    if (is_selected)
    {
        g.setColour (theme().accent.withAlpha (0.25f));
        g.fillRoundedRectangle (juce::Rectangle<int> (width, height).toFloat().reduced (1.0f), 4.0f);
    }
    auto area = juce::Rectangle<int> (width, height).reduced (margin, 0);
    g.setColour (is_folder ? theme().accent : theme().dim);
    const auto icon = area.removeFromLeft (icon_width).toFloat();
    g.strokePath (fileIcon (is_folder), juce::PathStrokeType (1.2f), juce::AffineTransform::translation (icon.getX(), icon.getCentreY() - 8.0f));
    if (! is_folder && area.getWidth() >= least_name + size_width + time_width)
    {
        g.setFont (font (12.0f));
        g.setColour (theme().dim);
        g.drawText (time, area.removeFromRight (time_width), juce::Justification::centredRight, false);
        g.drawText (size, area.removeFromRight (size_width), juce::Justification::centredRight, false);
        area.removeFromRight (margin);
    }
    g.setFont (font (13.0f));
    g.setColour (theme().text);
    g.drawText (name, area, juce::Justification::centredLeft, true);
}

}   // namespace tactus::host
