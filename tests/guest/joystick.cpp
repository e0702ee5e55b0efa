// SPDX-License-Identifier: MIT
#include "uhid.hpp"

#include <array>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

namespace tactus::guest
{

namespace
{
volatile std::sig_atomic_t ended = 0;

// OpenFFBoard's reports.
constexpr std::uint8_t place = 0x01, set_force = 0x05, create_effect = 0x11, block_load = 0x12;

struct Log
{
    std::string lines;

    void add (const char* how, std::span<const std::uint8_t> report)
    {
        char text[32];
        std::snprintf (text, sizeof text, "%s,%.6f,", how, now());
        lines += text;
        for (const auto byte : report)
        {
            std::snprintf (text, sizeof text, "%02x", byte);
            lines += text;
        }
        lines += '\n';
    }
};

/// The report at time t: the joystick is held one millimetre deep and rubbed back and forth. Each axis is 12 cm long, and z points
/// downwards.
std::array<std::uint8_t, 25> reportAt (double t)
{
    constexpr double counts = 65535.0 / 0.12;
    std::array<std::uint8_t, 25> r {};
    r[0] = 1;
    const auto put = [&] (std::size_t at, double metres) {
        const auto v = static_cast<int> (std::lround (metres * counts));
        r[at] = static_cast<std::uint8_t> (v);
        r[at + 1] = static_cast<std::uint8_t> (v >> 8);
    };
    put (9, 0.02 * std::sin (6.0 * t));   // x, after 64 buttons
    put (13, 1e-3);                       // z
    return r;
}
}   // namespace

/// A joystick with OpenFFBoard's report descriptor, read from a file. It answers like a real one, and logs everything it receives.
/// --file NAME --log FILE --mark FILE --seconds S --blocks N (effect blocks it assigns; 0: its memory is full) --unplug S
/// (unplugged this long after it was opened) --away S (stays unplugged for this long; comes back with another block) --quiet S (does not
/// move, and sends nothing, from this long after it was opened) --answers 0 (does not say where it is when it is asked)
int joystick (const std::vector<std::string>& args)
{
    std::signal (SIGTERM, [] (int) { ended = 1; });
    std::ifstream file (text (args, "file", ""), std::ios::binary);
    const std::vector<char> bytes { std::istreambuf_iterator<char> (file), {} };
    if (bytes.empty() || bytes.size() > 4096) return 2;   // of the kernel
    const std::vector<std::uint8_t> descriptor (bytes.begin(), bytes.end());

    Log log;
    std::uint8_t block = option (args, "blocks", 1.0) > 0.0 ? 3 : 0;
    bool asked = false;
    const bool answers = option (args, "answers", 1.0) > 0.0;
    std::array<std::uint8_t, 25> latest = reportAt (0.0);
    const auto plug = [&] {
        auto device = std::make_unique<Uhid> ("Test joystick", "J1", std::uint16_t { 0x1209 }, std::uint16_t { 0xffb0 }, descriptor);
        device->answerWith ([&] (std::uint8_t id) -> std::vector<std::uint8_t> {
            if (id == place && answers) return { latest.begin(), latest.end() };
            if (id != block_load || ! asked) return {};
            return { block_load, block, static_cast<std::uint8_t> (block > 0 ? 1 : 2), 0, 0x10 };
        });
        return device;
    };
    Mark mark (args);
    const auto heard = [&] (std::span<const std::uint8_t> report) {
        if (report.size() == 4 && report[0] == set_force && (report[2] | report[3]) != 0) mark.count();
        asked = asked || (! report.empty() && report[0] == create_effect);
        log.add ("out", report);
    };

    auto device = plug();
    const double begin = now(), end = begin + option (args, "seconds", 10.0);
    double unplug = option (args, "unplug", 0.0), quiet = option (args, "quiet", 0.0);
    bool is_quiet = false;
    bool was_open = false;
    double opened = 0.0;
    for (double due = begin; now() < end && ended == 0; due = std::max (due + 2e-3, now() - 8e-3))
    {
        device->serve (due, heard);
        if (device->isOpen() && ! was_open) opened = now();
        was_open = device->isOpen();
        if (unplug > 0.0 && was_open && now() - opened > unplug)
        {
            unplug = 0.0;
            log.add ("unplugged", {});
            device.reset();
            was_open = asked = false;
            block = 7;
            pauseFor (option (args, "away", 0.8));
            device = plug();
            log.add ("plugged", {});
            continue;
        }
        if (was_open && quiet > 0.0 && now() - opened > quiet && ! std::exchange (is_quiet, true)) log.add ("quiet", {});
        if (! was_open || is_quiet) continue;
        latest = reportAt (now() - begin);
        device->input (latest);
    }
    device->serve (now() + 0.05, heard);

    writeLog (args, log.lines);
    return 0;
}

}   // namespace tactus::guest
