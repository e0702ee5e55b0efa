// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfelt.hpp"

#include <host/app/compose/banks.hpp>
#include <host/app/model/clip_graph.hpp>
#include <host/app/model/face.hpp>
#include <host/app/model/obvious_wires.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace tactus::host
{

namespace
{
constexpr std::array<std::string_view, 5> readers { "device.position", "device.axis", "device.pressure", "device.button", "device.signal_in" };
constexpr std::array<std::string_view, 3> drivers { "device.force", "device.effort", "device.signal_out" };

template <std::size_t N>
bool isOneOf (const std::array<std::string_view, N>& types, const graph::Node& n)
{
    return std::ranges::find (types, n.type) != types.end();
}

template <std::size_t N>
bool hasOne (const graph::Graph& g, const std::array<std::string_view, N>& types)
{
    const auto isOne = [&] (const graph::Node& n) { return isOneOf (types, n); };
    return std::ranges::any_of (g.root.nodes, isOne)
           || std::ranges::any_of (g.graphs, [&] (const auto& subgraph) { return std::ranges::any_of (subgraph.second.nodes, isOne); });
}

/// The nodes of one patch, with what is wired to them.
class Wired
{
public:
    Wired (const graph::Graph& graph, std::string name, const graph::Patch& p, const Catalogue& c)
        : g (graph), catalogue (c), subgraph (std::move (name)), patch (p)
    {
        for (const auto& w : patch.wires)
        {
            sources.insert (graph::firstNameOf (w.from.node));
            ends[graph::firstNameOf (w.to.node)].push_back (&w.to);
        }
        if (subgraph.empty()) return;
        const auto note = [this] (const graph::Endpoint& e) {
            if (const auto slash = e.node.rfind ('/'); slash != std::string::npos) named_outside.emplace (graph::firstStep (e.node.substr (slash + 1)).name);
        };
        const auto noteAll = [&] (const graph::Patch& any) {
            for (const auto& w : any.wires)
                for (const auto* e : { &w.from, &w.to })
                    note (*e);
            for (const auto* exposed : { &any.expose.inputs, &any.expose.outputs })
                for (const auto& [id, e] : *exposed)
                    note (e);
        };
        noteAll (g.root);
        for (const auto& [id, any] : g.graphs)
            noteAll (any);
        for (const auto* exposed : { &patch.expose.inputs, &patch.expose.outputs })
            for (const auto& [id, e] : *exposed)
            {
                sources.insert (graph::firstNameOf (e.node));
                ends[graph::firstNameOf (e.node)].push_back (&e);
            }
    }

    void warn (Messages& all) const
    {
        for (const auto& n : patch.nodes)
        {
            if (named_outside.contains (n.name)) continue;
            const auto called = n.name + "' (" + n.type + ")";
            if (isOneOf (readers, n) && ! leads (n.name))
                add (all, n, "graph/hand_unwired", filled (TRANS ("'%1 is wired to nothing, so nothing follows it"), called),
                     TRANS ("wire it to what the tool touches"));
            if (isOneOf (drivers, n) && ! hears (n.name, {}))
                add (all, n, "graph/motor_unwired", filled (TRANS ("nothing is wired into '%1, so it stays at rest"), called), TRANS ("wire the forces to it"));
            if (n.type == clip_type && ! hasClip (n))
                add (all, n, "clip/no_file", filled (TRANS ("'%1 has no clip, so it is silent"), called),
                     TRANS ("choose a clip in the inspector, or drop one on the node"));
            if (n.type == "signal.envelope" && leads (n.name) && ! hears (n.name, "gate"))
                add (all, n, "envelope/no_gate", filled (TRANS ("nothing is wired into gate of '%1, so it stays at rest"), called),
                     filled (TRANS ("wire what opens it into %1, such as the gain of a contact window"), n.name + ".gate"));
            warnAboutInputs (n, called, all);
            warnAboutLayers (n, all);
        }
    }

private:
    const graph::Graph& g;
    const Catalogue& catalogue;
    std::string subgraph;
    const graph::Patch& patch;
    std::set<std::string, std::less<>> sources;                                     ///< nodes at which a wire begins, or that are exposed
    std::map<std::string, std::vector<const graph::Endpoint*>, std::less<>> ends;   ///< by node: where wires end, and what is exposed
    std::set<std::string, std::less<>> named_outside;                               ///< nodes that a wire or an exposed port outside of this patch names

    static bool hasClip (const graph::Node& n)
    {
        const auto clip = n.settings.find ("clip");
        return clip != n.settings.end() && ! (clip->is_string() && clip->asString().empty());
    }

    bool leads (const std::string& node) const { return sources.contains (node); }

    /// True if something is wired into the port, or into any port without one.
    bool hears (const std::string& node, std::string_view port, int index = -1) const
    {
        const auto its = ends.find (node);
        return its != ends.end() && std::ranges::any_of (its->second, [&] (const graph::Endpoint* e) {
                   return (port.empty() || e->port == port) && (index < 0 || e->index == index);
               });
    }

    void add (Messages& all, const graph::Node& n, const char* id, const juce::String& text, const juce::String& remedy) const
    {
        const auto in = subgraph.empty() ? std::string() : "/graphs/" + pointerPart (subgraph);
        all.push_back (Message::warning (id, in + "/nodes/" + pointerPart (n.name), text.toStdString(), remedy.toStdString()));
    }

    void warnAboutInputs (const graph::Node& n, const std::string& called, Messages& all) const
    {
        const auto* type = catalogue.find (n.type);
        if (type == nullptr || ! leads (n.name)) return;
        for (const auto& input : type->inputs)
            if (wiring::isNeeded (*type, input) && ! hears (n.name, input.id))
                return add (all, n, "node/no_input", filled (TRANS ("nothing is wired into %1 of '%2, so it is not felt"), input.id, called),
                            filled (TRANS ("wire something into %1: %2"), n.name + '.' + std::string (input.id), input.about));
    }

    void warnAboutLayers (const graph::Node& n, Messages& all) const
    {
        if (n.type != "layer.mix" && n.type != "layer.mix_vectors") return;
        for (const auto& input : faceOf (g, patch, n, catalogue).inputs)
            if (const auto layer = entryOf (input.id); layer && baseOf (input.id) == "in" && ! hears (n.name, baseOf (input.id), static_cast<int> (*layer)))
                add (all, n, "layer/empty", filled (TRANS ("nothing is wired into layer %1 of '%2'"), *layer + 1, n.name),
                     filled (TRANS ("wire something into %1, or remove the layer"), n.name + '.' + input.id));
    }
};
}   // namespace

Messages unfelt (const graph::Graph& g, const Catalogue& catalogue)
{
    Messages all;
    if (g.root.nodes.empty()) return all;
    if (! hasOne (g, readers))
        all.push_back (Message::warning ("graph/no_hand", "", TRANS ("the graph has no hand: no node reads the position of a tool").toStdString(),
                                         TRANS ("add device.position, and wire it to what the tool touches").toStdString()));
    if (! hasOne (g, drivers))
        all.push_back (Message::warning ("graph/no_motor", "", TRANS ("the graph has no motor: no node sends a force or a vibration to a device").toStdString(),
                                         TRANS ("add device.force, and wire the forces to it").toStdString()));
    Wired (g, {}, g.root, catalogue).warn (all);
    for (const auto& [name, patch] : g.graphs)
        Wired (g, name, patch, catalogue).warn (all);
    for (const auto& b : compose::bypassedBanks (g, catalogue))
    {
        const auto sources = listText (b.sources);
        auto text = filled (TRANS ("several effects reach '%1' without a mixer, so none can be muted alone: %2"), b.sink, sources);
        auto remedy = TRANS ("put a mixer before the motor, with a layer for each");
        if (b.has_bank)
        {
            text = b.mixer.empty() ? filled (TRANS ("%1 goes to '%2' without a mixer, so mute, solo and ceiling miss it"), sources, b.sink)
                                   : filled (TRANS ("%1 goes to '%2' past the mixer '%3', so mute, solo and ceiling miss it"), sources, b.sink, b.mixer);
            remedy = TRANS ("wire it into a layer of a mixer before the motor");
        }
        const auto where = "/nodes/" + pointerPart (graph::firstNameOf (b.sink));
        all.push_back (Message::warning (b.has_bank ? "mixer/bypassed" : "mixer/none", where, text.toStdString(), remedy.toStdString()));
    }
    return all;
}

}   // namespace tactus::host
