// SPDX-License-Identifier: MIT
#pragma once

#include "hand_motion.hpp"

#include <tactus/run/device/device_numbers.hpp>
#include <tactus/run/device/make_device.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace tactus::check
{

/// Makes the device that moves the hand of a role while a graph is measured. A simulated device keeps its mass, its damping and its
/// hand, but loses what the conditions judge: quanta, delay, Coulomb friction and compliance. A gesture or a trace is used as it is. For
/// everything else, such as a real device, a hand makes strokes (defaultDevice). Ids: those of makeDevice. [main thread]
MadeDevice makeHand (const Json& description, const std::filesystem::path& folder);

/// The numbers of a simulated device; empty for other devices and for a description with errors. [main thread]
std::optional<DeviceNumbers> numbersOf (const Json& description, const std::filesystem::path& folder);

/// The whole simulated device; empty as for numbersOf(). [main thread]
std::optional<Simulation> simulationOf (const Json& description, const std::filesystem::path& folder);

/// A role, and the description of the device that moves its hand.
struct HandChoice
{
    std::string role;
    Json description;
    std::filesystem::path folder {};   ///< base of the relative paths in the description
};

/// The time for which a graph is measured if the paths of all hands are endless, and the longest time for which it is measured, in s.
inline constexpr double default_length_s = 2.0, longest_s = 6.0;

struct RecordedMotion
{
    HandMotion motion {};   ///< has no ticks if there are errors
    Messages messages {};   ///< of the devices, with `where` /devices/ROLE/…; of the graph, if it does not compile; check/diverged, if a tool runs away
};

/// Moves the hands of a graph once. Roles without a choice get the hand of the graph's description, or strokes. `duration_s` 0: as
/// long as the longest path of a hand, but at most longest_s. [main thread]
RecordedMotion recordMotion (const Subject&, std::span<const HandChoice>, const std::filesystem::path& folder_of_graph, double duration_s = 0.0);

}   // namespace tactus::check
