// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/cli/bounded_log.hpp>

#include <catch2/catch.hpp>

#include <sstream>

using tactus::host::BoundedLog;

TEST_CASE ("a log ends at its bound, with a line that says so, once", "[cli]")
{
    std::ostringstream out;
    BoundedLog log (out, 10);
    CHECK_FALSE (log.add ("1 > a\n"));
    CHECK (log.add ("2 > b\n"));
    CHECK_FALSE (log.add ("3\n"));   // also if there would be room
    CHECK (out.str() == "1 > a\n! the log ends here, because it has reached its bound\n");
}
