// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

using tactus::SpscRing;

TEST_CASE ("pieces arrive whole and in order, or not at all", "[runtime]")
{
    tactus::test::property ("pieces of any length, fetched occasionally", [] {
        const auto capacity = *rc::gen::inRange<std::size_t> (1, 30);
        SpscRing<std::uint64_t> ring { capacity };
        std::vector<std::uint64_t> sent, got;
        std::uint64_t next = 0;
        for (const int piece : *rc::gen::container<std::vector<int>> (rc::gen::inRange (0, 12)))
        {
            if (piece == 0)
                while (ring.size() > 0)
                    got.push_back (ring.pop());
            std::vector<std::uint64_t> words;
            for (int i = 0; i < piece; ++i)
            {
                words.push_back (next++);
                ring.put (words.back());
            }
            const bool fits = sent.size() - got.size() + words.size() <= capacity;
            RC_ASSERT (ring.commit() == fits);
            if (fits) sent.insert (sent.end(), words.begin(), words.end());
        }
        while (ring.size() > 0)
            got.push_back (ring.pop());
        RC_ASSERT (got == sent);
    });
}

TEST_CASE ("a discarded piece never arrives", "[runtime]")
{
    SpscRing<std::uint64_t> ring { 4 };
    ring.put (1);
    ring.discard();
    CHECK (ring.size() == 0);
    ring.put (2);
    CHECK (ring.size() == 0);
    CHECK (ring.commit());
    REQUIRE (ring.size() > 0);
    CHECK (ring.pop() == 2);
    CHECK (ring.size() == 0);
}

TEST_CASE ("two threads share a ring, and no piece is torn", "[runtime][threads]")
{
    constexpr std::uint64_t pieces = 200'000, length = 5;
    SpscRing<std::uint64_t> ring { 64 };
    std::atomic<bool> done = false;
    std::uint64_t sent = 0;
    std::jthread ticking ([&] {
        for (std::uint64_t p = 0; p < pieces; ++p)
        {
            for (std::uint64_t i = 0; i < length; ++i)
                ring.put (length * p + i);
            sent += ring.commit();
        }
        done = true;
    });

    std::uint64_t got = 0, torn = 0;
    for (bool last = false; ! last;)
    {
        last = done;
        while (ring.size() > 0)
        {
            const auto first = ring.pop();
            torn += first % length != 0;
            for (std::uint64_t i = 1; i < length; ++i)
                torn += ring.pop() != first + i;
            ++got;
        }
    }
    ticking.join();
    CHECK (torn == 0);
    CHECK (got == sent);
    CHECK (got > 0);
}

TEST_CASE ("frames arrive contiguously, and a full ring counts the frames it loses", "[runtime]")
{
    SpscRing<float> ring { 4, 2 };
    for (int i = 0; i < 3; ++i)
        CHECK (ring.push (std::array { static_cast<float> (i), static_cast<float> (10 * i) }));
    CHECK (ring.front().size() == 6);
    ring.take (2);
    for (int i = 3; i < 6; ++i)
        CHECK (ring.push (std::array { static_cast<float> (i), static_cast<float> (10 * i) }));
    CHECK_FALSE (ring.push (std::array { 6.0f, 60.0f }));
    CHECK (ring.lost() == 1);
    CHECK (ring.size() == 4);
    CHECK (ring.pushed() == 6);
    CHECK (ring.removed() == 2);
    CHECK (ring.front().size() == 4);   // up to the end of the ring
    std::vector<float> got;
    ring.drain ([&] (std::span<const float> frame) { got.insert (got.end(), frame.begin(), frame.end()); });
    CHECK (got == std::vector { 2.0f, 20.0f, 3.0f, 30.0f, 4.0f, 40.0f, 5.0f, 50.0f });
    CHECK (ring.front().empty());
}
