// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_drawing.hpp"

namespace tactus::host
{

namespace
{
constexpr float line_thickness = 1.5f;
}

void drawTrace (juce::Graphics& g, const Lane& lane, const TraceColumns& columns, double tick_of_zero, double rate_hz, juce::Colour colour)
{
    g.setColour (colour);
    const auto x = [&] (std::size_t i) {
        const double tick = columns.first + static_cast<double> (i) * columns.ticks_each - tick_of_zero;
        return lane.toPixels (tick / rate_hz, lane.y.low).x;
    };
    if (columns.ticks_each <= 1.0)
    {
        juce::Path path;
        bool goes_on = false;
        for (std::size_t i = 0; i < columns.all.size(); ++i)
        {
            const auto& e = columns.all[i].extent;
            if (! e.isEmpty())
            {
                const juce::Point<float> p { x (i), lane.toPixels (lane.x.low, e.low).y };
                goes_on ? path.lineTo (p) : path.startNewSubPath (p);
            }
            goes_on = ! e.isEmpty();
        }
        g.strokePath (path, juce::PathStrokeType (line_thickness));
        return;
    }

    juce::RectangleList<float> spans;
    spans.ensureStorageAllocated (static_cast<int> (columns.all.size()));
    Extent before;
    const float width = x (1) - x (0);
    for (std::size_t i = 0; i < columns.all.size(); ++i)
    {
        const auto own = columns.all[i].extent;
        if (own.isEmpty())
        {
            before = {};
            continue;
        }
        auto e = own;
        if (! before.isEmpty()) e = { std::min (e.low, before.high), std::max (e.high, before.low) };   // joins the previous column
        before = own;
        const float top = lane.toPixels (lane.x.low, e.high).y, bottom = lane.toPixels (lane.x.low, e.low).y;
        spans.addWithoutMerging ({ x (i), top - 0.5f * line_thickness, width, bottom - top + line_thickness });
    }
    g.fillRectList (spans);
}

void drawBetween (juce::Graphics& g, const Lane& lane, const Points& low, const Points& high, juce::Colour colour)
{
    if (low.size() < 2 || low.size() != high.size()) return;
    juce::Path path;
    path.startNewSubPath (lane.toPixels (low.front().x, low.front().y));
    for (std::size_t i = 1; i < low.size(); ++i)
        path.lineTo (lane.toPixels (low[i].x, low[i].y));
    for (std::size_t i = high.size(); i-- > 0;)
        path.lineTo (lane.toPixels (high[i].x, high[i].y));
    path.closeSubPath();
    g.setColour (colour);
    g.fillPath (path);
}

}   // namespace tactus::host
