// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/face.hpp>

namespace tactus::host
{

/// A port that can be probed.
struct ScopePort
{
    std::string name;   ///< "drag.force", "grain/wave.value"
    std::string path;   ///< "grain/wave"
    graph::Id node = 0;
    std::string type;   ///< the node's type in the catalogue
    FacePort port;
    std::string first;           ///< its name in the first instances: "finger[0]/drag.force"; the same as the name if there is only one
    std::size_t instances = 1;   ///< how many ports have this name
};

constexpr std::size_t most_in_one_scope = 4;   ///< instances of a port

/// All ports of a graph and its subgraphs that can be probed, node by node in the order of the file, outputs first.
std::vector<ScopePort> scopePorts (const graph::Graph&, const Catalogue&);

/// The force on the first motor: all its instances, or the first one if they are many. Empty if there is no motor.
std::string motorPort (const std::vector<ScopePort>&);

}   // namespace tactus::host
