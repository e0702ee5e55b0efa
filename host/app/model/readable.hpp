// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <string>
#include <string_view>

namespace tactus::host
{

/// An id of a datasheet as a person writes it: "Spatial frequency" for spatial_frequency, "d max" for d_max, "μ" for mu. Files, wires and
/// commands use the id.
std::string readable (std::string_view id);

/// The readable name, and in brackets the id that files have, unless the two differ by no more than a capital: "d max (d_max)", "Mass".
std::string nameWithId (std::string_view id);

/// The name of a port on a node. A port that a subgraph exposes is named by the user, so it is shown as it is written.
std::string readableName (const FacePort&);

}   // namespace tactus::host
