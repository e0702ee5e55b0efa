// SPDX-License-Identifier: MIT
// Signals for vibration motors: blocks of samples, or an amplitude and a frequency.

#include "fake_board.hpp"
#include "host/devices/hid/hid.hpp"
#include "support/no_allocation.hpp"

#include <support/property.hpp>

#include <host/devices/hid/report/crc32.hpp>
#include <host/devices/hid/vibration_tracker.hpp>
#include <host/devices/hid_link/stream_feed.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;
using namespace tactus::host::hid;
using test::eventually;
using test::FakeBoard;

namespace
{
std::unique_ptr<HidDevice> open (FakeBoard& board, const char* profile, double dt_s)
{
    auto opened = HidPort::open (board, board.what, test::profileOf (profile), { .look_again = std::chrono::milliseconds (5), .real_time = false });
    REQUIRE (opened);
    auto device = std::make_unique<HidDevice> (std::move (*opened));
    device->prepare (dt_s);
    return device;
}

/// All output reports with this id sent so far.
std::vector<test::Bytes> sent (const FakeBoard& board, std::uint8_t id)
{
    std::vector<test::Bytes> reports;
    for (const auto& t : board.told())
        if (t.how == test::Told::How::output && t.bytes.at (0) == id) reports.push_back (t.bytes);
    return reports;
}

void tick (HidDevice& device, const Channels& signals)
{
    device.read();
    device.write ({ .signals = signals });
}
}   // namespace

TEST_CASE ("a stream gets its frames at its own rate, interpolated linearly between ticks", "[hid]")
{
    test::property ("any two rates", [] {
        const double rate = *rc::gen::inRange (100, 9000), dt = 1.0 / *rc::gen::inRange (100, 9000);
        const auto frames = *rc::gen::inRange<std::size_t> (1, 40);
        StreamFeed feed ({ .at = 0, .frames = frames, .rate = rate, .channels = { "a", "b" }, .is_signed = true, .bits = 8 }, 1);
        feed.prepare (dt);
        std::vector<double> got;
        const int ticks = 500;
        for (int k = 1; k <= ticks; ++k)
            feed.tick ({ 9.0, k * dt, -2.0 * k * dt }, [&] (std::span<const float> block) {
                RC_ASSERT (block.size() == 2 * frames);
                for (std::size_t i = 0; i < frames; ++i)
                {
                    got.push_back (static_cast<double> (block[2 * i]));
                    RC_ASSERT (std::abs (static_cast<double> (block[2 * i + 1]) + 2.0 * got.back()) < 1e-5);
                }
            });
        for (std::size_t i = 0; i < got.size(); ++i)
            RC_ASSERT (std::abs (got[i] - static_cast<double> (i + 1) / rate) < 1e-5);   // the signal rises by 1 per s
        RC_ASSERT (std::abs (static_cast<double> (got.size()) - ticks * dt * rate) <= static_cast<double> (frames) + 1.0);
    });
}

TEST_CASE ("the amplitude and frequency of a tone are found at any rate", "[hid]")
{
    test::property ("any tone", [] {
        const double hertz = *rc::gen::inRange (41, 600), dt = 1.0 / *rc::gen::inRange (4000, 10000), loud = *rc::gen::inRange (1, 100) * 0.01;
        VibrationTracker tracker;
        tracker.prepare (dt, 12.5e-3);
        for (int k = 0; k < 2000; ++k)
            tracker.tick (loud * std::sin (2.0 * std::numbers::pi * hertz * k * dt));
        RC_ASSERT (tracker.amplitude() <= loud);
        RC_ASSERT (tracker.amplitude() > 0.88 * loud);
        RC_ASSERT (std::abs (tracker.frequency() - hertz) < 0.05 * hertz);
        for (int k = 0; k < 2000; ++k)
            tracker.tick (0.0);
        RC_ASSERT (tracker.amplitude() == 0.0);
        RC_ASSERT (tracker.frequency() == 0.0);
    });
}

TEST_CASE ("a DualSense gets samples over Bluetooth, with a counter and a checksum", "[hid]")
{
    FakeBoard pad;
    const auto device = open (pad, "dualsense_bluetooth_samples", 1.0 / 3000.0);
    CHECK (device->layout().signal_outputs == 2);
    const auto reports = [&] { return sent (pad, 0x32); };
    // If the machine pauses for longer than the watchdog, the port sends neutral reports in between, and more ticks are needed.
    const auto isSent = [&] (const Channels& signals, const char* frame) {
        return eventually ([&] {
            tick (*device, {});
            for (int k = 0; k < 63; ++k)
                tick (*device, signals);
            const auto all = reports();
            if (all.empty()) return false;
            const auto& report = all.back();
            test::Bytes expected = test::bytes ("32 00 91 07 fe 00 00 00 00 ff 00 92 40");
            expected[10] = report.at (10);
            expected[1] = static_cast<std::uint8_t> (report[10] << 4);
            for (int i = 0; i < 32; ++i)
                for (const auto byte : test::bytes (frame))
                    expected.push_back (byte);
            expected.resize (138);
            const auto sum = crc32 (std::span (report).first (138), crc32 (test::bytes ("a2")));
            for (std::size_t i = 0; i < 4; ++i)
                expected.push_back (static_cast<std::uint8_t> (sum >> (8 * i)));
            return report == expected;
        });
    };
    tick (*device, {});
    // Computed manually: 0.5 of 127 is 64, -0.25 is -32; values out of range are clipped.
    CHECK (isSent ({}, "00 00"));
    CHECK (isSent ({ 0.5, -0.25 }, "40 e0"));
    CHECK (isSent ({ 2.0, -2.0 }, "7f 81"));
    CHECK (reports().back().at (10) >= 2);   // each report is counted
}

TEST_CASE ("rumble motors get the amplitude of their signal, and HD rumble motors its frequency too", "[hid]")
{
    const auto vibrates = [] (const char* profile, std::uint8_t id, auto&& matches) {
        FakeBoard pad;
        const auto device = open (pad, profile, 1e-3);
        tick (*device, {});
        int k = 0;
        CHECK (eventually ([&] {
            for (int i = 0; i < 20; ++i, ++k)
                tick (*device, { 0.5 * std::sin (2.0 * std::numbers::pi * 100.0 * 1e-3 * k) });
            if (k % 200 == 0) tick (*device, {});   // if the machine stalled, the port sent neutral reports; a tick without signals lets the output start again
            const auto reports = sent (pad, id);
            return ! reports.empty() && matches (reports.back());
        }));
        tick (*device, {});
        return device->layout().signal_outputs;
    };
    // 0.5 of 255 is 128; a sine of 100 Hz at 1 kHz has its largest samples at 0.951.
    CHECK (vibrates ("dualsense_usb", 0x02,
                     [] (const test::Bytes& r) { return r[4] == std::lround (0.5 * std::sin (0.4 * std::numbers::pi) * 255.0) && r[3] == 0; })
           == 2);
    // 100 Hz: round (32 log2 (100/10)) - 0x40 = 106 - 64 = 42 in the low band of the left motor.
    CHECK (vibrates ("switch_controllers", 0x10,
                     [] (const test::Bytes& r) { return (r[4] & 0x7f) == 42 && r[5] > 0x40 && r[5] <= 0x72 && (r[6] << 8 | r[7]) == 0x0001; })
           == 4);
}

TEST_CASE ("a stop of a rumble motor takes no longer than the fade of the guard", "[hid]")
{
    FakeBoard pad;
    const auto device = open (pad, "dualsense_usb", 1e-3);
    const auto amplitudeOf = [&] (double signal, bool is_stopping) {
        device->read();
        if (is_stopping) device->withhold();
        device->write ({ .signals = { signal } });
        const auto& e = device->effortsNow();
        return *std::ranges::max_element (e);
    };
    amplitudeOf (0.0, false);
    for (int k = 0; k < 100; ++k)
        amplitudeOf (std::sin (2.0 * std::numbers::pi * 100.0 * 1e-3 * k), false);
    double before = amplitudeOf (1.0, false);
    CHECK (before == 1.0);
    for (int k = 1; k <= 5; ++k)
    {
        const double left = 1.0 - k / 5.0;
        const double now = amplitudeOf (left, true);   // as Guard::crossfade does
        CHECK (now == Approx (left).margin (1e-15));
        CHECK (now < before);
        before = now;
    }
    CHECK (before == 0.0);
}

TEST_CASE ("max_signal also limits a rumble motor that the graph drives as an effort", "[hid]")
{
    FakeBoard pad;
    const auto device = open (pad, "dualsense_usb", 1e-3);
    device->limitSignals (0.25, GuardLimits::none);
    const auto efforts = device->layout().efforts;
    const auto at = std::ranges::find (efforts, "rumble_left") - efforts.begin();
    REQUIRE (at < std::ssize (efforts));
    Effort both { .signals = { 0.25, 0.25 } };
    both.axes.set (static_cast<int> (at), 1.0);
    device->read();
    device->write ({});
    for (int k = 0; k < 100; ++k)
    {
        device->read();
        device->write (both);
        REQUIRE (*std::ranges::max_element (device->effortsNow()) == 0.25);
    }
}

TEST_CASE ("a max_signal that is tightened during a run lowers a rumble motor smoothly, and no setting raises it again", "[hid][safety]")
{
    FakeBoard pad;
    const auto device = open (pad, "dualsense_usb", 1e-3);
    device->limitSignals (1.0, GuardLimits::none);
    Effort full { .signals = { 1.0, 1.0 } };
    const auto now = [&] {
        device->read();
        device->write (full);
        return *std::ranges::max_element (device->effortsNow());
    };
    device->read();
    device->write ({});
    double before = 0.0;
    for (int k = 0; k < 100; ++k)
        before = now();
    REQUIRE (before == 1.0);
    device->limitSignals (0.25, GuardLimits::none);
    for (int k = 1; k <= 20; ++k)
    {
        const double amplitude = now();
        CHECK (amplitude <= before);
        CHECK (before - amplitude <= 0.75 / 5.0 * (1.0 + 1e-9));
        if (k >= 5) CHECK (amplitude == 0.25);
        before = amplitude;
    }
    device->limitSignals (0.5, GuardLimits::none);
    CHECK (now() == 0.25);
}

TEST_CASE ("signals neither allocate nor lock on the tick thread", "[hid]")
{
    FakeBoard pad;
    const auto device = open (pad, "dualsense_bluetooth_samples", 1e-3);
    tick (*device, {});
    NoAllocation watch;
    for (int k = 0; k < 100; ++k)
        tick (*device, { 0.1 * (k % 7), -0.1 });
    CHECK (watch.allocations() == 0);
    CHECK (watch.locks() == 0);
}
