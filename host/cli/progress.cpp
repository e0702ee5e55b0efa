// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress.hpp"

#include <host/base/platform/terminal.hpp>

#include <cstdio>

namespace tactus::host
{

Progress::Progress (std::size_t t) : total (t), visible (stderrIsTerminal()) {}

Progress::~Progress()
{
    if (shown) std::fprintf (stderr, "\r\033[K");
}

void Progress::operator() (std::size_t done)
{
    constexpr std::size_t ticks_between_looks_at_the_clock = 4096;
    if (! visible || done == 0 || done % ticks_between_looks_at_the_clock != 0) return;
    const auto now = Clock::now();
    if (now < next) return;
    next = now + std::chrono::milliseconds (100);
    shown = true;

    const double part = static_cast<double> (done) / static_cast<double> (total);
    const double left = std::chrono::duration<double> (now - start).count() * (1.0 / part - 1.0);
    constexpr int width = 30;
    char bar[width + 1] = {};
    for (int i = 0; i < width; ++i)
        bar[i] = i < part * width ? '#' : '.';
    std::fprintf (stderr, "\r[%s] %3.0f %%  %.0f s left \033[K", bar, 100.0 * part, left);
    std::fflush (stderr);
}

}   // namespace tactus::host
