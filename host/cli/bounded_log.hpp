// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace tactus::host
{

/// The log of a program that may run for days: it ends at a bound, with a line that says so, and the disk does not fill up. [one thread]
class BoundedLog
{
public:
    BoundedLog (std::ostream& to, std::uint64_t most_bytes) : out (to), left (most_bytes) {}

    /// Writes a line, which ends with a newline. True if the log has just ended instead.
    bool add (std::string_view line)
    {
        if (has_ended) return false;
        has_ended = line.size() > left;
        if (! has_ended) left -= line.size();
        out << (has_ended ? std::string_view ("! the log ends here, because it has reached its bound\n") : line);
        return has_ended;
    }

private:
    std::ostream& out;
    std::uint64_t left;
    bool has_ended = false;
};

}   // namespace tactus::host
