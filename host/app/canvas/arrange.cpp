// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrange.hpp"

#include <tactus/kit/at.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace tactus::host
{

namespace
{
constexpr float grid = 8.0f, between_boxes = 32.0f, beside_lane = 16.0f;
constexpr float between_columns = 88.0f, per_wire = 8.0f;   // where many wires pass, columns are further apart
constexpr int few_wires = 2, many_wires = 10;

using Wires = std::vector<std::pair<int, int>>;

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
    Columns (const std::vector<juce::Point<float>>& s, const Wires& forward) : sizes (s), boxes_end (s.size()), column (columnsOf (s.size(), forward))
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
        readSteps();
        stackAll();
        for (int sweep = 0; sweep < sweeps; ++sweep)
            sortByNeighbours (sweep % 2 == 0);
        const bool is_divided = std::ranges::any_of (columns, [this] (const auto& boxes) { return heightOf (boxes) > highest; });
        stackAll (highest);
        for (int sweep = 0; sweep < sweeps && ! is_divided; ++sweep)
            straighten (sweep % 2 == 0);
    }

    const std::vector<juce::Point<float>>& result() const noexcept { return places; }

private:
    static constexpr float lane_height = 8.0f;
    static constexpr int sweeps = 8;
    static constexpr float highest = 6000.0f;   // a higher column cannot be seen as a whole

    std::vector<juce::Point<float>> sizes, places;
    std::size_t boxes_end;   // lanes come after the boxes
    std::vector<int> column;
    Wires steps;   // the wires, cut into pieces that each lead from one column to the next
    std::vector<std::vector<int>> columns;
    std::vector<int> wires_after;   // of each column: how many wires leave it to the right
    std::vector<std::vector<int>> neighbours;

    bool isLane (int b) const { return at (b) >= boxes_end; }
    float gapBelow (int upper, int lower) const { return isLane (upper) || isLane (lower) ? beside_lane : between_boxes; }

    /// With the gaps between the boxes.
    float heightOf (std::span<const int> boxes) const
    {
        float height = 0.0f;
        for (std::size_t i = 0; i < boxes.size(); ++i)
            height += sizes[at (boxes[i])].y + (i == 0 ? 0.0f : gapBelow (boxes[i - 1], boxes[i]));
        return height;
    }

    void readSteps()
    {
        wires_after.assign (columns.size(), 0);
        neighbours.resize (sizes.size());
        for (const auto& [from, to] : steps)
        {
            ++wires_after[at (column[at (from)])];
            neighbours[at (from)].push_back (to);
            neighbours[at (to)].push_back (from);
        }
    }

    float middle (int b) const { return places[at (b)].y + sizes[at (b)].y / 2; }

    /// A column that is higher than `most` is divided into several, side by side.
    void stackAll (float most = std::numeric_limits<float>::max())
    {
        float x = 0.0f;
        for (std::size_t c = 0; c < columns.size(); ++c)
        {
            const std::span<const int> boxes (columns[c]);
            const auto parts = static_cast<std::size_t> (std::ceil (std::max (1.0f, heightOf (boxes) / most)));
            const auto in_each = std::max<std::size_t> (1, (boxes.size() + parts - 1) / parts);
            for (std::size_t i = 0; i < boxes.size(); i += in_each)
                x = stack (boxes.subspan (i, std::min (in_each, boxes.size() - i)), x);
            x += per_wire * static_cast<float> (std::clamp (wires_after[c], few_wires, many_wires) - few_wires);
        }
    }

    /// Stacks boxes from x on; returns where the next column begins.
    float stack (std::span<const int> boxes, float x)
    {
        float widest = 0.0f, y = -heightOf (boxes) / 2;
        for (std::size_t i = 0; i < boxes.size(); ++i)
        {
            const int b = boxes[i];
            if (i > 0) y += gapBelow (boxes[i - 1], b);
            places[at (b)] = { x, y };
            y += sizes[at (b)].y;
            widest = std::max (widest, sizes[at (b)].x);
        }
        return x + widest + between_columns;
    }

    /// Moves the boxes of each column as close to the height of their neighbours as their order and the gaps between them allow: least squares, by
    /// pooling neighbours that would come too close.
    void straighten (bool to_the_right)
    {
        std::vector<float> pull (sizes.size(), 0.0f), count (sizes.size(), 0.0f);
        for (std::size_t i = 0; i < columns.size(); ++i)
        {
            const auto& boxes = columns[to_the_right ? i : columns.size() - 1 - i];
            for (const int b : boxes)
                pull[at (b)] = count[at (b)] = 0.0f;
            for (const int b : boxes)
                for (const int other : neighbours[at (b)])
                {
                    pull[at (b)] += middle (other);
                    count[at (b)] += 1.0f;
                }
            settle (boxes, pull, count);
        }
    }

    void settle (const std::vector<int>& boxes, const std::vector<float>& pull, const std::vector<float>& count)
    {
        struct Pool
        {
            float sum, weight;
            std::size_t size;
            float shift() const { return sum / weight; }
        };
        constexpr float held = 0.1f;   // the weight of a box without neighbours
        std::vector<Pool> pools;
        std::vector<float> offsets;
        float offset = 0.0f;
        for (std::size_t i = 0; i < boxes.size(); ++i)
        {
            const int b = boxes[i];
            if (i > 0) offset += sizes[at (boxes[i - 1])].y + gapBelow (boxes[i - 1], b);
            offsets.push_back (offset);
            const float weight = count[at (b)] > 0.0f ? count[at (b)] : held;
            const float wanted = (count[at (b)] > 0.0f ? pull[at (b)] / count[at (b)] : middle (b)) - sizes[at (b)].y / 2 - offset;
            pools.push_back ({ wanted * weight, weight, 1 });
            while (pools.size() > 1 && pools[pools.size() - 2].shift() > pools.back().shift())
            {
                const auto last = pools.back();
                pools.pop_back();
                pools.back() = { pools.back().sum + last.sum, pools.back().weight + last.weight, pools.back().size + last.size };
            }
        }
        std::size_t i = 0;
        for (const auto& pool : pools)
            for (std::size_t k = 0; k < pool.size; ++k, ++i)
                places[at (boxes[i])].y = pool.shift() + offsets[i];
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
