// SPDX-License-Identifier: MIT
// The messages between Haply's service and a program: without a service.

#include "support/corpus.hpp"

#include <fuzz/inverse3_target.hpp>
#include <host/drivers/haply/inverse3_messages.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace tactus;
using host::Inverse3Messages;
using host::Inverse3State;

namespace
{
std::string oneArm (const std::string& id, const std::string& position, const std::string& grip = "")
{
    return R"({"inverse3":[{"device_id":")" + id + R"(","state":{"cursor_position":)" + position
           + R"(,"control_mode":"idle"}}],"wireless_verse_grip":[)" + grip + "]}";
}
}   // namespace

TEST_CASE ("a state of an Inverse3 has position, rotation and buttons, and the commands for it have its id and spelling", "[haply][wires]")
{
    Inverse3Messages messages;
    REQUIRE (messages.configure ({ { "grip", "wireless" }, { "spelling", "vector" } }).empty());
    const auto text = oneArm ("04BA", R"({"x":1,"y":2,"z":-3})", R"({"state":{"orientation":{"x":0,"y":0,"z":-2,"w":-2},"buttons":{"b":true,"home":true}}})");
    REQUIRE (messages.readInventory (text).empty());
    Inverse3State state;
    REQUIRE (messages.read (text, state).empty());
    CHECK (state.position == Vec3 (1.0, 2.0, -3.0));
    CHECK ((state.rotation - Vec3 (0.0, 0.0, std::acos (0.0))).norm() < 1e-12);   // a quarter of a turn; a quaternion and its negative are the same
    CHECK (state.buttons == 0b1010u);
    CHECK (state.is_idle);
    CHECK (messages.push ({ 0.5, 0.0, -1.0 }) == R"({"inverse3":[{"device_id":"04BA","commands":{"set_cursor_force":{"vector":{"x":0.5,"y":0,"z":-1}}}}]})");
    CHECK (messages.probe() == R"({"inverse3":[{"device_id":"04BA","commands":{"probe_position":{}}}]})");
}

TEST_CASE ("what is wrong with a message about an Inverse3 is said, and the last state stays", "[haply][wires]")
{
    Inverse3Messages messages;
    const std::string origin = R"({"x":0,"y":0,"z":0})";
    CHECK (messages.readInventory ("{").find ("knows no Inverse3") != std::string::npos);
    CHECK (messages.readInventory (oneArm ("04\\\"BA", origin)).find ("characters") != std::string::npos);
    CHECK (messages.readInventory (R"({"inverse3":[{"device_id":"1"},{"device_id":"2"}]})").find ("several") != std::string::npos);
    CHECK (messages.readInventory (R"({"inverse3":[{"device_id":"1","status":{"calibrated":false}}]})").find ("not calibrated") != std::string::npos);
    REQUIRE (messages.readInventory (oneArm ("04BA", origin)).empty());
    Inverse3State state { .position = { 7.0, 7.0, 7.0 } };
    CHECK (messages.read (oneArm ("1F2E", origin), state).find ("no longer knows the Inverse3 04BA") != std::string::npos);
    CHECK (messages.read (oneArm ("04BA", "[0,0,0]"), state).find ("where the cursor is") != std::string::npos);
    CHECK (messages.read (oneArm ("04BA", origin) + "}", state).find ("not JSON") != std::string::npos);
    CHECK (state.position == Vec3 (7.0, 7.0, 7.0));
}

TEST_CASE ("every text of the Inverse3 corpus is read or refused", "[haply][wires]") { CHECK (test::replay ("inverse3", fuzz::tryInverse3) > 10); }
