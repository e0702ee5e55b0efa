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
    std::string file;     ///< of an included graph file; empty for the file itself
};

using Messages = std::vector<Message>;

inline bool hasErrors (const Messages& messages)
{
    return std::ranges::any_of (messages, [] (const Message& m)
                                { return m.severity == Message::Severity::error; });
}

}   // namespace tactus
