// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/run/device/make_device.hpp>

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

/// Collects the JSON pointers of all values that are not objects, such as "/hand/stiffness".
void addLeaves (const Json& v, const std::string& path, std::vector<std::string>& all)
{
    if (! v.is_object()) return all.push_back (path);
    for (const auto& [key, inner] : v.items())
        addLeaves (inner, path + '/' + key, all);
}

Remark describeRole (const Document& d, const std::string& role)
{
    const auto description = descriptionOf (d, role);
    if (description.is_null()) return { TRANS ("This role has no description. Its device is simulated, without a hand. Add a description below."), false };
    Remark r;
    const auto append = [&] (const Messages& messages) {
        for (const auto& m : messages)
        {
            r.text << (r.text.isEmpty() ? "" : "\n") << fromUtf8 (m.where + ": " + messageText (m));
            r.is_problem = true;
        }
    };
    Messages refused;
    const auto made = makeDevice (describedByGraph (&description, role, refused), d.graph().folder);
    r.text = refused.empty() ? fromUtf8 (unitShown (made.about)) : TRANS ("A graph cannot choose a real device. Choose it in the Devices panel.");
    r.is_problem = ! refused.empty();
    append (made.messages);
    return r;
}

/// A value as text: a list without its brackets and quotation marks, "0 mm, 0 mm, -1 mm".
juce::String textOf (const Json& value)
{
    if (! value.is_array()) return editText (value);
    juce::StringArray parts;
    for (const auto& v : value)
        parts.add (editText (v));
    return parts.joinIntoString (", ");
}

/// The value that was typed. Several parts with commas between them are a list.
Json valueOf (const juce::String& text)
{
    const auto one = parseText (text);
    if (! one.is_string() || ! text.containsChar (',')) return one;
    auto list = Json::array();
    for (const auto& part : juce::StringArray::fromTokens (text, ",", {}))
        list.push_back (parseText (part));
    return list;
}

/// Sets a value of the description of a role, or removes it, with the object around it if that becomes empty.
void setValue (Document& document, const std::string& role, const std::string& path, const std::optional<Json>& value)
{
    auto all = descriptionOf (document, role);
    if (all.is_null()) all = Json::object();
    const JsonPointer at (path);
    if (value)
        all[at] = *value;
    else if (all.contains (at))
    {
        all.at (at.parent()).erase (at.parts().back());
        if (! at.parent().parts().empty() && all.at (at.parent()).empty()) all.at (at.parent().parent()).erase (at.parent().parts().back());
    }
    document.perform (graph::SetDevice { role, std::move (all) });
}

const char* const driver_help = NEEDS_TRANS ("sim: a simulated tool in a hand; trace: a recording; gesture: a motion computed from a formula; "
                                             "real devices are chosen in the Devices panel");

/// Adds the row for one value of a device description.
void addValue (Document& document, const std::string& role, const std::string& path, Column& column)
{
    const auto get = [&document, role, path] {
        const auto all = descriptionOf (document, role);
        const auto pointer = JsonPointer (path);
        return all.contains (pointer) ? textOf (all.at (pointer)) : juce::String();
    };
    const auto set = [&document, role, path] (const std::optional<Json>& value) { setValue (document, role, path, value); };
    const auto label = juce::String (path.substr (1)).replaceCharacter ('/', ' ');
    if (path == "/driver")
        column.add (choiceRow (
            label, { "sim", "trace", "gesture" }, [get] { return get().toStdString(); },
            [set] (const std::string& t) { set (Json (t)); },
            juce::translate (driver_help)));
    else
        column.add (textRow (
            label, get, [set] (const juce::String& t) { set (t.trim().isEmpty() ? std::nullopt : std::optional (valueOf (t))); },
            TRANS ("A number, with or without a unit, or several with commas. Leave empty to remove it. Takes effect when the device restarts.")));
}
}   // namespace

void describeDevice (const InspectorContext& at, const graph::Node& node, Column& column)
{
    auto& document = at.document;
    const auto role = node.role;
    column.add (TRANS ("Device"), TextBlock::Kind::heading);
    std::vector<std::string> roles;
    for (const auto& [name, description] : document.graph().devices)
        roles.push_back (name);
    if (! role.empty() && std::ranges::count (roles, role) == 0) roles.push_back (role);
    const auto getRole = [at, name = node.name] {
        const auto* n = at.node (name);
        return n == nullptr ? std::string() : n->role;
    };
    const auto setRole = [at, name = node.name] (const std::string& to) { at.document.perform (graph::SetNodeKey { at.patch, name, "role", Json (to) }); };
    column.add (choiceRow (TRANS ("role"), roles, getRole, setRole, TRANS ("The device this node belongs to")));
    if (role.empty()) return;
    column.add (remark ([&document, role] { return describeRole (document, role); }));

    const auto now = descriptionOf (document, role);
    if (now.is_null())
    {
        const auto describe = [&document, role] { document.perform (graph::SetDevice { role, newTool() }); };
        column.add (buttonRow (TRANS ("Add description"), describe, TRANS ("Adds a simulated tool with a guard, moved by a hand that strokes")));
        return;
    }
    std::vector<std::string> paths;
    addLeaves (now, {}, paths);
    for (const auto& path : paths)
        addValue (document, role, path, column);
    column.add (textRow (
        TRANS ("add value"), [] { return juce::String(); },
        [&document, role, refused = at.refused] (const juce::String& t) {
        if (t.trim().isEmpty()) return;
        const auto path = t.upToFirstOccurrenceOf ("=", false, false).trim().replaceCharacter (' ', '/');
        if (! t.contains ("=") || path.isEmpty()) return refused (TRANS ("Write what and how much: mass = 50 g, or hand stiffness = 600 N/m"));
        setValue (document, role, '/' + path.toStdString(), valueOf (t.fromFirstOccurrenceOf ("=", false, false))); },
        TRANS ("Adds a value to the description of the device: mass = 50 g, or hand stiffness = 600 N/m")));
}

}   // namespace tactus::host
