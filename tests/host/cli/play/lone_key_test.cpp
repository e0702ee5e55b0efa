// SPDX-License-Identifier: GPL-3.0-or-later
// Which letter in a terminal counts, such as the R that rearms.
#include <host/cli/play/lone_key.hpp>

#include <catch2/catch.hpp>

#include <string>

using tactus::host::LoneKey;

namespace
{
/// Types the keys `apart` seconds apart, looking for an R to act on every 10 ms, and returns how many there were.
int rearmsOf (const std::string& keys, double apart, LoneKey& key, double& now)
{
    int count = 0;
    const auto wait = [&] (double s) {
        for (const double end = now + s; now < end; now += 0.01)
            count += key.isDue (now);
    };
    for (const char c : keys)
    {
        key.typed (c, now);
        wait (apart);
    }
    wait (2.0);
    return count;
}

int rearmsOf (const std::string& keys, double apart = 0.0)
{
    LoneKey key { 'r' };
    double now = 1000.0;
    return rearmsOf (keys, apart, key, now);
}
}   // namespace

TEST_CASE ("an R that comes alone rearms", "[cli]")
{
    CHECK (rearmsOf ("r") == 1);
    CHECK (rearmsOf ("R") == 1);
    CHECK (rearmsOf (" R", 1.2) == 1);
    CHECK (rearmsOf ("\x1bR", 0.6) == 1);   // Esc, and then R
    CHECK (rearmsOf ("RRR", 1.0) == 3);
    CHECK (rearmsOf ("xyzR", 0.1) == 1);
}

TEST_CASE ("an R in an escape sequence, in pasted text, or of a key held down does not rearm", "[cli]")
{
    for (const auto* keys : { "\x1bOR", "\x1b[R", "\x1b[1;2R", "\x1b[24;80R", "\x1br", "\x1b[24;80R\x1b[24;80R", "aR", "Ra", "R ", "\x1b[200~R\x1b[201~" })
    {
        CAPTURE (keys);
        CHECK (rearmsOf (keys) == 0);
        CHECK (rearmsOf (keys, 0.02) == 0);
    }
    CHECK (rearmsOf ("\x1b[24;80R", 0.04) == 0);   // over a slow network
    CHECK (rearmsOf (std::string (100, 'R'), 0.03) == 0);
    CHECK (rearmsOf (std::string (100, 'R'), 0.25) == 1);

    LoneKey key { 'r' };
    double now = 0.0;
    CHECK (rearmsOf ("\x1bOR", 0.0, key, now) == 0);
    CHECK (rearmsOf ("R", 0.0, key, now) == 1);   // pressed again, alone
}

TEST_CASE ("letters wait for each other, so that only one of several that come together can count", "[cli]")
{
    LoneKey rearms { 'r' }, moves { 's' };
    for (const char key : { 's', 'r' })
    {
        rearms.typed (key, 10.0);
        moves.typed (key, 10.0);
    }
    CHECK_FALSE (moves.isDue (10.1));
    CHECK_FALSE (rearms.isDue (10.1));
    for (auto* each : { &rearms, &moves })
        each->typed ('S', 11.0);
    CHECK (moves.isDue (11.1));
    CHECK_FALSE (rearms.isDue (11.1));
}
