// SPDX-License-Identifier: MIT
#include "handles.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/edit.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/json.hpp>

using namespace tactus::capi;
namespace graph = tactus::graph;
using tactus::Json;
using tactus::Message;
using tactus::Result;

namespace
{
tactus_graph* keep (tactus::LoadedGraph loaded, tactus_messages* messages)
{
    const bool is_broken = tactus::hasErrors (loaded.messages);
    add (messages, std::move (loaded.messages));
    return is_broken ? nullptr : new tactus_graph { graph::History (std::move (loaded.graph)) };
}

/// Performs the edit that `make` returns. `make` returns an error if the arguments of the caller are wrong.
template <typename F>
tactus_result perform (tactus_graph* g, tactus_messages* messages, F&& make) noexcept
{
    if (g == nullptr) return misuse ("the graph is NULL");
    return guarded (messages, TACTUS_FAILED, [&] {
        auto command = make();
        if (! command) return failed (messages, std::move (command).error());
        return asResult (messages, g->history.perform (std::move (*command)));
    });
}

/// Reads a value that is written as in a graph file. Empty if `json` is null.
Result<std::optional<Json>> valueOf (const char* json)
{
    if (json == nullptr) return std::optional<Json> {};
    if (auto value = Json::tryParse (json)) return std::optional<Json> (std::move (*value));
    return Message::error ("api/value", "", "the value " + std::string (json) + " is not JSON", "write a number, text in quotes, a list or an object");
}

template <typename F>
Result<graph::Command> withValue (const char* json, F&& make)
{
    auto value = valueOf (json);
    if (! value) return std::move (value).error();
    return graph::Command (make (std::move (*value)));
}

}   // namespace

tactus_graph* tactus_graph_create (const char* name, double rate_hz, tactus_messages* messages)
{
    return guarded<tactus_graph*> (messages, nullptr,
                                   [&]() -> tactus_graph* {
                                       if (! (rate_hz >= 1.0 && rate_hz <= 1e6))
                                       {
                                           failed (messages, Message::error ("api/rate", "/rate_hz", "the rate is not between 1 and 10^6 Hz",
                                                                             "give a rate such as 4000"));
                                           return nullptr;
                                       }
                                       graph::Graph g;
                                       g.name = text (name);
                                       g.rate_hz = rate_hz;
                                       return new tactus_graph { graph::History (std::move (g)) };
                                   });
}

tactus_graph* tactus_graph_load (const char* path, tactus_messages* messages)
{
    if (path == nullptr) return nullptr;
    return guarded<tactus_graph*> (messages, nullptr, [&] { return keep (tactus::loadGraph (path), messages); });
}

tactus_graph* tactus_graph_parse (const char* json, size_t length, const char* folder, tactus_messages* messages)
{
    if (json == nullptr) return nullptr;
    return guarded<tactus_graph*> (messages, nullptr, [&] {
        auto loaded = tactus::readGraph ({ json, length });
        loaded.graph.folder = text (folder);
        return keep (std::move (loaded), messages);
    });
}

tactus_result tactus_graph_set_file (tactus_graph* g, const char* path, const tactus_graph* file, tactus_messages* messages)
{
    if (g == nullptr || path == nullptr || file == nullptr) return misuse ("a graph or the path is NULL");
    if (g->history.isInBatch()) return misuse ("the graph is in a batch");
    return guarded (messages, TACTUS_FAILED, [&] {
        auto with = g->history.graph();
        with.files.insert_or_assign (path, std::make_shared<const graph::Graph> (file->history.graph()));
        g->history = graph::History (std::move (with));
        return TACTUS_OK;
    });
}

void tactus_graph_free (tactus_graph* g) { delete g; }

tactus_result tactus_graph_save (const tactus_graph* g, const char* path, tactus_messages* messages)
{
    if (g == nullptr || path == nullptr) return misuse ("the graph or the path is NULL");
    return guarded (messages, TACTUS_FAILED, [&] { return asResult (messages, tactus::saveGraph (g->history.graph(), path)); });
}

char* tactus_graph_text (const tactus_graph* g)
{
    if (g == nullptr) return nullptr;
    return guarded<char*> (nullptr, nullptr, [&] { return copied (tactus::writeGraph (g->history.graph())); });
}

double tactus_graph_rate (const tactus_graph* g) { return g != nullptr ? g->history.graph().rate_hz : 0.0; }

tactus_result tactus_graph_add_node (tactus_graph* g, const char* patch, const char* name, const char* type, tactus_messages* messages)
{
    return perform (g, messages, [&]() -> Result<graph::Command> {
        graph::Node node;
        node.name = text (name);
        node.type = text (type);
        return graph::Command (graph::AddNode { text (patch), std::move (node) });
    });
}

tactus_result tactus_graph_remove_node (tactus_graph* g, const char* patch, const char* name, tactus_messages* messages)
{
    return perform (g, messages, [&]() -> Result<graph::Command> { return graph::Command (graph::RemoveNode { text (patch), text (name) }); });
}

tactus_result tactus_graph_rename_node (tactus_graph* g, const char* patch, const char* name, const char* to, tactus_messages* messages)
{
    return perform (g, messages, [&]() -> Result<graph::Command> { return graph::Command (graph::RenameNode { text (patch), text (name), text (to) }); });
}

tactus_result tactus_graph_set_param (tactus_graph* g, const char* patch, const char* node, const char* param, const char* value, tactus_messages* messages)
{
    return perform (g, messages, [&] {
        return withValue (value, [&] (auto v) { return graph::SetParam { text (patch), text (node), text (param), std::move (v) }; });
    });
}

tactus_result tactus_graph_set_setting (tactus_graph* g, const char* patch, const char* node, const char* setting, const char* value, tactus_messages* messages)
{
    return perform (g, messages,
                    [&] { return withValue (value, [&] (auto v) { return graph::SetSetting { text (patch), text (node), text (setting), std::move (v) }; }); });
}

tactus_result tactus_graph_set_key (tactus_graph* g, const char* patch, const char* node, const char* key, const char* value, tactus_messages* messages)
{
    return perform (g, messages, [&] {
        return withValue (value, [&] (auto v) { return graph::SetNodeKey { text (patch), text (node), text (key), std::move (v) }; });
    });
}

tactus_result tactus_graph_add_wire (tactus_graph* g, const char* patch, const char* wire, tactus_messages* messages)
{
    return perform (g, messages, [&]() -> Result<graph::Command> {
        auto parsed = graph::parseWire (text (wire));
        if (! parsed) return Message::error (parsed.error().id, "/wires", parsed.error().text, "write a wire such as a.out -> b.in");
        return graph::Command (graph::AddWire { text (patch), std::move (*parsed) });
    });
}

tactus_result tactus_graph_remove_wire (tactus_graph* g, const char* patch, const char* wire, tactus_messages* messages)
{
    if (wire == nullptr) return TACTUS_MISUSE;
    return perform (g, messages, [&]() -> Result<graph::Command> { return graph::Command (graph::RemoveWire { text (patch), 0, text (wire) }); });
}

tactus_result tactus_graph_set_device (tactus_graph* g, const char* role, const char* description, tactus_messages* messages)
{
    return perform (g, messages, [&] { return withValue (description, [&] (auto v) { return graph::SetDevice { text (role), std::move (v) }; }); });
}

tactus_result tactus_graph_set_control (tactus_graph* g, const char* id, double value, tactus_messages* messages)
{
    return perform (g, messages, [&]() -> Result<graph::Command> {
        const auto found = tactus::findControl (g->history.graph(), text (id));
        if (! found) return found.error();
        if (! (value >= 0.0 && value <= 1.0)) return tactus::beyondControl (text (id));
        auto to = **found;
        to.value = value;
        return graph::Command (graph::ChangeControl { text (id), std::move (to) });
    });
}

tactus_result tactus_graph_perform_all (tactus_graph* g, const char* name, tactus_graph_edits edits, void* user, tactus_messages* messages)
{
    if (g == nullptr || edits == nullptr) return misuse ("the graph or the function is NULL");
    if (g->history.isInBatch()) return misuse ("the graph is in a batch already");
    const auto result = guarded (messages, TACTUS_FAILED, [&] {
        g->history.begin (text (name));
        const auto done = edits (g, user);
        return done == TACTUS_OK ? asResult (messages, g->history.finish()) : done;
    });
    if (g->history.isInBatch()) g->history.abandon();
    return result;
}

size_t tactus_graph_control_count (const tactus_graph* g) { return g != nullptr ? g->history.graph().controls.size() : 0; }

const char* tactus_graph_control_id (const tactus_graph* g, size_t i)
{
    return i < tactus_graph_control_count (g) ? g->history.graph().controls[i].id.c_str() : nullptr;
}

tactus_result tactus_graph_get_control (const tactus_graph* g, const char* id, tactus_control* to, tactus_messages* messages)
{
    if (g == nullptr) return misuse ("the graph is NULL");
    return guarded (messages, TACTUS_FAILED, [&] {
        const auto found = tactus::findControl (g->history.graph(), text (id));
        return found ? giveControl (to, **found, (*found)->value, messages) : failed (messages, found.error());
    });
}

int32_t tactus_graph_undo (tactus_graph* g)
{
    return g != nullptr && guarded (nullptr, false, [&] { return g->history.undo(); });
}
int32_t tactus_graph_redo (tactus_graph* g)
{
    return g != nullptr && guarded (nullptr, false, [&] { return g->history.redo(); });
}
