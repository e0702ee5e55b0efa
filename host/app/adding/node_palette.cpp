// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_palette.hpp"
#include "add_graph.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The free end of a wire being drawn, or both ends of a wire to insert into. Ends whose node no longer exists are left out.
std::vector<WireEnd> endsOf (const NodeRequest& request, const Scene& scene)
{
    std::vector<WireEnd> found;
    const auto add = [&] (const SceneNode* node, Role role, const std::string& id) {
        const auto* port = node == nullptr ? nullptr : node->face->find (role, id);
        if (port != nullptr) found.push_back ({ port, node->quantityOf (*port) });
    };
    if (request.start) add (scene.find (request.start->node), request.start->role, request.start->port);
    if (const auto* wire = request.wire != 0 ? scene.findWire (request.wire) : nullptr)
    {
        add (&scene.nodes()[static_cast<std::size_t> (wire->start)], Role::output, wire->out);
        add (&scene.nodes()[static_cast<std::size_t> (wire->end)], wire->in_role, wire->in);
    }
    return found;
}

/// The id of a template or preset in the palette, as that of a subgraph is "graph:grain".
std::string idOf (const Preset& t) { return "template:" + t.file.stem().string(); }

/// The entries whose name begins like this.
std::vector<PaletteEntry> withName (std::vector<PaletteEntry> entries, const std::string& query)
{
    std::erase_if (entries, [&] (const PaletteEntry& e) { return ! juce::String (e.name).startsWithIgnoreCase (juce::String (query).trim()); });
    return entries;
}
/// The template or preset of a list that an entry of the palette stands for; null if it is a node.
const Preset* presetOf (const std::string& entry, const std::vector<Preset>& of)
{
    const auto found = std::ranges::find (of, entry, idOf);
    return found == of.end() ? nullptr : &*found;
}
}   // namespace

void addNode (const Desk& desk, const std::string& type, const NodeRequest& request)
{
    desk.canvas.commands().addNodeAt (type, request);
    if (desk.types.find (type) != nullptr)   // else a subgraph, which other graphs do not have
    {
        desk.settings.noteType (type);
        desk.settingsChanged();
    }
    takeFocus (desk.canvas);
}

void openNodePalette (const Desk& desk, Palette& palette, const std::vector<Preset>& templates, const NodeRequest& request)
{
    auto& canvas = desk.canvas;
    const auto presets = desk.presets();
    std::vector<PaletteEntry> beginnings, layers;
    const bool begins = canvas.edited().graph().root.nodes.empty(), is_empty = begins && canvas.patch().empty();
    for (const auto& t : is_empty ? templates : std::vector<Preset> {})
        beginnings.push_back ({ idOf (t), t.name, t.about });
    const auto about = is_empty ? TRANS ("A preset to open") : TRANS ("A preset, as a node and a layer of the mixer");
    if ((is_empty || ! begins) && ! request.start && request.wire == 0)
        for (const auto& p : presets)
            if (p.problem.empty()) layers.push_back ({ idOf (p), p.name, about.toStdString() });
    auto purpose = TRANS ("Add node");
    if (request.wire != 0)
        purpose = TRANS ("Insert into wire");
    else if (request.start)
        purpose = filled (request.start->role == Role::output ? TRANS ("Connect %1 to") : TRANS ("Connect %1 from"), request.start->port);
    const auto at = canvas.view().toPixels (request.at).toInt() + canvas.getPosition();
    const auto search = [&canvas, &catalogue = desk.types, recent = desk.settings.recent_types, request, beginnings, layers] (const std::string& query) {
        auto found = searchPalette (query, canvas.edited().graph(), catalogue, endsOf (request, canvas.scene()), recent, canvas.patch());
        if (found.empty() && (request.start || request.wire != 0))
            if (const auto all = searchPalette (query, canvas.edited().graph(), catalogue, {}, {}, canvas.patch()); ! all.empty())
                found.push_back ({ {}, filled (TRANS ("%1 has no port for this wire"), all[0].name.empty() ? all[0].type : all[0].name).toStdString(), {} });
        if (const auto added = withName (layers, query); ! added.empty())
        {
            found.push_back ({ {}, (beginnings.empty() ? TRANS ("Add to this graph") : TRANS ("Open a preset")).toStdString(), {} });
            found.insert (found.end(), added.begin(), added.end());
        }
        if (beginnings.empty()) return found;
        auto all = withName (beginnings, query);
        if (! juce::String (query).trim().isEmpty())   // what the user types is the name of a node first
        {
            found.insert (found.end(), all.begin(), all.end());
            return found;
        }
        all.insert (all.begin(), PaletteEntry { {}, TRANS ("Begin with").toStdString(), {} });
        all.insert (all.end(), found.begin(), found.end());
        return all;
    };
    palette.open (at, search, purpose, [&desk, templates, presets, request, begins] (const std::string& chosen) {
        takeFocus (desk.canvas);   // first: what is chosen may open the palette again
        const auto* beginning = begins ? presetOf (chosen, templates) : nullptr;
        if (beginning != nullptr) return desk.feel (beginning->file, false);
        const auto* preset = presetOf (chosen, presets);
        if (preset == nullptr) return addNode (desk, chosen, request);
        begins ? desk.openGraph (preset->file) : addGraph (desk, preset->file, {}, request.at);
    });
}

void openPalette (Palette& palette, Canvas& canvas, const juce::String& purpose, PaletteSearch search,
                  std::function<void (const std::string&)> chosen)
{
    const auto at = canvas.view().toPixels (canvas.commands().pointerOrCentre()).toInt() + canvas.getPosition();
    const auto choose = [&canvas, chosen = std::move (chosen)] (const std::string& type) {
        takeFocus (canvas);   // first: what is chosen may open the palette again
        chosen (type);
    };
    palette.open (at, std::move (search), purpose, choose, Palette::Finds::others);
}

}   // namespace tactus::host
