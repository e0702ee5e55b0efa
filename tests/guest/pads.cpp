// SPDX-License-Identifier: MIT
// Pads that drivers of the kernel drive: what they get when they rumble.
#include "uhid.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <initializer_list>

namespace tactus::guest
{

namespace
{
volatile std::sig_atomic_t ended = 0;

/// The kernel's drivers know the layouts by heart, but the kernel passes on only reports that the descriptor has.
host::hid::Bytes descriptorOf (std::initializer_list<host::hid::ReportSize> reports) { return host::hid::describeReports (0xff00, 1, reports); }

using Kind = host::hid::DescribedField::Kind;
constexpr auto in = Kind::input, out = Kind::output;

/// Reports that a pad got. The file --mark is there while the pad rests after it has rumbled, so a script need not guess how long
/// the kernel takes for its last report.
struct Log
{
    explicit Log (const std::vector<std::string>& args) : mark (text (args, "mark", "")) {}

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

    void rumble (bool strength)
    {
        if (strength == rumbles || mark.empty()) return;
        rumbles = strength;
        if (rumbles)
            std::remove (mark.c_str());
        else if (auto* file = std::fopen (mark.c_str(), "w"))
            std::fclose (file);
    }

private:
    std::string mark;
    bool rumbles = false;
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

/// Whether both sides of a Switch controller rest. It gets zeros before its driver knows how to rumble it.
bool isNeutral (std::span<const std::uint8_t> sides)
{
    constexpr std::array<std::uint8_t, 8> neutral { 0, 1, 0x40, 0x40, 0, 1, 0x40, 0x40 };
    return std::ranges::equal (sides, neutral) || std::ranges::all_of (sides, [] (auto byte) { return byte == 0; });
}
}   // namespace

/// A DualSense at USB: --seconds S --log FILE --mark FILE
int dualSense (const std::vector<std::string>& args)
{
    std::signal (SIGTERM, [] (int) { ended = 1; });
    Log log (args);
    Uhid device ("Test DualSense", "01:02:03:04:05:06", 0x054c, 0x0ce6, descriptorOf ({ { in, 1, 63 }, { out, 2, 47 } }));
    device.answerWith (featureOfDualSense);
    const auto heard = [&] (std::span<const std::uint8_t> r) {
        log.add (r);
        if (r.size() > 4 && r[0] == 0x02 && (r[1] & 0x03) != 0) log.rumble ((r[3] | r[4]) != 0);
    };
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

/// A Switch Pro controller at USB, which answers commands and subcommands: --seconds S --log FILE --mark FILE
int switchPro (const std::vector<std::string>& args)
{
    std::signal (SIGTERM, [] (int) { ended = 1; });
    Log log (args);
    const auto descriptor = descriptorOf ({ { in, 0x21, 48 }, { in, 0x30, 48 }, { in, 0x81, 63 }, { out, 0x01, 48 }, { out, 0x10, 48 }, { out, 0x80, 63 } });
    Uhid device ("Test Pro Controller", "11:12:13:14:15:16", 0x057e, 0x2009, descriptor);
    std::array<std::uint8_t, 64> report {};
    const auto state = [&] (std::uint8_t id) {
        report = {};
        report[0] = id;
        report[2] = 0x8e;   // battery and connection
        // Both sticks in the middle: two numbers of 12 bits each.
        for (const std::size_t at : { 6u, 9u })
        {
            report[at] = 0x00;
            report[at + 1] = 0x08;
            report[at + 2] = 0x80;
        }
    };
    const auto send = [&] (std::size_t size) { device.input (std::span (report).first (size)); };
    const auto heard = [&] (std::span<const std::uint8_t> r) {
        log.add (r);
        if (r.size() >= 10 && (r[0] == 0x01 || r[0] == 0x10)) log.rumble (! isNeutral (r.subspan (2, 8)));
        if (r.size() >= 2 && r[0] == 0x80)   // a command of USB, such as the handshake
        {
            report = {};
            report[0] = 0x81;
            report[1] = r[1];
            send (64);
        }
        if (r.size() < 11 || r[0] != 0x01) return;   // no subcommand
        state (0x21);
        report[13] = 0x80;    // done
        report[14] = r[10];   // the subcommand
        if (r[10] == 0x02)    // asks what it is
        {
            report[17] = 3;   // a Pro controller
            for (std::uint8_t i = 0; i < 6; ++i)
                report[19 + i] = static_cast<std::uint8_t> (0x11 + i);
        }
        if (r[10] == 0x10 && r.size() >= 16)   // reads its flash: where, how much, what is there
        {
            report[13] = 0x90;
            std::copy_n (r.begin() + 11, 5, report.begin() + 15);
            std::fill (report.begin() + 20, report.begin() + 49, std::uint8_t { 0xff });   // empty, so the kernel uses its defaults
            // The scales of its accelerometer and of its gyroscope, after their offsets of 0.
            if (r[11] == 0x20 && r[12] == 0x60)
                for (std::size_t i = 0; i < 24; ++i)
                    report[20 + i] = i / 6 % 2 != 0 && i % 2 != 0 ? 0x40 : 0;
        }
        send (49);
    };
    const double end = now() + option (args, "seconds", 10.0);
    std::uint8_t moves = 0;
    for (double due = now(); now() < end && ended == 0; due += 15e-3)
    {
        device.serve (due, heard);
        state (0x30);
        report[1] = ++moves;
        report[7] = static_cast<std::uint8_t> (0x08 ^ (moves & 0x01));
        send (49);
    }
    device.serve (now() + 0.05, heard);
    writeLog (args, log.lines);
    return 0;
}

}   // namespace tactus::guest
