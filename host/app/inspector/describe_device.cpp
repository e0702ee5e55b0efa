// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"

#include <host/app/model/device_profiles.hpp>
#include <host/audio/audio_settings.hpp>
#include <host/devices/make_device.hpp>
#include <host/hid_link/open_device.hpp>
#include <host/sessions/role_fits.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
Json descriptionOf (const Document& d, const std::string& role)
{
    const auto& all = d.graph().devices;
    const auto at = std::ranges::find (all, role, &std::pair<std::string, Json>::first);
    return at == all.end() ? Json() : at->second;
}

juce::String written (const Json& v) { return juce::String::fromUTF8 ((v.is_string() ? v.get<std::string>() : v.dump()).c_str()); }

Json readText (const juce::String& t)
{
    auto value = Json::parse (t.trim().toStdString(), nullptr, false);
    return value.is_discarded() ? Json (t.trim().toStdString()) : value;
}

/// The places of what is no object, as "/hand/stiffness".
void leaves (const Json& v, const std::string& path, std::vector<std::string>& all)
{
    if (! v.is_object()) return all.push_back (path);
    for (const auto& [key, inner] : v.items())
        leaves (inner, path + '/' + key, all);
}

Remark about (const Document& d, const std::string& role)
{
    auto description = descriptionOf (d, role);
    if (description.is_null()) return { "Nobody describes this role: it is simulated, with no hand. Start a description below.", false };
    Remark r { "A device that is plugged in, by its profile.", false };
    const auto tell = [&] (const Messages& messages)
    {
        for (const auto& m : messages)
        {
            r.text << (r.text.isEmpty() ? "" : "\n") << juce::String::fromUTF8 ((m.where + ": " + m.text + (m.remedy.empty() ? "" : "; " + m.remedy)).c_str());
            r.is_wrong = true;
        }
    };
    if (hid::isHid (description) || audio::isAudio (description))
    {
        if (audio::isAudio (description)) r.text = "Channels of the sound card.";
        tell (checkDescription (description, d.graph().folder, deviceProfiles()));
        return r;
    }
    const auto made = makeDevice (description, d.graph().folder);
    r.text = juce::String::fromUTF8 (made.about.c_str());
    tell (made.messages);
    return r;
}
}   // namespace

void describeDevice (const Inspected& at, const graph::Node& node, Column& column)
{
    auto& document = at.document;
    const auto role = node.role;
    column.add ("Device", Words::Kind::heading);
    std::vector<std::string> roles;
    for (const auto& [name, description] : document.graph().devices)
        roles.push_back (name);
    if (! role.empty() && std::ranges::count (roles, role) == 0) roles.push_back (role);
    column.add (choiceRow (
        "role", roles, [at, name = node.name]
        {
        const auto* in = at.in();
        const auto* n = in == nullptr ? nullptr : in->find (name);
        return n == nullptr ? std::string() : n->role; },
        [at, name = node.name] (const std::string& to)
        { at.document.perform (graph::SetNodeKey { at.patch, name, "role", Json (to) }); },
        "Which device it is"));
    if (role.empty()) return;
    column.add (remark ([&document, role]
                        { return about (document, role); }));

    const auto now = descriptionOf (document, role);
    const auto set = [&document, role] (const std::string& path, const Json& value)
    {
        auto all = descriptionOf (document, role);
        if (all.is_null()) all = Json::object();
        all[Json::json_pointer (path)] = value;
        document.perform (graph::SetDevice { role, std::move (all) });
    };
    if (now.is_null())
    {
        column.add (buttonRow (
            "Describe it", [&document, role]
            { document.perform (graph::SetDevice { role, defaultDevice() }); },
            "A simulated tool in a hand that strokes"));
        return;
    }
    std::vector<std::string> paths;
    leaves (now, {}, paths);
    for (const auto& path : paths)
    {
        const auto get = [&document, role, path]
        {
            const auto all = descriptionOf (document, role);
            const auto pointer = Json::json_pointer (path);
            return all.contains (pointer) ? written (all.at (pointer)) : juce::String();
        };
        const auto label = juce::String (path.substr (1)).replaceCharacter ('/', ' ');
        if (path == "/driver")
            column.add (choiceRow (
                label, { "sim", "trace", "gesture", "hid", "audio" }, [get]
                { return get().toStdString(); },
                [set, path] (const std::string& t)
                { set (path, Json (t)); },
                "sim: a simulated tool in a hand; trace: a recording; gesture: one that is drawn by a formula; hid: one that is plugged in, by its profile (docs/devices.md); audio: channels of a sound card (docs/audio.md)"));
        else
            column.add (textRow (
                label, get, [set, path] (const juce::String& t)
                { set (path, readText (t)); },
                "As in the file: a number, or one with a unit. The device takes it when it starts anew."));
    }
    column.add (textRow (
        "all of it", [&document, role]
        {
        const auto all = descriptionOf (document, role);
        return all.is_null() ? juce::String() : written (all); },
        [&document, role, refused = at.refused] (const juce::String& t)
        {
        auto value = Json::parse (t.trim().toStdString(), nullptr, false);
        if (value.is_object())
            document.perform (graph::SetDevice { role, std::move (value) });
        else
            refused ("A description is an object: {\"driver\": \"sim\", \"mass\": \"50 g\"}"); },
        "The description as the file has it; other keys can be written here", 5));
}

}   // namespace tactus::host
