// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cut_line.hpp"

#include <vector>

namespace tactus::host
{

/// A grid of squares over a picture, some of which are marked to be painted again. A region of many small rectangles takes long to make and to paint.
class Squares
{
public:
    Squares() = default;
    Squares (int width, int height) : area (width, height), is_marked (static_cast<std::size_t> (columns() * rows())) {}

    std::size_t size() const noexcept { return is_marked.size(); }
    std::size_t count() const { return static_cast<std::size_t> (std::ranges::count (is_marked, true)); }
    void markAll (bool marked) { is_marked.assign (is_marked.size(), marked); }

    /// Marks what is painted on a path and up to `around` beside it: much less than the bounds of a wire, which most other wires of a large patch cross.
    void markAlong (juce::PathFlatteningIterator&& line, float around)
    {
        const auto numberOf = [] (float x) { return static_cast<int> (std::floor (x / side)); };
        cutLines (std::move (line), area.toFloat().expanded (around), side, [&] (const CutLine& cut) {
            for (int i = 0; i < cut.parts; ++i)
            {
                const auto piece = juce::Rectangle<float> (cut.at (i), cut.at (i + 1)).expanded (around);
                for (int y = std::max (0, numberOf (piece.getY())); y <= std::min (rows() - 1, numberOf (piece.getBottom())); ++y)
                    for (int x = std::max (0, numberOf (piece.getX())); x <= std::min (columns() - 1, numberOf (piece.getRight())); ++x)
                        is_marked[static_cast<std::size_t> (y * columns() + x)] = true;
            }
        });
    }

    /// The marked squares, those side by side as one rectangle.
    juce::RectangleList<int> marked() const
    {
        juce::RectangleList<int> all;
        for (int y = 0; y < rows(); ++y)
            for (int x = 0, first = 0; x <= columns(); ++x)
                if (x == columns() || ! is_marked[static_cast<std::size_t> (y * columns() + x)])
                {
                    if (x > first) all.addWithoutMerging ({ side * first, side * y, side * (x - first), side });
                    first = x + 1;
                }
        all.clipTo (area);
        return all;
    }

private:
    static constexpr int side = 32;   // pixels

    int columns() const noexcept { return (area.getWidth() + side - 1) / side; }
    int rows() const noexcept { return (area.getHeight() + side - 1) / side; }

    juce::Rectangle<int> area;
    std::vector<bool> is_marked;   // row after row
};

}   // namespace tactus::host
