// SPDX-License-Identifier: MIT
#include "hands.hpp"

#include <tactus/run/device/sim.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tactus::check
{

namespace
{
constexpr const char* judged[] { "quantum", "force_quantum", "delay", "first_mode", "first_mode_damping", "end_mass", "coulomb", "guard" };

bool hasDriver (const Json& description, std::string_view driver)
{
    return description.is_object() && description.contains ("driver") && description.at ("driver") == Json (driver);
}
}   // namespace

MadeDevice makeHand (const Json& description, const std::filesystem::path& folder)
{
    if (hasDriver (description, "gesture") || hasDriver (description, "trace")) return makeDevice (description, folder);
    if (! hasDriver (description, "sim")) return makeDevice (defaultDevice(), folder);
    auto ideal = Json::object();
    for (const auto& [key, value] : description.items())
        if (std::ranges::count (judged, key) == 0) ideal[key] = value;
    auto made = makeDevice (ideal, folder);
    made.messages = makeDevice (description, folder).messages;   // also what is wrong with the rest of the description
    return made;
}

std::optional<DeviceNumbers> numbersOf (const Json& description, const std::filesystem::path& folder)
{
    if (! hasDriver (description, "sim")) return std::nullopt;
    const auto made = makeDevice (description, folder);
    const auto* simulated = dynamic_cast<const SimulatedDevice*> (made.device.get());
    return simulated != nullptr ? std::optional (tactus::numbersOf (simulated->simulation(), made.limits)) : std::nullopt;
}

std::optional<Simulation> simulationOf (const Json& description, const std::filesystem::path& folder)
{
    if (! hasDriver (description, "sim")) return std::nullopt;
    const auto made = makeDevice (description, folder);
    const auto* simulated = dynamic_cast<const SimulatedDevice*> (made.device.get());
    return simulated != nullptr ? std::optional (simulated->simulation()) : std::nullopt;
}

RecordedMotion recordMotion (const Subject& subject, std::span<const HandChoice> choices, const std::filesystem::path& folder_of_graph, double duration_s)
{
    RecordedMotion recorded;
    auto [plan, problems] = compile (subject.graph, subject.catalogue, subject.options);
    if (! plan)
    {
        recorded.messages = std::move (problems);
        return recorded;
    }
    std::vector<std::unique_ptr<Device>> devices;
    std::vector<Hand> hands;
    double longest = 0.0;
    for (const auto& role : plan->roles())
    {
        const auto choice = std::ranges::find (choices, role.name, &HandChoice::role);
        const auto* described = subject.graph.device (role.name);
        HandChoice hand { role.name, described != nullptr ? *described : Json(), folder_of_graph };
        if (choice != choices.end()) hand = *choice;
        auto made = makeHand (hand.description, hand.folder);
        for (auto& m : made.messages)
        {
            m.where = "/devices/" + role.name + m.where;
            recorded.messages.push_back (std::move (m));
        }
        if (! made.device) continue;
        longest = std::max (longest, made.device->duration());
        hands.push_back ({ role.name, *made.device });
        devices.push_back (std::move (made.device));
    }
    if (hasErrors (recorded.messages)) return recorded;
    if (duration_s <= 0.0) duration_s = longest > 0.0 ? std::min (longest, longest_s) : default_length_s;
    const double rate_hz = plan->rateHz();
    recorded.motion = recordMotion (std::move (plan), hands, static_cast<std::size_t> (std::ceil (duration_s * rate_hz)));
    if (auto away = divergence (recorded.motion); ! away.empty())
    {
        recorded.motion = {};
        std::ranges::move (away, std::back_inserter (recorded.messages));
    }
    return recorded;
}

}   // namespace tactus::check
