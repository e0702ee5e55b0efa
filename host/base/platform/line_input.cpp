// SPDX-License-Identifier: MIT
#include "line_input.hpp"

#if defined(_WIN32)
#include <iostream>
#else
#include <poll.h>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace
{
std::string trimmed (const std::string& line)
{
    const auto first = line.find_first_not_of (" \t\r");
    return first == line.npos ? std::string() : line.substr (first, line.find_last_not_of (" \t\r") - first + 1);
}
}   // namespace

std::optional<std::string> LineInput::next (int wait_ms)
{
#if defined(_WIN32)
    if (wait_ms == 0 || has_ended) return std::nullopt;
    if (! std::getline (std::cin, typed)) has_ended = true;
    return has_ended ? std::nullopt : std::optional (trimmed (typed));
#else
    pollfd input { STDIN_FILENO, POLLIN, 0 };
    if (typed.find ('\n') == std::string::npos && ::poll (&input, 1, wait_ms) > 0)
    {
        char bytes[256];
        const auto got = ::read (STDIN_FILENO, bytes, sizeof bytes);
        if (got <= 0) has_ended = true;
        if (got > 0) typed.append (bytes, static_cast<std::size_t> (got));
    }
    const auto end = typed.find ('\n');
    if (end == std::string::npos) return std::nullopt;
    const auto line = typed.substr (0, end);
    typed.erase (0, end + 1);
    return trimmed (line);
#endif
}

}   // namespace tactus::host
