// SPDX-License-Identifier: MIT
#pragma once

#include "export_graph.hpp"
#include <host/code/generate/class/exported.hpp>

#include <set>
#include <string>

namespace tactus::host
{

/// The build files and the page of an exported folder. `sources` are the paths of the copied files.
std::string cmakeFile (const Exported&, const std::set<std::string>& sources);
std::string makeFile (const Exported&, const std::set<std::string>& sources);
std::string readmeFile (const Exported&, ExportTarget, const std::vector<std::string>& limits);

}   // namespace tactus::host
