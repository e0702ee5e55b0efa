// SPDX-License-Identifier: MIT
#pragma once

#include "messages.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace tactus::python
{

/// A graph with its undo history, as Python edits it. Values are JSON text. All functions hold the GIL and raise tactus.Error.
class EditedGraph
{
public:
    explicit EditedGraph (graph::Graph g) : handle { graph::History (std::move (g), &catalogue(), isOwnType) } {}

    /// Nodes of this type can be added from now on: it is a class derived from tactus.Node. The run checks them.
    static void knowOwnType (const std::string& id);

    static std::unique_ptr<EditedGraph> create (const std::string& name, double rate_hz);
    static std::unique_ptr<EditedGraph> load (const std::string& path);
    static std::unique_ptr<EditedGraph> parse (const std::string& text, const std::string& folder);

    const graph::Graph& graph() const noexcept { return handle.history.graph(); }
    std::string text() const;
    void save (const std::string& path) const;

    /// The graphs that this one includes from other files, by path as written in this graph.
    std::map<std::string, std::unique_ptr<EditedGraph>> files() const;
    static std::unique_ptr<EditedGraph> withFiles (const EditedGraph&, const std::map<std::string, const EditedGraph*>&);

    void addNode (const std::string& patch, const std::string& name, const std::string& type, const std::string& params, const std::string& settings,
                  const std::string& role);
    void removeNode (const std::string& patch, const std::string& name);
    void renameNode (const std::string& patch, const std::string& name, const std::string& to);
    void addWire (const std::string& patch, const std::string& wire, const std::optional<std::string>& gain);
    void removeWire (const std::string& patch, const std::string& wire);
    void setParam (const std::string& patch, const std::string& node, const std::string& param, const std::optional<std::string>& value);
    void setSetting (const std::string& patch, const std::string& node, const std::string& setting, const std::optional<std::string>& value);
    void setKey (const std::string& patch, const std::string& node, const std::string& key, const std::optional<std::string>& value);
    void setDevice (const std::string& role, const std::optional<std::string>& description);
    void beginBatch (const std::string& name);
    void finishBatch();
    void abandonBatch() { handle.history.abandon(); }
    bool undo() { return handle.history.undo(); }
    bool redo() { return handle.history.redo(); }

private:
    static bool isOwnType (const std::string& id);

    template <typename F>
    void edit (F&& f);
    void perform (graph::Command);

    tactus_graph handle;
};

void bindGraph (py::module_&);

}   // namespace tactus::python
