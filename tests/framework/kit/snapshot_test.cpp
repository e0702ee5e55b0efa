// SPDX-License-Identifier: MIT
#include <tactus/kit/threads/snapshot.hpp>

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

TEST_CASE ("a snapshot holds the last stored value, and a partial store changes only its part", "[runtime]")
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

TEST_CASE ("a snapshot stores several parts of a value, and keeps what is between them", "[runtime]")
{
    constexpr std::size_t word = sizeof (std::uint64_t);
    Snapshot<State> snapshot { allOf (1) };
    snapshot.storeParts (allOf (2), [] (auto part) {
        part (0, word);
        part (3 * word, 6 * word);
        part (12 * word, 5);           // part of a word counts as all of it
        part (38 * word, 10 * word);   // no further than the end
    });
    const auto now = snapshot.load().numbers;
    for (std::size_t i = 0; i < now.size(); ++i)
    {
        INFO (i);
        CHECK (now[i] == (i == 0 || (i >= 3 && i < 9) || i == 12 || i >= 38 ? 2u : 1u));
    }
}

TEST_CASE ("a reader that interrupts the writer anywhere gets the value before or after, and does not wait for the writer", "[runtime]")
{
    Snapshot<State> snapshot { allOf (1) };
    for (std::uint64_t n = 2; n <= 4; ++n)
    {
        std::vector<State> seen { snapshot.load() };
        const auto look = [&] { seen.push_back (snapshot.load()); };   // on the writer's thread, as a tick that runs on its core
        snapshot.storeParts (allOf (n), [&] (auto part) {
            look();
            for (std::size_t i = 0; i < 40; ++i)
            {
                part (i * sizeof (std::uint64_t), sizeof (std::uint64_t));
                look();
            }
        });
        look();
        REQUIRE (seen.size() == 2 + 2 * 41);
        for (std::size_t i = 0; i < seen.size(); ++i)
        {
            INFO (i);
            CHECK (seen[i].numbers == allOf (i < seen.size() / 2 ? n - 1 : n).numbers);
        }
    }
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
