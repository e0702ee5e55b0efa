// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace tactus
{

/// One thing found wrong, or worth a warning, in what somebody wrote. Functions that read what people write return a
/// list of these, so that all problems of a file are reported at once.
struct Message
{
    enum class Severity
    {
        warning,
        error
    };

    Severity severity = Severity::error;
    std::string id;       ///< stable, such as "unit/mismatch"; tests and tools hold on to it
    std::string where;    ///< JSON pointer into the graph file, such as "/nodes/drag/params/mu"
    std::string text;     ///< what is wrong, with the names of both ends
    std::string remedy;   ///< what would be right

    // Where it stands in a text, if it was read from one.
    std::string file = {};      ///< as it was opened, or as a subgraph's type names it; empty for the graph itself
    int line = 0, column = 0;   ///< counted from 1, 0 where unknown: see LoadedGraph::positionOf
};

using Messages = std::vector<Message>;

inline bool hasErrors (const Messages& messages)
{
    return std::ranges::any_of (messages, [] (const Message& m)
                                { return m.severity == Message::Severity::error; });
}

}   // namespace tactus
