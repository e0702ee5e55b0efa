// SPDX-License-Identifier: MIT
#include "needs.hpp"

#include <host/devices/hid/hid_model.hpp>
#include <host/devices/hid_link/hid_device.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/sessions/audio_settings.hpp>
#include <tactus/node/device_parts.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <charconv>

namespace tactus::host
{

namespace
{
/// A setting of a node; null if its type has none with this name.
const SettingValue* setting (const plan::FlatNode& node, std::string_view id)
{
    const auto at = std::ranges::find (node.type->settings, id, &SettingSheet::id);
    const auto i = static_cast<std::size_t> (at - node.type->settings.begin());
    return i < node.settings.size() ? &node.settings[i] : nullptr;
}

std::string textOf (const plan::FlatNode& node, std::string_view id)
{
    const auto* value = setting (node, id);
    const auto* text = value != nullptr ? std::get_if<std::string> (value) : nullptr;
    return text != nullptr ? *text : std::string();
}

int numberOf (const plan::FlatNode& node, std::string_view id)
{
    const auto* value = setting (node, id);
    const auto* number = value != nullptr ? std::get_if<double> (value) : nullptr;
    return number != nullptr ? static_cast<int> (*number) : 0;
}

void addOnce (std::vector<std::string>& names, std::string name)
{
    if (! name.empty() && std::ranges::count (names, name) == 0) names.push_back (std::move (name));
}

void add (DeviceParts& parts, const plan::Flat& flat, int index)
{
    const auto& node = flat.nodes[static_cast<std::size_t> (index)];
    const auto isWired = [&] (Role role, std::string_view port) {
        return std::ranges::any_of (flat.wires, [&] (const plan::FlatWire& w) {
            if (role == Role::output && ! w.from) return false;
            const auto& end = role == Role::output ? *w.from : w.to;
            return end.node == index && end.role == role && flat.sheet (end).id == port;
        });
    };
    const auto id = node.type->info.id;
    if (id == "device.position")
    {
        parts.position = parts.position || isWired (Role::output, "position");
        parts.rotation = parts.rotation || isWired (Role::output, "rotation");
    }
    else if (id == "device.force")
    {
        parts.force = parts.force || isWired (Role::input, "force");
        parts.torque = parts.torque || isWired (Role::input, "torque");
    }
    else if (id == "device.brake")
        parts.brake = true;
    else if (id == "device.pressure")
        parts.pressure = parts.pressure || isWired (Role::output, "force");
    else if (id == "device.truth")
        parts.truth = true;
    else if (id == "device.axis")
        addOnce (parts.others.axes, textOf (node, "axis"));
    else if (id == "device.effort")
        addOnce (parts.others.efforts, textOf (node, "axis"));
    else if (id == "device.button")
        addOnce (parts.others.buttons, textOf (node, "button"));
    else if (id == "device.signal_out")
        parts.others.signal_outputs = std::max (parts.others.signal_outputs, numberOf (node, "channel"));
    else if (id == "device.signal_in")
        parts.others.signal_inputs = std::max (parts.others.signal_inputs, numberOf (node, "channel"));
}

int entriesOf (const Json& description, const char* key)
{
    const auto list = description.find (key);
    return list != description.end() && list->is_array() ? static_cast<int> (std::min<std::size_t> (list->size(), Channels::most)) : 0;
}

/// True if the device has this button. Buttons can also be addressed by number.
bool hasButton (const DeviceLayout& there, const std::string& name)
{
    int number = -1;
    const auto* end = name.data() + name.size();
    if (std::from_chars (name.data(), end, number).ptr == end && number >= 0 && number < static_cast<int> (there.buttons.size())) return true;
    return partNamed (name, there.buttons) >= 0;
}
}   // namespace

std::vector<RoleNeeds> needsOf (const Plan& plan)
{
    std::vector<RoleNeeds> all;
    for (const auto& role : plan.roles())
        all.push_back ({ role.name, {} });
    const auto& flat = plan.flat();
    for (std::size_t i = 0; i < flat.nodes.size(); ++i)
        if (const auto at = std::ranges::find (all, flat.nodes[i].role, &RoleNeeds::role);
            at != all.end() && flat.nodes[i].type != nullptr && flat.nodes[i].runs())
            add (at->parts, flat, static_cast<int> (i));
    return all;
}

DeviceParts partsOf (const hid::Profile& p)
{
    const auto any = [] (const std::array<std::string, 3>& names) { return std::ranges::any_of (names, [] (const std::string& n) { return ! n.empty(); }); };
    return { .position = any (p.position),
             .rotation = any (p.rotation),
             .pressure = ! p.pressure.empty(),
             .force = any (p.force),
             .torque = any (p.torque),
             .others = hid::layoutOf (hid::HidModel (std::make_shared<const hid::Profile> (p))) };
}

namespace
{
/// The axes of the graph along which a device acts: "x and y". Empty if it acts along all three. `names`: its own axes; an empty name means none there.
std::string directions (const hid::Profile& p, const std::array<std::string, 3>& names, const Mat3& axes)
{
    Vec3 has;
    for (int i = 0; i < 3; ++i)
        has[i] = names[static_cast<std::size_t> (i)].empty() ? 0.0 : 1.0;
    Mat3 moves = has.asDiagonal();
    if (const auto* linear = std::get_if<hid::LinearMap> (&p.kinematics)) moves = linear->matrix * moves;
    if (std::holds_alternative<hid::SerialArm> (p.kinematics)) moves.setIdentity();   // of the five bars, the two fields lead to x and y
    moves = axes * p.axes * moves;
    std::string text;
    int count = 0;
    for (int i = 0; i < 3; ++i)
        if (moves.row (i).cwiseAbs().maxCoeff() > 1e-9) text += (count++ == 0 ? "" : " and ") + std::string (1, static_cast<char> ('x' + i));
    return count == 3 ? std::string() : text;
}
}   // namespace

std::string movesAlong (const hid::Profile& p, const Mat3& axes) { return directions (p, p.position, axes); }

std::string pushesAlong (const hid::Profile& p, const Mat3& axes) { return directions (p, p.force, axes); }

DeviceParts partsOf (const DriverAbout& a)
{
    return { .position = a.position, .rotation = a.rotation, .pressure = a.pressure, .force = a.force, .torque = a.torque, .others = a.layout };
}

std::optional<DeviceParts> partsOf (const Json& description, const std::filesystem::path& folder, const hid::LoadedProfiles& profiles)
{
    if (! description.is_object()) return std::nullopt;
    if (hid::isHid (description))
    {
        const auto name = description.value ("profile", Json());
        const auto profile = name.is_string() ? hid::profileNamed (profiles, name.asString()) : nullptr;
        return profile ? std::optional (partsOf (*profile)) : std::nullopt;
    }
    if (audio::isAudio (description))
    {
        // Without either, the sound card gets the channels that the graph uses.
        if (! description.contains ("outputs") && ! description.contains ("inputs")) return std::nullopt;
        DeviceParts parts;
        parts.others.signal_outputs = entriesOf (description, "outputs");
        parts.others.signal_inputs = entriesOf (description, "inputs");
        return parts;
    }
    const auto made = makeDevice (description, folder);
    if (! made.device) return std::nullopt;
    const auto layout = made.device->layout();
    return DeviceParts { .position = true,
                         .rotation = true,
                         .pressure = true,
                         .force = true,
                         .torque = true,
                         .brake = layout.brake > 0.0,
                         .truth = true,
                         .others = layout };
}

std::string describe (const DeviceParts& p)
{
    std::string text;
    const auto say = [&] (const std::string& what) { addToList (text, what); };
    const auto named = [&] (const char* kind, const std::vector<std::string>& names) {
        for (const auto& n : names)
            if (! n.empty()) say (std::string (kind) + " " + quote (n));
    };
    const auto channels = [&] (const char* kind, int n) {
        if (n > 0) say (std::string (kind) + (n == 1 ? " 1" : "s 1 to " + std::to_string (n)));
    };
    if (p.position) say ("position");
    if (p.rotation) say ("rotation");
    if (p.pressure) say ("pressure");
    if (p.force) say ("force");
    if (p.torque) say ("torque");
    if (p.brake) say ("brake");
    if (p.truth) say ("truth");
    named ("axis", p.others.axes);
    named ("effort", p.others.efforts);
    named ("button", p.others.buttons);
    channels ("signal output", p.others.signal_outputs);
    channels ("signal input", p.others.signal_inputs);
    return text.empty() ? "nothing" : text;
}

std::vector<std::string> lackingOf (const DeviceParts& needed, const DeviceParts& there)
{
    std::vector<std::string> all;
    const auto tool = [&] (bool is_needed, bool is_there, const char* what) {
        if (is_needed && ! is_there) all.push_back (std::string ("no ") + what);
    };
    const auto say = [&] (std::string what) {
        if (! what.empty()) all.push_back (std::move (what));
    };
    tool (needed.position, there.position, "position");
    tool (needed.rotation, there.rotation, "rotation");
    tool (needed.pressure, there.pressure, "pressure");
    tool (needed.force, there.force, "force");
    tool (needed.torque, there.torque, "torque");
    tool (needed.brake, there.brake, "brake");
    tool (needed.truth, there.truth, "ground truth: only a simulated device has it");
    for (const auto& name : needed.others.axes)
        say (lacking ("axis", "axes", name, there.others.axes));
    for (const auto& name : needed.others.efforts)
        say (lacking ("driven axis", "driven axes", name, there.others.efforts));
    for (const auto& name : needed.others.buttons)
        if (! hasButton (there.others, name)) say (lacking ("button", "buttons", name, there.others.buttons));
    if (needed.others.signal_outputs > there.others.signal_outputs)
        say (lackingChannel ("signal output", needed.others.signal_outputs, there.others.signal_outputs));
    if (needed.others.signal_inputs > there.others.signal_inputs)
        say (lackingChannel ("signal input", needed.others.signal_inputs, there.others.signal_inputs));
    return all;
}

Messages missingTools (const RoleNeeds& needs, const DeviceParts& there)
{
    auto tool = needs.parts;
    tool.others = {};
    Messages messages;
    for (const auto& what : lackingOf (tool, there))
        messages.push_back (Message::warning ("device/missing_tool", "/devices/" + needs.role,
                                              "the device of the role " + quote (needs.role) + " has " + what,
                                              "a missing input reads 0, and a missing output has no effect; "
                                              "to bind another device, see `tactus session --help`"));
    return messages;
}

}   // namespace tactus::host
