// SPDX-License-Identifier: MIT
#include "arduino_code.hpp"
#include <host/code/generate/sources/single_precision.hpp>
#include <host/code/generate/sources/sources.hpp>

namespace tactus::host
{

namespace
{
constexpr const char* properties = R"(name=@C@
version=1.0.0
author=@TOOL@
maintainer=@TOOL@
sentence=A haptic graph of Tactus: @NAME@
paragraph=@ABOUT@
category=Signal Input/Output
url=
architectures=*
includes=@S@.hpp
depends=Eigen
)";

constexpr const char* brake_numbers = R"(
// The brake of the device, whose damping is at least 0. Tactus cannot drive it: reports of Tactus ask for none.
const int brake = 10;
const double counts_per_damping = 12;   // per N s/m
)";

constexpr const char* drive_brake = R"(    const double braking = effort.brake * counts_per_damping;
    analogWrite (brake, static_cast<int> (braking < 255 ? braking : 255));
)";

constexpr const char* sketch = R"(// SPDX-License-Identifier: MIT
// The board plays the graph by itself, at the rate of the patch. 1000 times a second it reports to Tactus. From the first report of Tactus on,
// Tactus alone drives the motors. When Tactus lets go, or is silent for 20 ms, the board rests, until Tactus drives it again, the
// arm button is pressed while Tactus is silent, or the board is reset. Then the board plays the graph again. All forces pass the guard of
// the graph. Here the position comes from three analog sensors, the force goes to three motor drivers, and the arm button connects its pin to
// ground. Change readPosition, drive and the numbers above them to what your device has, and the limits in setup to what its motors are
// rated for. The limits of the patch hold as well.
#include <@S@.hpp>
#include <tactus_board.hpp>

// 0: reports go over USB, by the RawHID of a Teensy. 1: over a serial line, of any board.
#ifndef OVER_SERIAL
#define OVER_SERIAL 0
#endif

static @C@ graph;
static @C@::Inputs in;
static @C@::Outputs out;

const uint32_t period_us = @PERIOD@, report_us = 1000;
const int sensors[] = { A0, A1, A2 }, motors[] = { 3, 5, 6 }, directions[] = { 7, 8, 9 }, arm_button = 2;
const int middle = 2048;
const tactus::Fine metres_per_count = 0.1 / 4096;
const double counts_per_newton = 50;
@BRAKE@
static tactus::Position readPosition()
{
    tactus::Position p;
    for (int c = 0; c < 3; ++c)
        p[c] = (analogRead (sensors[c]) - middle) * metres_per_count;
    return p;
}

static void drive (const tactus::Effort& effort)
{
    for (int c = 0; c < 3; ++c)
    {
        const double duty = effort.force[c] * counts_per_newton;
        digitalWrite (directions[c], duty < 0 ? LOW : HIGH);
        analogWrite (motors[c], static_cast<int> (duty < 0 ? (duty > -255 ? -duty : 255) : (duty < 255 ? duty : 255)));
    }
@DRIVE_BRAKE@}

static tactus::board::Authority authority (graph.@ROLE@);
static tactus::board::State state;
static uint32_t last_tick, last_report;

void setup()
{
    analogReadResolution (12);
    for (int c = 0; c < 3; ++c)
    {
        pinMode (motors[c], OUTPUT);
        pinMode (directions[c], OUTPUT);
    }
@SETUP_BRAKE@    pinMode (arm_button, INPUT_PULLUP);
    graph.@ROLE@.tighten ({ .max_force = 3.0, .max_slew = 500.0, .ramp = 0.5 });   // N, N/s, and s until the full force
    graph.prepare (1e6 / period_us);
    state.is_homed = true;   // analog sensors know the position from power-on
#if OVER_SERIAL
    Serial.begin (2000000);
#endif
    last_tick = last_report = micros();
}

#if OVER_SERIAL
#include <tactus_serial.h>

static tactus_line line;
static uint8_t frame[tactus_frame_size];
static int frame_sent = tactus_frame_size;   // bytes of the frame that the line has taken

static bool receive (tactus::board::Report& report)
{
    while (Serial.available() > 0)
        if (tactus_take (&line, static_cast<uint8_t> (Serial.read()), report.data()) != 0) return true;
    return false;
}

/// Hands the line as much of the frame as it takes without waiting.
static void sendFrame()
{
    const int left = tactus_frame_size - frame_sent, room = Serial.availableForWrite(), now = room < left ? room : left;
    if (now > 0) frame_sent += static_cast<int> (Serial.write (frame + frame_sent, static_cast<size_t> (now)));
}

static bool send (const tactus::board::Report& report)
{
    if (frame_sent < tactus_frame_size) return false;
    tactus_frame (report.data(), frame);
    frame_sent = 0;
    return true;
}
#else
static bool receive (tactus::board::Report& report)
{
    for (int size; (size = RawHID.recv (report.data(), 0)) > 0;)
        if (size == static_cast<int> (report.size())) return true;
    return false;
}

static void sendFrame() {}
static bool send (const tactus::board::Report& report) { return RawHID.send (report.data(), 0) > 0; }
#endif

/// Reads all waiting reports. The newest counts.
static void listen (uint32_t now)
{
    tactus::board::Report report;
    while (receive (report))
        authority.hear (report, now);
}

void loop()
{
    sendFrame();
    // Never faster than the rate of the patch: what is late is lost, not caught up.
    const uint32_t now = micros(), passed = now - last_tick;
    if (passed < period_us) return;
    last_tick = now;
    graph.loseTime ((passed - period_us) * 1e-6);

    listen (now);
    authority.decide (now, digitalRead (arm_button) == LOW);
    in.@PORT@.position = readPosition();
    graph.tick (in, out);
    drive (out.@PORT@);

    if (now - last_report < report_us) return;
    last_report = now;
    state.us = now;
    state.is_driven = authority.isDriven();
    state.is_released = authority.hasTimedOut();
    if (send (tactus::board::reportOf (in.@PORT@, state))) ++state.number;
}
)";
}   // namespace

std::vector<std::pair<std::string, std::string>> arduinoFiles (const Exported& e)
{
    const auto period = static_cast<long> (1e6 / e.wiring.plan.rateHz() + 0.999999);
    const bool brakes = e.roles.front().layout.brake > 0.0;
    const auto ifBraked = [brakes] (const char* text) { return std::string (brakes ? text : ""); };
    const std::vector<std::pair<std::string, std::string>> marks { { "@C@", e.class_name },
                                                                   { "@S@", e.stem },
                                                                   { "@TOOL@", e.program },
                                                                   { "@NAME@", comment (e.graph.name.empty() ? e.stem : e.graph.name) },
                                                                   { "@ABOUT@", comment (e.graph.about) },
                                                                   { "@PERIOD@", std::to_string (period) },
                                                                   { "@ROLE@", e.wiring.role_names.front() },
                                                                   { "@PORT@", e.wiring.role_ports.front() },
                                                                   { "@BRAKE@", ifBraked (brake_numbers) },
                                                                   { "@SETUP_BRAKE@", ifBraked ("    pinMode (brake, OUTPUT);\n") },
                                                                   { "@DRIVE_BRAKE@", ifBraked (drive_brake) } };
    const auto code = [&e] (const std::string& text) { return e.is_single ? inSinglePrecision (text) : text; };
    return { { "library.properties", filled (properties, marks) },
             { "src/tactus_board.hpp", code (std::string (findSource ("host/code/generate/targets/tactus_board.hpp")->text)) },
             { "src/tactus_serial.h", std::string (findSource ("docs/examples/serial_board/tactus_serial.h")->text) },
             { "examples/Board/Board.ino", code (filled (sketch, marks)) } };
}

}   // namespace tactus::host
