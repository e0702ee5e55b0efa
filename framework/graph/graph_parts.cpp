// SPDX-License-Identifier: MIT
#include "graph_parts.hpp"

#include "endpoint_text.hpp"
#include "part_reader.hpp"

#include <tactus/text/quote.hpp>

#include <cmath>
#include <initializer_list>
#include <unordered_set>

namespace tactus
{
using namespace graph;

namespace
{
/// Checks a part that was made by a program rather than read from a file.
template <typename Read>
Messages checked (Json part, Read&& read)
{
    PartReader reader;
    if (const auto fits = checkValue (part))
        read (reader, part);
    else
        reader.error ("file/bad_value", "", fits.error().text, fits.error().remedy);
    std::erase_if (reader.messages, [] (const Message& m) { return m.severity != Message::Severity::error; });
    return std::move (reader.messages);
}

/// Checks that these parts are objects, because the writer relies on that.
Messages allObjects (std::initializer_list<const Json*> parts)
{
    PartReader reader;
    for (const auto* part : parts)
        if (! part->is_object()) reader.error ("file/wrong_kind", "", "this should be an object, {…}", "use Json::object()");
    return std::move (reader.messages);
}

bool sameEnds (const Wire& a, const Wire& b) { return a.from == b.from && a.to == b.to && a.delay == b.delay && a.add == b.add; }
}   // namespace

Messages graph::check (const graph::Node& node)
{
    if (auto wrong = allObjects ({ &node.params, &node.settings, &node.overrides, &node.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (node), [&] (PartReader& reader, Json& part) {
        graph::Node same;
        reader.checkId (node.name, "", "a node");
        reader.readNode (node.name, part, std::string(), same);
    });
}

Messages graph::check (const graph::Wire& wire)
{
    if (auto wrong = allObjects ({ &wire.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (wire), [&] (PartReader& reader, Json& part) {
        Patch same;
        reader.readWire (part, "", same);
        if (reader.messages.empty() && ! sameEnds (same.wires.at (0), wire))
            reader.error ("wire/syntax", "", quote (toText (wire)) + " reads back as a different wire",
                          "name nodes and ports with ids: lower-case letters, digits and _");
    });
}

Messages graph::check (const graph::Control& control)
{
    if (auto wrong = allObjects ({ &control.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (control), [&] (PartReader& reader, Json& part) {
        Control same;
        reader.checkId (control.id, "", "a control");
        reader.readControl (control.id, part, "", same);
    });
}

Messages graph::check (const graph::Expose& expose)
{
    if (auto wrong = allObjects ({ &expose.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (expose), [&] (PartReader& reader, Json& part) {
        Expose same;
        reader.readExpose (part, "", same);
        if (reader.messages.empty() && (same.inputs != expose.inputs || same.outputs != expose.outputs || same.params != expose.params))
            reader.error ("graph/bad_path", "", "an exposed port reads back as a different one",
                          "name nodes and ports with ids: lower-case letters, digits and _");
    });
}

Messages graph::check (const graph::Patch& patch)
{
    if (auto wrong = allObjects ({ &patch.extra }); ! wrong.empty()) return wrong;
    for (const auto& node : patch.nodes)
        if (auto wrong = check (node); ! wrong.empty()) return wrong;
    for (const auto& wire : patch.wires)
        if (auto wrong = check (wire); ! wrong.empty()) return wrong;
    if (auto wrong = check (patch.expose); ! wrong.empty()) return wrong;
    return checked (toJson (patch), [] (PartReader& reader, Json& part) {
        Patch same;
        reader.readSubgraph (part, "", same);
    });
}

Messages checkNodeKey (const std::string& key, const Json& value)
{
    auto object = Json::object();
    if (key != "type") append (object, "type", "signal.gain");
    append (object, key, value);
    return checked (std::move (object), [&] (PartReader& reader, Json& part) {
        graph::Node same;
        reader.readNode ("node", part, std::string(), same);
    });
}

Result<> checkValue (const Json& value)
{
    struct Walk
    {
        static Message wrong (std::string text) { return Message::error ("edit/bad_value", {}, std::move (text), "give a value that JSON can hold: a finite number, text, a list or an object"); }

        static Result<> through (const Json& v, int depth)
        {
            constexpr int deepest = deepest_nesting - 8;   // a value is nested up to 8 levels deep in a file
            if (depth > deepest) return wrong ("a value is nested too deeply for a file");
            if (v.is_number_float() && ! std::isfinite (v.get<double>())) return wrong ("nan and inf are not valid values");
            if (v.is_object())
            {
                std::unordered_set<std::string_view> keys;
                for (const auto& [key, member] : v.asObject())
                {
                    if (! keys.insert (key).second) return wrong ("the key " + quote (key) + " occurs twice in one object");
                    if (auto fits = through (member, depth + 1); ! fits) return fits;
                }
            }
            if (v.is_array())
                for (const auto& element : v)
                    if (auto fits = through (element, depth + 1); ! fits) return fits;
            return {};
        }
    };
    return Walk::through (value, 0);
}

}   // namespace tactus
