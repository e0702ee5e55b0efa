// SPDX-License-Identifier: GPL-3.0-or-later
#include "play_status.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstdio>
#include <string>

namespace tactus::host
{

void printStatus (const Runner& run, double rate_hz, bool over_the_last, const char* end)
{
    const auto now = run.status();
    const auto& late = run.account().lateness();
    std::string stops;
    if (now.phase == RunStatus::Phase::running)
        for (const auto& role : now.shown())
            if (role.stop != Guard::Stop::none) stops += "   " + printableName (role.name) + " stopped: " + describe (role.latestEvent());
    std::fprintf (stderr, "%s%8.2f s   force %6.3f N, peak %6.3f N   "
                          "late p50 %.1f us, p99 %.1f us, max %.0f us, missed %zu of %zu ticks%s%s",
                  over_the_last ? "\r\033[K" : "", static_cast<double> (now.ticks) / rate_hz, now.force, now.peak,
                  1e6 * late.quantile (0.5), 1e6 * late.quantile (0.99), 1e6 * late.longest(),
                  static_cast<std::size_t> (now.misses), static_cast<std::size_t> (now.ticks), stops.c_str(), end);
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
