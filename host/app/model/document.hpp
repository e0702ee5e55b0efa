// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "step_text.hpp"

#include <tactus/graph/history.hpp>
#include <tactus/text/message.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The graph being edited, its file and its listeners. Opening another graph is an edit too: undo brings back the previous
/// graph together with its file. [main thread]
class Document
{
public:
    struct Listener
    {
        virtual ~Listener() = default;
        virtual void documentChanged() = 0;                ///< after an edit, an undo, or when another graph is opened
        virtual void documentLeft() {}                     ///< before another graph is opened, or an undo or a redo brings another one back
        virtual void documentRefused (const Message&) {}   ///< called when an edit was refused; nothing has changed

        /// The catalogue has other node types now. documentChanged() follows; after both, nothing may point into the earlier types, because
        /// they may be unloaded.
        virtual void typesChanged() {}
    };

    /// The origin of a graph.
    struct Source
    {
        std::filesystem::path file {};     ///< where to save it; if empty, ask the user
        std::filesystem::path preset {};   ///< the preset of which the graph is a copy; empty if none
        bool is_changed = false;           ///< true if the graph differs from its file, for example after crash recovery
    };

    explicit Document (graph::Graph, std::filesystem::path file = {});

    const graph::Graph& graph() const noexcept { return edits.graph(); }
    const graph::History& history() const noexcept { return edits; }

    /// Differs after each change but those that only move nodes on the canvas, or only change the window. So who shows no places need not look at
    /// the graph again while this is the same.
    std::uint64_t version() const noexcept { return changes; }

    /// The name of a step of the history, with values in the units of the catalogue.
    std::string stepName (std::size_t step) const { return host::stepName (edits, step, catalogue()); }
    const std::filesystem::path& file() const noexcept { return origin().source.file; }
    const std::filesystem::path& preset() const noexcept { return origin().source.preset; }

    /// Identifies the open graph: changes when another graph is opened, and changes back when that is undone.
    const void* identity() const noexcept { return &origin(); }

    /// The `ui` of the graph as panels show it when the graph is opened: as it was when the graph was left for another one, or else as in the graph.
    Json ui() const { return origin().ui ? *origin().ui : graph().extra.value ("ui", Json()); }
    void keepUi (Json ui) { origin().ui = std::move (ui); }   ///< call it from documentLeft()

    /// Returns false if the edit was refused; the listeners get the reason.
    bool perform (graph::Command, graph::Step = graph::Step::own);

    /// Gives the graph another name, as saving does. This is no step, so undo keeps the name.
    void call (std::string name);

    /// Adds a step that changes only the window, such as a closed scope. Undoing and redoing it calls these functions, and leaves the graph alone.
    /// The change itself has been made. Edits that could be redone can still be redone, but not
    /// earlier steps of the window, which began with another window.
    void addWindowStep (const std::string& name, std::function<void()> undo, std::function<void()> redo);

    void undo() { goTo (edits.position() - std::min<std::size_t> (1, edits.position())); }
    void redo() { goTo (edits.position() + 1); }
    void goTo (std::size_t position);   ///< undoes or redoes up to that position of the history

    /// The position before an undo or a redo, while the listeners are told about it.
    std::optional<std::size_t> steppedFrom() const noexcept { return stepped_from; }
    bool isStepping() const noexcept { return stepped_from.has_value(); }

    /// Replaces the graph as one undo step of that name.
    void open (graph::Graph, Source, const std::string& step);

    /// Forgets all steps, so that nothing before now can be brought back.
    void beginHistory();

    /// Tells the listeners that the graph must be read again, because the node types of the catalogue have changed.
    void renew()
    {
        ++changes;
        notify ([] (Listener& l) { l.typesChanged(); });
        notifyChanged();
    }

    /// True if the graph differs from its file.
    bool isChanged() const;

    /// The text of the graph in its file; empty if it is not the text of any graph.
    const std::string& savedText() const noexcept { return origin().saved; }

    /// Writes the graph to a file, which becomes its file. [errors: those of saveGraph]
    Messages save (const std::filesystem::path& file) { return save (file, graph()); }
    Messages save (const std::filesystem::path&, const graph::Graph& written);   ///< as it is written in that folder, see carriedTo()

    void add (Listener& l) { listeners.push_back (&l); }
    void remove (Listener& l) { std::erase (listeners, &l); }

private:
    struct Origin
    {
        Source source;
        std::string saved;           // the text of the graph in its file
        std::optional<Json> ui {};   // if the graph was left
    };

    /// Notifies the listeners. A listener may remove itself or others while it is being notified.
    template <typename F>
    void notify (F&& f)
    {
        for (auto* l : std::vector (listeners))
            if (std::ranges::count (listeners, l) > 0) f (*l);
    }

    void notifyChanged()
    {
        differs.reset();
        notify ([] (Listener& l) { l.documentChanged(); });
    }

    Origin& origin() const noexcept { return *origins[edits.position()]; }

    graph::History edits;                                                                // accepts edits with errors, which the window shows as problems
    std::vector<std::shared_ptr<Origin>> origins;                                        // one per position of the history
    std::vector<std::pair<std::function<void()>, std::function<void()>>> window_steps;   // one per step of the history: how to undo and redo it
    std::vector<Listener*> listeners;
    mutable std::optional<bool> differs;   // from the file; empty until somebody asks
    std::uint64_t changes = 0;             // for version()
    std::optional<std::size_t> stepped_from;
};

/// Joins the edits of one text into one undo step, though the text is applied again and again while it is being typed. Another step in between begins
/// a new one. [main thread]
class TypedStep
{
public:
    explicit TypedStep (const Document& d) : document (d) {}

    /// `edit` performs an edit as this kind of step, and returns false if it was refused.
    template <typename Edit>
    bool perform (Edit&& edit)
    {
        if (! edit (last == now() ? graph::Step::joined : graph::Step::own)) return false;
        last = now();
        return true;
    }

private:
    /// The position alone would not do: after an undo, another edit brings it back.
    std::pair<std::size_t, std::uint64_t> now() const { return { document.history().position(), document.version() }; }

    const Document& document;
    std::optional<std::pair<std::size_t, std::uint64_t>> last;   // after the last edit
};

}   // namespace tactus::host
