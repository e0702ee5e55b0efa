// SPDX-License-Identifier: MIT
// A joystick or wheel without a profile, driven according to its own report descriptor.

#include "host/devices/hid/pid_wheel.hpp"
#include "support/waiting.hpp"

#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/hid_link/hid_device.hpp>
#include <host/devices/hid_link/open_device.hpp>

#include <support/property.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/text/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::hid;
using namespace std::chrono_literals;

namespace
{
/// The wheel of pid_wheel.hpp, with memory for effects.
class Wheel final : public HidSystem
{
public:
    Wheel()
    {
        what.vid = 0x1209;
        what.pid = 0xffb0;
        what.product = "Wheel";
        what.path = "fake/wheel";
        what.serial = "W1";
    }

    ConnectedDevice what;
    Bytes descriptor = test::wheel();
    std::uint8_t free_block = 5;              // assigned to the next effect; 0: no room
    int busy = 0;                             // how many more requests remain unanswered
    std::optional<std::uint8_t> refused {};   // id of a report that it rejects
    bool answers = true;                      // it says where it is when it is asked
    Bytes chatter {};                         // a report that it sends all the time
    std::function<void()> on_ask {};          // called without a lock

    struct Told
    {
        Bytes bytes;
        char how = 'o';   // o output, f feature, g feature request, w failsafe
    };

    std::vector<Told> told() const
    {
        const std::lock_guard lock (mutex);
        return log;
    }
    Bytes last (std::uint8_t id) const
    {
        const auto all = told();
        const auto it = std::find_if (all.rbegin(), all.rend(), [&] (const Told& t) { return t.how != 'w' && ! t.bytes.empty() && t.bytes[0] == id; });
        return it == all.rend() ? Bytes {} : it->bytes;
    }
    int magnitude() const
    {
        const auto bytes = last (3);
        return bytes.size() == 4 ? static_cast<std::int16_t> (bytes[2] | bytes[3] << 8) : 99999;
    }

    void moveTo (int x)
    {
        const std::lock_guard lock (mutex);
        state = input = { 1, static_cast<std::uint8_t> (x), static_cast<std::uint8_t> (x >> 8), 0 };
    }
    void pretend (int x)   // what it answers, until it moves
    {
        const std::lock_guard lock (mutex);
        state = { 1, static_cast<std::uint8_t> (x), static_cast<std::uint8_t> (x >> 8), 0 };
    }
    int asked() const
    {
        const std::lock_guard lock (mutex);
        return times_asked;
    }
    void plug (bool in)
    {
        const std::lock_guard lock (mutex);
        plugged = in;
        ++plugging;
    }

    std::vector<ConnectedDevice> connected() override
    {
        const std::lock_guard lock (mutex);
        if (! plugged) return {};
        return { what };
    }
    Bytes reportDescriptor (const ConnectedDevice&) override { return descriptor; }
    Result<std::unique_ptr<Transport>> open (const ConnectedDevice&) override
    {
        const std::lock_guard lock (mutex);
        return std::make_unique<Wire> (*this, plugging);
    }

private:
    struct Wire final : Transport
    {
        Wire (Wheel& w, int p) : wheel (w), plugging (p) {}

        Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override
        {
            if (timeout > 0ms) test::letPass (500us);
            const std::lock_guard lock (wheel.mutex);
            if (gone()) return transferError ("Input/output error");
            const auto report = wheel.input.empty() && timeout > 0ms ? wheel.chatter : std::exchange (wheel.input, {});
            std::ranges::copy (report, into.begin());
            return report.size();
        }
        Result<std::size_t> getInput (std::span<std::uint8_t> report) override
        {
            if (wheel.on_ask) wheel.on_ask();
            const std::lock_guard lock (wheel.mutex);
            ++wheel.times_asked;
            if (gone() || ! wheel.answers || report.size() != 4 || report[0] != 1) return transferError ("Broken pipe");
            std::ranges::copy (wheel.state, report.begin());
            return wheel.state.size();
        }
        Result<> write (std::span<const std::uint8_t> report) override { return tell (report, 'o'); }
        Result<> sendFeature (std::span<const std::uint8_t> report) override { return tell (report, 'f'); }
        Result<> getFeature (std::span<std::uint8_t> report) override
        {
            if (auto told = tell (report, 'g'); ! told) return told;
            const std::lock_guard lock (wheel.mutex);
            if (report.size() != 3 || report[0] != 7) return transferError ("Protocol error");
            report[1] = wheel.busy > 0 ? 0 : wheel.free_block;
            report[2] = 0;
            if (wheel.busy == 0) report[2] = wheel.free_block > 0 ? 1 : 2;
            wheel.busy = std::max (0, wheel.busy - 1);
            return {};
        }
        Result<> armFailsafe (const std::vector<OutgoingReport>& reports) override
        {
            Result<> armed;
            for (const auto& r : reports)
                armed = tell (r.bytes, 'w');
            return armed;
        }

        bool gone() const { return ! wheel.plugged || wheel.plugging != plugging; }
        Result<> tell (std::span<const std::uint8_t> report, char how)
        {
            const std::lock_guard lock (wheel.mutex);
            if (gone() || (how != 'w' && wheel.refused == report[0])) return transferError ("Broken pipe");
            wheel.log.push_back ({ { report.begin(), report.end() }, how });
            return {};
        }

        Wheel& wheel;
        const int plugging;
    };

    mutable std::mutex mutex;
    std::vector<Told> log;
    Bytes input, state { 1, 0, 0, 0 };   // the report that waits, and what it answers
    bool plugged = true;
    int plugging = 0, times_asked = 0;
};

const Json any { { "driver", "hid" }, { "profile", "auto" } };
const Json of_4_newton { { "driver", "hid" }, { "profile", "pid" }, { "calibration", { { "full_force", "4 N" }, { "travel", { { "x", "12 cm" } } } } } };

std::string idOf (const MadeDevice& made) { return made.messages.empty() ? "" : made.messages.front().id; }

/// A run at 1 kHz with one requested force.
struct Driven
{
    explicit Driven (MadeDevice& made) : device (*made.device)
    {
        device.prepare (1e-3);
        guard.prepare (made.limits, 1e-3);
    }

    void tick (const Effort& wanted)
    {
        reading = device.read();
        device.write (guard (wanted, reading));
    }

    /// Ticks until a condition holds.
    template <typename F>
    bool until (const Effort& wanted, F&& so)
    {
        return test::eventually (1ms, [&] {
            tick (wanted);
            return so();
        });
    }

    Device& device;
    Guard guard;
    Reading reading;
};

Effort push (double newton) { return { .force = { newton, 0.0, 0.0 } }; }
}   // namespace

TEST_CASE ("a force feedback device without a profile is initialised, driven in newtons and released", "[hid]")
{
    Wheel wheel;
    wheel.busy = 2;
    auto made = openDevice (of_4_newton, {}, wheel, {});
    REQUIRE (made.messages.empty());
    REQUIRE (made.device);
    CHECK (made.limits.max_force == 4.0);
    CHECK (made.limits.ramp > 0.0);

    const auto woken = wheel.told();
    std::string order;
    for (const auto& t : woken)
        order += t.how;
    CHECK (order == "wfgggooowwww");
    CHECK (wheel.last (2).at (1) == 5);   // the block that the wheel assigned
    CHECK (wheel.last (3) == Bytes { 3, 5, 0, 0 });

    Driven run (made);
    for (int i = 0; i < 50; ++i)
        run.tick (push (2.0));
    CHECK_FALSE (run.reading.valid);   // the wheel has not sent anything yet
    CHECK (wheel.magnitude() == 0);

    wheel.moveTo (16384);
    CHECK (run.until (push (2.0), [&] { return wheel.magnitude() == -5000; }));   // half of 4 N; a push to the right comes from the left
    CHECK (run.reading.position.x() == Approx (0.03).epsilon (1e-3));
    CHECK (wheel.last (4) == Bytes { 4, 5, 1, 1 });
    CHECK (run.until (push (-100.0), [&] { return wheel.magnitude() == 10000; }));

    made.device.reset();
    const auto told = wheel.told();
    CHECK (told.back().bytes == Bytes { 5, 3 });   // stop all effects
    CHECK (wheel.magnitude() == 0);
    CHECK (wheel.last (4) == Bytes { 4, 5, 3, 0 });
}

TEST_CASE ("the effect is restarted repeatedly, since it ends on its own", "[hid]")
{
    Wheel wheel;
    auto made = openDevice (of_4_newton, {}, wheel, {});
    REQUIRE (made.device);
    Driven run (made);
    wheel.moveTo (1);
    const auto starts = [&] {
        const auto told = wheel.told();
        return std::ranges::count_if (told, [] (const auto& t) { return t.bytes == Bytes { 4, 5, 1, 1 }; });
    };
    CHECK (run.until (push (1.0), [&] { return starts() >= 3; }));
}

TEST_CASE ("a device that sends only changes keeps its force at rest if it says where it is, and loses it if it does not", "[hid]")
{
    for (const bool answers : { true, false })
    {
        CAPTURE (answers);
        Wheel wheel;
        wheel.answers = answers;
        auto made = openDevice (of_4_newton, {}, wheel, {});
        REQUIRE (made.device);
        CHECK (made.limits.watchdog == 0.05);
        made.limits.max_still = GuardLimits::none;   // for this test, it may rest for as long as it likes
        Driven run (made);
        wheel.moveTo (1000);   // its only report
        const auto& device = dynamic_cast<HidDevice&> (*made.device);
        if (answers)
        {
            REQUIRE (run.until (push (2.0), [&] { return wheel.magnitude() == -5000; }));
            const auto asked = wheel.asked();
            double oldest = 0.0;
            REQUIRE (run.until (push (2.0), [&] {
                oldest = std::max (oldest, run.reading.age);
                return wheel.asked() > asked + 10;
            }));
            CHECK (oldest > 0.0);   // silence is not a new reading
            CHECK (run.reading.position.x() == Approx (0.06 * 1000.0 / 32767.5).epsilon (0.01));
            CHECK (device.port().counts().asked_for > 10);
            CHECK (device.port().counts().reports == device.port().counts().asked_for + 1);
        }
        else
        {
            // Whatever the graph asks for, the reading gets old, and the guard brings the force to zero.
            REQUIRE (run.until (push (2.0), [&] { return run.guard.stop() == Guard::Stop::stale && run.guard.isAtRest() && run.reading.age > 0.05; }));
            REQUIRE (run.until (push (2.0), [&] { return wheel.magnitude() == 0; }));
            CHECK (wheel.asked() == 1);
            CHECK (device.port().trouble().find ("Broken pipe") != std::string::npos);
            std::int16_t at = 2000;   // a single report would be a pulse of force
            CHECK (run.until (push (2.0), [&] {
                wheel.moveTo (at++);
                return run.guard.stop() == Guard::Stop::none;
            }));
        }
    }
}

TEST_CASE ("reports that do not say where a device is do not make its reading new", "[hid]")
{
    for (const bool answers : { true, false })
    {
        CAPTURE (answers);
        Wheel wheel;
        wheel.answers = answers;
        wheel.descriptor.pop_back();   // a second input report within the same joystick
        const auto state_report = test::bytes ("09 92 a1 02 85 09 09 a0 15 00 25 01 75 01 95 08 81 02 c0 c0");
        wheel.descriptor.insert (wheel.descriptor.end(), state_report.begin(), state_report.end());
        wheel.chatter = { 9, 1 };   // sent all the time
        auto made = openDevice (of_4_newton, {}, wheel, {});
        REQUIRE (made.device);
        made.limits.max_still = GuardLimits::none;
        Driven run (made);
        wheel.moveTo (1000);
        const auto& port = dynamic_cast<HidDevice&> (*made.device).port();
        if (answers)
        {
            REQUIRE (run.until (push (2.0), [&] { return wheel.magnitude() == -5000; }));
            CHECK (run.until (push (2.0), [&] { return port.counts().asked_for > 10; }));
            CHECK (run.guard.stop() == Guard::Stop::none);
        }
        else
        {
            CHECK (run.until (push (2.0), [&] { return run.guard.stop() == Guard::Stop::stale && run.reading.age > 0.05; }));
            CHECK (run.until (push (2.0), [&] { return wheel.magnitude() == 0; }));
        }
        CHECK (run.until (push (2.0), [&] { return port.counts().reports > 10; }));
    }
}

TEST_CASE ("an answer that is late, or older than a report, does not count", "[hid]")
{
    Wheel wheel;
    wheel.on_ask = [&, first = true]() mutable {
        if (std::exchange (first, false)) wheel.moveTo (3000);   // it moves while it is asked
        wheel.pretend (wheel.asked() == 0 ? -3000 : 3000);       // and answers where it was before
    };
    auto made = openDevice (of_4_newton, {}, wheel, {});
    REQUIRE (made.device);
    Driven run (made);
    wheel.moveTo (1);
    const auto& port = dynamic_cast<HidDevice&> (*made.device).port();
    bool went_back = false;
    REQUIRE (run.until ({}, [&] {
        went_back = went_back || run.reading.position.x() < -0.001;
        return run.reading.position.x() > 0.005;
    }));
    CHECK_FALSE (went_back);
    CHECK (port.counts().reports > 1);

    Wheel slow;
    slow.on_ask = [] { test::letPass (60ms); };   // longer than its watchdog
    auto other = openDevice (of_4_newton, {}, slow, {});
    REQUIRE (other.device);
    Driven late (other);
    slow.moveTo (1);
    REQUIRE (late.until ({}, [&] { return slow.asked() == 1 && late.reading.age > 0.2; }));
    CHECK (slow.asked() == 1);
    CHECK (dynamic_cast<HidDevice&> (*other.device).port().counts().asked_for == 0);
}

TEST_CASE ("a force feedback device has limits of force, slew, speed, energy and stillness", "[hid]")
{
    const auto limitsWith = [] (const Json& calibration, const char* warning = "") {
        Wheel wheel;
        const auto made = openDevice ({ { "driver", "hid" }, { "profile", "pid" }, { "calibration", calibration } }, {}, wheel, {});
        REQUIRE (made.device);
        CHECK (idOf (made) == warning);
        return made.limits;
    };
    const auto stick = limitsWith ({ { "full_force", "4 N" }, { "travel", { { "x", "12 cm" } } } });
    CHECK (stick.max_force == 4.0);
    CHECK (stick.max_slew == 1000.0);
    CHECK (stick.max_speed == 2.0);
    CHECK (stick.max_energy == Approx (4.0 * 0.06));   // a centred spring stores at most half of it
    CHECK (stick.energy_window == 1.0);
    CHECK (stick.still_force == 1.0);
    CHECK (stick.max_still == 1.0);   // 12 cm in 65536 counts are 2 um
    CHECK (stick.max_axis_slew == 1000.0);

    CHECK (limitsWith ({ { "full_force", "4 N" }, { "travel", { { "x", "2 m" } } } }).max_still == 5.0);   // 30 um
    CHECK (limitsWith ({ { "full_force", "4 N" }, { "travel", { { "x", "2 m" } } } }).max_energy == Approx (0.4));

    const auto wheel = limitsWith ({ { "full_force", "2.5 N*m" }, { "travel", { { "x", "900 deg" } } } });
    CHECK (wheel.max_torque == 2.5);
    CHECK (wheel.max_torque_slew == 625.0);
    CHECK (wheel.max_angular_speed == 20.0);
    CHECK (wheel.max_energy == Approx (2.5));
    CHECK (wheel.still_torque == 0.625);
    CHECK (wheel.max_still == 5.0);   // 0.24 mrad

    // Without the travel of the axis that is driven, a usual one is assumed, so that the limits mean something.
    const auto assumed = limitsWith ({ { "full_force", "4 N" } }, "pid/no_travel");
    CHECK (assumed.max_speed == 2.0);
    CHECK (assumed.max_energy == Approx (0.2));
    CHECK (limitsWith ({ { "full_force", "2 N*m" } }, "pid/no_travel").max_angular_speed == 20.0);

    Wheel plain;
    const auto uncalibrated = openDevice (any, {}, plain, {});
    CHECK (uncalibrated.limits.max_slew == 250.0);
    CHECK (uncalibrated.limits.max_energy == Approx (0.05));
}

TEST_CASE ("a force feedback device whose sensor is frozen loses its force", "[hid]")
{
    Wheel wheel;
    auto made = openDevice (of_4_newton, {}, wheel, {});
    REQUIRE (made.device);
    Driven run (made);
    wheel.moveTo (1000);
    REQUIRE (run.until (push (2.0), [&] { return wheel.magnitude() == -5000; }));
    // On a loaded machine, an answer may be late first: that is a stop of its own, and ends.
    CHECK (run.until (push (2.0), [&] {
        return run.guard.stop() == Guard::Stop::stale && run.guard.latest().fault == ReadingFault::frozen && wheel.magnitude() == 0;
    }));
    wheel.moveTo (1100);
    CHECK (run.until (push (2.0), [&] { return wheel.magnitude() == -5000; }));
}

TEST_CASE ("a force feedback device that comes back may assign a different effect block", "[hid]")
{
    Wheel wheel;
    auto made = openDevice (of_4_newton, {}, wheel, {});
    REQUIRE (made.device);
    Driven run (made);
    wheel.moveTo (1);
    REQUIRE (run.until (push (2.0), [&] { return wheel.magnitude() == -5000; }));

    wheel.plug (false);
    REQUIRE (run.until (push (2.0), [&] { return ! run.reading.valid; }));
    wheel.free_block = 9;
    wheel.plug (true);
    const auto before = wheel.told().size();
    REQUIRE (run.until (push (2.0), [&] { return wheel.last (2).at (1) == 9; }));
    wheel.moveTo (2);
    CHECK (run.until (push (2.0), [&] { return wheel.last (3) == Bytes { 3, 9, 0x78, 0xec }; }));   // -5000
    made.device.reset();

    const auto told = wheel.told();
    for (auto i = before; i < told.size(); ++i)
        if (told[i].bytes[0] >= 2 && told[i].bytes[0] <= 4) CHECK (told[i].bytes[1] == 9);
    CHECK (told.back().bytes == Bytes { 5, 3 });
}

TEST_CASE ("an uncalibrated device uses a tenth of its force, with a warning", "[hid]")
{
    Wheel wheel;
    auto made = openDevice (any, {}, wheel, {});
    REQUIRE (made.device);
    REQUIRE (idOf (made) == "pid/uncalibrated");
    CHECK (made.messages.front().severity == Message::Severity::warning);
    CHECK (made.limits.max_force == Approx (1.0));
    Driven run (made);
    wheel.moveTo (1);
    int most = 0;
    run.until (push (1000.0),
               [&] {
                   most = std::max (most, std::abs (wheel.magnitude()));
                   return most == 1000 && run.guard.stop() == Guard::Stop::none && wheel.magnitude() == -1000;
               });
    CHECK (most == 1000);

    // The effort of an axis cannot exceed a tenth either, whatever the guard passes.
    made.device->write ({ .axes = { 50.0 } });
    for (int i = 0; i < 50; ++i)
    {
        made.device->read();
        made.device->write ({ .axes = { 50.0 } });
        test::letPass (1ms);
    }
    CHECK (std::abs (wheel.magnitude()) <= 1000);
}

TEST_CASE ("a wheel reports its angle and takes a torque", "[hid]")
{
    Wheel wheel;
    auto made = openDevice ({ { "driver", "hid" },
                              { "profile", "pid" },
                              { "calibration", { { "full_force", "2.5 N*m" }, { "travel", { { "x", "900 deg" } } }, { "reversed", true } } } },
                            {}, wheel, {});
    REQUIRE (made.messages.empty());
    CHECK (made.limits.max_torque == 2.5);
    Driven run (made);
    wheel.moveTo (-16384);
    CHECK (run.until ({ .torque = { 0.0, 1.25, 0.0 } }, [&] { return wheel.magnitude() == 5000; }));
    CHECK (run.reading.rotation.y() == Approx (-0.25 * 5.0 * 3.14159265358979).epsilon (1e-3));
    CHECK (run.reading.position.isZero (0.0));
}

TEST_CASE ("a force feedback device that cannot be driven gives an error with a remedy", "[hid]")
{
    const auto attempt = [] (Wheel& wheel, const Json& description) {
        const auto made = openDevice (description, {}, wheel, {});
        CHECK_FALSE (made.device);
        REQUIRE_FALSE (made.messages.empty());
        CHECK_FALSE (made.messages.front().remedy.empty());
        return idOf (made);
    };
    const auto with = [] (const char* key, const Json& value) {
        auto d = of_4_newton;
        d["calibration"][key] = value;
        return d;
    };

    Wheel full;
    full.free_block = 0;
    CHECK (attempt (full, of_4_newton) == "pid/full");

    Wheel silent;
    silent.busy = 1000;
    CHECK (attempt (silent, of_4_newton) == "hid/init");

    for (const std::uint8_t id : Bytes { 2, 3, 5, 6, 7 })
    {
        Wheel refuses;
        refuses.refused = id;
        CHECK (attempt (refuses, of_4_newton) == "hid/init");
    }

    Wheel plain;   // a joystick without force feedback
    plain.descriptor = test::bytes ("05 01 09 04 a1 01 09 30 15 00 26 ff 00 75 08 95 01 81 02 c0");
    CHECK (attempt (plain, of_4_newton) == "hid/not_connected");

    Wheel springs;   // force feedback with only a state report
    springs.descriptor = test::bytes ("05 01 09 04 a1 01 09 30 15 00 26 ff 00 75 08 95 01 81 02 05 0f 09 92 a1 02 09 9f 81 02 c0 c0");
    CHECK (attempt (springs, of_4_newton) == "pid/missing");

    Wheel broken;
    broken.descriptor.resize (broken.descriptor.size() / 2);
    CHECK (attempt (broken, of_4_newton) == "hid/not_connected");

    Wheel wheel;
    CHECK (attempt (wheel, with ("travel", { { "slider", "1 cm" } })) == "pid/no_axis");
    CHECK (attempt (wheel, with ("full_force", "3 m")) == "device/unit");
    CHECK (attempt (wheel, with ("full_force", -1)) == "device/out_of_range");
    CHECK (attempt (wheel, with ("reversed", 1)) == "device/kind");
    CHECK (attempt (wheel, with ("ful_force", 1)) == "device/unknown_key");
    CHECK (attempt (wheel, { { "driver", "hid" }, { "calibration", Json::object() } }) == "device/missing");
    CHECK (attempt (wheel, { { "driver", "hid" }, { "calibration", 3 } }) == "device/kind");
}

TEST_CASE ("no force exceeds what the calibration allows", "[hid]")
{
    test::property ("any requested force", [] {
        Messages messages;
        const auto pid = PidDevice::from (readDescriptor (test::wheel()).descriptor, messages);
        PidCalibration calibration { .full_force = *rc::gen::inRange (1, 1000) * 0.1 };
        calibration.usable = *rc::gen::inRange (1, 101) * 0.01;
        calibration.is_reversed = *rc::gen::arbitrary<bool>();
        HidModel model (std::make_shared<const Profile> (pid->profile (calibration)));
        const double asked = *rc::gen::inRange (-100000, 100000) * 1e-2;
        const auto report = model.encode (0, { { asked, 0.0, 0.0 }, Vec3::Zero(), {} });
        const int counts = static_cast<std::int16_t> (report[2] | report[3] << 8);
        const double got = (calibration.is_reversed ? 1.0 : -1.0) * counts * calibration.full_force / 10000.0;
        const double most = calibration.full_force * calibration.usable;
        RC_ASSERT (std::abs (got - std::clamp (asked, -most, most)) <= 0.5001 * calibration.full_force / 10000.0);
    });
}
