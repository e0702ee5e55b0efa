// SPDX-License-Identifier: GPL-3.0-or-later
#include "route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::host
{

namespace
{
constexpr float clearance = 12.0f, bend = 24.0f;

void curveTo (juce::Path& path, juce::Point<float> from, juce::Point<float> to)
{
    const float reach = std::clamp (std::abs (to.x - from.x) / 2, bend, 160.0f);
    path.cubicTo (from.translated (reach, 0.0f), to.translated (-reach, 0.0f), to);
}
}   // namespace

PathPoints::PathPoints (const juce::Path& path)
{
    constexpr float step = 8.0f;
    float next = 0.0f;   // the distance to the next point, from the start of the piece
    for (juce::PathFlatteningIterator i (path); i.next();)
    {
        const juce::Point<float> a (i.x1, i.y1), way { i.x2 - i.x1, i.y2 - i.y1 };
        const float length = way.getDistanceFromOrigin();
        for (; next < length; next += step)
            points.push_back (a + way * (next / length));
        next -= length;
    }
    for (std::size_t i = 0; i < points.size(); i += in_group)
        groups.push_back (juce::Rectangle<float>::findAreaContainingPoints (points.data() + i, static_cast<int> (std::min (in_group, points.size() - i))));
}

bool PathPoints::areIn (juce::Rectangle<float> box) const
{
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
        const auto& area = groups[g];   // may have no width or height, so that intersects() does not do
        if (area.getX() > box.getRight() || area.getRight() < box.getX() || area.getY() > box.getBottom() || area.getBottom() < box.getY()) continue;
        const auto end = std::min (points.size(), (g + 1) * in_group);
        for (auto i = g * in_group; i < end; ++i)
            if (box.contains (points[i])) return true;
    }
    return false;
}

juce::Path curveThrough (juce::Point<float> from, const std::vector<juce::Point<float>>& by, juce::Point<float> to)
{
    juce::Path path;
    path.startNewSubPath (from);
    if (to.x < from.x && by.size() == 2)
    {
        // A wire that runs back: out to the right, down, left below the nodes, up, and in from the left.
        const auto low_right = by[0], low_left = by[1];
        path.cubicTo (from.translated (2 * bend, 0.0f), { low_right.x + 2 * bend, low_right.y }, low_right);
        path.lineTo (low_left);
        path.cubicTo ({ low_left.x - 2 * bend, low_left.y }, to.translated (-2 * bend, 0.0f), to);
        return path;
    }
    auto last = from;
    for (const auto& p : by)
    {
        curveTo (path, last, p);
        last = p;
    }
    curveTo (path, last, to);
    return path;
}

juce::Path curveThroughBends (juce::Point<float> from, const std::vector<juce::Point<float>>& by, juce::Point<float> to)
{
    std::vector<juce::Point<float>> all { from };
    all.insert (all.end(), by.begin(), by.end());
    all.push_back (to);
    const auto last = all.size() - 1;
    // The direction at a point is that from the one before it to the one after it. The longer way from it is not curved more than the shorter one.
    const auto reachAt = [&] (std::size_t i) {
        const auto before = i > 0 ? all[i].getDistanceFrom (all[i - 1]) : 0.0f, after = i < last ? all[i].getDistanceFrom (all[i + 1]) : 0.0f;
        if (i == 0 || i == last) return juce::Point<float> (std::max (bend, std::max (before, after)) / 3.0f, 0.0f);
        const auto along = all[i + 1] - all[i - 1];
        const float length = along.getDistanceFromOrigin();
        return length > 0.0f ? along * (std::min (before, after) / (3.0f * length)) : juce::Point<float>();
    };
    juce::Path path;
    path.startNewSubPath (from);
    for (std::size_t i = 0; i < last; ++i)
        path.cubicTo (all[i] + reachAt (i), all[i + 1] - reachAt (i + 1), all[i + 1]);
    return path;
}

namespace
{
/// The bends of a wire to the right that goes around these boxes, and stays clear of the other obstacles there.
std::vector<juce::Point<float>> bendsAround (std::vector<juce::Rectangle<float>> met, juce::Point<float> from, juce::Point<float> to,
                                             const std::vector<juce::Rectangle<float>>& obstacles)
{
    std::ranges::sort (met, {}, &juce::Rectangle<float>::getX);
    std::vector<juce::Point<float>> by;
    for (std::size_t i = 0; i < met.size();)
    {
        // Go around all boxes of a column together.
        auto box = met[i++];
        while (i < met.size() && met[i].getX() < box.getRight() + 2 * clearance)
            box = box.getUnion (met[i++]);
        const float middle = from.y + (to.y - from.y) * (box.getCentreX() - from.x) / std::max (1.0f, to.x - from.x);
        // Pass on the nearer side, far enough out to clear the other boxes there.
        float above = box.getY() - clearance, below = box.getBottom() + clearance;
        for (int look = 0; look < 4; ++look)
            for (const auto& o : obstacles)
            {
                if (o.getRight() < box.getX() || o.getX() > box.getRight()) continue;
                if (o.getY() < above && o.getBottom() > above) above = o.getY() - clearance;
                if (o.getY() < below && o.getBottom() > below) below = o.getBottom() + clearance;
            }
        const float y = middle - above < below - middle ? above : below;
        by.push_back ({ box.getX(), y });
        by.push_back ({ box.getRight(), y });
    }
    return by;
}
}   // namespace

namespace
{
/// The number of boxes that a path leads through.
int countMet (const juce::Path& path, const std::vector<juce::Rectangle<float>>& boxes)
{
    const PathPoints points (path);
    return static_cast<int> (std::ranges::count_if (boxes, [&] (const juce::Rectangle<float>& box) { return points.areIn (box); }));
}

/// The bends of a wire that runs back to the left: below both nodes, or, if one of them is above the other and would be in the way, between them or above.
std::vector<juce::Point<float>> bendsBack (juce::Point<float> from, juce::Point<float> to, juce::Rectangle<float> start, juce::Rectangle<float> end,
                                           const std::vector<juce::Rectangle<float>>& obstacles)
{
    float low = std::max (start.getBottom(), end.getBottom());
    for (const auto& o : obstacles)   // stay below everything in between
    {
        const bool is_between = o.getX() < from.x && o.getRight() > to.x;
        if (is_between && o.getY() < low + clearance && o.getBottom() > std::min (from.y, to.y)) low = std::max (low, o.getBottom());
    }
    const auto& upper = start.getY() < end.getY() ? start : end;
    const auto& lower = start.getY() < end.getY() ? end : start;
    const float gap = lower.getY() - upper.getBottom();
    std::vector<float> levels { low + 2 * clearance };
    if (gap >= clearance) levels.push_back (upper.getBottom() + gap / 2);
    levels.push_back (upper.getY() - 2 * clearance);
    auto boxes = obstacles;
    boxes.push_back (start.reduced (2.0f));
    boxes.push_back (end.reduced (2.0f));
    std::vector<juce::Point<float>> best;
    int fewest = std::numeric_limits<int>::max();
    for (const float y : levels)
    {
        const std::vector<juce::Point<float>> by { { from.x, y }, { to.x, y } };
        if (const int met = countMet (curveThrough (from, by, to), boxes); met < fewest)
        {
            best = by;
            fewest = met;
        }
        if (fewest == 0) break;
    }
    return best;
}
}   // namespace

std::vector<juce::Point<float>> routeAround (juce::Point<float> from, juce::Point<float> to, juce::Rectangle<float> start, juce::Rectangle<float> end,
                                             const std::vector<juce::Rectangle<float>>& obstacles)
{
    if (to.x < from.x) return bendsBack (from, to, start, end, obstacles);

    // A bend around one box may lead through another one, which then counts as met, too. A box above or below one of the two nodes cannot be
    // avoided there: the wire runs straight past it.
    constexpr int most_looks = 8;
    std::vector<juce::Rectangle<float>> met;
    std::vector<juce::Point<float>> by;
    auto bends_from = from, bends_to = to;
    for (int look = 0; look < most_looks; ++look)
    {
        const auto path = curveThrough (from, by, to);
        const auto reach = path.getBounds().expanded (clearance);
        const PathPoints points (path);
        bool is_clear = true;
        for (const auto& o : obstacles)
        {
            const auto box = o.expanded (2.0f);
            if (! o.intersects (reach) || std::ranges::count (met, box) > 0 || ! points.areIn (box)) continue;
            const bool is_at_start = box.getX() < from.x;
            const bool is_at_end = box.getRight() > to.x;
            if (is_at_start && is_at_end) continue;
            if (is_at_start) bends_from.x = std::max (bends_from.x, box.getRight() + clearance);
            if (is_at_end) bends_to.x = std::min (bends_to.x, box.getX() - clearance);
            if (! is_at_start && ! is_at_end) met.push_back (box);
            is_clear = false;
        }
        if (is_clear || bends_from.x >= bends_to.x) break;
        by = bendsAround (met, bends_from, bends_to, obstacles);
        if (bends_from.x > from.x) by.insert (by.begin(), { from.translated (clearance, 0.0f), bends_from });
        if (bends_to.x < to.x) by.insert (by.end(), { bends_to, to.translated (-clearance, 0.0f) });
    }
    return by;
}

}   // namespace tactus::host
