// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/runtime/word_ring.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <thread>

using tactus::host::WordRing;

TEST_CASE ("pieces arrive whole, in order, or not at all", "[runtime]")
{
    rc::prop ("pieces of any length, now and then fetched", []
              {
        const auto capacity = *rc::gen::inRange<std::size_t> (1, 30);
        WordRing ring { capacity };
        std::vector<std::uint64_t> sent, got;
        std::uint64_t next = 0;
        for (const int piece : *rc::gen::container<std::vector<int>> (rc::gen::inRange (0, 12)))
        {
            if (piece == 0)
                while (ring.hasMore())
                    got.push_back (ring.take());
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
        while (ring.hasMore())
            got.push_back (ring.take());
        RC_ASSERT (got == sent); });
}

TEST_CASE ("what is discarded never arrives", "[runtime]")
{
    WordRing ring { 4 };
    ring.put (1);
    ring.discard();
    CHECK_FALSE (ring.hasMore());
    ring.put (2);
    CHECK_FALSE (ring.hasMore());
    CHECK (ring.commit());
    REQUIRE (ring.hasMore());
    CHECK (ring.take() == 2);
    CHECK_FALSE (ring.hasMore());
}

TEST_CASE ("two threads share it, and no piece is torn", "[runtime][threads]")
{
    constexpr std::uint64_t pieces = 200'000, length = 5;
    WordRing ring { 64 };
    std::atomic<bool> done = false;
    std::uint64_t sent = 0;
    std::jthread ticking ([&]
                          {
        for (std::uint64_t p = 0; p < pieces; ++p)
        {
            for (std::uint64_t i = 0; i < length; ++i)
                ring.put (length * p + i);
            sent += ring.commit();
        }
        done = true; });

    std::uint64_t got = 0, torn = 0;
    for (bool last = false; ! last;)
    {
        last = done;
        while (ring.hasMore())
        {
            const auto first = ring.take();
            torn += first % length != 0;
            for (std::uint64_t i = 1; i < length; ++i)
                torn += ring.take() != first + i;
            ++got;
        }
    }
    ticking.join();
    CHECK (torn == 0);
    CHECK (got == sent);
    CHECK (got > 0);
}
