// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/flat/flat.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::plan
{

/// The resolved ports that are driven or read from outside the graph. A port of a placeholder is empty: values written to it
/// are ignored, and it reads as 0.
struct Outside
{
    /// A port or a part of it, with the name under which it was requested.
    struct Read
    {
        std::string name;
        std::optional<PortRef> port;
    };

    std::vector<std::vector<PortRef>> feeds;   ///< by feed: the ports it drives, each one component; several ports if there are several instances
    std::vector<Read> records;
    std::map<std::string, std::vector<PortRef>> exposed;   ///< params and inputs by the names under which subgraphs expose them
};

}   // namespace tactus::plan
