// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/history.hpp>
#include <tactus/node/catalogue.hpp>

#include <string>

namespace tactus::host
{

/// The name of a step of a history. If a step changes only one value, its name contains the
/// old and the new value: "wall: Stiffness 400 -> 550 N/m". The name of a new wire is the wire: "grating.force -> mixer.in[1]".
std::string stepName (const graph::History&, std::size_t step, const Catalogue&);

}   // namespace tactus::host
