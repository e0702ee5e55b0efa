// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/history.hpp>
#include <framework/message.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

namespace tactus::host
{

/// The graph that is edited, its file, and whoever shows it. To open another graph is an edit too: what was open before
/// comes back by undo, and its file with it. [main thread]
class Document
{
public:
    struct Listener
    {
        virtual ~Listener() = default;
        virtual void documentChanged() = 0;                ///< by an edit, an undo, or another graph
        virtual void documentRefused (const Message&) {}   ///< an edit was, and changed nothing
    };

    /// Where a graph comes from.
    struct Source
    {
        std::filesystem::path file {};     ///< where it is saved; empty: it has to be asked
        std::filesystem::path preset {};   ///< what it is a copy of
        bool is_changed = false;           ///< it has more than its file has, as after a crash
    };

    explicit Document (graph::Graph, std::filesystem::path file = {});

    const graph::Graph& graph() const noexcept { return edits.graph(); }
    const graph::History& history() const noexcept { return edits; }
    const std::filesystem::path& file() const noexcept { return origin().source.file; }
    const std::filesystem::path& preset() const noexcept { return origin().source.preset; }

    /// Another one each time another graph is opened, the same again when that is undone.
    const void* identity() const noexcept { return &origin(); }

    /// False if it was refused, which the listeners are told.
    bool perform (graph::Command, graph::Step = graph::Step::own);
    void undo() { goTo (edits.position() - std::min<std::size_t> (1, edits.position())); }
    void redo() { goTo (edits.position() + 1); }
    void goTo (std::size_t position);   ///< of the history, by as many undos or redos as it takes

    /// Puts another graph in the place of this one, as a step of that name.
    void open (graph::Graph, Source, const std::string& step);

    /// True if what the file holds is not what is here.
    bool isChanged() const;

    /// Writes the graph to its file, or to another one that is its file from then on. [errors as of saveGraph]
    Messages save (const std::filesystem::path&);

    void add (Listener& l) { listeners.push_back (&l); }
    void remove (Listener& l) { std::erase (listeners, &l); }

private:
    struct Origin
    {
        Source source;
        std::string saved;   // what the file holds, as text
    };

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

    Origin& origin() const noexcept { return *origins[edits.position()]; }

    graph::History edits;
    std::vector<std::shared_ptr<Origin>> origins;   // of each position of the history
    std::vector<Listener*> listeners;
};

}   // namespace tactus::host
