// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>

namespace tactus::host
{

/// A progress line for long runs. Prints nothing during the first half second, or if stderr is not a terminal.
class Progress
{
public:
    explicit Progress (std::size_t total);
    ~Progress();

    void operator() (std::size_t done);

private:
    using Clock = std::chrono::steady_clock;

    std::size_t total;
    bool visible, shown = false;
    Clock::time_point start = Clock::now(), next = start + std::chrono::milliseconds (500);
};

}   // namespace tactus::host
