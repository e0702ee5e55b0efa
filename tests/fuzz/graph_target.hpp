// SPDX-License-Identifier: MIT
#pragma once

#include <framework/file/graph_file.hpp>

#include <cstdlib>

namespace tactus::fuzz
{

/// A text is a graph that is written and read without a change, or a list of problems that all have a place. Aborts if not.
inline void tryGraph (std::string_view text)
{
    const auto loaded = readGraph (text);
    for (const auto& m : loaded.messages)
        if (m.id.empty() || m.text.empty() || m.line < 1 || m.column < 1) std::abort();
    if (hasErrors (loaded.messages)) return;

    const auto written = writeGraph (loaded.graph);
    const auto again = readGraph (written);
    if (hasErrors (again.messages) || writeGraph (again.graph) != written) std::abort();
}

}   // namespace tactus::fuzz
