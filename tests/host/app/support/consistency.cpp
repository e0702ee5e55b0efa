// SPDX-License-Identifier: GPL-3.0-or-later
#include "consistency.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <algorithm>
#include <map>
#include <ranges>
#include <vector>

namespace tactus::host::test
{

namespace
{
/// The texts of the errors, by id and place.
std::map<std::string, std::string> errorsOf (const Messages& messages)
{
    std::map<std::string, std::string> found;
    for (const auto& m : messages)
    {
        const bool is_device = m.where.starts_with ("/devices") || m.where.starts_with ("/hand");
        if (m.severity == Message::Severity::error && ! is_device) found.emplace (m.id + " at " + m.where, m.text);
    }
    return found;
}

std::string joined (const std::map<std::string, std::string>& all)
{
    std::string text;
    for (const auto& [what, why] : all)
        text += "\n    " + what + ": " + why;
    return text;
}
}   // namespace

std::string disagreement (MainView& view)
{
    auto& canvas = view.canvas();
    const auto& graph = view.document().graph();
    const auto* patch = &graph.root;
    std::string here;
    for (const auto& [node, subgraph] : canvas.breadcrumbs())
    {
        const auto* entered = patch->find (node);
        if (entered == nullptr) return "the breadcrumbs contain '" + node + "', which is not in '" + here + "'";
        if (entered->type != "graph:" + subgraph) return "the breadcrumbs contain '" + node + "' of '" + subgraph + "', but it is a " + entered->type;
        patch = graph.find (subgraph);
        if (patch == nullptr) return "the breadcrumbs contain '" + subgraph + "', which does not exist";
        here = subgraph;
    }

    const auto& scene = canvas.scene();
    const auto isSame = [] (const SceneNode& s, const graph::Node& n) { return s.id == n.id && s.name == n.name && s.type == n.type && s.bypass == n.bypass; };
    if (! std::ranges::equal (scene.nodes(), patch->nodes, isSame)) return "the nodes on the canvas are not those of '" + here + "'";
    std::vector<graph::Id> wires, drawn;
    for (const auto& w : patch->wires)
        if (patch->find (graph::firstNameOf (w.from.node)) != nullptr && patch->find (graph::firstNameOf (w.to.node)) != nullptr) wires.push_back (w.id);
    for (const auto& w : scene.wires())
        drawn.push_back (w.id);
    if (wires != drawn) return "the wires on the canvas are not those of '" + here + "'";
    if (scene.notes().size() != notesOf (graph, here).size()) return "the notes on the canvas are not those of '" + here + "'";

    for (const auto id : canvas.selection())
    {
        const bool exists = isNote (id) ? noteOf (id) < scene.notes().size() : scene.find (id) != nullptr || scene.findWire (id) != nullptr;
        if (! exists) return "the selection contains something that does not exist";
    }
    if (view.document().history().position() > view.document().history().names().size()) return "the history position is beyond its end";
    return {};
}

std::string disagreementWithCompile (MainView& view, FileAssets& assets)
{
    const auto& graph = view.document().graph();
    const auto compiled = compile (graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
    const auto expected = errorsOf (compiled.messages), reported = errorsOf (view.run().messages());
    const auto key = [](const auto& e) -> const auto& { return e.first; };   // clang 14 does not compile std::views::keys
    if (std::ranges::equal (expected, reported, {}, key, key)) return {};
    return "compile reports:" + joined (expected) + "\n  and the run at " + std::to_string (view.run().rate()) + " Hz, which "
           + (view.run().isRunning() ? "runs" : view.run().isWanted() ? "is about to begin"
                                                                      : "is over")
           + ":" + joined (reported);
}

std::string instability (const graph::Graph& g)
{
    const auto text = writeGraph (g);
    const auto again = readGraph (text);
    if (hasErrors (again.messages)) return "the written graph cannot be read: " + again.messages.front().text + " at " + again.messages.front().where;
    return writeGraph (again.graph) == text ? std::string() : std::string ("writing the graph again gives different text");
}

std::string historyFault (Document& d)
{
    const auto at = d.history().position(), all = d.history().names().size();
    const auto here = writeGraph (d.graph());
    d.goTo (all);
    const auto last = writeGraph (d.graph());
    d.goTo (0);
    d.goTo (all);
    if (writeGraph (d.graph()) != last) return "undoing and redoing everything changes the graph";
    d.goTo (at);
    return writeGraph (d.graph()) == here ? std::string() : std::string ("jumping through the history and back changes the graph");
}

std::string keyboardFault (MainView& view)
{
    if (juce::Component::getNumCurrentlyModalComponents() > 0) return {};
    const auto* now = juce::Component::getCurrentlyFocusedComponent();
    if (now == nullptr) return "nothing has the keyboard";
    if (! now->isShowing()) return "something that is not seen has the keyboard";
    if (now == &view && view.canvas().isShowing()) return "the window has the keyboard, and not a part of it";
    return now == &view || view.isParentOf (now) ? std::string() : std::string ("something outside of the window has the keyboard");
}

std::string stepFault (Document& d)
{
    if (d.history().position() == 0) return {};
    const auto text = writeGraph (d.graph());
    d.undo();
    d.redo();
    return writeGraph (d.graph()) == text ? std::string() : "undoing and redoing " + d.history().names()[d.history().position() - 1] + " changes the graph";
}

std::string movedValue (const Document& d, const ValuesInEffect& before, const ValuesInEffect& now)
{
    if (d.history().position() == 0) return {};
    const auto name = d.history().names()[d.history().position() - 1];
    for (const char* begin : { "add control", "remove control", "release ", "assign ", "duplicate", "paste", "rename", "move", "align", "arrange", "add note",
                               "edit note", "colour region", "resize note", "store snapshot", "close scope", "add scope", "size scopes", "probe" })
        if (name.starts_with (begin))
        {
            const auto moved = changedValue (before, now);
            return moved.empty() ? std::string() : name + ": " + moved;
        }
    return {};
}

}   // namespace tactus::host::test
