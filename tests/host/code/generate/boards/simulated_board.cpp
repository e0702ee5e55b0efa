// SPDX-License-Identifier: MIT
// Runs the sketch SKETCH on a simulated board, whose clock and host are virtual:
//
//     board SCENARIO MAX_FORCE MAX_SLEW RAMP [SEED]
//
// With OVER_SERIAL, the reports go over a serial line.
//
// The three numbers are what the force on the motors must keep to. On every pass of loop(), the watch checks that.
// Prints what went wrong, or how long each driver pushed.
#include "Arduino.h"

#include SKETCH

#include "board_watch.hpp"

#include <random>
#include <string_view>

namespace
{
constexpr int contact = 2048, outside = contact + 100, inside = contact - 60;   // counts of the sensor; 60 of them are 1.5 mm

double pushing() { return forceNow()[2]; }

SimulatedBoard::Report signedOff (SimulatedBoard::Report r)
{
    tactus::board::put (r, 60, tactus::board::crcOf (r));
    return r;
}

/// What a host sends.
SimulatedBoard::Report asking (double force_z, bool drives = true, double force_x = 0.0)
{
    SimulatedBoard::Report r {};
    r[0] = 0x54;
    r[1] = 1;
    r[2] = drives ? 1 : 0;
    tactus::board::put (r, 8, force_x, 1e6);
    tactus::board::put (r, 16, force_z, 1e6);
    return signedOff (r);
}

void send (const SimulatedBoard::Report& r, int size = 64) { RawHID.to_board.push_back ({ r, size }); }

#if OVER_SERIAL
SimulatedBoard::Sent on_the_line;

/// The next report for the board goes on the line, if that is empty.
void frameNext()
{
    if (RawHID.to_board.empty() || ! Serial.to_board.empty()) return;
    on_the_line = RawHID.to_board.front();
    RawHID.to_board.pop_front();
    std::vector<std::uint8_t> summed (on_the_line.bytes.begin(), on_the_line.bytes.begin() + on_the_line.size);
    const auto crc = tactus_crc (summed.data(), on_the_line.size);
    for (int i = 0; i < 4; ++i)
        summed.push_back (static_cast<std::uint8_t> (crc >> 8 * i));
    summed.push_back (0);   // ends the last part
    Serial.to_board.push_back (0);
    for (auto part = summed.begin(); part != summed.end();)
    {
        const auto zero = std::find (part, summed.end(), std::uint8_t { 0 });
        Serial.to_board.push_back (static_cast<std::uint8_t> (zero - part + 1));
        Serial.to_board.insert (Serial.to_board.end(), part, zero);
        part = zero + 1;
    }
    Serial.to_board.push_back (0);
}

/// Takes the reports of the board from the line.
void unframe()
{
    static tactus_line from_board;
    for (const auto byte : Serial.from_board)
        if (tactus_take (&from_board, byte, RawHID.from_board.data()) != 0) ++RawHID.reports;
    Serial.from_board.clear();
}

void connectLine()
{
    Serial.before_reading = frameNext;
    Serial.after_writing = unframe;
    Serial.emptied = [] { RawHID.received (on_the_line); };
}
#else
void connectLine()
{
}
#endif

Watch* watch = nullptr;

void pass (std::uint64_t us, std::uint64_t step_us = 50)
{
    for (const auto end = RawHID.now_us + us; RawHID.now_us < end;)
        watch->pass (step_us);
}

/// A host that asks for this once per ms.
void driveFor (std::uint64_t us, double force_z, bool drives = true)
{
    for (const auto end = RawHID.now_us + us; RawHID.now_us < end; pass (1000))
        send (asking (force_z, drives));
}

void moveTo (int count)
{
    for (; RawHID.counts[2] != count; pass (1000))
        RawHID.counts[2] += RawHID.counts[2] < count ? 1 : -1;
    pass (second);
}

void press (std::uint64_t us = 100000)
{
    RawHID.is_button_down = true;
    pass (us);
    RawHID.is_button_down = false;
    pass (100000);
}

std::uint64_t rampTime() { return static_cast<std::uint64_t> (1e6 * limits.ramp) + 100000; }

void rests (std::uint64_t us, const char* what)
{
    for (const auto end = RawHID.now_us + us; RawHID.now_us < end;)
    {
        watch->pass (250);
        check (sizeOf (forceNow()) == 0.0, what, sizeOf (forceNow()));
    }
}

//==============================================================================

/// Presses the tool into the object, lets a host drive, and stops it in each way.
void story()
{
    RawHID.counts[2] = outside;
    pass (second);
    check (pushing() == 0.0, "a force outside of the object");
    check (RawHID.reports > 900 && RawHID.reports < 1100, "reports in a second", RawHID.reports);
    check (RawHID.from_board[0] == 0x54 && (RawHID.from_board[2] & 1) != 0, "a wrong report");

    moveTo (inside);
    pass (rampTime());
    const double pushed = pushing();
    check (pushed > 0.0, "the board does not play its graph");
    const double reported = 1e-9 * static_cast<std::int32_t> (tactus::board::get (RawHID.from_board, 20));
    check (std::abs (reported - (inside - contact) * 0.1 / 4096) < 1e-9, "a wrong position", reported);

    const double asked = 0.4 * limits.force;
    driveFor (rampTime(), -asked);
    check (std::abs (pushing() + asked) <= newtons_per_count, "not what the host asks for", pushing());
    check ((RawHID.from_board[2] & 2) != 0, "not reported as driven");

    auto broken = asking (2.0 * asked);
    broken[16] ^= 1;
    send (broken);
    pass (2000);
    check (std::abs (pushing() + asked) <= newtons_per_count, "a report with a wrong CRC counts");

    driveFor (50000, -asked);
    driveFor (100000, 0.0, false);   // the host lets go: enable 0, and the neutral report at its end
    rests (5 * second, "a force after the host let go");
    check ((RawHID.from_board[2] & 6) == 0, "reported as driven, or as timed out");

    driveFor (rampTime(), -asked);
    check (std::abs (pushing() + asked) <= newtons_per_count, "the host does not return");
    pass (60000);   // the cable is pulled, or the host killed
    rests (5 * second, "a force after the host fell silent");
    check ((RawHID.from_board[2] & 4) != 0, "not reported as timed out");
    check ((RawHID.from_board[2] & 2) == 0, "reported as driven");

    press();
    pass (rampTime());
    check (pushing() == pushed, "the arm button does not give the board its graph", pushing());
    moveTo (outside);
    check (pushing() == 0.0, "a force outside of the object");
}

/// A host that only opens the device is in charge, too.
void opened()
{
    RawHID.counts[2] = inside;
    pass (rampTime());
    check (pushing() > 0.0, "the board does not play its graph");
    send (asking (0.0, false));
    pass (60000);
    rests (10 * second, "a force after a neutral report");
    press();
    pass (rampTime());
    check (pushing() > 0.0, "the arm button has no effect");

    // Whatever is not a valid report is no host.
    auto wrong = asking (1.0);
    for (auto& byte : wrong)
        byte ^= 0x5a;
    send (wrong);
    send (asking (1.0), 63);
    auto newer = asking (1.0);
    newer[1] = 2;
    send (signedOff (newer));
    pass (100000);
    check (pushing() > 0.0, "reports that are not valid stop the board");
}

/// A report of which a part is missing must not count as the one before.
void shortened()
{
    RawHID.counts[2] = inside;
    driveFor (rampTime(), -1.0);
    for (int i = 0; i < 500; ++i)
    {
        send (asking (-1.0), i % 64 + 1 < 64 ? i % 64 + 1 : 1);
        pass (1000);
    }
    rests (second, "parts of reports count as reports");
}

void button()
{
    RawHID.counts[2] = inside;
    RawHID.is_button_down = true;   // held at the reset
    pass (100000);
    driveFor (100000, 0.0);
    pass (100000);
    rests (second, "a button that is held at the reset counts");
    RawHID.is_button_down = false;
    rests (5000, "a button that is released counts");
    RawHID.is_button_down = true;
    rests (second, "a button that is held but for 5 ms counts");
    RawHID.is_button_down = false;
    rests (100000, "a button that is released counts");

    // Bounces, and contacts that last for less than 20 ms.
    for (int i = 0; i < 200; ++i)
    {
        RawHID.is_button_down = i % 2 == 0;
        rests (static_cast<std::uint64_t> (1 + i % 18) * 1000, "a button that bounces counts");
    }
    RawHID.is_button_down = false;
    pass (100000);

    // Pressed while the host speaks, and held until it is silent.
    driveFor (100000, 0.0);
    RawHID.is_button_down = true;
    driveFor (100000, 0.0);
    pass (100000);
    rests (second, "a button that was pressed while the host spoke counts");
    RawHID.is_button_down = false;
    pass (100000);
    for (int i = 0; i < 200; ++i)
    {
        RawHID.is_button_down = i % 20 >= 10;
        send (asking (0.0, false));
        rests (15000, "a button that is pressed between two reports counts");
    }
    RawHID.is_button_down = false;
    pass (100000);

    press();
    pass (rampTime());
    check (pushing() > 0.0, "the button has no effect");
    driveFor (100000, 0.0, false);
    rests (second, "a host that comes back and asks for nothing does not stop the board");
}

/// Efforts beyond all limits, and a stop in the middle.
void limited()
{
    RawHID.counts[2] = inside;
    driveFor (rampTime(), 1e6);
    check (pushing() > limits.force - 1.5 * newtons_per_count, "less than the limit", pushing());
    for (int i = 0; i < 300; ++i)
    {
        send (asking (i % 2 == 0 ? 2147.0 : -2147.0, true, i % 3 == 0 ? 2147.0 : -1.0));
        pass (1000);
    }
    driveFor (500000, -1e6);
    driveFor (200000, 1e6, false);   // a force without leave to drive
    check (sizeOf (forceNow()) == 0.0, "a force that is not enabled");
}

/// The clock wraps every 71.6 minutes. What is over stays over.
void wrapped()
{
    RawHID.counts[2] = inside;
    driveFor (rampTime(), -1.0);
    check (pushing() < 0.0, "the host does not drive");
    const auto last = RawHID.now_us;
    pass (60000);
    for (std::uint64_t turn = 1; turn <= 2; ++turn)
    {
        rests (10000, "a force after the host fell silent");
        while (RawHID.now_us < last + turn * wrap - 100000)
        {
            watch->pass (10000);
            check (sizeOf (forceNow()) == 0.0, "a force while the host is silent");
        }
        rests (200000, "the last force returns when the clock has wrapped");
        RawHID.now_us += wrap / 2 + 12345;   // held by a debugger
        rests (200000, "a force after a pause");
    }
    press();
    pass (rampTime());
    check (pushing() > 0.0, "the board has stopped for good");
    const auto reports = RawHID.reports;
    pass (second);
    check (RawHID.reports > reports + 900, "reports in a second", RawHID.reports - reports);
}

/// The board itself is late, so reports wait, and the last one is old.
void late()
{
    RawHID.counts[2] = inside;
    driveFor (rampTime(), -limits.force);
    for (int i = 0; i < 20; ++i)
    {
        send (asking (-limits.force));
        watch->pass (second);
        if (i > 2) check (sizeOf (forceNow()) == 0.0, "a force from reports that waited, in N", sizeOf (forceNow()));
    }
    pass (60000);
    rests (second, "a force after the host fell silent");
}

/// The guard of the patch stops a host that pushes for too long, by the wall clock, however late the ticks are. The patch allows 4 N s in 10 s.
void latched()
{
    RawHID.counts[2] = outside;
    for (const std::uint32_t step_us : { 50u, 2 * period_us + 300 })
    {
        const auto begin = RawHID.now_us;
        while (RawHID.now_us < begin + 20 * second)
        {
            send (asking (-limits.force));
            watch->pass (step_us);
            if (RawHID.now_us > begin + 5 * second && sizeOf (forceNow()) == 0.0) break;
        }
        const double pushed = 1e-6 * static_cast<double> (RawHID.now_us - begin);
        check (pushed < 4.0 / limits.force + limits.ramp + 1.0, "a push that is too long, in s", pushed);
        for (int i = 0; i < 2000; ++i)
        {
            send (asking (-limits.force));
            watch->pass (1000);
            check (sizeOf (forceNow()) == 0.0, "a latched stop ends by itself");
        }
        check ((RawHID.from_board[2] & 2) == 0, "reported as driven");
        RawHID.is_button_down = true;
        driveFor (rampTime(), -limits.force);
        RawHID.is_button_down = false;
        check (pushing() < 0.0, "the arm button does not rearm the guard");
        driveFor (11 * second, 0.0);
    }
}

/// Ticks are as far apart as the patch says, however often loop() runs and however late it was.
void paced()
{
    RawHID.counts[2] = inside;
    std::uint64_t earlier = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const auto before = RawHID.ticks;
        watch->pass (i % 1000 == 0 ? 5 * period_us + 17 : 7);
        if (RawHID.ticks == before) continue;
        check (earlier == 0 || RawHID.now_us - earlier >= period_us, "ticks that are too close, in us", static_cast<double> (RawHID.now_us - earlier));
        earlier = RawHID.now_us;
    }
}

//==============================================================================

/// Hosts, buttons, hands and clocks that do anything.
class Chaos
{
public:
    explicit Chaos (unsigned seed) : random (seed) {}

    void run()
    {
        for (const auto end = RawHID.now_us + 60 * second; RawHID.now_us < end;)
        {
            if (one (3)) host = below (10);
            if (one (3)) hand = below (4);
            if (one (3)) button = below (4);
            if (one (3)) pace = below (5);
            for (const auto until = RawHID.now_us + below (4) * below (500000); RawHID.now_us < until;)
                millisecond();
            if (one (10)) watch->pass (below (500000));   // loop() is late
            if (one (100)) watch->pass (random());        // by up to 71 minutes
        }
    }

private:
    std::uint32_t below (std::uint32_t n) { return random() % n; }
    bool one (std::uint32_t of) { return below (of) == 0; }
    double anyForce() { return (below (2) == 0 ? 4.0 : 4294.0) * (static_cast<double> (random()) / 4294967296.0 - 0.5); }

    void millisecond()
    {
        speak();
        const int deep = RawHID.counts[2];
        if (hand == 0 && deep > inside - 40) --RawHID.counts[2];
        if (hand == 1 && deep < outside) ++RawHID.counts[2];
        if (hand == 2) RawHID.counts[2] += static_cast<int> (below (3)) - 1;
        if (button == 0) RawHID.is_button_down = RawHID.now_us / 100000 % 2 == 0;
        if (button == 1) RawHID.is_button_down = one (2);
        if (button == 2) RawHID.is_button_down = false;
        const std::uint32_t steps[] { 13, 50, 100 + below (900), 1000, 3000 };
        for (const auto until = RawHID.now_us + 1000; RawHID.now_us < until;)
            watch->pass (steps[pace]);
    }

    void speak()
    {
        auto r = asking (anyForce(), true, anyForce());
        switch (host)
        {
        case 0:
        case 1:
            send (asking (limits.force));
            break;
        case 2:
            send (asking (one (2) ? 1e6 : -1e6));
            break;
        case 3:
            send (r);
            break;
        case 4:
            for (auto n = below (9); n > 0; --n)
                send (asking (anyForce(), ! one (5)));
            break;
        case 5:
            send (asking (anyForce(), false));
            break;
        case 6:
            if (one (25)) send (r);
            break;
        case 7:
            r[below (64)] ^= static_cast<std::uint8_t> (1 + below (255));
            send (one (2) ? r : asking (0.0), static_cast<int> (1 + below (63)));
            break;
        case 8:
            for (auto& byte : r)
                byte = static_cast<std::uint8_t> (random());
            r[0] = 0x54;
            r[1] = 1;
            send (one (2) ? signedOff (r) : r);
            break;
        default:
            break;
        }
    }

    std::mt19937 random;
    std::uint32_t host = 9, hand = 0, button = 2, pace = 1;
};
}   // namespace

int main (int count, char** arguments)
{
    if (count < 5) return 2;
    const std::string_view scenario = arguments[1];
    limits = { std::atof (arguments[2]), std::atof (arguments[3]), std::atof (arguments[4]) };
    const auto seed = static_cast<unsigned> (count > 5 ? std::stoi (arguments[5]) : 0);
    RawHID.now_us = seed % 2 == 0 ? 0 : wrap - 3 * second;
    Watch watching;
    watch = &watching;
    RawHID.received = [] (const SimulatedBoard::Sent& sent) { watch->read (sent); };
    connectLine();
    setup();
    const struct Scenario
    {
        std::string_view name;
        void (*run)();
    } all[] {
        { "story", story },
        { "opened", opened },
        { "shortened", shortened },
        { "button", button },
        { "limited", limited },
        { "wrapped", wrapped },
        { "late", late },
        { "latched", latched },
        { "paced", paced },
    };
    const auto* const found = std::ranges::find (all, scenario, &Scenario::name);
    if (found != std::end (all))
        found->run();
    else if (scenario == "chaos")
        Chaos (seed).run();
    else
        fail ("there is no such scenario");
    std::printf ("the board pushed for %.3f s, the host for %.3f s\n", watching.pushed_s[1], watching.pushed_s[2]);
    return 0;
}
