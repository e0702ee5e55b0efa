// SPDX-License-Identifier: GPL-3.0-or-later
// Drops on the canvas: files of clips and graphs, presets from their list, and nodes from the list of nodes.
#include "canvas.hpp"

#include <host/app/model/clip_graph.hpp>
#include <host/app/palette/search.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/text/file_path.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

fs::path droppedFile (const juce::StringArray& files) { return fs::path (files[0].toStdString()); }
}   // namespace

bool Canvas::isInterestedInFileDrag (const juce::StringArray& files)
{
    return files.size() == 1 && (isClipExtension (droppedFile (files)) || extensionOf (droppedFile (files)) == ".json");
}

void Canvas::fileDragEnter (const juce::StringArray& files, int x, int y) { fileDragMove (files, x, y); }

void Canvas::fileDragMove (const juce::StringArray& files, int x, int y)
{
    file_over = { x, y };
    const auto* node = shown->nodeAt (window.toCanvas (juce::Point<int> (x, y).toFloat()));
    const auto name = juce::String (printableName (droppedFile (files).filename().string()));
    if (! isClipFile (droppedFile (files)))
        hint (filled (TRANS ("Drop %1 to add it to this graph, as a node and a layer."), name));
    else if (node == nullptr)
        hint (filled (TRANS ("Drop %1 to add a node that plays it."), name));
    else if (node->type == clip_type)
        hint (filled (TRANS ("Drop %1 to let %2 play it."), name, node->name));
    else
        hint (filled (TRANS ("%1 does not play clips. Drop %2 on empty canvas, or on a clip node."), node->name, name));
    repaint();
}

void Canvas::fileDragExit (const juce::StringArray&)
{
    file_over.reset();
    hint ({});
    repaint();
}

void Canvas::filesDropped (const juce::StringArray& files, int x, int y)
{
    fileDragExit (files);
    const auto file = droppedFile (files);
    if (isClipFile (file)) return dropClip (file, juce::Point<int> (x, y).toFloat());
    if (onGraphDropped) onGraphDropped (file, window.toCanvas (juce::Point<int> (x, y).toFloat()));
}

void Canvas::dropClip (const fs::path& file, juce::Point<float> pixel)
{
    const auto at = window.toCanvas (pixel);
    const auto written = pathFrom (file, document.graph().folder);
    const auto* node = shown->nodeAt (at);
    if (node != nullptr && node->type != clip_type)
        return notice (filled (TRANS ("%1 does not play clips. Drop the file on empty canvas, or on a clip node."), node->name));
    if (node != nullptr)
    {
        const auto name = node->name;
        edits.perform (graph::SetSetting { patch(), name, "clip", Json (written) });
        return;
    }
    graph::Id made = 0;
    auto add = addNode (document.graph(), patch(), clip_type, freePlace (*shown, at), made);
    if (auto* one = std::get_if<graph::AddNode> (&add.edit)) playClip (one->node, written);
    if (! edits.perform (std::move (add))) return;
    select ({ made });
    notice (filled (TRANS ("Added a node that plays %1 over and over. Wire its value to a motor to feel it."), printableName (file.filename().string())));
}

bool Canvas::isInterestedInDragSource (const SourceDetails& dragged)
{
    return ! typeOfDragged (dragged.description.toString().toStdString()).empty() || ! fileOfDragged (dragged.description.toString().toStdString()).empty();
}

void Canvas::itemDragMove (const SourceDetails& dragged)
{
    if (typeOfDragged (dragged.description.toString().toStdString()).empty()) return hint (TRANS ("Drop it to add it to this graph, as a node and a layer."));
    const auto* wire = shown->wireAt (window.toCanvas (dragged.localPosition.toFloat()), wire_reach / window.zoom);
    highlights.hovered = wire != nullptr ? wire->id : 0;
    hint (wire != nullptr ? filled (TRANS ("Drop it to insert it into %1"), wire->text) : TRANS ("Drop it to add it here"));
    repaint();
}

void Canvas::itemDragExit (const SourceDetails&)
{
    highlights.hovered = 0;
    hint ({});
    repaint();
}

void Canvas::itemDropped (const SourceDetails& dragged)
{
    itemDragExit (dragged);
    const auto at = window.toCanvas (dragged.localPosition.toFloat());
    if (const auto file = fileOfDragged (dragged.description.toString().toStdString()); ! file.empty())
    {
        if (onGraphDropped) onGraphDropped (file, at);
        return;
    }
    const auto* wire = shown->nodeAt (at) == nullptr ? shown->wireAt (at, wire_reach / window.zoom) : nullptr;
    if (onTypeDropped) onTypeDropped (typeOfDragged (dragged.description.toString().toStdString()), { at, {}, wire != nullptr ? wire->id : 0 });
}

void Canvas::paintFileOver (juce::Graphics& g) const
{
    const auto& theme = themeOf (*this);
    g.setColour (theme.accent);
    const auto* node = shown->nodeAt (window.toCanvas (file_over->toFloat()));
    if (node == nullptr)
        g.drawRect (getLocalBounds(), 2);
    else if (node->type == clip_type)
        g.drawRoundedRectangle (node->bounds().transformedBy (window.transform()).expanded (3.0f), 6.0f, 2.0f);
}

}   // namespace tactus::host
