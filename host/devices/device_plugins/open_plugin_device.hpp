// SPDX-License-Identifier: MIT
#pragma once

#include "plugin_device.hpp"

#include <tactus/run/device/make_device.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// Device drivers are found in the folders of node plugins (installed_plugins.hpp), by the names of their files, and loaded only when a person has chosen
/// one. Descriptions in graphs never get here: they go through describedByGraph().

/// The file of the driver with this name, in the first of these folders that has one. Empty for the drivers that are part of Tactus, for a name that is
/// not an id, and if there is no such file. [main thread]
std::optional<std::filesystem::path> findDriver (std::string_view name, const std::vector<std::filesystem::path>& folders);

/// The same in the folders of this program.
std::optional<std::filesystem::path> findDriver (std::string_view name);

/// The names of all drivers in the folders of this program, sorted. Loads nothing. [main thread]
std::vector<std::string> installedDrivers();

/// Loads a driver and asks it for its devices, as a person wants. Ids: those of DeviceDriver::load and DeviceDriver::find, device/unknown_driver,
/// plugin/quarantined. [any thread, one at a time]
Result<std::vector<FoundByDriver>> findDevices (const std::string& driver);

/// The devices of all drivers that can look for them. Loads all drivers of this computer. `messages`: of those that failed. [any thread, one at a time]
std::vector<FoundByDriver> findDevices (Messages&);

/// The description for an option NAME or NAME:PORT: {"driver": "NAME", "port": "PORT"}. Null if there is no such driver. [main thread]
Json parsePluginDevice (std::string_view);

/// True if the driver of a description is in a plugin of this computer. Loads nothing. [main thread]
bool isPluginDevice (const Json& description);

/// Checks a description, as far as that is possible without the device. Loads the driver.
/// Ids: those of DeviceDriver::load and DeviceDriver::check, of readGuardLimits, plugin/quarantined. [main thread]
Messages checkPluginDevice (const Json& description);

/// Opens the device of a description: {"driver": "serial_arm", "port": "/dev/ttyACM0", "guard": {…}}. The guard tightens the limits of the driver.
/// Ids: those of checkPluginDevice and DeviceDriver::open; the warnings device/failsafe and device/no_failsafe. [main thread]
MadeDevice openPluginDevice (const Json& description);

/// The same with a driver that is already there.
MadeDevice openPluginDevice (const DeviceDriver&, const Json& description);

}   // namespace tactus::host
