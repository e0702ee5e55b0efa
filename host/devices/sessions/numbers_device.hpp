// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile_reader.hpp>
#include <tactus/run/device/make_device.hpp>

#include <functional>

namespace tactus::host
{

/// The description of a simulated device with the numbers of a profile. Hand, start, axes and guard are those of `sim`, the
/// description of a simulated device. Numbers that the profile does not give have their defaults. The peak force tightens the
/// guard's max_force.
Json withNumbers (Json sim, const DeviceNumbers&);

/// The ids of the guessed numbers, as in "mass, damping"; empty if none is a guess.
std::string guessesOf (const DeviceNumbers&);

/// Like tactus::parseDeviceOption, but `ROLE=NAME` and `ROLE=NAME:PORT` may also name the driver of an installed plugin, and `ROLE=ID` a profile that
/// holds only numbers, whose device Tactus cannot open: the role then gets a simulated device with these numbers, and `notes` says so
/// (device/numbers_only, a warning). If there are both, `ROLE=NAME` means the profile, so that an option that meant a simulated device never opens a
/// real one because a driver was installed; `ROLE=NAME:PORT` means the driver. `profiles` is called only if the option has none of the other forms.
/// Ids: those of tactus::parseDeviceOption. [main thread]
Result<DeviceOption> parseDeviceOption (std::string_view text, const std::vector<std::pair<std::string, Json>>& described,
                                        const std::filesystem::path& folder_of_graph, const std::function<const hid::LoadedProfiles&()>& profiles,
                                        Messages& notes);

}   // namespace tactus::host
