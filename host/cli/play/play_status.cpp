// SPDX-License-Identifier: GPL-3.0-or-later
#include "play_status.hpp"

#include <host/base/platform/status_line.hpp>
#include <host/base/platform/terminal.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

namespace
{
template <typename... Values>
std::string formatted (const char* format, Values... values)
{
    std::array<char, 160> text;
    std::snprintf (text.data(), text.size(), format, values...);
    return text.data();
}
}   // namespace

void printStatus (const Runner& run, double rate_hz, bool over_the_last, const std::string& hardware, bool is_last)
{
    const auto now = run.status();
    const auto& late = run.account().lateness();
    std::vector<StatusPart> parts {
        { formatted ("%8.2f s   force %6.3f N", static_cast<double> (now.ticks) / rate_hz, now.force), 0 },
        { formatted (", peak %6.3f N", now.peak), 3 },
        { formatted ("   late p50 %.1f us, p99 %.1f us, max %.0f us", 1e6 * late.quantile (0.5), 1e6 * late.quantile (0.99), 1e6 * late.longest()), 4 },
        { formatted (", missed %zu of %zu ticks", static_cast<std::size_t> (now.misses), static_cast<std::size_t> (now.ticks)), 2 },
    };
    for (const auto& role : now.shown())
    {
        if (now.phase != RunStatus::Phase::running) break;
        const auto name = "   " + printableName (role.name);
        if (role.stop != Guard::Stop::none)
            parts.push_back ({ name + " stopped: " + describe (role.latestEvent()), 0 });
        else if (role.is_clipping)
            parts.push_back ({ name + ": its guard clips most ticks, as the graph asks for more than its limits", 0 });
    }
    parts.push_back ({ hardware, 1 });
    const auto line = statusLine (std::move (parts), over_the_last && ! is_last ? stderrColumns() : 0);
    std::fprintf (stderr, "%s%s%s", over_the_last ? "\r\033[K" : "", line.c_str(), is_last ? "\n" : "");
    std::fflush (stderr);
}

void printCosts (Runner& run)
{
    constexpr std::size_t most = 10;
    const auto costs = run.costs();
    std::fprintf (stderr, "    mean us   share   node\n");
    for (std::size_t i = 0; i < std::min (most, costs.size()); ++i)
        std::fprintf (stderr, "%11.3f %5.1f %%   %s (%s)\n", 1e6 * costs[i].mean_s, 100.0 * costs[i].share, printableName (costs[i].node).c_str(),
                      printableName (costs[i].type).c_str());
    if (costs.size() > most) std::fprintf (stderr, "and %zu cheaper nodes\n", costs.size() - most);
}

}   // namespace tactus::host
