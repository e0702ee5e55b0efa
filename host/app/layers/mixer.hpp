// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Layer mixers as mixing desks with one channel per layer, and edits of them as commands. Each command is one undo step.

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// A mixer's position: its patch, and its path from the top of the graph, such as "threads/mix". With several instances of a subgraph,
/// the path leads through the first one.
struct MixerPlace
{
    graph::Id id = 0;
    std::string patch, node, path;
    bool vectors = false;   ///< true for layer.mix_vectors, whose layers are forces in three axes

    bool operator== (const MixerPlace&) const = default;
};

std::vector<MixerPlace> mixersOf (const graph::Graph&);

const graph::Node* findMixer (const graph::Graph&, const MixerPlace&);

int layersOf (const graph::Node&, const Catalogue&);

/// The datasheet row of a param of mixers.
const PortSheet& mixerSheet (const Catalogue&, std::string_view param);

/// The names in the setting `names`; "" for a layer without a name.
std::vector<std::string> layerNames (const graph::Node&, int layers);

/// The value of a list param, such as "gain", for one layer: as written in the file, or the default.
Json layerValue (const graph::Node&, const Catalogue&, const std::string& param, int layer);

/// The first wire into a layer; null if there is none.
const graph::Wire* wireInto (const graph::Graph&, const MixerPlace&, int layer);

/// The symbol of the unit of a layer, as far as it is known without a run: "N"; "" if it is not. A mixer of vectors has only forces.
std::string_view unitOfLayer (const graph::Graph&, const MixerPlace&, const Catalogue&, int layer);

/// Without a value: resets to the default.
graph::Command setLayerValue (const graph::Node&, const MixerPlace&, const Catalogue&, const std::string& param, int layer, const std::optional<Json>&);

/// Replaces commas in the name, because they separate names in the file.
graph::Command renameLayer (const graph::Node&, const MixerPlace&, int layers, int layer, std::string name);

/// The result of addLayer(). The layer is empty, or a new node is wired into it. The inputs of that node are wired as far as the patch has
/// sources for them.
struct AddedLayer
{
    graph::Command command;
    std::string missing;   ///< "Wire something into ring.hit ..."; "" if nothing is left to do
    graph::Id node = 0;    ///< the new node; 0 for an empty layer
};

/// A texture is felt only in contact: it is multiplied by the gain of a contact window. The patch must have such a window, or a depth for a new
/// one. A mixer of vectors gets the force of a texture with its direction, and numbers along z.
/// A clip plays the file `clip`, a path as the graph contains it, at each tap.
/// If the mixer has only one layer and nothing is wired to it, this layer is filled. Ids: mixer/gone, mixer/full, mixer/type.
Result<AddedLayer> addLayer (const graph::Graph&, const MixerPlace&, const Catalogue&, const std::string& type = {}, const std::string& clip = {});

/// Adds a layer that plays a clip in a loop, as a vibration, with this gain in N, or a gentle one. `file` is the path as the graph contains it.
/// Ids: as addLayer.
Result<AddedLayer> addClipLayer (const graph::Graph&, const MixerPlace&, const Catalogue&, const std::string& file, std::optional<double> gain = {});

/// Pastes copied nodes into a patch as a layer of its first mixer that can take their one free output. Their inputs are wired as those of the nodes of the
/// same names and types, or else as far as the patch has sources for them. `made` receives the ids of the new nodes. Ids: mixer/none, mixer/full, mixer/type.
Result<AddedLayer> addCopiedLayer (const graph::Graph&, const std::string& patch, const Catalogue&, const graph::Graph& copied, std::set<graph::Id>& made);

/// The kinds of layers that the desk adds with one click.
struct LayerKind
{
    std::string name, type, about;   ///< name and about are in English
};

const std::vector<LayerKind>& layerKinds();

/// The types that can be a layer: textures and vibrations with a force output; for a mixer of vectors, also friction.
std::vector<const NodeType*> layerTypes (const Catalogue&, bool vectors = false);

/// True if a layer is multiplied by the gain of a contact window. The product and the window may be inside or outside of a group.
bool isGated (const graph::Graph&, const MixerPlace&, int layer);

/// Makes a layer felt only in contact, or always. Ids: mixer/gone, mixer/empty, mixer/no_contact, mixer/gate_elsewhere.
Result<graph::Command> setGate (const graph::Graph&, const MixerPlace&, const Catalogue&, int layer, bool on);

/// Removes a layer and its wires; the layers after it move up, also in the snapshots. Ids: mixer/gone, mixer/last_layer, mixer/exposed.
Result<graph::Command> removeLayer (const graph::Graph&, const MixerPlace&, const Catalogue&, int layer);

/// Moves a layer to another position, with its name, values, wires and controls, and its values in the snapshots.
graph::Command moveLayer (const graph::Graph&, const MixerPlace&, const Catalogue&, int layer, int to);

/// The result of addMixer(). The mixer is inserted between forces and the input where they are summed: a mixer of vectors if one of them
/// is a vector. If nothing drives the device yet, the mixer has one empty layer.
struct AddedMixer
{
    graph::Command command;
    std::string description;   ///< what the command does, for the user
    MixerPlace place;
};

/// Ids: mixer/no_motor, mixer/in_subgraph, mixer/no_forces.
Result<AddedMixer> addMixer (const graph::Graph&, const Catalogue&);

}   // namespace tactus::host
