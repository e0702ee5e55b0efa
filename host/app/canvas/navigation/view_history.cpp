// SPDX-License-Identifier: GPL-3.0-or-later
#include "view_history.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host
{

void ViewHistory::begin (const ViewState& now)
{
    const auto position = document.history().position();
    if (position == seen_position) return;   // it continues the latest step, or a file was saved
    views.resize (position > 0 ? position - 1 : 0, { now, now });
    if (position > 0) views.push_back ({ now, now });
    seen_position = position;
}

void ViewHistory::end (const ViewState& now)
{
    if (! document.isStepping() && seen_position > 0 && seen_position <= views.size()) views[seen_position - 1].after = now;
}

std::optional<ViewState> ViewHistory::step (const ViewState& now)
{
    const auto to = document.history().position();
    const auto from = std::exchange (seen_position, to);
    if (from == to || std::max (from, to) > views.size()) return {};
    const bool undone = to < from;
    const auto& left = undone ? views[from - 1].after : views[from].before;
    const auto& reached = undone ? views[to].before : views[to - 1].after;
    const bool is_there = left.patch == now.patch && left.window == now.window;
    if (! is_there || reached.patch != now.patch || reached.window == left.window) return {};
    return reached;
}

}   // namespace tactus::host
