// SPDX-License-Identifier: MIT
// The stop switch: presses are counted, and a rearm comes a second after the last stop and the last rearm.
#include <host/live/stop_switch.hpp>

#include <tactus/text/message.hpp>

#include <catch2/catch.hpp>

using tactus::host::StopSwitch;
using Clock = std::chrono::steady_clock;

TEST_CASE ("a rearm is refused within a second of an emergency stop, and if it was asked for before", "[live][safety]")
{
    StopSwitch stops;
    CHECK (stops.mayRearm());
    const auto before = Clock::now();
    stops.emergencyStop();
    CHECK (stops.mayRearm().error().id == "run/rearm_too_early");
    CHECK_FALSE (stops.mayRearm (before));
    CHECK_FALSE (stops.mayRearm (Clock::now() + StopSwitch::pause / 2));
    CHECK (stops.mayRearm (Clock::now() + StopSwitch::pause));
}

TEST_CASE ("a rearm is refused within a second of the last one", "[live][safety]")
{
    StopSwitch stops;
    stops.rearmed();
    CHECK (stops.mayRearm().error().text == "the last rearm was less than a second ago");
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
    stops.note();   // a stop that needs no press
    CHECK_FALSE (stops.isAhead());
    CHECK_FALSE (stops.mayRearm());
}
