// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/history.hpp>
#include <framework/message.hpp>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace tactus::host
{

/// The graph that is edited, its file, and whoever shows it. [main thread]
class Document
{
public:
    struct Listener
    {
        virtual ~Listener() = default;
        virtual void documentChanged() = 0;                ///< by an edit, an undo, or another graph
        virtual void documentRefused (const Message&) {}   ///< an edit was, and changed nothing
    };

    explicit Document (graph::Graph, std::filesystem::path file = {});

    const graph::Graph& graph() const noexcept { return edits.graph(); }
    const graph::History& history() const noexcept { return edits; }
    const std::filesystem::path& file() const noexcept { return path; }

    /// False if it was refused, which the listeners are told.
    bool perform (graph::Command, graph::Step = graph::Step::own);
    void undo();
    void redo();

    /// True if what the file holds is not what is here.
    bool isChanged() const;

    /// Writes the graph to its file, or to another one that is its file from then on. [errors as of saveGraph]
    Messages save (const std::filesystem::path&);

    void add (Listener& l) { listeners.push_back (&l); }
    void remove (Listener& l) { std::erase (listeners, &l); }

private:
    /// Some may leave while they are told.
    template <typename F>
    void tell (F&& f)
    {
        for (auto* l : std::vector (listeners))
            if (std::ranges::count (listeners, l) > 0) f (*l);
    }

    void tellOfChange()
    {
        tell ([] (Listener& l)
              { l.documentChanged(); });
    }

    graph::History edits;
    std::filesystem::path path;
    std::string saved;   // what the file holds, as text
    std::vector<Listener*> listeners;
};

}   // namespace tactus::host
