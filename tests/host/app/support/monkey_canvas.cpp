// SPDX-License-Identifier: GPL-3.0-or-later
// What the monkey does on the canvas.
#include "monkey.hpp"

#include <host/app/canvas/commands.hpp>

namespace tactus::host::test
{

juce::Point<float> Monkey::onCanvas (juce::Point<float> of_scene) { return stage->getLocalPoint (&view->canvas(), view->canvas().view().toPixels (of_scene)); }

juce::Point<float> Monkey::onNode (const SceneNode& n, bool title)
{
    if (title) return onCanvas (n.at + juce::Point<float> (30.0f, 12.0f));
    return onCanvas (n.at + juce::Point<float> (n.box.width - 16.0f, oneOf (n.box.sockets).at.y));
}

const SceneNode* Monkey::someNode() { return view->canvas().scene().nodes().empty() ? nullptr : &oneOf (view->canvas().scene().nodes()); }

std::string Monkey::drawWire()
{
    const auto *a = someNode(), *b = someNode();
    if (a == nullptr || a->box.sockets.empty() || b->box.sockets.empty()) return "no port to draw from";
    // Prefer ports that may fit, or hardly any wire would be drawn.
    const auto &from = oneOf (a->box.sockets), *to = &oneOf (b->box.sockets);
    for (int i = 0; i < 6 && (from.port->role == Role::output) == (to->port->role == Role::output); ++i)
        to = &oneOf (b->box.sockets);
    const auto wire = "from " + a->name + "." + from.port->id + " to " + b->name + "." + to->port->id + ": ";
    const auto start = onCanvas (a->placeOf (from));
    return wire + dragFromTo (start, upTo (8) == 0 ? anywhere() : onCanvas (b->placeOf (*to)));
}

std::string Monkey::dragOnNode()
{
    const auto* n = someNode();
    if (n == nullptr) return "no node to drag";
    const bool by_title = n->box.sockets.empty() || upTo (2) == 0;
    const auto from = onNode (*n, by_title);
    const auto name = n->name;
    return name + ": " + dragFromTo (from, from + juce::Point<float> (part() - 0.5f, part() - 0.5f) * 200.0f);
}

std::string Monkey::clickOnCanvas()
{
    const auto& scene = view->canvas().scene();
    const int what = upTo (4);
    if (what == 0 && ! scene.wires().empty())
    {
        const auto& wire = oneOf (scene.wires());
        const auto path = wire.path();
        const auto text = wire.text;
        return text + ": " + clickAt (onCanvas (path.getPointAlongPath (path.getLength() * part())));
    }
    if (what == 1 && ! scene.notes().empty())
    {
        const auto area = oneOf (scene.notes()).area;
        if (upTo (2) == 0) return "note: " + clickAt (onCanvas (area.getTopLeft().translated (12.0f, 10.0f)));
        return "note: " + dragFromTo (onCanvas (area.getBottomRight().translated (-3.0f, -3.0f)), anywhere());
    }
    const auto* n = someNode();
    if (n == nullptr) return "canvas: " + clickAt (in (view->canvas()));
    const auto name = n->name;
    const bool by_title = n->box.sockets.empty() || upTo (2) == 0;
    return name + ": " + clickAt (onNode (*n, by_title));
}

/// Not while the enlarged scene hides the canvas.
void Monkey::focusCanvas()
{
    if (view->canvas().isShowing()) view->canvas().grabKeyboardFocus();
}

std::string Monkey::canvasKey()
{
    const auto& command = oneOf (canvasCommands());
    if (upTo (3) != 0) focusCanvas();
    if (upTo (4) == 0 && ! view->canvas().scene().nodes().empty())
    {
        Selection some;
        for (const auto& n : view->canvas().scene().nodes())
            if (upTo (3) == 0) some.insert (n.id);
        view->canvas().select (some);
    }
    auto keys = juce::StringArray::fromTokens (command.keys, "|", {});
    const auto k = keys[upTo (keys.size())];
    stage->key (k);
    return "key " + k.toStdString() + ": " + command.name;
}

std::string Monkey::group()
{
    const auto& nodes = view->canvas().scene().nodes();
    if (nodes.empty()) return "nothing to group";
    Selection some;
    for (int i = 1 + upTo (3); --i >= 0;)
        some.insert (oneOf (nodes).id);
    view->canvas().select (some);
    focusCanvas();
    stage->key (juce::String ("g"));
    if (upTo (2) == 0) stage->key (juce::String ("return"));
    return "group " + std::to_string (some.size());
}

std::string Monkey::enter()
{
    for (const auto& n : view->canvas().scene().nodes())
        if (n.type.starts_with ("graph:"))
        {
            const auto name = n.name;
            view->canvas().enter (n);
            return "enter " + name;
        }
    return "nothing to enter";
}

std::string Monkey::rename()
{
    const auto& g = view->document().graph();
    const bool is_root = g.graphs.empty() || upTo (2) == 0;
    const auto patch = is_root ? std::string() : oneOf (g.graphs).first;
    const auto& nodes = is_root ? g.root.nodes : g.find (patch)->nodes;
    if (nodes.empty()) return "nothing to rename";
    const auto before = oneOf (nodes).name, after = "n" + std::to_string (upTo (100));
    view->document().perform (graph::RenameNode { patch, before, after });
    return "rename " + patch + "/" + before + " to " + after;
}

const NodeType& Monkey::someType()
{
    std::vector<const NodeType*> all;
    for (const auto& type : catalogue())
        all.push_back (&type);
    return *oneOf (all);
}

std::string Monkey::addByPalette()
{
    focusCanvas();
    stage->key (juce::String ("spacebar"));
    const std::string type (someType().info.id);
    const auto query = type.substr (0, static_cast<std::size_t> (upTo (static_cast<int> (type.size()) + 1)));
    stage->type (query);
    for (int i = upTo (3); --i >= 0;)
        stage->key (juce::String (upTo (3) == 0 ? "cursor up" : "cursor down"));
    const int end = upTo (5);
    if (end == 0) return "palette stays open at " + query;
    stage->key (juce::String (end == 1 ? "escape" : "return"));
    return "palette: " + query + (end == 1 ? ", escape" : ", return");
}

std::string Monkey::addDirectly()
{
    const std::string type (someType().info.id);
    NodeRequest request { { part() * 800.0f - 400.0f, part() * 600.0f - 300.0f } };
    const auto& wires = view->canvas().scene().wires();
    if (! wires.empty() && upTo (3) == 0) request.wire = oneOf (wires).id;
    view->canvas().commands().addNodeAt (type, request);
    return "add " + type + (request.wire != 0 ? " into a wire" : "");
}

}   // namespace tactus::host::test
