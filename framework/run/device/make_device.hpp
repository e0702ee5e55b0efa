// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/guard.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tactus
{

struct MadeDevice
{
    std::unique_ptr<Device> device;   ///< null if there are errors
    GuardLimits limits;
    std::string about;   ///< a sentence that describes what moves, and how
    Messages messages;   ///< `where` is relative to the description
};

/// Makes the device that is described, or reports all problems in the description. [main thread]
///
///     {"driver": "sim", "mass": "50 g", "damping": 2.0, "quantum": "10 um", "force_quantum": "1 mN", "delay": 0,
///      "coulomb": "40 mN", "brake": "20 N*s/m", "brake_time": "5 ms", "first_mode": "30 Hz", "first_mode_damping": 0.05, "end_mass": "25 g",
///      "position": [0, 0, "5 mm"], "velocity": [0, 0, 0], "rotation": [0, 0, 0], "hand_force": [0, 0, "-0.5 N"],
///      "hand": {"stiffness": 100.0, "damping": 2.0, "path": "stroke"},
///      "axes": {"trigger": {"mass": "50 g", "damping": 1.0, "stiffness": 0, "position": 0, "hand_force": 0}}, "signal_outputs": 0}
///     {"driver": "trace", "path": "pen.csv"}
///     {"driver": "gesture", "path": "stroke"}
///
/// A `path` is the name of a gesture or a CSV file, relative to `folder`; "offset" (v3, m) and "scale" (1) may accompany it.
/// Each device may have a "guard"; "about" and "ui" are ignored here.
///
/// Defaults of a simulated device: mass 0.1 kg, damping 1 N s/m; with a first mode, a damping ratio of 0.05 and half of the mass at
/// the end; for a hand, stiffness 100 N/m and damping 2 N s/m. The default position is the start of the hand's path, because the
/// tool is in the hand, or 0 without a hand.
///
/// These drivers are the only ones that open no hardware. "hid", "serial", "udp" and "audio" are for real devices, which are opened by
/// hid::openDevice and audio::openAudio; here they are refused.
///
/// Ids: device/unknown_driver, device/real, device/missing, device/unknown_key, device/kind, device/unit,
/// device/out_of_range, device/unknown_gesture, device/unknown_button, device/name, and the ids of trace/ and csv/.
MadeDevice makeDevice (const Json& description, const std::filesystem::path& folder);

/// True for the drivers that makeDevice() makes, which open no hardware.
bool isSimulated (const Json& description);

/// The description that makeDevice() gets for a role to which neither an option, nor a session, nor a person has given a device: the description in
/// the graph, which may be null. A graph may come from anyone, so it neither chooses real hardware nor calibrates it: instead of a real device, the
/// role gets a simulated tool at rest, and a warning says how to choose the device. Never pass the description in a graph to anything else that opens
/// devices. Id: device/not_by_graph. [main thread]
Json describedByGraph (const Json* description, const std::string& role, Messages&);

/// The device for `--device ROLE=sim` if the graph does not describe the role: a hand that makes strokes.
Json defaultDevice();

/// The option `--device ROLE=FILE.json|sim|trace:FILE.csv|gesture:NAME|hid:PROFILE|audio[:CARD]`, turned into a description.
struct DeviceOption
{
    std::string role;
    Json description;
    std::filesystem::path folder;   ///< base of the relative paths in the description
};

/// `sim` uses the parts of the graph's description of the role that apply to a simulated device, or else defaultDevice(). The
/// description of a real device takes nothing from the graph. Ids: device/option, device/unreadable, device/syntax. [main thread]
Result<DeviceOption> parseDeviceOption (std::string_view text, const std::vector<std::pair<std::string, Json>>& described,
                                        const std::filesystem::path& folder_of_graph);

}   // namespace tactus
