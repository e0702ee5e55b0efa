// SPDX-License-Identifier: MIT
// The stop switch: presses are counted, and a rearm comes a second after the last stop and the last rearm.
#include "support/waiting.hpp"

#include <host/live/stop_switch.hpp>

#include <tactus/text/message.hpp>

#include <catch2/catch.hpp>

using tactus::host::StopSwitch;
using tactus::test::fromNow;

TEST_CASE ("a rearm is refused within a second of an emergency stop, and if it was asked for before", "[live][safety]")
{
    StopSwitch stops;
    CHECK (stops.mayRearm());
    const auto before = fromNow ({});
    stops.emergencyStop();
    CHECK (stops.mayRearm (before).error().id == "run/rearm_too_early");
    CHECK_FALSE (stops.mayRearm (before + StopSwitch::pause / 2));
    CHECK (stops.mayRearm (fromNow (StopSwitch::pause)));
}

TEST_CASE ("a rearm is refused within a second of the last one", "[live][safety]")
{
    StopSwitch stops;
    CHECK (tactus::test::eventually ([&] {   // a busy computer may take longer than a second from one to the other
        stops.rearmed();
        const auto allowed = stops.mayRearm();
        return ! allowed && allowed.error().text == "the last rearm was less than a second ago";
    }));
}

TEST_CASE ("a press is ahead until it is noticed, and both kinds are counted", "[live]")
{
    StopSwitch stops;
    CHECK_FALSE (stops.isAhead());
    stops.stop();
    stops.emergencyStop();
    CHECK (stops.isAhead());
    CHECK (stops.presses() == StopSwitch::PressCounts { 1, 1 });
    CHECK (stops.notice() == StopSwitch::PressCounts {});
    CHECK_FALSE (stops.isAhead());
    const auto before = fromNow ({});
    stops.note();   // a stop that needs no press
    CHECK_FALSE (stops.isAhead());
    CHECK_FALSE (stops.mayRearm (before));
}
