// SPDX-License-Identifier: MIT
#pragma once

// The only ways in which a test waits or looks at a clock; tests/structure/waits.py refuses others. No load of the computer makes one of them fail.

#include <algorithm>
#include <chrono>
#include <thread>

namespace tactus::test
{

/// At least this time passes. For a fake with a pace of its own, and for code that counts wall time. What is tested may not depend on how much more passes.
inline void letPass (std::chrono::nanoseconds least)
{
#if defined(_WIN32)
    std::this_thread::sleep_for (std::chrono::ceil<std::chrono::milliseconds> (least));   // mingw leaves out what is less than a millisecond
#else
    std::this_thread::sleep_for (least);
#endif
}

/// The wall time of something: to print it, to compare it with another one of the same run, or to know how much has passed at least.
class Stopwatch
{
public:
    double s() const { return std::chrono::duration<double> (std::chrono::steady_clock::now() - begin).count(); }
    bool hasRun (std::chrono::nanoseconds least) const { return std::chrono::steady_clock::now() - begin >= least; }

private:
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
};

/// True as soon as the condition holds, on which a test looks again after each nap. Gives up after this many looks that took two minutes: a busy computer
/// makes the looks slower, and so the deadline later.
template <typename F>
bool eventually (std::chrono::nanoseconds nap, int most_looks, F&& so)
{
    const Stopwatch watch;
    for (int looks = 0; looks < most_looks || ! watch.hasRun (std::chrono::minutes (2)); ++looks)
    {
        if (so()) return true;
        letPass (nap);
    }
    return false;
}

template <typename F>
bool eventually (std::chrono::nanoseconds nap, F&& so)
{
    return eventually (nap, 10'000, so);
}

template <typename F>
bool eventually (F&& so)
{
    return eventually (std::chrono::microseconds (200), so);
}

/// The looks for a compiler of low priority. With naps of 5 ms, they are eight minutes.
inline constexpr int looks_at_compiler = 100'000;

/// True if the condition holds at each look during at least this time. A busy computer makes the looks fewer.
template <typename F>
bool stays (std::chrono::nanoseconds least, F&& so)
{
    for (const Stopwatch watch; ! watch.hasRun (least); letPass (std::chrono::milliseconds (1)))
        if (! so()) return false;
    return so();
}

/// The processor is busy for at least this time.
inline void busyFor (std::chrono::nanoseconds least)
{
    for (const Stopwatch watch; ! watch.hasRun (least);)
        ;
}

/// A point in time for code that waits until then at most, or that is told what time it is.
inline std::chrono::steady_clock::time_point fromNow (std::chrono::nanoseconds later) { return std::chrono::steady_clock::now() + later; }

/// The pace of a fake that reports periodically. A report that is late delays the next ones.
class Pace
{
public:
    explicit Pace (std::chrono::nanoseconds p) : period (p) {}

    void next()
    {
        due = std::max (due + period, std::chrono::steady_clock::now());
        std::this_thread::sleep_until (due);
    }

private:
    std::chrono::nanoseconds period;
    std::chrono::steady_clock::time_point due = std::chrono::steady_clock::now();
};

}   // namespace tactus::test
