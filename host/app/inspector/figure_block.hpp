// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "block.hpp"
#include "plot_box.hpp"

#include <functional>
#include <variant>

namespace tactus::host
{

/// A figure of what a setting holds, or why there is none.
class FigureBlock final : public Block
{
public:
    using Shown = std::variant<Figure, std::string>;

    explicit FigureBlock (std::function<Shown()> g) : get (std::move (g)) {}

    int heightFor (int) override { return 132; }

    void refresh (const graph::Node*) override
    {
        shown = get();
        repaint();
    }

    const Shown& figure() const noexcept { return shown; }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        const auto area = getLocalBounds().reduced (0, 4).toFloat();
        const auto* f = std::get_if<Figure> (&shown);
        paintFigure (g, area, f != nullptr ? *f : Figure {}, look);
        const auto* why = std::get_if<std::string> (&shown);
        if (why == nullptr || why->empty()) return;
        juce::AttributedString s;
        s.append (juce::String::fromUTF8 (why->c_str()), look.font (12.0f), look.theme().dim);
        s.setJustification (juce::Justification::centred);
        s.draw (g, area.reduced (12.0f));
    }

private:
    std::function<Shown()> get;
    Shown shown;
};

}   // namespace tactus::host
