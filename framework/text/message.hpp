// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace tactus
{

/// An error or a warning about something that a user wrote. Functions that read what people write return a list of these, so that
/// all problems of a file are reported together.
struct Message
{
    enum class Severity
    {
        warning,
        error
    };

    Severity severity = Severity::error;
    std::string id;       ///< stable, such as "unit/mismatch"; tests and tools rely on it
    std::string where;    ///< JSON pointer into the graph file, such as "/nodes/drag/params/mu"
    std::string text;     ///< what is wrong, with all names involved
    std::string remedy;   ///< what to do about it

    // Position in the text, if it was read from text.
    std::string file = {};      ///< name of the file as it was opened, or as written in the type of a subgraph; empty for the graph itself
    int line = 0, column = 0;   ///< counted from 1, 0 if unknown; see LoadedGraph::positionOf

    /// `where` may be empty if no file is at fault.
    static Message error (std::string id, std::string where, std::string text, std::string remedy = {})
    {
        return make (Severity::error, std::move (id), std::move (where), std::move (text), std::move (remedy));
    }
    static Message warning (std::string id, std::string where, std::string text, std::string remedy = {})
    {
        return make (Severity::warning, std::move (id), std::move (where), std::move (text), std::move (remedy));
    }

private:
    static Message make (Severity severity, std::string id, std::string where, std::string text, std::string remedy)
    {
        return { .severity = severity, .id = std::move (id), .where = std::move (where), .text = std::move (text), .remedy = std::move (remedy) };
    }
};

/// For use within another message: "where: text; remedy".
inline std::string sentence (const Message& m) { return (m.where.empty() ? "" : m.where + ": ") + m.text + (m.remedy.empty() ? "" : "; " + m.remedy); }

/// One line for a terminal: "where: text; remedy [id]".
inline std::string describe (const Message& m) { return m.where + ": " + m.text + "; " + m.remedy + " [" + m.id + "]"; }

using Messages = std::vector<Message>;

/// More are not worth reading, and a hostile file may have millions of problems.
inline constexpr std::size_t most_messages = 1000;

inline bool hasErrors (const Messages& messages)
{
    return std::ranges::any_of (messages, [] (const Message& m) { return m.severity == Message::Severity::error; });
}

}   // namespace tactus
