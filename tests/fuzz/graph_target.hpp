// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>

#include <cstdlib>

namespace tactus::fuzz
{

/// Reads the text as a graph. Either reading reports problems, each with its location, or the graph survives writing and reading
/// unchanged, and then runs or is refused. Aborts otherwise.
inline void tryGraph (std::string_view text)
{
    const auto loaded = readGraph (text);
    for (const auto& m : loaded.messages)
        if (m.id.empty() || m.text.empty() || m.line < 1 || m.column < 1) std::abort();
    if (hasErrors (loaded.messages)) return;

    const auto written = writeGraph (loaded.graph);
    const auto again = readGraph (written);
    if (hasErrors (again.messages) || writeGraph (again.graph) != written) std::abort();

    const auto compiled = compile (loaded.graph, catalogue());
    if (! compiled.plan && ! hasErrors (compiled.messages)) std::abort();
    for (int k = 0; compiled.plan && k < 3; ++k)
        compiled.plan->tick();
}

}   // namespace tactus::fuzz
