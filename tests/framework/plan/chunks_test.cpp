// SPDX-License-Identifier: MIT
#include <tactus/plan/chunks.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using tactus::plan::Chunks;

TEST_CASE ("a copy of a chunked list shares all elements until one of them is changed", "[plan]")
{
    Chunks<std::string> list;
    for (int i = 0; i < 1000; ++i)
        list.add (std::to_string (i));
    auto copy = list;
    CHECK (std::ranges::all_of (std::vector { 0u, 500u, 999u }, [&] (auto i) { return &copy[i] == &list[i]; }));

    copy.change (500) = "other";
    CHECK (list[500] == "500");
    CHECK (copy[500] == "other");
    CHECK (copy[501] == "501");
    CHECK (&copy[0] == &list[0]);
    CHECK (&copy[501] != &list[501]);   // it is in the same chunk

    const auto* mine = &copy[500];
    copy.change (500) = "again";
    CHECK (&copy[500] == mine);
    CHECK (list[500] == "500");
}

TEST_CASE ("a chunked list grows, shrinks and can be searched", "[plan]")
{
    Chunks<int> list;
    CHECK (list.empty());
    CHECK (list.begin() == list.end());
    list.resize (64);
    CHECK (list.size() == 64);
    CHECK (list[63] == 0);
    const auto* first = &list[0];
    for (int i = 64; i < 200; ++i)
        list.add (i);
    CHECK (&list[0] == first);
    CHECK (list.back() == 199);
    CHECK (std::ranges::find (list, 130) - list.begin() == 130);
    CHECK (std::ranges::find (list, 1000) == list.end());

    const auto copy = list;
    while (list.size() > 64)
        list.drop();
    CHECK (copy.size() == 200);
    CHECK (copy[64] == 64);
    list.add (7);
    CHECK (list[64] == 7);
    CHECK (copy[64] == 64);
    list.resize (3);
    CHECK (list.end() - list.begin() == 3);
    CHECK (copy[63] == 0);
}
