// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace tactus::host
{

/// The lines of the standard input, for a program that does other things while none comes. [one thread]
class LineInput
{
public:
    /// A line, without spaces around it, if one comes within this time. On Windows, it waits until a line comes, unless `wait_ms` is 0; then there is none.
    std::optional<std::string> next (int wait_ms);

    bool hasEnded() const noexcept { return has_ended; }   ///< no further line will come

private:
    std::string typed;
    bool has_ended = false;
};

}   // namespace tactus::host
