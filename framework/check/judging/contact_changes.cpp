// SPDX-License-Identifier: MIT
#include "contact_changes.hpp"
#include "judging.hpp"

#include <tactus/check/sampled_loop.hpp>
#include <tactus/check/spring_and_damper.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tactus::check
{

namespace
{
constexpr std::size_t longest = 12;   // ticks of a response

/// The response as far as it changes.
std::vector<double> shortened (std::span<const double> response)
{
    constexpr double matters = 1e-6;   // relative
    std::vector<double> all (response.begin(), response.end());
    double most = 0.0;
    for (const double v : all)
        most = std::max (most, std::abs (v));
    while (all.size() > 1 && std::abs (all[all.size() - 2] - all.back()) <= matters * most)
        all.pop_back();
    return all;
}

/// hold.predictive: a force of 1.5 times the last one, less half of the one before.
std::vector<double> predicted (const std::vector<double>& response)
{
    auto all = response;
    all.push_back (all.back());
    for (std::size_t k = all.size(); k-- > 0;)
        all[k] = 1.5 * all[k] - (k > 0 ? 0.5 * all[k - 1] : 0.0);
    return all;
}

/// The response at twice the rate: the same damper responds twice as strongly, for half as long.
std::vector<double> faster (std::span<const double> response, double period_s)
{
    const auto contact = springAndDamper (response, period_s);
    return contact.response (contact.stiffness, 2.0 * contact.damping);
}

std::string withUnit (double v) { return roundedText (v, 3) + " N*s/m"; }

/// The largest part of 1 with which the device can dissipate a load, if it can with less; 0 if it never can. `load` is convex.
template <typename Load>
double largestPart (const Load& load, double limit)
{
    double low = 0.0, high = 1.0;
    if (! (load (low) < limit)) return 0.0;
    for (int i = 0; i < 40; ++i)
        (load (0.5 * (low + high)) <= limit ? low : high) = 0.5 * (low + high);
    return low;
}

/// The b of a contact that is softer by a part, or ticks faster. A hold.predictive makes its b from the force, so what no damper claims falls with it.
double dampingOf (const Contact& c, const Dampers& dampers, double part)
{
    if (! dampers.are_predicted || ! dampers.leaveUnclaimed (c.damping)) return c.damping;
    const double stays = std::min (c.damping, dampers.claimed);
    return stays + part * (c.damping - stays);
}

/// The change that makes one contact passive without another rate or device.
std::string passiveWay (const Contact& c, const Dampers& dampers, double period_s)
{
    using namespace judging;
    constexpr double least = 1e-3;
    const bool is_unclaimed = dampers.leaveUnclaimed (c.damping);
    const auto softer = [&] (double part) { return c.load (part * c.stiffness, dampingOf (c, dampers, part), period_s); };
    const auto lessDamped = [&] (double part) { return c.load (c.stiffness, part * c.damping, period_s); };
    if (const double part = largestPart (softer, c.limit); part > least)
    {
        if (is_unclaimed && dampers.are_predicted)
            return "a stiffness of " + atMost (part * c.stiffness, "N/m") + " (if the b that no damper claims falls with it)";

        // A factor, because a friction may be twice as stiff as its own stiffness, on a reversal. A softer one is stretched otherwise at the same place.
        constexpr double stretched = 0.99;
        if (c.softer == Stretch::Softer::stiffness) return "a stiffness " + atMost (stretched * part, "times") + " as large";
        if (c.softer == Stretch::Softer::d_max) return "a d_max " + atLeast (1.0 / (stretched * part), "times") + " as long";
        return "a stiffness of " + atMost (part * c.stiffness, "N/m");
    }
    if (is_unclaimed) return smaller_b;
    if (const double part = largestPart (lessDamped, c.limit); part > 0.0) return "a virtual damping of " + atMost (part * c.damping, "N*s/m");
    return "a virtual damping below that of the device and a softer contact";
}

/// The rate from which on a contact is passive, in Hz; infinite if there is none.
double passiveRate (const Contact& c, const Dampers& dampers, double period_s)
{
    constexpr double fastest = 1e6;   // times the rate
    const auto load = [&] (double part) { return c.load (c.stiffness, dampingOf (c, dampers, part), std::max (part, 1.0 / fastest) * period_s); };
    const double part = largestPart (load, c.limit);
    return part > 1.0 / fastest ? 1.0 / (part * period_s) : std::numeric_limits<double>::infinity();
}
}   // namespace

std::string passiveRemedy (std::span<const Contact> broken, double load, const Dampers& dampers, const DeviceNumbers& device, double period_s)
{
    using namespace judging;
    double rate = 0.0;
    std::string each;
    for (const auto& contact : broken)
    {
        rate = std::max (rate, passiveRate (contact, dampers, period_s));
        const auto along = contact.node.empty() ? std::string() : "along the force of '" + contact.node + "' ";
        each += (each.empty() ? "" : " and ") + along + passiveWay (contact, dampers, period_s);
    }
    std::vector<std::string> ways;
    const bool falls = dampers.are_predicted && std::ranges::any_of (broken, [&] (const Contact& c) { return dampers.leaveUnclaimed (c.damping); });
    if (std::isfinite (rate) && reaches (device, rate))
        ways.push_back ("a rate of " + atLeast (rate, "Hz") + (falls ? " (if this b falls with the period)" : ""));
    ways.push_back ("a device with a damping of " + atLeast (load, "N*s/m"));
    if (broken.size() > 1) return each + "; or for all of them " + anyOf (ways);
    ways.insert (ways.begin(), each);
    return anyOf (ways);
}

std::optional<Change> strongestChange (std::span<const double> measured, const DeviceNumbers& device, double period_s, bool drags,
                                       std::span<const std::vector<double>> others)
{
    if (measured.empty() || ! device.mass || ! device.damping) return std::nullopt;
    const auto response = shortened (measured);
    if (response.size() > longest) return std::nullopt;
    const auto contact = springAndDamper (response, period_s);
    const double k = contact.stiffness, b = contact.damping;

    const auto restsTimes = [] (double factor, std::vector<double> r, const DeviceNumbers& numbers, double period) {
        for (double& v : r)
            v *= factor;
        return comesToRest (r, numbers, period);
    };
    Change best;
    const auto attempt = [&] (std::string what, const std::vector<double>& changed, const DeviceNumbers& numbers, double period) {
        const double room = roomToGrow ([&] (double factor) {
            return restsTimes (factor, changed, numbers, period) && std::ranges::all_of (others, [&] (const auto& other) {
                       return restsTimes (factor, period < period_s ? faster (other, period_s) : other, numbers, period);
                   });
        });
        constexpr double clearly = 1.02;
        if (room > clearly * best.room) best = { std::move (what), room };
    };
    auto changed = device;
    if (k != 0.0) attempt ("half the stiffness", contact.response (0.5 * k, b), device, period_s);
    if (b != 0.0)
    {
        attempt ("half the virtual damping", contact.response (k, 0.5 * b), device, period_s);
        attempt ("twice the virtual damping", contact.response (k, 2.0 * b), device, period_s);
    }
    else
        attempt ("a virtual damping of " + withUnit (device.damping->value), contact.response (k, device.damping->value), device, period_s);
    if (const double twice = 2.0 / period_s; ! device.rate || ! (device.rate->value > 0.0) || device.rate->value >= twice)
        attempt ("twice the rate", faster (response, period_s), device, 0.5 * period_s);
    if (! drags) attempt ("a hold.predictive", predicted (response), device, period_s);
    if (device.delay && device.delay->value > 0.0)
    {
        changed.delay->value = 0.0;
        attempt ("no delay of the device", response, changed, period_s);
        changed = device;
    }
    changed.damping->value *= 2.0;
    attempt ("a device with twice the damping", response, changed, period_s);
    return best.room > 0.0 ? std::optional (best) : std::nullopt;
}

}   // namespace tactus::check
