// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
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

    Message();
    Message (const Message&);
    Message (Message&&) noexcept;
    Message& operator= (const Message&);
    Message& operator= (Message&&) noexcept;
    ~Message();

    /// `where` may be empty if no file is at fault.
    static Message error (std::string id, std::string where, std::string text, std::string remedy = {});
    static Message warning (std::string id, std::string where, std::string text, std::string remedy = {});
};

/// For use within another message: "where: text; remedy".
std::string sentence (const Message&);

/// One line for a terminal: "where: text; remedy [id]".
std::string describe (const Message&);

using Messages = std::vector<Message>;

/// More are not worth reading, and a hostile file may have millions of problems.
inline constexpr std::size_t most_messages = 1000;

bool hasErrors (const Messages&);

}   // namespace tactus
