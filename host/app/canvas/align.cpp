// SPDX-License-Identifier: GPL-3.0-or-later
#include "align.hpp"

#include <algorithm>
#include <numeric>

namespace tactus::host
{

namespace
{
constexpr float least_gap = 16.0f;

/// Spaces the boxes out between the first and the last. Those two stay in place if the others fit between them.
void spread (std::vector<juce::Rectangle<float>>& boxes, bool vertical)
{
    const auto begin = [&] (std::size_t i) { return vertical ? boxes[i].getY() : boxes[i].getX(); };
    const auto size = [&] (std::size_t i) { return vertical ? boxes[i].getHeight() : boxes[i].getWidth(); };
    std::vector<std::size_t> order (boxes.size());
    std::iota (order.begin(), order.end(), std::size_t { 0 });
    std::ranges::stable_sort (order, {}, begin);

    float filled = 0.0f;
    for (const auto i : order)
        filled += size (i);
    const float room = begin (order.back()) + size (order.back()) - begin (order.front()) - filled;
    const float gap = std::max (least_gap, room / static_cast<float> (boxes.size() - 1));
    float at = begin (order.front());
    for (const auto i : order)
    {
        if (vertical)
            boxes[i].setY (at);
        else
            boxes[i].setX (at);
        at += size (i) + gap;
    }
}
}   // namespace

std::vector<juce::Rectangle<float>> aligned (std::vector<juce::Rectangle<float>> boxes, Alignment how)
{
    if (boxes.size() < 2) return boxes;
    auto all = boxes.front();
    for (const auto& b : boxes)
        all = all.getUnion (b);
    switch (how)
    {
    case Alignment::columns:
        spread (boxes, true);
        return boxes;
    case Alignment::rows:
        spread (boxes, false);
        return boxes;
    case Alignment::left:
    case Alignment::right:
    case Alignment::top:
    case Alignment::bottom:
        break;
    }
    for (auto& b : boxes)
    {
        if (how == Alignment::left) b.setX (all.getX());
        if (how == Alignment::right) b.setX (all.getRight() - b.getWidth());
        if (how == Alignment::top) b.setY (all.getY());
        if (how == Alignment::bottom) b.setY (all.getBottom() - b.getHeight());
    }
    return boxes;
}

}   // namespace tactus::host
