// SPDX-License-Identifier: MIT
#include <host/base/platform/status_line.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using tactus::host::statusLine;
using tactus::host::StatusPart;

TEST_CASE ("status line: what matters least is left out first, and what is still too long is cut", "[host][platform]")
{
    const std::vector<StatusPart> parts { { "1.00 s", 0 }, { ", peak 2 N", 3 }, { ", late 5 µs", 4 }, { ", board lost", 1 } };
    CHECK (statusLine (parts, 0) == "1.00 s, peak 2 N, late 5 µs, board lost");
    CHECK (statusLine (parts, 40) == "1.00 s, peak 2 N, late 5 µs, board lost");   // 39 letters, and the last column stays free
    CHECK (statusLine (parts, 39) == "1.00 s, peak 2 N, board lost");
    CHECK (statusLine (parts, 28) == "1.00 s, board lost");
    CHECK (statusLine (parts, 10) == "1.00 s");
    CHECK (statusLine (parts, 5) == "1.0…");
    CHECK (statusLine ({ { "µµµµ", 0 } }, 4) == "µµ…");
}

TEST_CASE ("status line: it never fills the row, whatever the parts", "[host][platform]")
{
    tactus::test::property ("its letters are fewer than the columns", [] (const std::vector<std::string>& texts) {
        const int columns = *rc::gen::inRange (2, 60);
        std::vector<StatusPart> parts;
        for (const auto& text : texts)
            parts.push_back ({ text, *rc::gen::inRange (0, 3) });
        const auto line = statusLine (parts, columns);
        RC_ASSERT (std::ranges::count_if (line, [] (char c) { return (c & 0xc0) != 0x80; }) < columns);
    });
}
