// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The signals that reach the motors of a graph, and those of them that go through a layer mixer.

#include <tactus/plan/flat/flat.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// True for layer.mix and layer.mix_vectors.
bool isLayerMixer (const plan::FlatNode&);

/// A wire that reaches a motor without a mixer.
struct UnmixedWire
{
    std::size_t wire = 0;   ///< number in Flat::wires
    std::string from;       ///< "wall.force"; "" for the output of a placeholder

    std::vector<int> through {};   ///< the nodes between this wire and the motor, numbers in Flat::nodes
};

/// An input of a node that drives a device, with a wire into it.
struct SinkMix
{
    int sink = 0;                 ///< number in Flat::nodes
    plan::PortRef input;          ///< of the sink
    std::string name;             ///< "motor.force"
    std::vector<int> mixers {};   ///< those whose mix reaches this input, in the order of Flat::nodes
    bool is_direct = false;       ///< the mix of a mixer is wired directly into it
    std::vector<UnmixedWire> unmixed {};
};

/// The inputs of all nodes that drive a motor. A signal is mixed if it comes from a layer mixer, directly or through other nodes. A signal that is added
/// to a mix on its way, by a second wire into the same input or by a node that adds, is not mixed. A node that is bypassed passes a signal on, and a
/// bypassed mixer does not mix. A brake takes no force.
std::vector<SinkMix> sinkMixes (const plan::Flat&);

}   // namespace tactus::host
