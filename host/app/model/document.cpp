// SPDX-License-Identifier: GPL-3.0-or-later
#include "document.hpp"

#include <host/app/storage/kept_names.hpp>

#include <tactus/file/graph_file.hpp>

namespace tactus::host
{

Document::Document (graph::Graph g, std::filesystem::path file)
    : edits (std::move (g), nullptr), origins { std::make_shared<Origin> (Origin { { std::move (file) }, writeGraph (edits.graph()) }) }
{
}

bool Document::perform (graph::Command command, graph::Step step)
{
    const auto before = edits.position();
    const bool counts = ! onlyMoves (command);
    if (const auto done = edits.perform (withNamesKept (graph(), std::move (command)), step); ! done)
    {
        notify ([&] (Listener& l) { l.documentRefused (done.error()); });
        return false;
    }
    if (counts) ++changes;
    origins.resize (before + 1);   // drops the redo steps
    if (window_steps.size() > before) window_steps.resize (before);
    if (edits.position() > before) origins.push_back (origins.back());
    notifyChanged();
    return true;
}

void Document::call (std::string name)
{
    edits.call (std::move (name));
    ++changes;
    notifyChanged();
}

void Document::addWindowStep (const std::string& name, std::function<void()> undo, std::function<void()> redo)
{
    if (isStepping()) return;
    const auto at = edits.position();
    const auto place = [] (std::size_t i) { return static_cast<std::ptrdiff_t> (i); };
    for (auto i = window_steps.size(); i-- > at;)
        if (window_steps[i].first && edits.removeEmptyStep (i))
        {
            window_steps.erase (window_steps.begin() + place (i));
            origins.erase (origins.begin() + place (i) + 1);
        }
    edits.insertStep (name);
    origins.insert (origins.begin() + place (at), std::shared_ptr (origins[at]));
    window_steps.resize (std::max (window_steps.size(), at));
    window_steps.insert (window_steps.begin() + place (at), { std::move (undo), std::move (redo) });
    notifyChanged();
}

void Document::open (graph::Graph g, Source source, const std::string& step)
{
    notify ([] (Listener& l) { l.documentLeft(); });
    auto saved = source.is_changed ? std::string() : writeGraph (g);
    const auto to = std::make_shared<const graph::Graph> (std::move (g));
    (void)edits.perform (graph::Batch { step, { graph::ReplaceGraph { to } } }, graph::Step::of_another_graph);   // cannot be refused
    origins.resize (edits.position());
    if (window_steps.size() >= edits.position()) window_steps.resize (edits.position() - 1);
    origins.push_back (std::make_shared<Origin> (Origin { std::move (source), std::move (saved) }));
    ++changes;
    notifyChanged();
}

void Document::beginHistory()
{
    const auto now = origins[edits.position()];
    edits = graph::History (edits.graph(), nullptr);
    origins = { now };
    window_steps.clear();
    ++changes;
    notifyChanged();
}

void Document::goTo (std::size_t position)
{
    const auto before = edits.position();
    if (origins[std::min (position, origins.size() - 1)] != origins[before]) notify ([] (Listener& l) { l.documentLeft(); });
    std::vector<std::function<void()>> of_window;
    while (edits.position() > position && edits.undo())
        if (edits.position() < window_steps.size()) of_window.push_back (window_steps[edits.position()].first);
    while (edits.position() < position && edits.redo())
        if (edits.position() <= window_steps.size()) of_window.push_back (window_steps[edits.position() - 1].second);
    if (edits.position() == before) return;
    for (auto step = std::min (before, edits.position()); step < std::max (before, edits.position()); ++step)
        if (! std::ranges::all_of (edits.commandsOf (step), onlyMoves)) ++changes;
    stepped_from = before;
    notifyChanged();
    for (const auto& change : of_window)
        if (change) change();
    stepped_from.reset();
}

bool Document::isChanged() const
{
    if (! differs) differs = writeGraph (edits.graph()) != origin().saved;
    return *differs;
}

Messages Document::save (const std::filesystem::path& file, const graph::Graph& written)
{
    if (auto done = saveGraph (written, file); ! done) return { std::move (done).error() };
    const auto text = writeGraph (edits.graph());
    for (const auto& o : origins)   // the same file may have been opened more than once
        if (o->source.file == file) o->saved = text;
    origin() = { { file }, text };
    ++changes;
    notifyChanged();
    return {};
}

}   // namespace tactus::host
