// SPDX-License-Identifier: MIT
#pragma once

#include "support/waiting.hpp"

#include <host/cli/running.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

namespace tactus::test
{

/// The time of the steady clock, in ns, by which fakes say when something has happened.
inline std::int64_t steadyNow() { return std::chrono::nanoseconds (fromNow (std::chrono::nanoseconds (0)).time_since_epoch()).count(); }

/// An end of a program that plays on a fake, and the longest time for which a force may outlive it.
struct End
{
    const char* what;
    double promise_ms;
    int signal = 0;                            // to the program; 0: none
    std::function<void()> otherwise = [] {};   // what happens then, such as a pulled cable
};

/// True if a force on a fake outlives an end no longer than promised. A busy computer adds to the time, so the end is tried again until it is short enough,
/// 5 times at most: it is never short enough if what should take the force off does not. Prints the times. `zero`: the time at which the fake has lost its
/// force since then, or 0.
template <typename Pushes, typename Zero>
bool keepsPromise (const std::vector<std::string>& play, const End& end, Pushes&& pushes, Zero&& zero)
{
    double shortest = std::numeric_limits<double>::infinity();
    int tries = 0;
    for (; shortest > end.promise_ms && tries < 5; ++tries)
    {
        Running program (play);
        REQUIRE (soon (pushes));
        letPass (std::chrono::milliseconds (300));   // the ramp
        const auto begin = steadyNow();
        if (end.signal != 0) program.signal (end.signal);
        end.otherwise();
        std::int64_t at = 0;
        REQUIRE (eventually ([&] { return (at = zero (begin)) > begin; }));
        shortest = std::min (shortest, 1e-6 * static_cast<double> (at - begin));
        if (end.signal == SIGSTOP) program.signal (SIGCONT);
        static_cast<void> (end.signal == SIGKILL ? program.finish() : program.stop());
    }
    std::cout << play[3] << ", " << end.what << ": the force is zero after " << shortest << " ms, promised " << end.promise_ms << " ms, try " << tries << "\n";
    return shortest <= end.promise_ms;
}

}   // namespace tactus::test
