// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/file/graph_file.hpp>
#include <tactus/text/message.hpp>

#include <string>

namespace tactus::host
{

/// Exit statuses of the program (contract section 3).
enum ExitStatus
{
    fine = 0,
    fault_of_input = 1,
    wrong_usage = 2
};

/// Ends a command whose input is wrong; the problem has already been printed to stderr.
struct Stop
{
};

/// Escapes what could disturb a terminal and joins the text into one line, so that a name in a file cannot forge a message.
std::string inOneLine (std::string);

/// Prints each message, up to most_messages, to stderr: the location, the problem, the remedy. Returns the number of errors.
int report (const Messages&, const LoadedGraph&, const std::string& file);

/// The same for messages that name their files and lines.
int report (const Messages&);

/// Prints a warning about this file.
void warn (const std::string& file, const Message&);

/// Prints each message as a warning, with its own file and place.
void warnOfFiles (const Messages&);

/// Prints the error and throws Stop.
[[noreturn]] void fail (const Message&);
[[noreturn]] void fail (const std::string& id, const std::string& what, const std::string& remedy);

/// Returns the value of a result, or ends the command.
template <typename Expected>
auto orFail (Expected&& result)
{
    if (! result) fail (result.error());
    if constexpr (! std::is_void_v<typename std::remove_cvref_t<Expected>::value_type>)
        return std::move (*result);
}

}   // namespace tactus::host
