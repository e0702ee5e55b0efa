// SPDX-License-Identifier: MIT
#include "graph_parts.hpp"

#include "part_reader.hpp"

#include <framework/graph/text.hpp>
#include <framework/in_quotes.hpp>

#include <cmath>
#include <initializer_list>
#include <unordered_set>

namespace tactus
{
using namespace graph;

namespace
{
/// What is wrong with a part that has been made by a program rather than read.
template <typename Read>
Messages checked (Json part, Read&& read)
{
    PartReader reader;
    if (const auto problem = problemOf (part))
        reader.error ("file/bad_value", "", *problem);
    else
        read (reader, part);
    std::erase_if (reader.messages, [] (const Message& m)
                   { return m.severity != Message::Severity::error; });
    return std::move (reader.messages);
}

/// The writer relies on these being objects.
Messages allObjects (std::initializer_list<const Json*> parts)
{
    PartReader reader;
    for (const auto* part : parts)
        if (! part->is_object()) reader.error ("file/wrong_kind", "", "an object, {…}, should stand here", "use Json::object()");
    return std::move (reader.messages);
}

bool sameEnds (const Wire& a, const Wire& b) { return a.from == b.from && a.to == b.to && a.delay == b.delay && a.add == b.add; }
}   // namespace

Messages check (const graph::Node& node)
{
    if (auto wrong = allObjects ({ &node.params, &node.settings, &node.overrides, &node.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (node), [&] (PartReader& reader, Json& part)
                    {
                        graph::Node same;
                        reader.checkId (node.name, "", "a node");
                        reader.readNode (node.name, part, "", same); });
}

Messages check (const graph::Wire& wire)
{
    if (auto wrong = allObjects ({ &wire.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (wire), [&] (PartReader& reader, Json& part)
                    {
                        Patch same;
                        reader.readWire (part, "", same);
                        if (reader.messages.empty() && ! sameEnds (same.wires.at (0), wire))
                            reader.error ("wire/syntax", "", inQuotes (toText (wire)) + " does not read back as it was meant", "use ids for nodes and ports"); });
}

Messages check (const graph::Control& control)
{
    if (auto wrong = allObjects ({ &control.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (control), [&] (PartReader& reader, Json& part)
                    {
                        Control same;
                        reader.checkId (control.id, "", "a control");
                        reader.readControl (control.id, part, "", same); });
}

Messages check (const graph::Expose& expose)
{
    if (auto wrong = allObjects ({ &expose.extra }); ! wrong.empty()) return wrong;
    return checked (toJson (expose), [&] (PartReader& reader, Json& part)
                    {
                        Expose same;
                        reader.readExpose (part, "", same);
                        if (reader.messages.empty() && (same.inputs != expose.inputs || same.outputs != expose.outputs || same.params != expose.params))
                            reader.error ("graph/bad_path", "", "a port that is shown does not read back as it was meant", "use ids for nodes and ports"); });
}

Messages check (const graph::Patch& patch)
{
    if (auto wrong = allObjects ({ &patch.extra }); ! wrong.empty()) return wrong;
    for (const auto& node : patch.nodes)
        if (auto wrong = check (node); ! wrong.empty()) return wrong;
    for (const auto& wire : patch.wires)
        if (auto wrong = check (wire); ! wrong.empty()) return wrong;
    if (auto wrong = check (patch.expose); ! wrong.empty()) return wrong;
    return checked (toJson (patch), [] (PartReader& reader, Json& part)
                    {
                        Patch same;
                        reader.readSubgraph (part, "", same); });
}

Messages checkNodeKey (const std::string& key, const Json& value)
{
    auto object = Json::object();
    if (key != "type") append (object, "type", "signal.gain");
    append (object, key, value);
    return checked (std::move (object), [&] (PartReader& reader, Json& part)
                    {
                        graph::Node same;
                        reader.readNode ("node", part, "", same); });
}

std::optional<std::string> problemOf (const Json& value)
{
    struct Walk
    {
        static std::optional<std::string> through (const Json& v, int depth)
        {
            constexpr int deepest = deepest_nesting - 8;   // what a value may add to its place in the file
            if (depth > deepest) return "a value is nested too deep for a file";
            if (v.is_number_float() && ! std::isfinite (v.get<double>())) return "nan and inf are not values";
            if (v.is_binary() || v.is_discarded()) return "this is not a value for a file";
            if (v.is_object())
            {
                std::unordered_set<std::string_view> keys;
                for (const auto& [key, member] : v.get_ref<const Json::object_t&>())
                {
                    if (! keys.insert (key).second) return "the key " + inQuotes (key) + " stands twice in one object";
                    if (auto problem = through (member, depth + 1)) return problem;
                }
            }
            if (v.is_array())
                for (const auto& element : v)
                    if (auto problem = through (element, depth + 1)) return problem;
            return std::nullopt;
        }
    };
    return Walk::through (value, 0);
}

}   // namespace tactus
