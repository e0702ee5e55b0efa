// SPDX-License-Identifier: MIT
#include "graph.hpp"

#include <pybind11/stl.h>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/json.hpp>

#include <set>

namespace tactus::python
{

namespace
{
using Text = const std::string&;
using Value = const std::optional<std::string>&;

const char* orNull (Value value) { return value ? value->c_str() : nullptr; }

std::unique_ptr<EditedGraph> taken (tactus_graph* made, const tactus_messages& messages)
{
    const std::unique_ptr<tactus_graph, void (*) (tactus_graph*)> owner { made, tactus_graph_free };
    report (messages.list);
    if (! owner) fail (Message::error ("file/unreadable", "", "the graph could not be read", "check the file"));
    return std::make_unique<EditedGraph> (owner->history.graph());
}
}   // namespace

std::unique_ptr<EditedGraph> EditedGraph::create (Text name, double rate_hz)
{
    tactus_messages messages;
    auto* made = tactus_graph_create (name.c_str(), rate_hz, &messages);
    return taken (made, messages);
}

std::unique_ptr<EditedGraph> EditedGraph::load (Text path)
{
    tactus_messages messages;
    auto* made = tactus_graph_load (path.c_str(), &messages);
    return taken (made, messages);
}

std::unique_ptr<EditedGraph> EditedGraph::parse (Text text, Text folder)
{
    tactus_messages messages;
    auto* made = tactus_graph_parse (text.data(), text.size(), folder.c_str(), &messages);
    return taken (made, messages);
}

namespace
{
std::set<std::string>& ownTypes()
{
    static std::set<std::string> all;   // with the GIL
    return all;
}
}   // namespace

void EditedGraph::knowOwnType (Text id) { ownTypes().insert (id); }
bool EditedGraph::isOwnType (Text id) { return ownTypes().contains (id); }

std::string EditedGraph::text() const { return writeGraph (graph()); }

void EditedGraph::save (Text path) const
{
    tactus_messages messages;
    tactus_graph_save (&handle, path.c_str(), &messages);
    report (messages.list);
}

std::map<std::string, std::unique_ptr<EditedGraph>> EditedGraph::files() const
{
    std::map<std::string, std::unique_ptr<EditedGraph>> all;
    for (const auto& [path, file] : graph().files)
        all[path] = std::make_unique<EditedGraph> (*file);
    return all;
}

std::unique_ptr<EditedGraph> EditedGraph::withFiles (const EditedGraph& from, const std::map<std::string, const EditedGraph*>& files)
{
    auto g = from.graph();
    for (const auto& [path, file] : files)
        g.files[path] = std::make_shared<graph::Graph> (file->graph());
    return std::make_unique<EditedGraph> (std::move (g));
}

template <typename F>
void EditedGraph::edit (F&& f)
{
    tactus_messages messages;
    f (&handle, &messages);
    report (messages.list);
}

void EditedGraph::perform (graph::Command command)
{
    if (auto done = handle.history.perform (std::move (command)); ! done) fail (std::move (done).error());
}

void EditedGraph::addNode (Text patch, Text name, Text type, Text params, Text settings, Text role)
{
    graph::Node node;
    node.name = name;
    node.type = type;
    node.role = role;
    node.params = jsonOf (params);
    node.settings = jsonOf (settings);
    perform (graph::AddNode { patch, std::move (node) });
}

void EditedGraph::addWire (Text patch, Text wire, Value gain)
{
    auto parsed = graph::parseWire (wire);
    if (! parsed)
        fail (Message::error (parsed.error().id, "/wires", "'" + wire + "': " + parsed.error().text, "write a wire such as a.out -> b.in"));
    if (gain) parsed->gain = jsonOf (*gain);
    perform (graph::AddWire { patch, std::move (*parsed) });
}

void EditedGraph::removeNode (Text patch, Text name)
{
    edit ([&] (auto* g, auto* m) { tactus_graph_remove_node (g, patch.c_str(), name.c_str(), m); });
}

void EditedGraph::renameNode (Text patch, Text name, Text to)
{
    edit ([&] (auto* g, auto* m) { tactus_graph_rename_node (g, patch.c_str(), name.c_str(), to.c_str(), m); });
}

void EditedGraph::removeWire (Text patch, Text wire)
{
    edit ([&] (auto* g, auto* m) { tactus_graph_remove_wire (g, patch.c_str(), wire.c_str(), m); });
}

void EditedGraph::setParam (Text patch, Text node, Text param, Value value)
{
    edit ([&] (auto* g, auto* m) { tactus_graph_set_param (g, patch.c_str(), node.c_str(), param.c_str(), orNull (value), m); });
}

void EditedGraph::setSetting (Text patch, Text node, Text setting, Value value)
{
    edit ([&] (auto* g, auto* m) { tactus_graph_set_setting (g, patch.c_str(), node.c_str(), setting.c_str(), orNull (value), m); });
}

void EditedGraph::setKey (Text patch, Text node, Text key, Value value)
{
    edit ([&] (auto* g, auto* m) { tactus_graph_set_key (g, patch.c_str(), node.c_str(), key.c_str(), orNull (value), m); });
}

void EditedGraph::setDevice (Text role, Value description)
{
    edit ([&] (auto* g, auto* m) { tactus_graph_set_device (g, role.c_str(), orNull (description), m); });
}

void EditedGraph::beginBatch (Text name)
{
    if (handle.history.isInBatch())
        fail (Message::error ("edit/in_batch", "", "this graph is in a batch already", "end the `with graph.edit ():` first; its edits are one batch"));
    handle.history.begin (name);
}

void EditedGraph::finishBatch()
{
    if (auto done = handle.history.finish(); ! done) fail (std::move (done).error());
}

void bindGraph (py::module_& module)
{
    module.def ("know_own_type", &EditedGraph::knowOwnType);
    py::class_<EditedGraph> (module, "Graph")
        .def_static ("create", &EditedGraph::create)
        .def_static ("load", &EditedGraph::load)
        .def_static ("parse", &EditedGraph::parse)
        .def_static ("with_files", &EditedGraph::withFiles)
        .def ("text", &EditedGraph::text)
        .def ("save", &EditedGraph::save)
        .def ("files", &EditedGraph::files)
        .def ("folder", [] (const EditedGraph& g) { return g.graph().folder; })
        .def ("rate", [] (const EditedGraph& g) { return g.graph().rate_hz; })
        .def ("name", [] (const EditedGraph& g) { return g.graph().name; })
        .def ("add_node", &EditedGraph::addNode)
        .def ("remove_node", &EditedGraph::removeNode)
        .def ("rename_node", &EditedGraph::renameNode)
        .def ("add_wire", &EditedGraph::addWire)
        .def ("remove_wire", &EditedGraph::removeWire)
        .def ("set_param", &EditedGraph::setParam)
        .def ("set_setting", &EditedGraph::setSetting)
        .def ("set_key", &EditedGraph::setKey)
        .def ("set_device", &EditedGraph::setDevice)
        .def ("begin_batch", &EditedGraph::beginBatch)
        .def ("finish_batch", &EditedGraph::finishBatch)
        .def ("abandon_batch", &EditedGraph::abandonBatch)
        .def ("undo", &EditedGraph::undo)
        .def ("redo", &EditedGraph::redo);
}

}   // namespace tactus::python
