// SPDX-License-Identifier: GPL-3.0-or-later
#include "template_row.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>
#include <array>

namespace tactus::host
{

namespace
{
constexpr int between = 8, title_height = 20, button_height = 28, line_step = button_height + between;
}

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

/// The buttons line by line, each line no wider than this, if it has more than one button.
std::vector<std::vector<PlainButton*>> TemplateRow::linesFor (int width) const
{
    std::vector<std::vector<PlainButton*>> lines;
    int left = 0;
    for (const auto& b : buttons)
    {
        const int needs = b->widthFor() + between;
        if (lines.empty() || needs > left + between)
        {
            lines.emplace_back();
            left = width;
        }
        lines.back().push_back (b.get());
        left -= needs;
    }
    return lines;
}

int TemplateRow::heightFor (int width) const { return title_height + line_step * static_cast<int> (linesFor (width).size()); }

void TemplateRow::resized()
{
    auto area = getLocalBounds().withTrimmedTop (title_height);
    for (const auto& line : linesFor (getWidth()))
    {
        int width = -between;
        for (const auto* b : line)
            width += b->widthFor() + between;
        auto place = area.removeFromTop (line_step);
        place = place.withSizeKeepingCentre (std::min (width, place.getWidth()), place.getHeight()).removeFromTop (button_height);
        for (auto* b : line)
        {
            b->setBounds (place.removeFromLeft (std::min (place.getWidth(), b->widthFor())));
            place.removeFromLeft (between);
        }
    }
}

void TemplateRow::paint (juce::Graphics& g)
{
    if (buttons.empty()) return;
    const auto& look = lookOf (*this);
    g.setColour (look.theme().dim);
    g.setFont (look.font (14.0f));
    g.drawText (TRANS ("Or begin with one of these:"), getLocalBounds().removeFromTop (title_height), juce::Justification::centred, true);
}

}   // namespace tactus::host
