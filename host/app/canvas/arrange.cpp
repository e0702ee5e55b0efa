// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace tactus::host
{

namespace
{
constexpr float between_columns = 72.0f, between_boxes = 24.0f, grid = 8.0f;

using Wires = std::vector<std::pair<int, int>>;

std::size_t at (int i) { return static_cast<std::size_t> (i); }

/// Drops the wires that close a loop, by depth-first search from the first box.
Wires withoutLoops (std::size_t size, const Wires& wires)
{
    std::vector<std::vector<int>> next (size);
    for (const auto& [from, to] : wires)
        if (from != to) next[at (from)].push_back (to);

    enum class Mark
    {
        fresh,
        open,
        done
    };
    std::vector<Mark> mark (size, Mark::fresh);
    Wires kept;
    for (int start = 0; start < static_cast<int> (size); ++start)
    {
        if (mark[at (start)] != Mark::fresh) continue;
        std::vector<std::pair<int, std::size_t>> stack { { start, 0 } };
        mark[at (start)] = Mark::open;
        while (! stack.empty())
        {
            const auto [box, i] = stack.back();
            if (i == next[at (box)].size())
            {
                mark[at (box)] = Mark::done;
                stack.pop_back();
                continue;
            }
            ++stack.back().second;
            const int to = next[at (box)][i];
            if (mark[at (to)] == Mark::open) continue;
            kept.emplace_back (box, to);
            if (mark[at (to)] == Mark::fresh)
            {
                mark[at (to)] = Mark::open;
                stack.emplace_back (to, 0);
            }
        }
    }
    return kept;
}

std::vector<int> columnsOf (std::size_t size, const Wires& wires)
{
    std::vector<int> waiting (size, 0), column (size, 0), ready;
    std::vector<std::vector<int>> next (size);
    for (const auto& [from, to] : wires)
    {
        next[at (from)].push_back (to);
        ++waiting[at (to)];
    }
    for (int i = 0; i < static_cast<int> (size); ++i)
        if (waiting[at (i)] == 0) ready.push_back (i);
    for (std::size_t i = 0; i < ready.size(); ++i)
        for (const int to : next[at (ready[i])])
        {
            column[at (to)] = std::max (column[at (to)], column[at (ready[i])] + 1);
            if (--waiting[at (to)] == 0) ready.push_back (to);
        }

    // Moves a source next to its nearest destination.
    for (auto box = ready.rbegin(); box != ready.rend(); ++box)
    {
        const bool is_source = std::ranges::none_of (wires, [&] (const auto& w) { return w.second == *box; });
        if (! is_source || next[at (*box)].empty() || column[at (*box)] > 0) continue;
        int nearest = column[at (next[at (*box)].front())];
        for (const int to : next[at (*box)])
            nearest = std::min (nearest, column[at (to)]);
        column[at (*box)] = std::max (0, nearest - 1);
    }
    return column;
}

/// Boxes in columns, plus an empty lane in each column that a wire crosses.
class Columns
{
public:
    Columns (const std::vector<juce::Point<float>>& s, const Wires& forward) : sizes (s), column (columnsOf (s.size(), forward))
    {
        for (const auto& [from, to] : forward)
        {
            int last = from;
            for (int c = column[at (from)] + 1; c < column[at (to)]; ++c)
            {
                sizes.emplace_back (0.0f, lane_height);
                column.push_back (c);
                steps.emplace_back (last, static_cast<int> (sizes.size()) - 1);
                last = steps.back().second;
            }
            steps.emplace_back (last, to);
        }
        columns.resize (at (*std::ranges::max_element (column)) + 1);
        for (int i = 0; i < static_cast<int> (sizes.size()); ++i)
            columns[at (column[at (i)])].push_back (i);
        places.resize (sizes.size());
        stackAll();
        for (int sweep = 0; sweep < sweeps; ++sweep)
            sortByNeighbours (sweep % 2 == 0);
        stackAll (highest);
    }

    const std::vector<juce::Point<float>>& result() const noexcept { return places; }

private:
    static constexpr float lane_height = 16.0f;
    static constexpr int sweeps = 8;
    static constexpr float highest = 6000.0f;   // a higher column cannot be seen as a whole

    std::vector<juce::Point<float>> sizes, places;
    std::vector<int> column;
    Wires steps;   // the wires, cut into pieces that each lead from one column to the next
    std::vector<std::vector<int>> columns;

    float middle (int b) const { return places[at (b)].y + sizes[at (b)].y / 2; }

    /// A column that is higher than `most` is divided into several, side by side.
    void stackAll (float most = std::numeric_limits<float>::max())
    {
        float x = 0.0f;
        for (const auto& boxes : columns)
        {
            float height = 0.0f;
            for (const int b : boxes)
                height += sizes[at (b)].y + between_boxes;
            const auto parts = static_cast<std::size_t> (std::ceil (std::max (1.0f, height / most)));
            const auto in_each = std::max<std::size_t> (1, (boxes.size() + parts - 1) / parts);
            for (std::size_t i = 0; i < boxes.size(); i += in_each)
                x = stack (std::span (boxes).subspan (i, std::min (in_each, boxes.size() - i)), x);
        }
    }

    /// Stacks boxes from x on; returns where the next column begins.
    float stack (std::span<const int> boxes, float x)
    {
        float widest = 0.0f, y = between_boxes / 2;
        for (const int b : boxes)
        {
            widest = std::max (widest, sizes[at (b)].x);
            y -= (sizes[at (b)].y + between_boxes) / 2;
        }
        for (const int b : boxes)
        {
            places[at (b)] = { x, y };
            y += sizes[at (b)].y + between_boxes;
        }
        return x + widest + between_columns;
    }

    void sortByNeighbours (bool on_the_left)
    {
        std::vector<float> pull (sizes.size(), 0.0f);
        std::vector<int> count (sizes.size(), 0);
        for (const auto& [from, to] : steps)
        {
            const int moved = on_the_left ? to : from, fixed = on_the_left ? from : to;
            pull[at (moved)] += middle (fixed);
            ++count[at (moved)];
        }
        for (auto& boxes : columns)
            std::ranges::stable_sort (boxes, {}, [&] (int b) { return count[at (b)] > 0 ? pull[at (b)] / static_cast<float> (count[at (b)]) : middle (b); });
        stackAll();
    }
};
}   // namespace

std::vector<juce::Point<float>> arrange (const std::vector<juce::Point<float>>& sizes, const Wires& wires)
{
    if (sizes.empty()) return {};
    auto places = Columns (sizes, withoutLoops (sizes.size(), wires)).result();
    places.resize (sizes.size());
    float top = 0.0f;
    for (const auto& p : places)
        top = std::min (top, p.y);
    for (auto& p : places)
        p = { std::round (p.x / grid) * grid, std::round ((p.y - top) / grid) * grid };
    return places;
}

}   // namespace tactus::host
