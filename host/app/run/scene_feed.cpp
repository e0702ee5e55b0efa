// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_feed.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{

void SceneFeed::watch (bool w)
{
    if (std::exchange (is_watched, w) == w) return;
    every.store (is_watched ? spacing : 0, std::memory_order_relaxed);
    if (is_watched && onWatched) onWatched();
    wantPorts();
}

void SceneFeed::wantPorts()
{
    auto ports = is_watched ? scene::portsOf (all, ProbeRing::most) : std::vector<std::string> {};
    if (ports == wanted) return;
    wanted = std::move (ports);
    if (onWanted) onWanted();
}

void SceneFeed::show (const Plan* plan)
{
    if (! is_watched) return;
    all = plan != nullptr ? scene::bodiesOf (*plan) : std::vector<scene::Body> {};
    static std::uint64_t latest = 0;
    shown = ++latest;
}

void SceneFeed::clear()
{
    values.clear();
    tools.store ({});
}

void SceneFeed::planComes (const Plan& plan)
{
    constexpr std::size_t most_plans = 8;
    std::vector<std::size_t> chosen;
    std::vector<std::string> chosen_names;
    for (std::size_t i = 0; i < plan.taps().size() && chosen.size() < ProbeRing::most; ++i)
        if (std::ranges::any_of (wanted, [&] (const std::string& port) { return isPartOf (plan.taps()[i].name, port); }))
        {
            chosen.push_back (i);
            chosen_names.push_back (plan.taps()[i].name);
        }
    const auto interval = static_cast<std::uint32_t> (std::max (1.0, plan.rateHz() / pictures_per_second));
    if (chosen != taps || chosen_names != names || interval != spacing)
    {
        ring.drain ([] (const ProbeRing::Frame&) {});
        selected.clear();
        taps = std::move (chosen);
        names = std::move (chosen_names);
        spacing = interval;
        std::erase_if (values, [this] (const auto& value) { return std::ranges::count (names, value.first) == 0; });
        ring.select (taps, interval);
    }
    selected.push_back (plan.serial());
    if (selected.size() > most_plans) selected.erase (selected.begin());
    auto& of_plan = roles[plan.serial()];
    of_plan.clear();
    for (const auto& r : plan.roles())
        of_plan.push_back (! hasPlace || hasPlace (r.name) ? r.name : std::string {});
    if (roles.size() > most_plans) roles.erase (roles.begin());
    every.store (is_watched ? interval : 0, std::memory_order_relaxed);
}

void SceneFeed::after (const Plan& plan, std::uint64_t tick, bool) noexcept
{
    const auto interval = every.load (std::memory_order_relaxed);
    if (interval == 0 || tick % interval != 0) return;
    ring.note (plan, tick);
    Tools t { .plan = plan.serial(), .count = std::min (plan.roles().size(), most_tools) };
    for (std::size_t i = 0; i < t.count; ++i)
    {
        const auto& device = *plan.roles()[i].state;
        const auto &p = device.reading.position, &f = device.applied.force;
        t.values[i] = { p.x(), p.y(), p.z(), f.x(), f.y(), f.z() };
    }
    tools.store (t);
}

scene::SceneState SceneFeed::now()
{
    wantPorts();
    ring.drain ([this] (const ProbeRing::Frame& frame) {
        if (std::ranges::count (selected, frame.plan) == 0 || frame.size != names.size()) return;
        for (std::size_t i = 0; i < frame.size; ++i)
            values[names[i]] = frame.values[i];
    });
    scene::SceneState now;
    const auto t = tools.load();
    const auto of_plan = roles.find (t.plan);
    if (of_plan == roles.end()) return now;
    for (std::size_t i = 0; i < t.count && i < of_plan->second.size(); ++i)
    {
        if (of_plan->second[i].empty()) continue;
        scene::Tool tool { of_plan->second[i], Vec3 (t.values[i].data()), Vec3 (t.values[i].data() + 3) };
        constexpr double far = 100.0;   // m; an unstable loop may throw the tool anywhere
        if (isFinite (tool.position, tool.force) && tool.position.norm() < far) now.tools.push_back (std::move (tool));
    }
    now.live = scene::liveOf (all, [this] (const std::string& component) {
        const auto found = values.find (component);
        return found == values.end() ? std::nullopt : std::optional (found->second);
    });
    return now;
}

}   // namespace tactus::host
