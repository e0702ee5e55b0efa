// SPDX-License-Identifier: MIT
// The stop switch: presses are counted, and a rearm comes a second after the last stop and the last rearm.
#include "support/waiting.hpp"

#include <host/devices/live/stop_switch.hpp>

#include <tactus/text/message.hpp>

#include <catch2/catch.hpp>

using tactus::host::By;
using tactus::host::StopSwitch;
using tactus::test::fromNow;

TEST_CASE ("a rearm is refused within a second of an emergency stop, and if it was asked for before", "[live][safety]")
{
    StopSwitch stops;
    CHECK (stops.mayRearm());
    const auto before = fromNow ({});
    stops.emergencyStop (By::program);
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
    stops.stop (By::program);
    stops.emergencyStop (By::program);
    CHECK (stops.isAhead());
    CHECK (stops.presses() == StopSwitch::PressCounts { 1, 1 });
    CHECK (stops.notice() == StopSwitch::PressCounts {});
    CHECK_FALSE (stops.isAhead());
    const auto before = fromNow ({});
    stops.note (By::program);   // a stop that needs no press
    CHECK_FALSE (stops.isAhead());
    CHECK_FALSE (stops.mayRearm (before));
}

TEST_CASE ("what a person has stopped, or has not started yet, no program starts, whatever programs stop meanwhile", "[live][safety]")
{
    StopSwitch stops;
    CHECK (stops.mayStart().error().text == "no person has started the run yet");
    stops.started();
    CHECK (stops.mayStart());
    stops.stop (By::program);
    static_cast<void> (stops.notice());
    CHECK (stops.mayStart());
    for (const auto& stop : { +[] (StopSwitch& s) { s.stop (By::person); }, +[] (StopSwitch& s) { s.emergencyStop (By::person); },
                              +[] (StopSwitch& s) { s.stopped (By::person); } })
    {
        stop (stops);
        stops.stop (By::program);
        CHECK (stops.mayStart().error().id == "run/stopped_by_person");
        static_cast<void> (stops.notice());
        CHECK_FALSE (stops.mayStart());
        stops.started();
        CHECK (stops.mayStart());
    }
}

TEST_CASE ("a person's press that nobody has noticed when a person starts comes after the start", "[live][safety]")
{
    StopSwitch stops;
    stops.started();
    stops.stop (By::person);
    stops.started();
    CHECK_FALSE (stops.mayStart());

    const auto seen = stops.personStops();
    stops.emergencyStop (By::person);
    stops.startedAfter (seen);   // a rearm that was asked for before
    CHECK_FALSE (stops.mayStart());
}
