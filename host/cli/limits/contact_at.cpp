// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_at.hpp"

#include <host/cli/report.hpp>
#include <tactus/check/factors.hpp>
#include <tactus/check/measure.hpp>
#include <tactus/check/sampled_loop.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tactus::host
{

namespace
{
double delayOf (const DeviceNumbers& n) { return n.delay ? n.delay->value : 0.0; }

/// The tick period of the loop, in s. A device that is slower than the graph holds each force for longer.
double periodOf (const DeviceNumbers& n, double rate_hz)
{
    return n.rate && n.rate->value > 0.0 ? std::max (1.0 / n.rate->value, 1.0 / rate_hz) : 1.0 / rate_hz;
}

/// The response with the largest load, divided into spring and damper; that of no force at all if nothing is felt there. Empty if none is known.
std::optional<check::SpringAndDamper> heaviest (const check::Slope& slope, double rate_hz, double delay)
{
    if (slope.stiffness == 0.0 && slope.damping == 0.0) return check::springAndDamper ({}, 1.0 / rate_hz);
    std::optional<check::SpringAndDamper> most;
    const auto load = [&] (const check::SpringAndDamper& c) { return c.load (c.stiffness, c.damping, delay); };
    for (const auto& response : slope.responses)
    {
        auto contact = check::springAndDamper (response, 1.0 / rate_hz);
        if (! most || load (contact) > load (*most)) most = std::move (contact);
    }
    return most;
}

void requireNumber (const check::RoleDevice& device, const DeviceNumbers::Number& number, const std::string& name)
{
    if (number && number->value > 0.0) return;
    fail (Message::error ("limits/unknown", printableName (device.role) + " on " + printableName (device.name), "the " + name + " of the device is not known",
                          "add it to \"physics\" in its profile, or name another device: --device " + device.role + "=PROFILE"));
}
}   // namespace

double Standing::rests() const { return radius ? *radius - check::at_rest : std::numeric_limits<double>::quiet_NaN(); }

Contact::Contact (check::Subject s, check::HandMotion m, const std::vector<CheckedRole>& roles, const std::string& chosen)
    : subject (std::move (s)), motion (std::move (m))
{
    const auto demand = check::measure (subject, motion);
    double most = 0.0;
    bool is_known = false, is_felt = false;
    for (std::size_t r = 0; r < demand.roles.size(); ++r)
    {
        if (! chosen.empty() && demand.roles[r].role != chosen) continue;
        const auto candidate = std::ranges::find (roles, demand.roles[r].role, [] (const CheckedRole& c) { return c.device.role; });
        for (const auto& slope : demand.roles[r].slopes)
        {
            if (slope.stiffness == 0.0 && slope.damping == 0.0) continue;
            is_felt = true;
            const auto contact = heaviest (slope, motion.rate_hz, delayOf (candidate->device.numbers));
            if (! contact) continue;
            const double load = contact->load (contact->stiffness, contact->damping, delayOf (candidate->device.numbers));
            if (is_known && load <= most) continue;
            is_known = true;
            most = load;
            role = *candidate;
            t_s = slope.t_s;
            const auto node = std::ranges::max_element (slope.by_node);
            steepest = node != slope.by_node.end() && *node > 0.0 ? demand.nodes[static_cast<std::size_t> (node - slope.by_node.begin())].path : "";
        }
    }
    if (! is_felt)
        fail ("limits/no_contact", "the hand feels no force that depends on its position, so there is nothing to limit",
              "another motion of the hand: --sweep, --device ROLE=gesture:NAME or --device ROLE=trace:FILE.csv; or another --role");
    if (! is_known)
        fail ("limits/no_loop", "the force does not respond in the same way on every tick, so its loop is not known",
              "sections that run on every tick: leave out `every`, or choose another --role");
    requireNumber (role.device, role.device.numbers.mass, "mass");
    requireNumber (role.device, role.device.numbers.damping, "damping");
}

const check::SpringAndDamper& Contact::measured (double rate_hz, const std::vector<double>& params)
{
    auto key = params;
    key.push_back (rate_hz);
    if (const auto found = known.find (key); found != known.end()) return found->second;

    auto changed = subject;
    changed.options.rate_hz = rate_hz;
    std::string where;
    for (std::size_t i = 0; i < params.size(); ++i)
    {
        changed.options.overrides.push_back ({ varied[i], Json (params[i]) });
        addToList (where, varied[i] + "=" + numberText (params[i]));
    }
    for (const auto& message : compile (changed.graph, changed.catalogue, changed.options).messages)
        if (message.severity == Message::Severity::error)
            fail (Message::error (message.id,
                                  (where.empty() ? "" : where + ", ") + numberText (rate_hz) + " Hz" + (message.where.empty() ? "" : ", " + message.where),
                                  message.text, message.remedy));
    const auto demand = check::measure (changed, rate_hz == motion.rate_hz ? motion : check::atRate (motion, rate_hz), { .at_s = t_s });
    const auto at = std::ranges::find (demand.roles, role.device.role, &check::RoleDemand::role);
    std::optional<check::SpringAndDamper> contact;
    if (! at->slopes.empty()) contact = heaviest (at->slopes.front(), rate_hz, delayOf (role.device.numbers));
    if (! contact)
        fail (Message::error ("limits/no_loop", (where.empty() ? "" : where + ", ") + numberText (rate_hz) + " Hz",
                              "the force does not respond in the same way on every tick", "a smaller range of --x and --y"));
    return known.emplace (std::move (key), std::move (*contact)).first->second;
}

Standing Contact::at (const Conditions& c)
{
    const double rate_hz = c.rate_hz > 0.0 ? c.rate_hz : motion.rate_hz;
    const auto& numbers = role.device.numbers;
    const auto& contact = measured (rate_hz, c.params);
    const double period_s = periodOf (numbers, rate_hz);
    Standing s { .stiffness = c.stiffness.value_or (contact.stiffness), .damping = c.damping.value_or (contact.damping), .period_s = period_s };
    s.load = contact.load (s.stiffness, s.damping, delayOf (numbers)) + s.stiffness * (0.5 + delayOf (numbers)) * (period_s - 1.0 / rate_hz);
    s.largest_damper = check::largestDamper (numbers, period_s);
    if (period_s <= (1.0 + 1e-9) / rate_hz) s.radius = check::largestRadius (contact.response (s.stiffness, s.damping), numbers, period_s);
    return s;
}

}   // namespace tactus::host
