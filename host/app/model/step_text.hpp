// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/history.hpp>
#include <tactus/node/catalogue.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// What a command does, like graph::nameOf, in the language of the user. The names of batches are in English in the history, and translated
/// here.
std::string stepName (const graph::Command&);

/// The names of the steps of a history in the language of the user, oldest first. If a step changes only one value, its name contains the
/// old and the new value: "wall: Stiffness 400 -> 550 N/m".
std::vector<std::string> stepNames (const graph::History&, const Catalogue&);

}   // namespace tactus::host
