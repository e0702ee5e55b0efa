// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/flat/flat.hpp>

#include <string>

namespace tactus::plan
{

/// Stores the settings of a node, and the size of its lists. Loads the files that settings name through `assets`; without assets,
/// such settings are refused. `folder` is the base of relative paths. Errors: node/unknown_setting, setting/value.
void readSettings (const graph::Node&, Origin, Assets* assets, const std::string& folder, FlatNode&, Flat&);

}   // namespace tactus::plan
