// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_list.hpp"
#include "limit_words.hpp"

#include <host/app/model/quantity_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/sessions/binding.hpp>
#include <host/devices/sessions/choose_clock.hpp>
#include <host/devices/sessions/role_fits.hpp>
#include <tactus/check/trials/trials.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/rounded_bound.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
DeviceNumbers inWorkspace (DeviceNumbers n, const Workspace& w)
{
    const auto scale = [] (DeviceNumbers::Number& number, double by) {
        if (number) number->value *= by;
    };
    for (auto* number : { &n.mass, &n.damping, &n.end_mass })
        scale (*number, 1.0 / w.scale);
    scale (n.quantum, w.scale);
    if (n.workspace)
    {
        // A box around the box, which may be turned.
        const Mat3 along = w.axes.cwiseMax (0.0), against = w.axes.cwiseMin (0.0);
        const Vec3 min = n.workspace->min, max = n.workspace->max;
        n.workspace->min = w.scale * (along * min + against * max) + w.offset;
        n.workspace->max = w.scale * (along * max + against * min) + w.offset;
    }
    return n;
}

void describe (LimitRole& r, const Json& description, const std::filesystem::path& folder, const hid::LoadedProfiles& profiles)
{
    r.device = description.value ("driver", std::string()) == "sim" ? TRANS ("simulated").toStdString() : nameOf (description);
    if (const auto numbers = check::numbersOf (description, folder)) r.numbers = *numbers;
    if (! hid::isHid (description)) return;
    const auto name = description.find ("profile");
    if (name == description.end() || ! name->is_string()) return;
    if (const auto profile = hid::profileNamed (profiles, name->asString()))
    {
        r.device = profile->name;
        r.numbers = hid::numbersOf (*profile);
    }
}

/// True if the device moves by itself, or is simulated together with the hand that moves it.
bool hasHand (const Json& description)
{
    const auto driver = description.value ("driver", std::string());
    return driver == "gesture" || driver == "trace" || (driver == "sim" && description.contains ("hand"));
}

std::string number (double v, std::string_view unit)
{
    if (unit == "m" || unit == "N" || unit == "s") return withPrefix (v, std::string (unit));
    return unit == "1" ? roundedText (v, 3) : roundedText (v, 3) + ' ' + std::string (unit);
}

std::string detailsOf (const check::Condition& c, const std::string& device, bool is_broken)
{
    auto who = printableName (c.role) + " (" + printableName (device) + ")";
    if (! c.node.empty()) who = filled (TRANS ("%1 on %2"), printableName (c.node), who).toStdString();
    auto text = filled (TRANS ("%1 of %2: %3, limit %4"), c.id, who, number (c.value, c.unit), number (c.limit, c.unit));
    if (! is_broken && ! isPastPassivity (c)) text << ", " + filled (TRANS ("%1 left"), number (100.0 * (c.margin() - 1.0), "%"));
    return unitShown (text.toStdString() + " (" + c.text + "; " + std::string (c.law) + ")"
                      + (c.remedy.empty() ? "." : ".\n" + filled (TRANS ("Would help: %1."), c.remedy).toStdString()));
}

/// The paths of the nodes that push the device of a role.
std::vector<std::string> sinksOf (const Plan& plan, const std::string& role)
{
    std::vector<std::string> all;
    if (const auto* use = plan.findRole (role))
        for (const auto& sink : use->sinks)
            all.push_back (plan.flat().nodes[sink.instance].path);
    return all;
}

/// The path of the node whose own force is steepest where the role's force is steepest; empty if there is none.
std::string steepestOf (const check::Demand& demand, const std::string& role)
{
    const auto r = std::ranges::find (demand.roles, role, &check::RoleDemand::role);
    if (r == demand.roles.end() || r->slopes.empty()) return {};
    const auto& by_node = std::ranges::max_element (r->slopes, {}, &check::Slope::stiffness)->by_node;
    const auto most = std::ranges::max_element (by_node);
    return most == by_node.end() || ! (*most > 0.0) ? std::string() : demand.nodes[static_cast<std::size_t> (most - by_node.begin())].path;
}

/// The nodes that a condition is about. For a condition on a whole role: first the steepest node, if the condition is about the slope of
/// the force; then the nodes that push the device.
std::vector<std::string> nodesOf (const check::Condition& c, const check::Demand& demand, const Plan& plan)
{
    if (! c.node.empty()) return { c.node };
    auto nodes = sinksOf (plan, c.role);
    const bool is_slope = c.id == "stiffness" || c.id == "quantum";
    std::string first;
    if (! c.loops.empty())
        first = c.loops.front().node;
    else if (is_slope)
        first = steepestOf (demand, c.role);
    if (! first.empty()) nodes.insert (nodes.begin(), std::move (first));
    return nodes;
}

/// The JSON pointer of a node, from its path. For a path into an included file, that of the node that includes the file.
std::string pointerOf (const graph::Graph& g, std::string path)
{
    const auto* patch = &g.root;
    std::string pointer, inside;
    while (patch != nullptr && ! path.empty())
    {
        const auto slash = path.find ('/');
        const auto name = path.substr (0, std::min (slash, path.find ('[')));
        const auto* node = patch->find (name);
        if (node == nullptr) break;
        pointer = inside + "/nodes/" + name;
        if (slash == path.npos || ! node->type.starts_with ("graph:")) break;
        path.erase (0, slash + 1);
        inside = "/graphs/" + node->type.substr (6);
        patch = g.find (node->type.substr (6));
    }
    return pointer;
}

std::string nameOf (const std::vector<check::RoleDevice>& devices, const std::string& role)
{
    const auto device = std::ranges::find (devices, role, &check::RoleDevice::role);
    return device != devices.end() ? device->name : TRANS ("unknown device").toStdString();
}

LimitList listOf (const check::Demand& demand, const std::vector<check::RoleDevice>& devices, const check::Trials& trials, const Plan& plan)
{
    LimitList list;
    for (const auto& c : check::judge (demand, devices, { .trials = &trials }))
    {
        const bool is_weakest_known = c.verdict == check::Verdict::unstable && ! c.loops.empty() && c.loops.front().may_grow < 1.0 && ! std::isnan (c.may_grow);
        const auto addContact = [&] (const std::string& node, double passive_up_to, double may_grow) {
            list.contacts.push_back ({ .node = node,
                                       .device = nameOf (devices, c.role),
                                       .verdict = c.verdict,
                                       .passive_up_to = passive_up_to,
                                       .stable_up_to = std::isnan (may_grow) ? 0.0 : may_grow,
                                       .swinging = is_weakest_known && may_grow >= 1.0 ? c.loops.front().node : std::string() });
        };
        for (const auto& loop : c.is_partial ? std::vector<check::Condition::Loop> {} : c.loops)   // what it leaves out may be of these nodes
        {
            const double passive_up_to = std::isnan (loop.passive_up_to) ? c.limit / c.value : loop.passive_up_to;
            addContact (loop.node, passive_up_to, std::isnan (c.may_grow) ? c.may_grow : loop.may_grow);
        }
        if (c.id == "stiffness" && c.isKnown() && c.value > 0.0 && c.loops.empty() && ! c.is_partial)   // the steepest node stands for all
            addContact (steepestOf (demand, c.role), c.limit / c.value, c.may_grow);
        const bool is_broken = c.isBroken();
        if (! c.isKnown())
        {
            const bool is_reached = c.verdict == check::Verdict::unknown;
            ++(is_reached ? list.unknown : list.not_reached);
            const auto remedy =
                is_reached ? unitShown (c.remedy) : TRANS ("move the hand to the node, or change the place or the size of its shape").toStdString();
            list.unjudged.push_back ({ false, std::string (c.id), nodesOf (c, demand, plan), limitSentence (c, c.node, nameOf (devices, c.role)), remedy, {} });
        }
        else if (! is_broken && ! isPastPassivity (c) && ! (c.margin() < LimitList::near))   // a margin that is not known is not near
            ++list.held;
        else
        {
            const auto device = nameOf (devices, c.role);
            auto nodes = nodesOf (c, demand, plan);
            const bool is_slope = c.id == "stiffness" || c.id == "quantum" || c.id == "damping";
            auto about = c.node.empty() && is_slope && ! nodes.empty() ? nodes.front() : c.node;
            if (isMostlyDamping (c) && c.loops.empty() && nodes.size() > 1) about.clear();   // the stiffest node need not be the one with the dampers
            const auto details = detailsOf (c, device, is_broken);
            list.limits.push_back ({ is_broken, std::string (c.id), std::move (nodes), limitSentence (c, about, device), firstRemedy (c), details });
            for (std::size_t i = 1; i < c.loops.size() && (is_broken ? ! std::isnan (c.may_grow) : isPastPassivity (c)); ++i)
            {
                const auto& [node, passive_up_to, may_grow] = c.loops[i];
                const double room = is_broken ? may_grow : passive_up_to;
                if (! (room < 1.0)) continue;
                auto other = c;
                other.may_grow = may_grow;
                const auto most = roundedText (roundedBound (room, false), 3);
                const auto remedy = filled (TRANS ("at most %1 times its stiffness and virtual damping"), most).toStdString();
                list.limits.push_back ({ is_broken, std::string (c.id), { node }, limitSentence (other, node, device), remedy, details });
            }
        }
    }
    list.is_checked = ! list.limits.empty() || list.held > 0 || list.unknown > 0 || list.not_reached > 0;
    std::stable_partition (list.limits.begin(), list.limits.end(), [] (const Limit& l) { return l.is_broken; });
    return list;
}

/// The list of a graph along which no motion could be recorded: a tool that runs away is a limit that is broken, and with anything else, nothing is judged.
LimitList withoutMotion (const Messages& messages, const Plan& plan)
{
    LimitList list { .is_checked = true };
    for (const auto& m : messages)
    {
        if (m.severity != Message::Severity::error) continue;
        if (m.id == "check/diverged")
        {
            const auto role = m.where.substr (m.where.rfind ('/') + 1);
            list.limits.push_back ({ .is_broken = true,
                                     .id = "diverged",
                                     .nodes = sinksOf (plan, role),
                                     .text = filled (TRANS ("The forces drive the tool of %1 away, so nothing else is judged"), role).toStdString(),
                                     .remedy = TRANS ("softer or weaker forces").toStdString(),
                                     .details = m.text });
        }
        else
        {
            ++list.unknown;
            list.unjudged.push_back ({ .id = "motion", .text = m.text, .remedy = m.remedy });
        }
    }
    return list;
}
}   // namespace

std::vector<LimitRole> limitRolesOf (const graph::Graph& g, const LoadedSession& session, const hid::LoadedProfiles& profiles)
{
    std::vector<LimitRole> roles;
    for (const auto& role : rolesNamed (g))
    {
        auto& r = roles.emplace_back (LimitRole { .role = role, .device = TRANS ("simulated").toStdString() });
        if (const auto bound = bindingOf (session, role))
        {
            describe (r, bound->description, bound->folder, profiles);
            r.numbers = inWorkspace (std::move (r.numbers), bound->workspace);
            if (hasHand (bound->description))
            {
                r.hand = bound->description;
                r.hand_folder = bound->folder;
            }
        }
        else if (const auto* described = g.device (role))
        {
            Messages said_by_run;
            const auto description = describedByGraph (described, role, said_by_run);
            describe (r, description, g.folder, profiles);
            if (check::simulationOf (description, g.folder)) r.simulated = description;
        }
    }
    return roles;
}

std::size_t LimitList::broken() const noexcept { return static_cast<std::size_t> (std::ranges::count_if (limits, &Limit::is_broken)); }

Messages LimitList::remarks (const graph::Graph& g) const
{
    Messages all;
    for (const auto& l : unjudged)
        all.push_back (Message::warning ("limit/" + l.id, l.nodes.empty() ? std::string() : pointerOf (g, l.nodes.front()), l.text, l.remedy));
    return all;
}

Messages LimitList::messages (const graph::Graph& g) const
{
    Messages all;
    for (const auto& l : limits)
    {
        const auto where = l.nodes.empty() ? std::string() : pointerOf (g, l.nodes.front());
        const auto remedy = l.remedy.empty() ? std::string() : filled (TRANS ("would help: %1"), l.remedy).toStdString();
        all.push_back (l.is_broken ? Message::error ("limit/" + l.id, where, l.text, remedy) : Message::warning ("limit/" + l.id, where, l.text, remedy));
    }
    return all;
}

LimitList limitsOf (const LimitJob& job, const Catalogue& catalogue, FileAssets& assets, std::stop_token stop)
{
    const check::Subject subject { job.graph,
                                   catalogue,
                                   { .rate_hz = job.rate_hz, .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } },
                                   std::move (stop) };
    const auto compiled = compile (subject.graph, subject.catalogue, subject.options);
    if (hasErrors (compiled.messages) || ! compiled.plan) return {};

    std::vector<check::HandChoice> hands;
    std::vector<check::RoleDevice> devices;
    for (const auto& r : job.roles)
    {
        if (r.hand) hands.push_back ({ r.role, *r.hand, r.hand_folder });
        devices.push_back ({ r.role, r.numbers, r.device, r.simulated ? check::simulationOf (*r.simulated, job.graph.folder) : std::nullopt });
    }
    const auto recorded = check::recordMotion (subject, hands, job.graph.folder);
    if (hasErrors (recorded.messages)) return withoutMotion (recorded.messages, *compiled.plan);
    const auto ticks = check::affordableTicks (*compiled.plan);   // as many as `tactus check` takes, however busy this computer is
    try
    {
        const auto demand = check::measure (subject, recorded.motion, { .ticks = ticks });
        const auto trials = check::tryLoops (subject, recorded.motion, demand, devices, { .ticks = ticks / 2 });
        return listOf (demand, devices, trials, *compiled.plan);
    }
    catch (const check::Stopped&)
    {
        return {};
    }
}

}   // namespace tactus::host
