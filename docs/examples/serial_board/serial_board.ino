// SPDX-License-Identifier: MIT
// A board that tells Tactus over a serial line where the hand is, 1000 times a second, and does with its motors what Tactus asks. It has no graph of its
// own, and needs only tactus_serial.h, which is in the same folder. Here, the position comes from three analog sensors, and the force goes to three motor
// drivers. Change readPosition, drive and the numbers above them to what your device has. docs/devices.md of Tactus says what the rest must do.
#include "tactus_serial.h"

const int sensors[] = { A0, A1, A2 }, motors[] = { 3, 5, 6 }, directions[] = { 7, 8, 9 };
const int32_t middle = 2048, nm_per_count = 24414;                                   // 0.1 m in 4096 counts
const int32_t un_per_duty = 20000, most_un = 2000000, most_step_un = 500000;         // what the motors are rated for: 2 N, and 0.5 N per report
const uint32_t report_us = 1000, watchdog_us = 20000;

static tactus_line line;
static uint8_t asked[tactus_report_size], report[tactus_report_size], frame[tactus_frame_size];
static int frame_sent = tactus_frame_size;   // bytes of the frame that the line has taken
static int32_t force_un[3];
static uint32_t last_report, last_heard, number;
static bool is_driven = false, has_timed_out = false;

static void readPosition (int32_t nm[3])
{
    for (int c = 0; c < 3; ++c)
        nm[c] = (analogRead (sensors[c]) - middle) * nm_per_count;
}

static void drive()
{
    for (int c = 0; c < 3; ++c)
    {
        const int32_t duty = force_un[c] / un_per_duty;
        digitalWrite (directions[c], duty < 0 ? LOW : HIGH);
        analogWrite (motors[c], duty < 0 ? -duty : duty);
    }
}

static int32_t between (int32_t low, int32_t value, int32_t high) { return value < low ? low : (value > high ? high : value); }

/// Reads all that has come. The newest report counts. Without one for 20 ms, or if Tactus lets go, the motors are released.
static void listen (uint32_t now)
{
    bool is_new = false;
    while (Serial.available() > 0)
        if (tactus_take (&line, (uint8_t) Serial.read(), report) && tactus_asks (report))
        {
            memcpy (asked, report, sizeof asked);
            is_new = true;
        }
    if (is_new)
    {
        last_heard = now;
        is_driven = (asked[2] & 1) != 0;
        has_timed_out = false;
    }
    else if (is_driven && now - last_heard > watchdog_us)
    {
        is_driven = false;
        has_timed_out = true;
    }
    for (int c = 0; c < 3; ++c)
    {
        const int32_t wanted = between (-most_un, (int32_t) tactus_get (asked, 8 + 4 * c), most_un);
        if (! is_driven) force_un[c] = 0;
        else if (is_new) force_un[c] = between (force_un[c] - most_step_un, wanted, force_un[c] + most_step_un);
    }
}

/// Hands the line as much of the frame as it takes without waiting.
static void sendFrame()
{
    const int left = tactus_frame_size - frame_sent, room = Serial.availableForWrite(), now = room < left ? room : left;
    if (now > 0) frame_sent += (int) Serial.write (frame + frame_sent, (size_t) now);
}

void setup()
{
    analogReadResolution (12);
    for (int c = 0; c < 3; ++c)
    {
        pinMode (motors[c], OUTPUT);
        pinMode (directions[c], OUTPUT);
    }
    drive();
    Serial.begin (2000000);
    last_report = micros();
}

void loop()
{
    const uint32_t now = micros();
    listen (now);
    drive();
    sendFrame();
    if (now - last_report < report_us || frame_sent < tactus_frame_size) return;
    last_report = now;

    int32_t nm[3];
    readPosition (nm);
    memset (report, 0, sizeof report);
    report[0] = 0x54;
    report[1] = 1;
    report[2] = (uint8_t) (1 | (is_driven ? 2 : 0) | (has_timed_out ? 4 : 0));   // 1: analog sensors know the position from power-on
    tactus_put (report, 4, number++);
    tactus_put (report, 8, now);
    for (int c = 0; c < 3; ++c)
        tactus_put (report, 12 + 4 * c, (uint32_t) nm[c]);
    tactus_frame (report, frame);
    frame_sent = 0;
}
