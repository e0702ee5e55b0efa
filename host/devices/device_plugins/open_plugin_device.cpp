// SPDX-License-Identifier: MIT
#include "open_plugin_device.hpp"

#include <host/code/plugins/installed_plugins.hpp>
#include <host/code/plugins/quarantine.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <system_error>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

std::string driverOf (const Json& description)
{
    const auto at = description.find ("driver");
    return at != description.end() && at->is_string() ? at->get<std::string>() : std::string();
}

Result<std::shared_ptr<const DeviceDriver>> loadDriver (const std::string& name)
{
    const auto file = findDriver (name);
    if (! file)
        return Message::error ("device/unknown_driver", "/driver", "there is no driver " + quote (name),
                               "install " + name + DeviceDriver::suffix + " in a folder of plugins, or give its folder with --plugins");
    const Quarantine quarantine { pluginMarks() };
    if (quarantine.holds (*file)) return quarantine.refusal (*file);
    const Quarantine::LoadingMark loading { quarantine, *file };
    return DeviceDriver::load (*file);
}

GuardLimits readGuard (const Json& description, const DeviceLayout& layout, Messages& messages)
{
    const auto guard = description.find ("guard");
    return guard == description.end() ? GuardLimits {} : readGuardLimits (*guard, "/guard", messages, layout);
}
}   // namespace

std::optional<fs::path> findDriver (std::string_view name, const std::vector<fs::path>& folders)
{
    if (! graph::isId (name) || isBuiltInDriver (name)) return std::nullopt;
    std::error_code unseen;
    for (const auto& folder : folders)
        if (auto file = folder / (std::string (name) + DeviceDriver::suffix); fs::is_regular_file (file, unseen)) return file;
    return std::nullopt;
}

std::optional<fs::path> findDriver (std::string_view name) { return findDriver (name, usedPluginFolders()); }

std::vector<std::string> installedDrivers()
{
    std::set<std::string> names;
    for (const auto& folder : usedPluginFolders())
    {
        std::error_code failed;
        for (fs::directory_iterator it (folder, failed), end; ! failed && it != end; it.increment (failed))
            if (auto name = it->path().stem().string(); it->path().extension() == DeviceDriver::suffix && findDriver (name)) names.insert (std::move (name));
    }
    return { names.begin(), names.end() };
}

Result<std::vector<FoundByDriver>> findDevices (const std::string& name)
{
    const auto driver = loadDriver (name);
    if (! driver) return driver.error();
    return (*driver)->find();
}

std::vector<FoundByDriver> findDevices (Messages& messages)
{
    std::vector<FoundByDriver> all;
    for (const auto& name : installedDrivers())
    {
        const auto driver = loadDriver (name);
        if (driver && ! (*driver)->canFind()) continue;
        if (auto found = driver ? (*driver)->find() : Result<std::vector<FoundByDriver>> (driver.error()))
            std::ranges::move (*found, std::back_inserter (all));
        else
            messages.push_back (std::move (found).error());
    }
    return all;
}

Json parsePluginDevice (std::string_view text)
{
    const auto colon = text.find (':');
    const auto name = text.substr (0, colon);
    if (! findDriver (name)) return {};
    Json description { { "driver", name } };
    if (colon != text.npos) description["port"] = text.substr (colon + 1);
    return description;
}

bool isPluginDevice (const Json& description) { return findDriver (driverOf (description)).has_value(); }

Messages checkPluginDevice (const Json& description)
{
    const auto driver = loadDriver (driverOf (description));
    if (! driver) return { driver.error() };
    auto messages = (*driver)->check (description);
    readGuard (description, {}, messages);
    std::erase_if (messages, [] (const Message& m) { return m.id == "device/unknown_button"; });   // the buttons are known when the device is open
    return messages;
}

MadeDevice openPluginDevice (const Json& description)
{
    MadeDevice made;
    if (auto driver = loadDriver (driverOf (description)); driver)
        return openPluginDevice (**driver, description);
    else
        made.messages.push_back (std::move (driver).error());
    return made;
}

MadeDevice openPluginDevice (const DeviceDriver& driver, const Json& description)
{
    MadeDevice made;
    auto opened = driver.open (description, made.messages);
    if (! opened) return made;
    made.limits = tightest (opened->about().limits, readGuard (description, opened->about().layout, made.messages));
    if (hasErrors (made.messages)) return made;
    made.about = opened->about().about.empty() ? "A device of the driver " + driver.name() + "." : opened->about().about;
    if (auto armed = armFailsafe (opened->about()); armed)
        made.device = std::make_unique<PluginDevice> (std::move (opened), std::move (*armed), PluginDevice::Options { .silence_s = made.limits.watchdog });
    else
        made.messages.push_back (std::move (armed).error());
    return made;
}

}   // namespace tactus::host
