// SPDX-License-Identifier: MIT
#include "make_device.hpp"
#include "gesture_device.hpp"
#include "guard_limits.hpp"
#include "sim.hpp"
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/object_reader.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace tactus
{
namespace
{
using Folder = std::filesystem::path;

std::vector<std::string> gestureNames()
{
    std::vector<std::string> names;
    for (const auto& gesture : gestures())
        names.emplace_back (gesture.id);
    return names;
}

bool isFile (std::string_view path) { return path.find_first_of ("./\\") != path.npos; }

/// Adds messages about a file that a description refers to. Their location becomes this reference.
void adopt (const Messages& from, const std::string& where, const std::string& file, Messages& messages)
{
    for (auto message : from)
    {
        message.text = file + ", " + message.where + ": " + message.text;
        message.where = where;
        messages.push_back (std::move (message));
    }
}

std::shared_ptr<const TraceData> loadTrace (const std::string& file, const Folder& folder, const std::string& where, Messages& messages)
{
    const auto table = readTable (folder / file);
    if (! table)
    {
        const auto& error = table.error();
        messages.push_back (Message::error (error.id, where, error.where + ": " + error.text, error.remedy));
        return nullptr;
    }

    auto [trace, found] = readTrace (table->columns, table->values);
    adopt (found, where, file, messages);
    if (hasErrors (found)) return nullptr;
    return std::make_shared<const TraceData> (std::move (trace));
}

const Gesture* gestureNamed (const std::string& name, const std::string& where, Messages& messages)
{
    const auto* gesture = findGesture (name);
    if (gesture == nullptr)
        messages.push_back (Message::error ("device/unknown_gesture", where, "there is no gesture " + quote (name), suggestion (name, gestureNames())));
    return gesture;
}

Placement readPlacement (ObjectReader& in)
{
    return { .offset = in.vector ("offset", unit::metre, Vec3 (Vec3::Zero())), .scale = in.number ("scale", unit::gain, Bounds::positive(), 1.0) };
}

Simulation::Hand readHand (const Json& json, const std::string& where, const Folder& folder, Messages& messages)
{
    ObjectReader in (json, where, messages);
    Simulation::Hand hand;
    hand.stiffness = in.number ("stiffness", unit::stiffness, Bounds::notNegative(), 100.0);
    hand.damping = in.number ("damping", unit::damping, Bounds::notNegative(), 2.0);
    const auto placement = readPlacement (in);

    in.require ("path", "write the name of a gesture, such as \"stroke\", or of a CSV file");
    if (const auto path = in.text ("path"); isFile (path))
    {
        if (const auto trace = loadTrace (path, folder, where + "/path", messages))
            hand.path = std::make_shared<TracePath> (*trace, placement);
    }
    else if (! path.empty())
    {
        if (const auto* gesture = gestureNamed (path, where + "/path", messages))
            hand.path = std::make_shared<GesturePath> (*gesture, placement);
    }

    in.finish();
    return hand;
}

/// {"trigger": {"mass": "20 g", "damping": 0.5, "stiffness": "0.2 N/mm", "position": 0, "hand_force": "1 N"}}
std::vector<Simulation::Axis> readAxes (const Json& json, const std::string& where, Messages& messages)
{
    ObjectReader all (json, where, messages);
    std::vector<Simulation::Axis> axes;
    if (! json.is_object()) return axes;
    for (const auto& [name, description] : json.items())
    {
        if (! graph::isId (name))
            all.error (name, "device/name", quote (name) + " is not a valid name for an axis", "use lower-case letters, digits and _, starting with a letter");
        if (axes.size() == static_cast<std::size_t> (Channels::most))
            all.error (name, "device/out_of_range", "there are more than " + std::to_string (Channels::most) + " axes", "remove some of them");
        ObjectReader in (description, where + "/" + name, messages);
        Simulation::Axis axis { .name = name };
        axis.mass = in.number ("mass", unit::kilogram, Bounds::positive(), axis.mass);
        axis.damping = in.number ("damping", unit::damping, Bounds::notNegative(), axis.damping);
        axis.stiffness = in.number ("stiffness", unit::stiffness, Bounds::notNegative(), axis.stiffness);
        axis.position = in.number ("position", unit::metre, {}, axis.position);
        axis.hand_force = in.number ("hand_force", unit::newton, {}, axis.hand_force);
        in.finish();
        axes.push_back (std::move (axis));
    }
    return axes;
}

void readStructure (ObjectReader& in, Simulation& sim)
{
    sim.first_mode = in.number ("first_mode", unit::hertz, { .min = 0.0, .max = highest_first_mode, .without_min = true }, sim.first_mode);
    sim.first_mode_damping = in.number ("first_mode_damping", unit::gain, { .min = 0.0, .max = 1.0 }, sim.first_mode_damping);
    sim.end_mass = in.number ("end_mass", unit::kilogram, Bounds::positive(), sim.end_mass);
    if (! (sim.end_mass < sim.mass))
        in.error ("end_mass", "device/out_of_range", "end_mass is " + numberText (sim.end_mass) + " kg, which is not less than mass",
                  "end_mass is the part of the mass at the tool: write less than " + numberText (sim.mass) + " kg");
    for (const auto* key : { "first_mode_damping", "end_mass" })
        if (in.has (key) && ! in.has ("first_mode"))
            in.error (key, "device/missing", std::string (key) + " has no effect without first_mode",
                      "add \"first_mode\", in Hz, or remove " + std::string (key));
}

void readBrake (ObjectReader& in, Simulation& sim)
{
    sim.brake = in.number ("brake", unit::damping, Bounds::notNegative(), sim.brake);
    sim.brake_time = in.number ("brake_time", unit::second, Bounds::notNegative(), sim.brake_time);
    if (in.has ("brake_time") && ! in.has ("brake"))
        in.error ("brake_time", "device/missing", "brake_time has no effect without brake", "add \"brake\", in N*s/m, or remove brake_time");
    if (in.has ("brake") && in.has ("first_mode"))
        in.error ("brake", "device/out_of_range", "a simulated tool that bends has no brake", "remove first_mode, or remove brake");
}

std::unique_ptr<Device> makeSimulated (ObjectReader& in, const Folder& folder, Messages& messages, std::string& about)
{
    Simulation sim;
    sim.mass = in.number ("mass", unit::kilogram, Bounds::positive(), sim.mass);
    sim.damping = in.number ("damping", unit::damping, Bounds::notNegative(), sim.damping);
    sim.quantum = in.number ("quantum", unit::metre, Bounds::notNegative(), sim.quantum);
    sim.force_quantum = in.number ("force_quantum", unit::newton, Bounds::notNegative(), sim.force_quantum);
    sim.delay = in.whole ("delay", 0, longest_delay, sim.delay);
    sim.coulomb = in.number ("coulomb", unit::newton, Bounds::notNegative(), sim.coulomb);
    readStructure (in, sim);
    readBrake (in, sim);
    if (in.has ("hand")) sim.hand = readHand (in.object ("hand"), "/hand", folder, messages);
    sim.position = in.vector ("position", unit::metre, sim.hand.path ? sim.hand.path->at (0.0).position : Vec3 (Vec3::Zero()));
    sim.velocity = in.vector ("velocity", unit::speed, sim.velocity);
    sim.rotation = in.vector ("rotation", unit::radian, sim.rotation);
    sim.hand_force = in.vector ("hand_force", unit::newton, sim.hand_force);
    if (in.has ("axes")) sim.axes = readAxes (in.object ("axes"), "/axes", messages);
    sim.signal_outputs = in.whole ("signal_outputs", 0, Channels::most, sim.signal_outputs);

    about = "A simulated tool of " + numberText (sim.mass) + " kg with a damping of " + numberText (sim.damping) + " N*s/m, ";
    about += sim.hand.path ? "in a hand that follows " + in.object ("hand").value ("path", std::string()) + "." : std::string ("without a hand.");
    return std::make_unique<SimulatedDevice> (std::move (sim));
}

std::unique_ptr<Device> makeTrace (ObjectReader& in, const Folder& folder, Messages& messages, std::string& about)
{
    in.require ("path", "write the name of a CSV file that has the columns t,x,y,z");
    const auto file = in.text ("path");
    const auto placement = readPlacement (in);
    if (file.empty()) return nullptr;

    const auto trace = loadTrace (file, folder, "/path", messages);
    if (! trace) return nullptr;

    auto placed = std::make_shared<TraceData> (*trace);
    for (auto& row : placed->rows)
        row.position = placement.offset + placement.scale * row.position;

    about = "The recording " + file + ", " + std::to_string (placed->rows.size()) + " rows.";
    return std::make_unique<TraceDevice> (std::move (placed));
}

std::unique_ptr<Device> makeGesture (ObjectReader& in, const Folder&, Messages& messages, std::string& about)
{
    in.require ("path", "write the name of a gesture, such as \"stroke\"");
    const auto name = in.text ("path");
    const auto placement = readPlacement (in);
    if (name.empty()) return nullptr;

    const auto* gesture = gestureNamed (name, "/path", messages);
    if (gesture == nullptr) return nullptr;

    about = "A hand that does not yield. " + std::string (gesture->about);
    return std::make_unique<GestureDevice> (*gesture, placement);
}

struct Driver
{
    const char* id;
    std::unique_ptr<Device> (*make) (ObjectReader&, const Folder&, Messages&, std::string& about);
};

constexpr Driver drivers[] {
    { "sim", makeSimulated },
    { "trace", makeTrace },
    { "gesture", makeGesture },
};

std::vector<std::string> driverNames()
{
    std::vector<std::string> names;
    for (const auto& driver : drivers)
        names.emplace_back (driver.id);
    return names;
}

// Drivers of real devices, which other parts of Tactus open, and what chooses such a device in `--device ROLE=`.
constexpr std::string_view real_drivers[] { "hid", "serial", "udp", "audio" };

std::string driverOf (const Json& description)
{
    const auto written = description.is_object() ? description.find ("driver") : description.end();
    return written != description.end() && written->is_string() ? written->get<std::string>() : std::string();
}

/// The outputs of a sound card, which its description lists.
int outputsOf (const Json& description)
{
    const auto outputs = description.find ("outputs");
    return outputs != description.end() && outputs->is_array() ? static_cast<int> (std::min<std::size_t> (outputs->size(), Channels::most)) : 0;
}

/// The option that chooses the real device that a graph describes. The graph may contain any text, and users copy this line.
std::string optionFor (const Json& description, const std::string& role)
{
    const auto driver = driverOf (description);
    auto option = "--device " + role + "=" + driver;
    if (driver == "audio") return option;
    const auto profile = description.find ("profile");
    const bool is_named = profile != description.end() && profile->is_string() && graph::isId (profile->asString());
    if (driver != "hid") return option + ":" + (is_named ? profile->get<std::string>() : "PROFILE") + "@PORT";
    return option + ":" + (is_named ? profile->get<std::string>() : "auto");
}

// The keys that a simulated device can use from the description of a real one.
constexpr std::string_view known_to_sim[] { "mass", "damping", "quantum", "force_quantum", "delay", "coulomb", "first_mode",
                                            "first_mode_damping", "end_mass", "brake", "brake_time", "position", "velocity", "rotation", "hand_force", "hand",
                                            "axes", "signal_outputs", "guard", "about", "ui" };
}   // namespace

MadeDevice makeDevice (const Json& description, const Folder& folder)
{
    MadeDevice made;
    ObjectReader in (description, "", made.messages);
    if (! description.is_object()) return made;

    in.ignore ("about");
    in.ignore ("ui");
    in.require ("driver", "write one of: sim, trace, gesture");
    const auto id = in.text ("driver");

    const auto* driver = std::ranges::find_if (drivers, [&] (const Driver& d) { return d.id == id; });
    if (driver == std::end (drivers))
    {
        // Without the driver, the valid keys are unknown, so only this problem is reported.
        if (std::ranges::count (real_drivers, id) > 0)
            in.error ("driver", "device/real", "this is a real device, which only `tactus play` and tactus-host can drive",
                      "give the role a simulated device instead: \"driver\": \"sim\"");
        else if (! id.empty())
            in.error ("driver", "device/unknown_driver", "there is no driver " + quote (id),
                      suggestion (id, driverNames())
                          + (graph::isId (id) ? " (a driver in a plugin, " + id
                                                    + ".tactus-device, must be in a folder of plugins, and is chosen only with --device or in a session)"
                                              : std::string()));
        return made;
    }

    made.device = driver->make (in, folder, made.messages, made.about);
    if (in.has ("guard")) made.limits = readGuardLimits (in.object ("guard"), "/guard", made.messages, made.device ? made.device->layout() : DeviceLayout {});
    in.ignore ("guard");
    in.finish();

    if (hasErrors (made.messages)) made.device.reset();
    return made;
}

bool isSimulated (const Json& description)
{
    return std::ranges::count (drivers, driverOf (description), [] (const Driver& d) { return std::string (d.id); }) > 0;
}

Json describedByGraph (const Json* description, const std::string& role, Messages& messages)
{
    Json at_rest { { "driver", "sim" } };
    if (description == nullptr) return at_rest;
    if (std::ranges::count (real_drivers, driverOf (*description)) == 0) return *description;   // makeDevice() refuses what it does not know
    messages.push_back (Message::warning ("device/not_by_graph", "/devices/" + role + "/driver",
                                          "a graph cannot choose or calibrate a real device, so the role '" + role + "' gets a simulated tool at rest",
                                          "to use your device, give " + optionFor (*description, role)
                                              + " to `tactus play`, bind the role in your session, or choose it in the window, under Devices"));
    at_rest["signal_outputs"] = outputsOf (*description);
    return at_rest;
}

Json defaultDevice()
{
    return { { "driver", "sim" }, { "mass", "100 g" }, { "damping", 1.0 }, { "hand", { { "stiffness", 100.0 }, { "damping", 2.0 }, { "path", "stroke" } } } };
}

namespace
{
Message badOption (std::string_view text, std::string what)
{
    return Message::error ("device/option", "--device " + std::string (text), std::move (what),
                           "write ROLE=FILE.json, ROLE=sim, ROLE=trace:FILE.csv, ROLE=gesture:NAME, ROLE=hid:PROFILE, ROLE=serial:PROFILE@PORT, "
                           "ROLE=udp:PROFILE@ADDRESS:PORT, ROLE=audio:CARD or ROLE=DRIVER:PORT");
}

Json simulated (std::string_view role, const std::vector<std::pair<std::string, Json>>& described)
{
    for (const auto& [name, description] : described)
        if (name == role && description.is_object())
        {
            Json sim { { "driver", "sim" } };
            for (const auto key : known_to_sim)
                if (const auto it = description.find (key); it != description.end()) sim[std::string (key)] = *it;
            if (description.contains ("outputs")) sim["signal_outputs"] = outputsOf (description);   // the description is that of a sound card
            return sim;
        }
    return defaultDevice();
}

Result<DeviceOption> fromFile (std::string_view option, std::string role, const Folder& path)
{
    const auto content = readFile (path);
    if (! content)
        return Message::error ("device/unreadable", path.string(), "the device file cannot be read: " + content.error().text, badOption (option, {}).remedy);

    auto read = readJson (*content);
    if (! read.messages.empty())
    {
        const auto& m = read.messages.front();
        return Message::error ("device/syntax", path.string() + ":" + std::to_string (m.line) + ":" + std::to_string (m.column), m.text, m.remedy);
    }
    return DeviceOption { .role = std::move (role), .description = std::move (read.root), .folder = path.parent_path() };
}
}   // namespace

Result<DeviceOption> parseDeviceOption (std::string_view text, const std::vector<std::pair<std::string, Json>>& described, const Folder& folder_of_graph)
{
    const auto equals = text.find ('=');
    if (equals == text.npos) return badOption (text, "there is no '='");

    std::string role (text.substr (0, equals));
    const auto what = text.substr (equals + 1);
    if (! graph::isId (role)) return badOption (text, quote (role) + " is not a valid role name: use lower-case letters, digits and _, starting with a letter");

    if (what == "sim") return DeviceOption { .role = role, .description = simulated (role, described), .folder = folder_of_graph };

    constexpr std::string_view audio = "audio";
    if (what == audio || (what.starts_with (audio) && what.substr (audio.size()).starts_with (':')))
    {
        Json card { { "driver", audio } };
        if (const auto name = what.substr (std::min (what.size(), audio.size() + 1)); ! name.empty()) card["card"] = name;
        return DeviceOption { .role = role, .description = std::move (card), .folder = {} };
    }

    constexpr std::pair<std::string_view, const char*> with_a_name[] { { "trace", "path" }, { "gesture", "path" }, { "hid", "profile" } };
    for (const auto& [driver, key] : with_a_name)
        if (what.starts_with (driver) && what.substr (driver.size()).starts_with (':'))
        {
            const auto name = what.substr (driver.size() + 1);
            if (name.empty()) return badOption (text, "there is nothing after '" + std::string (driver) + ":'");
            return DeviceOption { .role = role, .description = { { "driver", driver }, { key, name } }, .folder = {} };
        }

    for (const std::string_view wire : { "serial", "udp" })
        if (what.starts_with (wire) && what.substr (wire.size()).starts_with (':'))
        {
            const auto profile = what.substr (wire.size() + 1);
            const auto at = profile.find ('@');
            if (at == profile.npos || at == 0 || at + 1 == profile.size())
                return badOption (text, quote (what) + " does not say both the profile and the place, as " + std::string (wire) + ":tactus_board@"
                                            + (wire == "udp" ? "192.168.4.1:9750" : "/dev/ttyACM0") + " does");
            return DeviceOption { .role = role,
                                  .description = { { "driver", wire }, { "profile", profile.substr (0, at) }, { "port", profile.substr (at + 1) } },
                                  .folder = {} };
        }

    if (! what.ends_with (".json"))
        return badOption (text, what.empty() ? "there is nothing after '='"
                                             : quote (what) + " is not sim, trace:, gesture:, hid:, serial:, udp:, audio, an installed driver or a .json file");
    return fromFile (text, std::move (role), Folder (what));
}

}   // namespace tactus
