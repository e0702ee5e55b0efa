// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>

#include <filesystem>
#include <string>

namespace tactus::host
{

inline constexpr auto clip_type = "signal.clip";

/// Makes a signal.clip play a file in a loop, from the first tick on. `file` is the path as the graph contains it.
void playClip (graph::Node&, const std::string& file);

/// A graph that plays a clip on a simulated device: its value pushes along z, with 1 N at amplitude 1.
graph::Graph graphOfClip (const std::filesystem::path& file);

}   // namespace tactus::host
