// SPDX-License-Identifier: MIT
#include "examination.hpp"
#include "no_allocation.hpp"
#include "parts.hpp"
#include "watched_ticks.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

namespace tactus::examine
{

namespace
{
struct Counted
{
    int allocations = 0, locks = 0;
};

Counted count (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Rig rig = prepared (type);
    Counted most;
    std::optional<NoAllocation> watch;
    tickWatched (
        rig, dice, [&] { watch.emplace(); },
        [&] {
            most.allocations = std::max (most.allocations, watch->allocations());
            most.locks = std::max (most.locks, watch->locks());
            watch.reset();
        });
    return most;
}

std::string timesText (int n, const char* what) { return n == 0 ? "" : say ("a tick ", what, ' ', n, n == 1 ? " time" : " times"); }
}   // namespace

std::string unwatched (const NodeType&) { return NoAllocation::watches ? "" : "this program cannot count allocations and locks (sanitizer, or no glibc)"; }
std::string allocationFault (const NodeType& type, unsigned seed) { return timesText (count (type, seed).allocations, "allocates or frees memory"); }
std::string lockFault (const NodeType& type, unsigned seed) { return timesText (count (type, seed).locks, "locks a mutex"); }

double tickTime (const NodeType& type)
{
    constexpr int batches = 21, ticks = 500;
    NodeDice dice { 1 };
    Rig rig = prepared (type);
    std::vector<std::vector<double>> inputs (64);
    for (auto& in : inputs)
    {
        randomTameInputs (rig, dice);
        in = rig.in;
    }
    std::vector<double> times;
    for (int b = 0; b < batches; ++b)
    {
        const auto start = std::chrono::steady_clock::now();
        for (int k = 0; k < ticks; ++k)
        {
            std::ranges::copy (inputs[static_cast<std::size_t> (k) % inputs.size()], rig.in.begin());
            rig.tick();
        }
        times.push_back (std::chrono::duration<double, std::nano> (std::chrono::steady_clock::now() - start).count() / ticks);
    }
    std::ranges::nth_element (times, times.begin() + batches / 2);
    return times[batches / 2];
}

}   // namespace tactus::examine
