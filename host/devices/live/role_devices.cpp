// SPDX-License-Identifier: MIT
#include "role_devices.hpp"

#include <tactus/run/guard/included_guards.hpp>
#include <tactus/text/message.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::host
{

const DeviceOption* RoleDevices::givenTo (const std::string& role) const
{
    const auto at = std::ranges::find (choice.given, role, &DeviceOption::role);
    return at != choice.given.end() ? &*at : nullptr;
}

std::optional<RoleBinding> RoleDevices::boundTo (const std::string& role) const
{
    return choice.is_by_graph && choice.is_by_graph (role) ? std::nullopt : bindingOf (choice.session, role);
}

std::vector<Described> RoleDevices::describe (const graph::Graph& graph) const
{
    const auto named = rolesNamed (graph);
    std::vector<std::string> roles;   // those that the graph describes come first
    for (const auto& [role, description] : graph.devices)
        if (std::ranges::count (named, role) > 0) roles.push_back (role);
    for (const auto& role : named)
        if (std::ranges::count (roles, role) == 0) roles.push_back (role);

    std::vector<Described> all;
    for (const auto& role : roles)
    {
        Messages told_when_opened;
        if (const auto* given = givenTo (role))
            all.emplace_back (role, given->description);
        else if (const auto bound = boundTo (role))
            all.emplace_back (role, bound->description);
        else
            all.emplace_back (role, describedByGraph (graph.device (role), role, told_when_opened));
    }
    return all;
}

ClockChoice RoleDevices::chooseClock (const graph::Graph& graph, const std::string& asked, std::optional<double> rate_hz) const
{
    const auto rateOf = [&] (const Described& d, bool may_wait) {
        const bool is_bound = givenTo (d.first) == nullptr && boundTo (d.first);
        return hardware.tickRate (d.second, may_wait && is_bound && choice.absence == Absence::waits);
    };
    auto chosen = host::chooseClock ({ asked, choice.session.session.clock(), rate_hz }, describe (graph), rateOf);
    for (auto& m : chosen.messages)
        if (m.id == "session/clock") place (m, choice.session);
    return chosen;
}

Run::RoleDevice RoleDevices::open (const std::string& role, const graph::Graph& graph, const Plan& plan, Messages& messages)
{
    if (givenTo (role) == nullptr)
        if (const auto binding = boundTo (role)) return openBound (role, *binding, plan, messages);
    return openOther (role, graph, plan, messages);
}

Run::RoleDevice RoleDevices::openBound (const std::string& role, const RoleBinding& binding, const Plan& plan, Messages& messages)
{
    const auto openOne = [&] (const Json& description, const std::filesystem::path& from) { return hardware.open (description, from, role, plan); };
    auto bound = host::openBound (choice.session, role, binding, openOne, hardware.system(), hardware.profiles(), choice.absence);
    std::ranges::move (bound.messages, std::back_inserter (messages));
    Run::RoleDevice opened { std::move (bound.device), bound.limits, bound.driver };
    if (opened.device && choice.adopt) choice.adopt (role, opened, binding.workspace, messages);
    return opened;
}

Run::RoleDevice RoleDevices::openOther (const std::string& role, const graph::Graph& graph, const Plan& plan, Messages& messages)
{
    const auto* given = givenTo (role);
    const auto* described = graph.device (role);
    if (given == nullptr && described == nullptr && ! choice.remedy.empty())
    {
        auto remedy = choice.remedy;
        if (const auto at = remedy.find ("ROLE"); at != std::string::npos) remedy.replace (at, 4, role);
        messages.push_back (Message::warning ("device/undescribed", "/devices",
                                              "no device is given for the role '" + role + "', so it gets a simulated tool at rest", std::move (remedy)));
    }

    auto made = given != nullptr ? hardware.open (given->description, given->folder, role, plan)
                                 : makeDevice (describedByGraph (described, role, messages), graph.folder);
    for (auto& m : made.messages)
        m.where = (given != nullptr ? "--device " : "/devices/") + role + m.where;
    std::ranges::move (made.messages, std::back_inserter (messages));
    Run::RoleDevice opened { std::move (made.device), made.limits };
    if (! opened.device) return opened;
    if (given == nullptr) by_graph.insert (role);
    if (choice.adopt) choice.adopt (role, opened, Workspace {}, messages);
    return opened;
}

Messages RoleDevices::notTakenOver (const graph::Graph& before, const graph::Graph& after) const
{
    Messages messages;
    for (const auto& role : by_graph)
    {
        const auto *now = after.device (role), *then = before.device (role);
        if (now != nullptr && (then == nullptr || withoutGuard (*now) != withoutGuard (*then)))
            messages.push_back (Message::warning ("watch/device", "/devices/" + role,
                                                  "the device of the role '" + role + "' has a new description, but the run keeps the old device",
                                                  "restart the run to use the new description"));
    }
    return messages;
}

void makeMovable (Run::RoleDevice& opened)
{
    if (dynamic_cast<WorkspaceDevice*> (opened.device.get()) != nullptr) return;
    if (opened.driver == nullptr) opened.driver = opened.device.get();
    opened.device = std::make_unique<WorkspaceDevice> (std::move (opened.device), Workspace {}, opened.limits);
}

std::vector<RealDevice> realDevices (const Run& run)
{
    std::vector<RealDevice> all;
    for (const auto& [role, d] : run.devices())
        if (auto real = realDevice (role, d.driver != nullptr ? *d.driver : *d.device)) all.push_back (std::move (*real));
    return all;
}

std::vector<PluginRole> pluginRoles (const Run& run)
{
    std::vector<PluginRole> all;
    for (const auto& [role, d] : run.devices())
        if (auto plugin = pluginRole (role, d.driver != nullptr ? *d.driver : *d.device)) all.push_back (std::move (*plugin));
    return all;
}

}   // namespace tactus::host
