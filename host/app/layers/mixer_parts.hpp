// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What the edits of mixers share: ends of wires, and the search for sources in a patch.

#include "mixer.hpp"

#include <host/app/model/face.hpp>

#include <set>

namespace tactus::host::mixing
{

inline constexpr std::string_view number_mixer = "layer.mix", vector_mixer = "layer.mix_vectors";

inline bool isMixer (std::string_view type) noexcept { return type == number_mixer || type == vector_mixer; }

inline const graph::Patch* patchOf (const graph::Graph& g, const std::string& name) { return name.empty() ? &g.root : g.find (name); }

graph::Endpoint endOf (const std::string& node, std::string_view port, int index = -1, int component = -1);
graph::Wire wire (graph::Endpoint from, graph::Endpoint to);

/// A node and everything downstream of it.
std::set<std::string> downstreamOf (const graph::Patch&, const std::string& node);

/// The best source in the patch for an input. The excluded nodes are skipped.
std::optional<graph::Endpoint> sourceFor (const PortSheet& input, const graph::Graph&, const graph::Patch&, const std::set<std::string>& excluded,
                                          const Catalogue&);

/// Names in the form in which the setting `names` stores them.
std::string joined (std::vector<std::string> names);

/// The names of the layers with one more at the end. The position of a name is the number of commas before it, so no name is empty.
std::string namesWith (const graph::Node& mixer, int layers, const std::string& last);

Message mixerIsGone();

/// The node that multiplies the source of a wire by the gain of a contact window; null if there is none.
const graph::Node* gateOf (const graph::Patch&, const graph::Wire&);

/// Multiplies a source by the gain of a contact window, which is 0 while the tool does not touch. Uses a window of the patch, or adds one that
/// reads the depth of a surface. Returns the product, or the source itself if the patch has neither.
graph::Endpoint gated (graph::Endpoint source, bool is_vector, const graph::Graph&, const MixerPlace&, const std::set<std::string>& excluded, const Catalogue&,
                       graph::Batch&);

}   // namespace tactus::host::mixing
