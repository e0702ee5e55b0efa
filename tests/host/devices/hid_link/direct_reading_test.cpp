// SPDX-License-Identifier: MIT
// The tick thread reads the device that ticks the run; a thread of the port reads all others, and opens a device that comes back.

#include "fake_board.hpp"

#include <host/devices/hid_link/hid_clock.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <thread>
#include <vector>

using namespace tactus;
using namespace tactus::host::hid;
using test::boardReport;
using test::Bytes;
using test::eventually;
using test::FakeBoard;
using test::openBoard;
using namespace std::chrono_literals;

namespace
{
/// A board that ticks, one tick after the other, on this thread. Reports are sent during ticks, so what a tick sends is there before
/// the next one begins.
struct Driven final : Ticked
{
    explicit Driven (FakeBoard& b, bool can_read_until = true) : board (b)
    {
        board.can_read_until = can_read_until;
        device = openBoard (board);
    }

    /// Sends a report, and calls `what` on each tick until it returns false.
    void run (std::function<bool()> what)
    {
        each = std::move (what);
        HidClock clock { device->port(), 1000.0 };
        send();
        clock.drive (*this);
    }

    bool tick (double late_s) noexcept override
    {
        was_early = was_early || late_s < 0.0;
        ++ticks;
        const auto before = device->counts().taken;
        reading = device->read();
        device->write ({});
        has_come = device->counts().taken > before;
        return each();
    }

    void send (int how_many = 1)
    {
        for (; how_many > 0; --how_many)
        {
            ++count;
            board.send (boardReport (count, count));
        }
    }

    /// Like a board that waits for each answer.
    void answer()
    {
        if (has_come) send();
    }

    std::uint64_t readHere() const { return device->port().counts().read_by_tick; }

    FakeBoard& board;
    std::unique_ptr<HidDevice> device;
    std::function<bool()> each;
    Reading reading {};
    std::uint16_t count = 0;
    int ticks = 0;
    bool has_come = false, was_early = false;
};

constexpr int many_ticks = 20000;   // 20 s if a timer ticks
}   // namespace

TEST_CASE ("the thread that a board ticks reads the board itself until the run ends", "[hid][threads]")
{
    FakeBoard board, other;
    Driven driven { board };
    const auto beside = openBoard (other);
    driven.run ([&] {
        other.send (boardReport (driven.count));
        beside->read();
        driven.answer();
        return driven.count < 200;
    });
    CHECK_FALSE (driven.was_early);
    CHECK_FALSE (driven.device->port().isReadByTick());

    // The reading thread takes at most the report before the request, and the one that its read waits for at that time. No thread has
    // read the last report when the run ends.
    const auto readers = board.readers();
    REQUIRE (readers.size() >= 199);
    CHECK (std::all_of (readers.begin() + 2, readers.begin() + 199, [] (auto id) { return id == std::this_thread::get_id(); }));
    const auto here = std::ranges::count (readers, std::this_thread::get_id());
    CHECK (driven.readHere() == static_cast<std::uint64_t> (here));

    // Then the port's own thread reads again.
    driven.send (5);
    CHECK (eventually ([&] { return driven.device->port().counts().reports == 205; }));
    CHECK (std::ranges::count (board.readers(), std::this_thread::get_id()) == here);
    driven.device->read();
    CHECK (driven.device->counts().taken == 205);
    CHECK (driven.device->counts().lost == 0);

    CHECK (beside->port().counts().read_by_tick == 0);
    CHECK (std::ranges::count (other.readers(), std::this_thread::get_id()) == 0);
}

TEST_CASE ("a board that only its own thread can read ticks a run too", "[hid][threads]")
{
    FakeBoard board;
    Driven driven { board, false };
    driven.run ([&] {
        driven.answer();
        return driven.count < 100;
    });
    CHECK (driven.readHere() == 0);
    CHECK (std::ranges::count (board.readers(), std::this_thread::get_id()) == 0);
    CHECK (driven.device->counts().taken == 99);
    CHECK (driven.device->counts().lost == 0);
}

TEST_CASE ("reports that arrive during a tick cause one tick, with the newest of them", "[hid][threads]")
{
    FakeBoard board;
    Driven driven { board };
    int sent_at = 0;
    std::uint64_t skipped = 0;
    driven.run ([&] {
        if (sent_at > 0) return false;
        if (driven.readHere() > 0 && driven.has_come)
        {
            sent_at = driven.ticks;
            skipped = driven.device->counts().skipped;
            driven.send (20);
        }
        else
            driven.answer();
        return true;
    });
    CHECK (driven.ticks == sent_at + 1);
    CHECK (driven.reading.age == 0.0);
    CHECK (driven.reading.position.x() == Approx (driven.count * 1e-9).epsilon (1e-12));
    CHECK (driven.device->counts().skipped == skipped + 19);
    CHECK (driven.device->counts().lost == 0);
}

TEST_CASE ("if the system may have dropped the newest reports, a reading is not a new one", "[hid][threads][safety]")
{
    FakeBoard board;
    Driven driven { board };
    std::vector<double> ages;
    driven.run ([&] {
        if (! ages.empty() || (driven.readHere() > 0 && driven.has_come))
        {
            ages.push_back (driven.reading.age);
            driven.send (ages.size() == 1 ? 70 : 1);
        }
        else
            driven.answer();
        return ages.size() < 3;
    });
    CHECK (ages[0] == 0.0);
    CHECK (ages[1] >= 1e-3);   // by the clock or in ticks, whichever is longer
    CHECK (ages[2] == 0.0);
}

TEST_CASE ("reports that the tick thread is woken too late for are not new ones either", "[hid][threads][safety]")
{
    FakeBoard board;
    Driven driven { board };
    std::vector<Bytes> many;
    for (std::uint16_t n = 1000; n < 1070; ++n)
        many.push_back (boardReport (n, n));
    std::jthread sender;
    double age = -1.0;
    driven.run ([&] {
        if (sender.joinable())
        {
            if (! driven.has_come) return true;
            age = driven.reading.age;
            return false;
        }
        if (driven.readHere() > 0 && driven.has_come)
            sender = std::jthread ([&] {
                test::letPass (2ms);   // so that the tick thread usually sleeps by now; the result does not depend on it
                board.sendAtOnce (many);
            });
        else
            driven.answer();
        return true;
    });
    CHECK (age > 0.0);
    CHECK (driven.device->counts().taken >= 70);
}

TEST_CASE ("a board that is unplugged while it ticks a run is opened again elsewhere, and then read by the tick thread again", "[hid][threads]")
{
    FakeBoard board;
    Driven driven { board };
    bool is_out = false, is_back = false;
    std::uint64_t before = 0;
    driven.run ([&] {
        if (! is_out && driven.readHere() > 20)
        {
            is_out = true;
            before = driven.readHere();
            board.plug (false);
        }
        else if (is_out && ! is_back && driven.reading.fault == ReadingFault::unplugged)
        {
            is_back = true;
            CHECK_FALSE (driven.device->port().isReadByTick());
            board.plug (true);
        }
        else if (! is_out)
            driven.answer();
        else if (board.openings() == 2)
            driven.send();
        return driven.ticks < many_ticks && (! is_back || driven.readHere() < before + 20);
    });
    CHECK (board.openings() == 2);
    CHECK (driven.device->port().counts().departures == 1);
    CHECK (driven.readHere() >= before + 20);
}

TEST_CASE ("a board that the failsafe has brought to rest is given back, opened again, and read by the tick thread again", "[hid][threads][safety]")
{
    FakeBoard board;
    Driven driven { board };
    bool is_taken = false;
    std::uint64_t before = 0;
    driven.run ([&] {
        if (! is_taken && driven.readHere() > 20)
        {
            is_taken = true;
            before = driven.readHere();
            board.take();
        }
        if (! is_taken)
            driven.answer();
        else if (board.openings() == 2)
            driven.send();
        return driven.ticks < many_ticks && (board.openings() < 2 || driven.readHere() < before + 20);
    });
    CHECK (board.openings() == 2);
    CHECK (driven.device->port().counts().departures == 1);
    CHECK (driven.readHere() >= before + 20);
}
