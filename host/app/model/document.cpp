// SPDX-License-Identifier: GPL-3.0-or-later
#include "document.hpp"

#include <framework/file/graph_file.hpp>

namespace tactus::host
{

Document::Document (graph::Graph g, std::filesystem::path f) : edits (std::move (g)), path (std::move (f)), saved (writeGraph (edits.graph())) {}

bool Document::perform (graph::Command command, graph::Step step)
{
    if (const auto refusal = edits.perform (std::move (command), step))
    {
        tell ([&] (Listener& l)
              { l.documentRefused (*refusal); });
        return false;
    }
    tellOfChange();
    return true;
}

void Document::undo()
{
    if (edits.undo()) tellOfChange();
}

void Document::redo()
{
    if (edits.redo()) tellOfChange();
}

bool Document::isChanged() const { return writeGraph (edits.graph()) != saved; }

Messages Document::save (const std::filesystem::path& file)
{
    auto messages = saveGraph (edits.graph(), file);
    if (! messages.empty()) return messages;
    path = file;
    saved = writeGraph (edits.graph());
    tellOfChange();
    return {};
}

}   // namespace tactus::host
