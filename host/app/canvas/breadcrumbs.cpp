// SPDX-License-Identifier: GPL-3.0-or-later
// The way of the canvas from patch to patch.
#include "canvas.hpp"

namespace tactus::host
{

void Canvas::chooseInstance (int number)
{
    trail.chooseInstance (number);
    point ({});
    if (onBreadcrumbs) onBreadcrumbs();
}

void Canvas::breadcrumbsChanged()
{
    highlights = {};
    point ({});
    text_editor.close (false);
    rebuild();
    frameStart();   // repaints
    if (onBreadcrumbs) onBreadcrumbs();
    if (onSelection) onSelection();
}

void Canvas::leaveTo (std::size_t depth)
{
    if (depth >= breadcrumbs().size()) return;
    const auto left = breadcrumbs()[depth].first;
    trail.leaveTo (depth);
    breadcrumbsChanged();
    for (const auto& n : shown->nodes())
        if (n.name == left) select ({ n.id });
}

void Canvas::enter (const SceneNode& node)
{
    if (! node.type.starts_with ("graph:") || document.graph().find (node.type.substr (6)) == nullptr) return;
    trail.enter (node.name, node.type.substr (6));
    breadcrumbsChanged();
}

void Canvas::show (const std::string& patch_name, graph::Id id)
{
    if (patch() != patch_name)
    {
        if (! trail.goTo (patch_name)) return;
        breadcrumbsChanged();
    }
    if (id == 0) return;
    select ({ id });
    auto at = window.toCanvas (getLocalBounds().getCentre().toFloat());
    if (const auto* node = shown->find (id)) at = node->bounds().getCentre();
    if (const auto* wire = shown->findWire (id)) at = (wire->from + wire->to) / 2.0f;
    if (! getLocalBounds().toFloat().contains (window.toPixels (at))) window.centreOn (at, getLocalBounds().toFloat());
    repaint();
}

}   // namespace tactus::host
