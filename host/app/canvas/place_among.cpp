// SPDX-License-Identifier: GPL-3.0-or-later
// Where new boxes go among those that stay where they are.
#include "arrange.hpp"
#include "box.hpp"
#include "route.hpp"

#include <tactus/kit/at.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tactus::host
{

namespace
{
constexpr float column_gap = 88.0f, row_gap = 32.0f;   // as in arrange()
constexpr float box_room = 24.0f;                      // between a new box and the others

float onGrid (float v) { return std::round (v / Box::grid) * Box::grid; }

bool isClear (juce::Rectangle<float> box, const std::vector<juce::Rectangle<float>>& others)
{
    const auto area = box.expanded (box_room);
    return std::ranges::none_of (others, [&] (const auto& o) { return o.intersects (area); });
}

/// Visits the heights around one, nearest first, until it returns false.
template <typename Visit>
void eachHeightFrom (float middle, Visit visit)
{
    for (float way = 0.0f;; way += Box::grid)
        if (! visit (middle + way) || (way > 0.0f && ! visit (middle - way))) return;
}

/// Finds the places of new boxes, one after another.
class Among
{
public:
    Among (std::vector<juce::Rectangle<float>>& b, std::vector<bool> p, const std::vector<Lead>& l) : boxes (b), placed (std::move (p)), leads (l) {}

    void run()
    {
        constexpr std::ptrdiff_t most_new = 12;
        constexpr std::size_t most_boxes = 300;
        auto left = std::ranges::count (placed, false);
        is_careful = left <= most_new && boxes.size() <= most_boxes;   // else it would slow down the edit
        for (; left > 0; --left)
        {
            const auto i = next();
            put (i);
            placed[i] = true;
        }
    }

private:
    static constexpr float through_box = 400.0f, through_wire = 80.0f, backwards = 600.0f;   // as bad as a wire that is longer by this

    std::vector<juce::Rectangle<float>>& boxes;
    std::vector<bool> placed;
    const std::vector<Lead>& leads;
    bool is_careful = true;

    /// The next box to place. A box that feeds a placed one comes first, then one whose sources are all placed, so that it gets to their right.
    std::size_t next() const
    {
        for (const auto& l : leads)
            if (! placed[at (l.from)] && placed[at (l.to)]) return at (l.from);
        const auto waits = [&] (int box) {
            return std::ranges::any_of (leads, [&] (const Lead& l) { return l.to == box && l.from != box && ! placed[at (l.from)]; });
        };
        for (const bool may_wait : { false, true })   // true: a loop
            for (const auto& l : leads)
                if (placed[at (l.from)] && ! placed[at (l.to)] && (may_wait || ! waits (l.to))) return at (l.to);
        return at (static_cast<int> (std::ranges::find (placed, false) - placed.begin()));
    }

    void put (std::size_t i)
    {
        auto& box = boxes[i];
        std::vector<Lead> own, others;
        std::vector<juce::Rectangle<float>> taken;
        for (std::size_t k = 0; k < boxes.size(); ++k)
            if (placed[k]) taken.push_back (boxes[k]);
        for (const auto& l : leads)
        {
            const bool leaves = at (l.from) == i, enters = at (l.to) == i;
            if (leaves != enters && placed[at (leaves ? l.to : l.from)]) own.push_back (l);
            if (! leaves && ! enters && placed[at (l.from)] && placed[at (l.to)]) others.push_back (l);
        }
        if (own.empty()) return putBelow (box, taken);

        std::optional<float> after, before;   // what feeds it, and what it feeds
        float sum = 0.0f;
        for (const auto& l : own)
        {
            const bool leaves = at (l.from) == i;
            const auto& other = boxes[at (leaves ? l.to : l.from)];
            sum += other.getY() + (leaves ? l.in.y - l.out.y : l.out.y - l.in.y);
            if (leaves)
                before = std::min (before.value_or (other.getX()), other.getX());
            else
                after = std::max (after.value_or (other.getRight()), other.getRight());
        }
        const float level = onGrid (sum / static_cast<float> (own.size()));
        std::vector<float> columns;
        if (before) columns.push_back (std::floor ((*before - column_gap - box.getWidth()) / Box::grid) * Box::grid);
        if (after) columns.push_back (std::ceil ((*after + column_gap) / Box::grid) * Box::grid);
        if (columns.size() == 2 && columns[1] < columns[0]) columns.push_back (onGrid ((columns[0] + columns[1]) / 2));

        std::vector<std::pair<float, juce::Rectangle<float>>> found;   // with what they cost
        float least = std::numeric_limits<float>::max();
        for (const float x : columns)
            eachHeightFrom (level, [&] (float y) {
                const auto here = box.withPosition (x, y);
                const float length = lengthOf (i, here, own);
                if (length >= least + through_box) return is_careful && std::abs (y - level) < 2 * (least + through_box);
                if (! isClear (here, taken)) return true;
                found.emplace_back (is_careful ? length + obstaclesOf (i, here, own, others) : 0.0f, here);
                least = std::min (least, found.back().first);
                return is_careful;
            });
        std::ranges::stable_sort (found, {}, &std::pair<float, juce::Rectangle<float>>::first);
        box = found.front().second;
        constexpr std::size_t most_tried = 60;   // routes take time
        if (is_careful)
            for (std::size_t k = 0; k < std::min (found.size(), most_tried); ++k)
                if (! isCrossed (i, found[k].second, own)) return void (box = found[k].second);
    }

    /// True if a wire of the new box runs through another one although it goes around what is in its way.
    bool isCrossed (std::size_t i, juce::Rectangle<float> here, const std::vector<Lead>& own) const
    {
        return std::ranges::any_of (own, [&] (const Lead& l) {
            const auto [from, to] = endsOf (l, i, here);
            const auto boxOf = [&] (int box) { return at (box) == i ? here : boxes[at (box)]; };
            std::vector<juce::Rectangle<float>> obstacles;
            for (std::size_t k = 0; k < boxes.size(); ++k)
                if (placed[k] && k != at (l.from) && k != at (l.to)) obstacles.push_back (boxes[k]);
            const auto path = curveThrough (from, routeAround (from, to, boxOf (l.from), boxOf (l.to), obstacles), to);
            const PathPoints points (path);
            return std::ranges::any_of (obstacles, [&] (const auto& o) { return points.areIn (o); });
        });
    }

    static void putBelow (juce::Rectangle<float>& box, const std::vector<juce::Rectangle<float>>& taken)
    {
        float left = std::numeric_limits<float>::max(), low = std::numeric_limits<float>::lowest();
        for (const auto& t : taken)
        {
            left = std::min (left, t.getX());
            low = std::max (low, t.getBottom());
        }
        box.setPosition (std::floor (left / Box::grid) * Box::grid, std::ceil ((low + row_gap) / Box::grid) * Box::grid);
    }

    /// The two ends of a wire, with one of the boxes at another place.
    std::pair<juce::Point<float>, juce::Point<float>> endsOf (const Lead& l, std::size_t moved, juce::Rectangle<float> here) const
    {
        const auto of = [&] (int box) { return at (box) == moved ? here.getPosition() : boxes[at (box)].getPosition(); };
        return { of (l.from) + l.out, of (l.to) + l.in };
    }

    float lengthOf (std::size_t i, juce::Rectangle<float> here, const std::vector<Lead>& own) const
    {
        float sum = 0.0f;
        for (const auto& l : own)
        {
            const auto [from, to] = endsOf (l, i, here);
            sum += from.getDistanceFrom (to) + (to.x < from.x ? backwards : 0.0f);
        }
        return sum;
    }

    float obstaclesOf (std::size_t i, juce::Rectangle<float> here, const std::vector<Lead>& own, const std::vector<Lead>& others) const
    {
        float sum = 0.0f;
        for (const auto& l : own)
        {
            const auto [from, to] = endsOf (l, i, here);
            for (std::size_t k = 0; k < boxes.size(); ++k)
                if (placed[k] && k != at (l.from) && k != at (l.to) && meets (from, to, boxes[k])) sum += through_box;
            for (const auto& o : others)
            {
                const auto [a, b] = endsOf (o, i, here);
                if (juce::Line<float> (from, to).intersects (juce::Line<float> (a, b)) && o.from != l.from && o.to != l.to) sum += through_wire;
            }
        }
        for (const auto& o : others)
        {
            const auto [a, b] = endsOf (o, i, here);
            if (meets (a, b, here.expanded (Box::grid))) sum += through_box;
        }
        return sum;
    }

    /// True if a wire runs through a box.
    static bool meets (juce::Point<float> from, juce::Point<float> to, juce::Rectangle<float> box)
    {
        if (! juce::Rectangle<float> (from, to).expanded (Box::grid).intersects (box)) return false;
        constexpr int pieces = 24;
        for (int k = 0; k <= pieces; ++k)
        {
            // The curve is level at both ends.
            const float t = static_cast<float> (k) / pieces, rise = t * t * (3.0f - 2.0f * t);
            if (box.contains (juce::Point<float> (from.x + t * (to.x - from.x), from.y + rise * (to.y - from.y)))) return true;
        }
        return false;
    }
};
}   // namespace

void placeAmong (std::vector<juce::Rectangle<float>>& boxes, std::vector<bool> placed, const std::vector<Lead>& leads)
{
    Among (boxes, std::move (placed), leads).run();
}

void pushApart (const std::vector<juce::Rectangle<float>>& before, std::vector<juce::Rectangle<float>>& boxes)
{
    std::vector<std::size_t> pushing;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (boxes[i].getRight() > before[i].getRight() || boxes[i].getBottom() > before[i].getBottom()) pushing.push_back (i);
    const auto most = 4 * boxes.size();   // boxes in a ring would push each other for ever
    for (std::size_t n = 0; n < std::min (pushing.size(), most); ++n)
    {
        const auto i = pushing[n];
        for (std::size_t k = 0; k < boxes.size(); ++k)
        {
            const auto &box = boxes[i], &other = boxes[k];
            const float below = before[k].getY() - before[i].getBottom(), beside = before[k].getX() - before[i].getRight();
            const bool is_below = below >= 0.0f && box.getX() < other.getRight() && other.getX() < box.getRight();
            const bool is_beside = beside >= 0.0f && box.getY() < other.getBottom() && other.getY() < box.getBottom();
            if (! is_below && ! is_beside) continue;
            const float least = is_below ? box.getBottom() + std::min (below, box_room) : box.getRight() + std::min (beside, box_room);
            if ((is_below ? other.getY() : other.getX()) > least - 0.5f) continue;
            const float to = std::ceil (least / Box::grid) * Box::grid;
            is_below ? boxes[k].setY (to) : boxes[k].setX (to);
            pushing.push_back (k);
        }
    }
}

juce::Point<float> clearPlace (juce::Rectangle<float> box, const std::vector<juce::Rectangle<float>>& others)
{
    auto found = box.getPosition();
    eachHeightFrom (onGrid (box.getY()), [&] (float y) {
        found = { onGrid (box.getX()), y };
        return ! isClear (box.withPosition (found), others);
    });
    return found;
}

}   // namespace tactus::host
