// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string_view>

namespace tactus::host
{

/// An event after which a live run may push harder than before, and who may cause it. Whatever the cause, the guard and the limits of the
/// device come after it, and a force that returns begins at zero.
struct ForceCause
{
    std::string_view event;   ///< of an OSC message, its address; an address that ends in / stands for all that begin with it
    std::string_view who;     ///< who may cause it
    std::string_view after;   ///< the stops after which it works
    std::string_view code;    ///< the file and the function where it enters a run
    std::string_view test;    ///< tries what `who` and `after` exclude
};

/// All of them. docs/hazards.md shows this table (tests/docs/hazards.py), and RemoteControl asks for the token of a run by it. A stop is a
/// person's if it comes from a key, a click, a button or pad, or Ctrl-C. "No stop" means that a stop stays in place.
inline constexpr ForceCause force_causes[] = {
    { "START in the window", "a person", "every stop, but not within 1 s of an emergency stop", "host/app/run/live_run.cpp: LiveRun::start",
      "latched_stop_test" },
    { "another hand is chosen in the window, and moves the tool", "a person", "every stop but a latched one",
      "host/app/run/live_run.cpp: LiveRun::moveBy", "live_run_test" },
    { "`tactus play` begins", "the person who enters the command", "does not apply: a run begins", "host/cli/play/play.cpp: Playing",
      "emergency_test" },
    { "REARM in the window, R in the terminal of `play`", "a person", "every stop, but not within 1 s of an emergency stop or of a rearm",
      "host/devices/live/live_session.cpp: LiveSession::rearm", "stop_switch_test" },
    { "a graph or preset is opened in the window", "a person",
      "every stop of a simulated hand but a latched one; with a device of the session, none of a person", "host/app/window/beginnings.cpp: Beginnings::run",
      "hand_test" },
    { "an edit, undo or snapshot in the window", "a person", "no stop", "host/app/run/live_run.cpp: LiveRun::takeOver", "live_run_test" },
    { "live C++: the source of a node is saved", "who may write the file", "no stop", "host/app/run/live_run.cpp: LiveRun::takeOver",
      "live_nodes_test" },
    { "`/tactus/start`", "a program of this machine; with a real device, one with the token",
      "a program's stop, or the run's own end; never a latched stop", "host/app/run/osc_server.cpp: OscServer::start", "osc_server_test" },
    { "`/tactus/rearm`", "a program of this machine with the token", "a program's emergency stop, or a limit; not within 1 s of either",
      "host/devices/osc/remote_control.cpp: RemoteControl::rearm", "remote_control_test" },
    { "`/tactus/param`", "a program; with a real device, one with the token", "no stop", "host/devices/osc/remote_control.cpp: RemoteControl::turn",
      "remote_control_test" },
    { "`/tactus/control`", "a program; with a real device, one with the token", "no stop", "host/devices/osc/remote_control.cpp: RemoteControl::turn",
      "remote_control_test" },
    { "`/tactus/hit`", "a program; with a real device, one with the token", "no stop", "host/devices/osc/remote_control.cpp: RemoteControl::carryOut",
      "remote_control_test" },
    { "`/tactus/transport/`", "a program; with a real device, one with the token", "no stop",
      "host/devices/osc/remote_control.cpp: RemoteControl::transport", "remote_control_test" },
    { "`tactus_session_start`, `Session.start`", "the program that opened the session", "does not apply: a run begins",
      "host/devices/live/c_session.cpp: tactus_session_start", "c_session_test" },
    { "`tactus_session_rearm`, `Session.rearm`", "the program that opened the session",
      "every stop, but not within 1 s of an emergency stop or of a rearm", "host/devices/live/c_session.cpp: tactus_session_rearm",
      "c_session_test" },
    { "`tactus_session_set`, `_turn`, `_hit`, `_edit`, and the same in Python", "the program that opened the session", "no stop",
      "host/devices/live/c_session.cpp: tactus_session_edit", "c_session_test" },
    { "a device comes back", "the device", "a stop `stale`; no latched stop", "host/devices/sessions/awaited_device.cpp: AwaitedDevice::poll",
      "awaited_device_test" },
    { "readings are valid again", "the device", "a stop `stale`; no latched stop", "framework/run/guard.cpp: Guard::operator()", "fault_table_test" },
    { "the graph itself: its sources, gestures, sound, and the readings of other devices", "the graph", "no stop",
      "framework/run/engine.cpp: Engine::afterPlan", "guard_motion_test" },
    { "exported code: `rearm`, `setControl`, `strike`", "the program that contains it", "for `rearm`, every stop; otherwise no stop",
      "host/code/generate/class/class_code.cpp: setControl", "export_test" },
    { "an exported board: its arm button, and a host that drives it", "a person at the board; the host",
      "for the button, every stop; for the host, no latched stop", "host/code/generate/targets/arduino_code.cpp: arduinoFiles",
      "export_targets_test" },
};

/// True if an OSC message with this address can raise a force.
constexpr bool raisesForce (std::string_view address) noexcept
{
    return std::ranges::any_of (force_causes, [&] (const ForceCause& cause) {
        if (! cause.event.starts_with ("`/")) return false;
        const auto listed = cause.event.substr (1, cause.event.size() - 2);
        return listed.ends_with ('/') ? address.starts_with (listed) : address == listed;
    });
}

}   // namespace tactus::host
