// SPDX-License-Identifier: MIT
// A board that uses the reports of host/devices/profiles/tactus_board.json and can misbehave on request.
#include "gadget.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <memory>
#include <random>

namespace tactus::guest
{

namespace
{
using Report = std::array<std::uint8_t, 64>;

// Vendor page 0xffab, usage 0x0200: 64 bytes each way, no report id.
constexpr std::uint8_t descriptor[] { 0x06, 0xab, 0xff, 0x0a, 0x00, 0x02, 0xa1, 0x01, 0x75, 0x08, 0x15, 0x00, 0x26, 0xff, 0x00,
                                      0x95, 0x40, 0x09, 0x01, 0x81, 0x02, 0x95, 0x40, 0x09, 0x02, 0x91, 0x02, 0xc0 };

volatile std::sig_atomic_t ended = 0;

void put32 (Report& r, std::size_t at, std::uint32_t v)
{
    for (std::size_t i = 0; i < 4; ++i)
        r[at + i] = static_cast<std::uint8_t> (v >> (8 * i));
}

std::int32_t get32 (std::span<const std::uint8_t> r, std::size_t at)
{
    std::uint32_t v = 0;
    for (std::size_t i = 0; i < 4; ++i)
        v |= static_cast<std::uint32_t> (r[at + i]) << (8 * i);
    return static_cast<std::int32_t> (v);
}

/// CRC-32 of IEEE 802.3, bit by bit.
std::uint32_t crcOf (std::span<const std::uint8_t> bytes)
{
    std::uint32_t crc = 0xffffffff;
    for (const auto byte : bytes)
    {
        crc ^= byte;
        for (int i = 0; i < 8; ++i)
            crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

/// The position in report n, in nm: the tool is pressed into the wood and rubbed back and forth.
std::array<std::int32_t, 3> placeAt (std::uint32_t n)
{
    const double t = 1e-3 * n;
    const double depth = 1e6 * std::min (1.0, 4.0 * t) * (1.0 + 0.2 * std::sin (9.0 * t));
    return { static_cast<std::int32_t> (2e7 * std::sin (6.0 * t)), static_cast<std::int32_t> (5e6 * std::sin (1.3 * t)), static_cast<std::int32_t> (-depth) };
}

Report reportOf (std::uint32_t n, bool is_driven)
{
    Report r {};
    r[0] = 0x54;
    r[1] = 1;
    r[2] = is_driven ? 3 : 1;   // homed, motors driven
    put32 (r, 4, n);
    put32 (r, 8, 1000 * n);
    const auto place = placeAt (n);
    for (std::size_t i = 0; i < 3; ++i)
        put32 (r, 12 + 4 * i, static_cast<std::uint32_t> (place[i]));
    return r;
}

/// The log, kept in memory until the end so that file access causes no delays.
struct Log
{
    std::string lines;
    bool is_driven = false;   // as the latest report to the board asked

    void sent (const char* how, std::uint32_t n)
    {
        const auto p = placeAt (n);
        char line[96];
        std::snprintf (line, sizeof line, "in,%s,%u,%d,%d,%d\n", how, n, p[0], p[1], p[2]);
        lines += line;
    }

    /// Returns true if the report contains a force.
    bool got (std::span<const std::uint8_t> report)
    {
        // Some kernels prepend a 0 in place of the missing report id.
        if (report.size() == 65) report = report.subspan (1);
        if (report.size() != 64)
        {
            lines += "out,size\n";
            return false;
        }
        const bool good_sum = static_cast<std::uint32_t> (get32 (report, 60)) == crcOf (report.first (60));
        const bool neutral = std::all_of (report.begin() + 2, report.begin() + 60, [] (auto b) { return b == 0; });
        const bool driven = (report[2] & 1) != 0;
        is_driven = driven && good_sum;
        const char* kind = driven ? "driven" : "other";
        if (neutral) kind = "neutral";
        if (! good_sum && ! neutral) kind = "sum";
        char line[128];
        std::snprintf (line, sizeof line, "out,%s,%u,%d,%d,%d,%.6f\n", kind, static_cast<std::uint32_t> (get32 (report, 4)), get32 (report, 8),
                       get32 (report, 12), get32 (report, 16), now());
        lines += line;
        return good_sum && driven && get32 (report, 8) != 0;
    }

    void mark (const char* what)
    {
        char line[64];
        std::snprintf (line, sizeof line, "%s,%.6f\n", what, now());
        lines += line;
    }
};

/// Sends report n, with the faults that `args` request for it. Returns how many further reports it sent.
std::uint32_t sendReport (VirtualDevice& device, Log& log, const std::vector<std::string>& args, std::uint32_t n)
{
    const auto every = [&] (const char* name) {
        const auto each = static_cast<std::uint32_t> (option (args, name, 0.0));
        return each > 0 && n % each == each - 1;
    };
    auto r = reportOf (n, log.is_driven);
    if (every ("drop"))
        log.sent ("dropped", n);
    else if (every ("malformed"))
    {
        r[0] = 0x55;
        device.input (r);
        log.sent ("malformed", n);
    }
    else if (every ("short"))
    {
        device.input (std::span (r).first (20));
        log.sent ("short", n);
    }
    else if (every ("oversized"))
    {
        std::array<std::uint8_t, 200> large {};
        std::copy (r.begin(), r.end(), large.begin());
        device.input (large);
        log.sent ("oversized", n);
    }
    else if (every ("swap"))
    {
        device.input (reportOf (n + 1, log.is_driven));
        log.sent ("good", n + 1);
        device.input (r);
        log.sent ("good", n);
        return 1;
    }
    else
        log.sent (device.input (r) ? "good" : "dropped", n);
    return 0;
}
}   // namespace

/// --seconds S, --rate HZ, --log FILE, --serial TEXT, --wait 1 (silent until it receives a report), --mark FILE (created
/// after 200 forces), --gadget FILE (the device end of an existing USB gadget, instead of uhid), --describe 1 (only prints its
/// report descriptor to stdout); every N reports: --drop, --malformed, --short, --oversized, --swap; once, after N reports:
/// --stall (100 ms), --unplug (away for --away S).
int board (const std::vector<std::string>& args)
{
    std::signal (SIGTERM, [] (int) { ended = 1; });
    const double seconds = option (args, "seconds", 10.0), period = 1.0 / option (args, "rate", 1000.0);
    const auto stall_at = static_cast<std::uint32_t> (option (args, "stall", 0.0)), unplug_at = static_cast<std::uint32_t> (option (args, "unplug", 0.0));
    const auto serial = text (args, "serial", "B7");

    if (option (args, "describe", 0.0) > 0.0) return std::fwrite (descriptor, 1, sizeof descriptor, stdout) == sizeof descriptor ? 0 : 1;

    Log log;
    const auto gadget = text (args, "gadget", "");
    const auto plug = [&]() -> std::unique_ptr<VirtualDevice> {
        if (! gadget.empty()) return std::make_unique<Gadget> (gadget.c_str());
        return std::make_unique<Uhid> ("Tactus test board", serial.c_str(), std::uint16_t { 0x16c0 }, std::uint16_t { 0x0486 }, descriptor);
    };
    const bool waits = option (args, "wait", 0.0) > 0.0;
    bool told = false;
    Mark mark (args);
    const auto heard = [&] (std::span<const std::uint8_t> r) {
        told = true;
        if (log.got (r)) mark.count();
    };

    auto device = plug();
    const double end = now() + seconds;
    std::uint32_t n = 0;
    double due = now();
    bool was_open = false;
    while (now() < end && ended == 0)
    {
        device->serve (due, heard);
        due = std::max (due + period, now() - 4.0 * period);   // the board does not catch up on larger delays
        if (device->isOpen() != was_open) log.mark (was_open ? "closed" : "opened");
        was_open = device->isOpen();
        if (! was_open || (waits && ! told)) continue;

        ++n;
        if (n == stall_at) device->serve (now() + 0.1, heard);
        if (n == unplug_at)
        {
            log.mark ("unplugged");
            log.is_driven = false;
            device.reset();
            was_open = false;
            pauseFor (option (args, "away", 1.0));
            device = plug();
            log.mark ("plugged");
            due = now();
            continue;
        }
        n += sendReport (*device, log, args, n);
    }
    device->serve (now() + 0.05, heard);

    writeLog (args, log.lines);
    return 0;
}

}   // namespace tactus::guest
