// SPDX-License-Identifier: MIT
#include <tactus/kit/snapshot.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

using namespace tactus;

namespace
{
struct State
{
    std::array<std::uint64_t, 40> numbers {};
};

State allOf (std::uint64_t n)
{
    State s;
    s.numbers.fill (n);
    return s;
}
}   // namespace

TEST_CASE ("a snapshot holds the last stored value; a partial store changes only its part", "[runtime]")
{
    Snapshot<State> snapshot { allOf (1) };
    CHECK (snapshot.load().numbers == allOf (1).numbers);
    snapshot.store (allOf (2));
    CHECK (snapshot.load().numbers == allOf (2).numbers);
    snapshot.store (allOf (3), 2 * sizeof (std::uint64_t));
    const auto now = snapshot.load().numbers;
    CHECK (now[1] == 3);
    CHECK (now[2] == 2);
}

TEST_CASE ("a reader sees every snapshot complete, and never one older than the previous one", "[runtime]")
{
    Snapshot<State> snapshot;
    std::atomic<bool> done { false };
    std::atomic<int> broken { 0 };
    std::atomic<std::uint64_t> seen { 0 };
    std::vector<std::thread> readers;
    for (int r = 0; r < 2; ++r)
        readers.emplace_back ([&] {
            std::uint64_t last = 0, n = 0;
            for (; ! done; ++n)
            {
                const auto now = snapshot.load().numbers;
                broken += std::ranges::count (now, now[0]) != static_cast<std::ptrdiff_t> (now.size()) || now[0] < last;
                last = now[0];
            }
            seen += n;
        });
    for (std::uint64_t n = 1; n <= 200000; ++n)
    {
        snapshot.store (allOf (n));
        if (n % 1000 == 0) std::this_thread::yield();
    }
    while (seen == 0 && ! done)
        done = snapshot.load().numbers[0] == 200000;
    for (auto& r : readers)
        r.join();
    CHECK (broken == 0);
    CHECK (seen > 0);
}
