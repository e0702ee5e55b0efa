// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid_link/describe_counts.hpp>

#include <numeric>

namespace tactus::host::hid
{

std::string describe (const ReadingCounts& read, const PortCounts& port)
{
    const auto number = [] (auto n)
    { return std::to_string (n); };
    auto text = number (read.taken) + " taken, " + number (read.lost) + " lost, " + number (std::accumulate (read.refused.begin(), read.refused.end(), std::uint64_t { 0 })) + " refused";
    std::string reasons;
    for (std::size_t i = 0; i < read.refused.size(); ++i)
        if (read.refused[i] > 0) reasons += (reasons.empty() ? "" : ", ") + number (read.refused[i]) + " " + std::string (describe (static_cast<Refusal> (i)));
    if (! reasons.empty()) text += " (" + reasons + ")";
    if (read.restarts > 0) text += ", " + number (read.restarts) + " out of order";
    if (read.skipped > 0) text += ", " + number (read.skipped) + " skipped for newer ones";
    if (port.overflown > 0) text += ", " + number (port.overflown) + " without room";
    return text;
}

}   // namespace tactus::host::hid
