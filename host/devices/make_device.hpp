// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/guard.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace tactus::host
{

struct MadeDevice
{
    std::unique_ptr<Device> device;   ///< null if there are errors
    GuardLimits limits;
    std::string about;   ///< a sentence: what moves, and how
    Messages messages;   ///< `where` relative to the description
};

/// Makes the device that a description asks for, or tells everything that is wrong with it. [main thread]
///
///     {"driver": "sim", "mass": "50 g", "damping": 2.0, "quantum": "10 um", "force_quantum": "1 mN", "delay": 0,
///      "first_mode": "30 Hz", "position": [0, 0, "5 mm"], "velocity": [0, 0, 0], "rotation": [0, 0, 0],
///      "hand_force": [0, 0, "-0.5 N"],
///      "hand": {"stiffness": 100.0, "damping": 2.0, "path": "stroke"},
///      "axes": {"trigger": {"mass": "50 g", "damping": 1.0, "stiffness": 0, "position": 0, "hand_force": 0}}, "signal_outputs": 0}
///     {"driver": "trace", "path": "pen.csv"}
///     {"driver": "gesture", "path": "stroke"}
///
/// A `path` is the name of a gesture or a CSV file, relative to `folder`; beside it may stand "offset" (v3, m) and
/// "scale" (1). Each may have a "guard"; "about" and "ui" are for people.
///
/// Where a simulated device is not told: mass 0.1 kg, damping 1 N s/m; a hand of stiffness 100 N/m and damping
/// 2 N s/m, if there is one; its position is where the hand's path starts, as the tool is in the hand, else 0.
///
/// The drivers "hid" and "audio" mean real devices, for which there are hid::openDevice and audio::openAudio; here they are
/// refused.
///
/// Ids: device/unknown_driver, device/real, device/missing, device/unknown_key, device/kind, device/unit,
/// device/out_of_range, device/unknown_gesture, device/unknown_button, device/name, and those of trace/ and csv/.
MadeDevice makeDevice (const Json& description, const std::filesystem::path& folder);

/// What `--device ROLE=sim` means for a role that the graph does not describe: a hand that strokes.
Json defaultDevice();

/// `--device ROLE=FILE.json|sim|trace:FILE.csv|gesture:NAME|hid:PROFILE|audio[:CARD]`, turned into a description.
struct DeviceOption
{
    std::string role;
    Json description;
    std::filesystem::path folder;   ///< where paths in the description start
};

/// `sim` takes what the graph says about the role, as far as a simulated device knows it, or else defaultDevice().
/// Ids: device/option, device/unreadable, device/syntax. [main thread]
std::variant<DeviceOption, Message> parseDeviceOption (std::string_view text, const std::vector<std::pair<std::string, Json>>& described,
                                                       const std::filesystem::path& folder_of_graph);

}   // namespace tactus::host
