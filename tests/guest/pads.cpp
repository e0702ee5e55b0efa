// SPDX-License-Identifier: MIT
// A pad that a driver of the kernel drives: what it gets when it rumbles.
#include "uhid.hpp"

#include <csignal>

namespace tactus::guest
{

namespace
{
volatile std::sig_atomic_t ended = 0;

// A vendor's page with one input and one output report of some ids and lengths. The kernel's drivers know the layouts by heart.
std::vector<std::uint8_t> descriptorOf (std::uint8_t input, std::uint8_t input_length, std::uint8_t output, std::uint8_t output_length)
{
    return { 0x06, 0x00, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x75, 0x08, 0x15, 0x00, 0x26, 0xff, 0x00, 0x85, input, 0x95,
             input_length, 0x09, 0x02, 0x81, 0x02, 0x85, output, 0x95, output_length, 0x09, 0x03, 0x91, 0x02, 0xc0 };
}

struct Log
{
    std::string lines;

    void add (std::span<const std::uint8_t> report)
    {
        char text[32];
        std::snprintf (text, sizeof text, "out,%.6f,", now());
        lines += text;
        for (const auto byte : report)
        {
            std::snprintf (text, sizeof text, "%02x", byte);
            lines += text;
        }
        lines += '\n';
    }
};

void put16 (std::vector<std::uint8_t>& to, std::size_t at, int value)
{
    to[at] = static_cast<std::uint8_t> (value);
    to[at + 1] = static_cast<std::uint8_t> (value >> 8);
}

/// The feature reports that hid-playstation asks a DualSense for: calibration, address, firmware.
std::vector<std::uint8_t> featureOfDualSense (std::uint8_t id)
{
    if (id == 0x05)
    {
        std::vector<std::uint8_t> report (41, 0);
        for (std::size_t at = 7; at < 35; at += 2)
            put16 (report, at, at / 2 % 2 != 0 ? 8192 : -8192);   // a range that is not empty
        report[0] = id;
        return report;
    }
    if (id == 0x09) return { id, 1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    if (id == 0x20)
    {
        std::vector<std::uint8_t> report (64, 0);
        report[0] = id;
        return report;
    }
    return {};
}
}   // namespace

/// A DualSense at USB: --seconds S --log FILE
int dualSense (const std::vector<std::string>& args)
{
    std::signal (SIGTERM, [] (int) { ended = 1; });
    Log log;
    Uhid device ("Test DualSense", "01:02:03:04:05:06", 0x054c, 0x0ce6, descriptorOf (1, 63, 2, 47));
    device.on_ask = featureOfDualSense;
    const auto heard = [&] (std::span<const std::uint8_t> report) { log.add (report); };
    const double end = now() + option (args, "seconds", 10.0);
    std::array<std::uint8_t, 64> report {};
    report[0] = 1;
    for (double due = now(); now() < end && ended == 0; due += 4e-3)
    {
        device.serve (due, heard);
        ++report[1];     // the left stick moves
        report[8] = 8;   // nothing is pressed
        device.input (report);
    }
    device.serve (now() + 0.05, heard);
    writeLog (args, log.lines);
    return 0;
}

}   // namespace tactus::guest
