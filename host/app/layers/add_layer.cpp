// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixer.hpp"
#include "mixer_parts.hpp"

#include <host/app/model/clip_graph.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// Values of a new layer that differ from the defaults of its type: values that are easy to feel, and that break no limit of a typical
/// device.
Json firstParams (std::string_view type)
{
    auto params = Json::object();
    if (type == clip_type) params["gain"] = "0.2 N";
    if (type == "texture.noise") params["gain"] = 0.1;   // at 1, its noise changes so fast with speed and depth that a typical device buzzes
    return params;
}
}   // namespace

const std::vector<LayerKind>& layerKinds()
{
    static const std::vector<LayerKind> kinds {
        { NEEDS_TRANS ("Texture"), "texture.grating", NEEDS_TRANS ("Add ridges that you feel while you stroke, only in contact") },
        { NEEDS_TRANS ("Vibration"), "vibration.modal", NEEDS_TRANS ("Add a ring that each tap excites") },
        { NEEDS_TRANS ("Recorded"), "texture.noise", NEEDS_TRANS ("Add a recorded texture: the hiss of a real surface, only in contact") },
        { NEEDS_TRANS ("Clip"), std::string (clip_type), NEEDS_TRANS ("Add a haptic clip that each tap plays") },
    };
    return kinds;
}

std::vector<const NodeType*> layerTypes (const Catalogue& catalogue, bool vectors)
{
    std::vector<const NodeType*> all;
    for (const auto& t : catalogue)
    {
        const bool is_layer = wiring::isTexture (t.info.id) || t.info.id.starts_with ("vibration.") || (vectors && t.info.id.starts_with ("friction."));
        if (is_layer && wiring::forceOutput (t, vectors)) all.push_back (&t);
    }
    return all;
}

namespace
{
enum class ClipPlays
{
    at_taps,
    in_a_loop,   // so that its inputs stay unwired
};

/// A layer with a node of this type.
Result<AddedLayer> addLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, const std::string& type, const std::string& clip,
                             ClipPlays plays, std::optional<double> gain)
{
    const auto* mixer = findMixer (g, at);
    const auto* patch = findPatch (g, at.patch);
    if (mixer == nullptr) return mixing::mixerIsGone();
    const int layers = layersOf (*mixer, catalogue);
    const bool fills = layers == 1 && ! type.empty() && wireInto (g, at, 0) == nullptr;   // the only layer is still empty
    if (layers >= list_capacity && ! fills) return mixing::mixerIsFull();

    const int place = fills ? 0 : layers;
    graph::Batch batch { NEEDS_TRANS ("add a layer"), {} };
    if (! fills) batch.commands.push_back (graph::SetSetting { at.patch, at.node, "inputs", Json (layers + 1) });
    if (type.empty()) return AddedLayer { std::move (batch), {}, {} };
    const auto* sheet = catalogue.find (type);
    const auto output = sheet == nullptr ? std::nullopt : wiring::forceOutput (*sheet, at.vectors);
    if (! output) return Message::error ("mixer/type", {}, filled (TRANS ("%1 has no force output that fits, so it cannot be a layer"), type).toStdString());

    graph::Node node;
    node.name = freeName (*patch, {}, type.substr (type.find ('.') + 1));
    node.type = type;
    node.params = firstParams (type);
    if (! clip.empty() && plays == ClipPlays::in_a_loop) playClip (node, clip);
    if (! clip.empty()) node.settings["clip"] = clip;
    if (gain) node.params["gain"] = numberText (*gain) + " N";
    const auto name = node.name;
    const auto id = node.id;
    batch.name = filled (TRANS ("add the layer '%1'"), name).toStdString();
    batch.commands.push_back (graph::AddNode { at.patch, std::move (node) });
    const auto later = wiring::downstreamOf (*patch, at.node);
    auto missing = plays == ClipPlays::at_taps ? wiring::wireInputs (*sheet, name, g, at.patch, later, catalogue, batch) : std::string();
    if (type == clip_type && clip.empty())
        missing = filled (TRANS ("Choose a clip for %1 in the inspector"), name).toStdString() + (missing.empty() ? "" : ". " + missing);
    auto out = wiring::endOf (name, output->port);
    if (wiring::isTexture (type))   // or it would be felt in the air
        out = wiring::gated (std::move (out), output->is_vector, g, at.patch, later, catalogue, batch);
    const int component = at.vectors && ! output->is_vector ? wiring::z_component : -1;
    batch.commands.push_back (graph::AddWire { at.patch, wiring::wire (std::move (out), wiring::endOf (at.node, "in", place, component)) });
    batch.commands.push_back (graph::SetSetting { at.patch, at.node, "names", Json (mixing::namesWith (*mixer, place + 1, name)) });
    return AddedLayer { std::move (batch), std::move (missing), id };
}
}   // namespace

Result<AddedLayer> addLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, const std::string& type,
                             const std::string& clip)
{
    return addLayer (g, at, catalogue, type, clip, ClipPlays::at_taps, {});
}

Result<AddedLayer> addClipLayer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, const std::string& file, std::optional<double> gain)
{
    return addLayer (g, at, catalogue, std::string (clip_type), file, ClipPlays::in_a_loop, gain);
}

}   // namespace tactus::host
