// SPDX-License-Identifier: MIT
#include "numbers_device.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid/physics.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>

namespace tactus::host
{
std::string guessesOf (const DeviceNumbers& numbers)
{
    std::string all;
    for (const auto& row : deviceNumberRows())
        if (const auto& number = numbers.*row.member; number && number->guess) addToList (all, row.id);
    return all;
}

Json withNumbers (Json sim, const DeviceNumbers& numbers)
{
    for (const auto& row : deviceNumberRows())
        if (row.is_simulated) sim.erase (std::string (row.id));

    const auto set = [&] (std::string_view id, const DeviceNumbers::Number& number) {
        if (number) sim[std::string (id)] = number->value;
    };
    for (const auto& row : deviceNumberRows())
        if (row.is_simulated && (numbers.first_mode || (row.id != "first_mode_damping" && row.id != "end_mass"))) set (row.id, numbers.*row.member);

    if (! numbers.peak_force) return sim;
    Messages reported_later;
    Json guard = sim.value ("guard", Json::object());
    if (numbers.peak_force->value < readGuardLimits (guard, "", reported_later).max_force)
    {
        guard["max_force"] = numbers.peak_force->value;
        sim["guard"] = std::move (guard);
    }
    return sim;
}

Result<DeviceOption> parseDeviceOption (std::string_view text, const std::vector<std::pair<std::string, Json>>& described,
                                        const std::filesystem::path& folder_of_graph, const std::function<const hid::LoadedProfiles&()>& profiles,
                                        Messages& notes)
{
    auto parsed = tactus::parseDeviceOption (text, described, folder_of_graph);
    const auto equals = text.find ('=');
    if (parsed || equals == text.npos || ! graph::isId (text.substr (0, equals))) return parsed;

    const std::string role (text.substr (0, equals)), id (text.substr (equals + 1)), where = "--device " + std::string (text);
    const auto profile = graph::isId (id) ? hid::profileNamed (profiles(), id) : nullptr;
    const bool is_numbers_only = profile && hid::isNumbersOnly (*profile);
    if (! is_numbers_only)
        if (auto of_plugin = parsePluginDevice (id); ! of_plugin.is_null())
            return DeviceOption { .role = role, .description = std::move (of_plugin), .folder = {} };
    if (! profile)
    {
        auto why = std::move (parsed).error();
        if (const auto name = id.substr (0, id.find (':')); graph::isId (name) && ! isBuiltInDriver (name))
            why.remedy += "; a driver in a plugin is the file " + name + DeviceDriver::suffix + " in a folder of plugins (--plugins)";
        return why;
    }
    if (! is_numbers_only)
    {
        std::string how = "=hid:" + id;
        if (profile->match.empty()) how = profile->wires.serial ? "=serial:" + id + "@PORT" : "=udp:" + id + "@ADDRESS:PORT";
        return Message::error ("device/option", where, quote (id) + " is the profile of a device that must be connected", "write " + role + how);
    }

    auto option = tactus::parseDeviceOption (role + "=sim", described, folder_of_graph);
    if (! option) return option;
    const auto numbers = hid::numbersOf (*profile);
    option->description = withNumbers (std::move (option->description), numbers);
    const auto guesses = guessesOf (numbers);
    notes.push_back (Message::warning ("device/numbers_only", where,
                                       "the profile of " + profile->name + " has only numbers, so the role gets a simulated device with them"
                                           + (guesses.empty() ? std::string() : " (guessed: " + guesses + ")"),
                                       "the profile says where each number comes from; for a real device, write " + role + "=hid:PROFILE"));
    return option;
}

}   // namespace tactus::host
