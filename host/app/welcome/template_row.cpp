// SPDX-License-Identifier: GPL-3.0-or-later
#include "template_row.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>
#include <array>

namespace tactus::host
{

std::vector<Preset> templatesIn (const std::filesystem::path& presets, const Catalogue& catalogue)
{
    constexpr std::array first { "Press", "Stroke", "Tap", "Cut", "Clip" };
    auto all = presets.empty() ? std::vector<Preset>() : presetsIn (presets / "templates", catalogue);
    std::erase_if (all, [] (const Preset& p) { return ! p.problem.empty(); });
    std::ranges::stable_sort (all, {}, [&] (const Preset& p) { return std::ranges::find (first, p.name) - first.begin(); });
    return all;
}

void TemplateRow::show (const std::vector<Preset>& all)
{
    templates = all;
    buttons.clear();
    for (std::size_t i = 0; i < templates.size(); ++i)
    {
        auto& b = *buttons.emplace_back (std::make_unique<PlainButton> (juce::translate (juce::String (templates[i].name))));
        b.setTooltip (juce::String::fromUTF8 (templates[i].about.c_str()));
        b.onClick = [this, i] {
            if (onChoose) onChoose (Preset (templates[i]));
        };
        addAndMakeVisible (b);
    }
    resized();
}

void TemplateRow::resized()
{
    constexpr int gap = 8, row = 28;
    auto area = getLocalBounds().withTrimmedTop (20);
    int width = -gap;
    for (const auto& b : buttons)
        width += b->widthFor() + gap;
    area = area.withSizeKeepingCentre (std::min (width, area.getWidth()), area.getHeight()).removeFromTop (row);
    for (auto& b : buttons)
    {
        b->setBounds (area.removeFromLeft (std::min (area.getWidth(), b->widthFor())));
        area.removeFromLeft (gap);
    }
}

void TemplateRow::paint (juce::Graphics& g)
{
    if (buttons.empty()) return;
    const auto& look = lookOf (*this);
    g.setColour (look.theme().dim);
    g.setFont (look.font (14.0f));
    g.drawText (TRANS ("Or begin with one of these:"), getLocalBounds().removeFromTop (20), juce::Justification::centred, true);
}

}   // namespace tactus::host
