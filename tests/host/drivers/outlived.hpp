// SPDX-License-Identifier: MIT
#pragma once

#include "support/waiting.hpp"

#include <host/cli/running.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace tactus::test
{

/// The time of the steady clock, in ns, by which fakes say when something has happened.
inline std::int64_t steadyNow() { return std::chrono::nanoseconds (fromNow (std::chrono::nanoseconds (0)).time_since_epoch()).count(); }

/// The time for which a force on a fake outlives a signal to the program that plays on it, in ms. The shortest of five times, because a busy computer adds to each of
/// them. `zero`: the time at which the fake has lost its force since then, or 0.
template <typename Pushes, typename Zero>
double outlived (const std::vector<std::string>& play, int signal, Pushes&& pushes, Zero&& zero)
{
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i)
    {
        Running program (play);
        REQUIRE (soon (pushes));
        letPass (std::chrono::milliseconds (300));   // the ramp
        const auto sent = steadyNow();
        program.signal (signal);
        std::int64_t at = 0;
        REQUIRE (eventually ([&] { return (at = zero (sent)) > sent; }));
        shortest = std::min (shortest, 1e-6 * static_cast<double> (at - sent));
        if (signal == SIGSTOP) program.signal (SIGCONT);
        static_cast<void> (signal == SIGKILL ? program.finish() : program.stop());
    }
    std::cout << play[3] << ", signal " << signal << ": the force is zero after " << shortest << " ms\n";
    return shortest;
}

}   // namespace tactus::test
