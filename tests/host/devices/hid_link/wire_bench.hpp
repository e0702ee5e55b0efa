// SPDX-License-Identifier: MIT
#pragma once

#include "host/devices/hid/hid.hpp"
#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <host/devices/hid/hex.hpp>
#include <host/devices/hid_link/capture.hpp>
#include <host/devices/hid_link/fake_device.hpp>
#include <host/devices/hid_link/hid_device.hpp>
#include <host/devices/hid_link/open_device.hpp>

#include <tactus/file/text_file.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/text/json_text.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cstring>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tactus::test::wires
{

using namespace host;
using namespace host::hid;
using namespace std::chrono_literals;
using test::eventually;
using test::fromNow;
using WireClock = WireFile::Clock;

/// An open device without a failsafe. On a busy computer, that would take a test for suspended, and open the device again. It has tests of its own.
struct WithoutFailsafe final : Transport
{
    explicit WithoutFailsafe (std::unique_ptr<Transport> t) : to (std::move (t)) {}

    Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override { return to->read (into, timeout); }
    bool canReadUntil() const noexcept override { return to->canReadUntil(); }
    std::size_t keptBySystem() const noexcept override { return to->keptBySystem(); }
    std::uint64_t strayBytes() const noexcept override { return to->strayBytes(); }
    bool awaitsAnswer() const noexcept override { return to->awaitsAnswer(); }
    ReportFile::Outcome readUntil (std::span<std::uint8_t> into, ReportFile::Clock::time_point until) noexcept override { return to->readUntil (into, until); }
    Result<> write (std::span<const std::uint8_t> report) override { return to->write (report); }
    Result<> sendFeature (std::span<const std::uint8_t> report) override { return to->sendFeature (report); }
    Result<> getFeature (std::span<std::uint8_t> report) override { return to->getFeature (report); }

    std::unique_ptr<Transport> to;
};

/// A computer without HID devices, with a clock of its own.
struct NoHid final : host::hid::HidSystem
{
    std::vector<ConnectedDevice> connected() override { return {}; }
    Result<std::unique_ptr<Transport>> open (const ConnectedDevice&) override { return Message::error ("hid/not_opened", {}, "there is none"); }
    Result<std::unique_ptr<Transport>> reach (const ConnectedDevice& device, const Profile& profile) override
    {
        auto reached = HidSystem::reach (device, profile);
        if (! reached) return reached;
        return std::make_unique<WithoutFailsafe> (std::move (*reached));
    }
    std::chrono::steady_clock::time_point now() const noexcept override { return std::chrono::steady_clock::time_point (std::chrono::nanoseconds (ns.load())); }

    std::atomic<std::int64_t> ns = 1'000'000'000;
};

/// The board's profile, with a framing, and with a watchdog and a pause within a report that a busy machine does not trigger.
inline std::shared_ptr<const Profile> board (const std::string& framing = "cobs", const std::string& watchdog = "10 s", std::chrono::milliseconds pause = 1s)
{
    auto json = readJson (*readTextFile (test::profile_folder / "tactus_board.json")).root;
    json["wires"]["serial"]["framing"] = framing;
    json["limits"]["stale_input"] = watchdog;
    json["outputs"][0]["max_rate"] = 20000;
    auto loaded = readProfile (json);
    INFO (test::text (loaded.messages));
    REQUIRE (loaded.profile);
    auto profile = *loaded.profile;
    profile.wires.serial->pause = pause;
    return std::make_shared<const Profile> (std::move (profile));
}

inline std::unique_ptr<Device> stillHand()
{
    auto made = makeDevice ({ { "driver", "sim" } }, {});
    REQUIRE (made.device);
    return std::move (made.device);
}

inline std::uint32_t numberAt (const Bytes& report, std::size_t at)
{
    std::uint32_t n = 0;
    std::memcpy (&n, report.data() + at, sizeof n);
    return n;
}

/// A fake board and the port that is open on it.
struct Bench
{
    /// Records what passes in a file, if there is one.
    explicit Bench (Wire w, std::shared_ptr<const Profile> p = board(), std::unique_ptr<Device> hand = stillHand(), const std::string& link = {},
                    CaptureFile* file = nullptr)
        : profile (std::move (p))
    {
        if (file != nullptr) capturing.emplace (system, *file);
        auto made = FakeDevice::make (profile, std::move (hand), { .wire = w, .link = link, .faults = {} });
        INFO ((made ? std::string() : made.error().text));
        REQUIRE (made);
        fake = std::move (*made);
        fake->on_line = [this] (const FakeDevice::Line& line) {
            if (line.what == FakeDevice::Line::What::sent) sent.emplace_back (line.bytes.begin(), line.bytes.end());
            if (line.what == FakeDevice::Line::What::heard) heard.emplace_back (line.bytes.begin(), line.bytes.end());
        };
        where.wire = w;
        where.path = link.empty() ? fake->place() : link;
        where.product = "fake board";

        // Over UDP, the device must answer while it is opened.
        const HidPort::Options options { .look_again = 5ms, .real_time = false };
        auto opening = std::async (std::launch::async, [&] { return HidPort::open (opener(), where, profile, options); });
        while (opening.wait_for (1ms) != std::future_status::ready)
            fake->step();
        auto opened = opening.get();
        INFO ((opened ? std::string() : opened.error().text));
        REQUIRE (opened);
        device = std::make_unique<HidDevice> (std::move (*opened));
        device->prepare (1e-3);
        const auto& axes = device->model().axisNames();
        sequence = static_cast<std::size_t> (std::ranges::find (axes, "sequence") - axes.begin());
        REQUIRE (sequence < axes.size());
    }

    /// One step of the fake, and reads until its report is there. False if it does not come.
    bool step (Reading& reading)
    {
        const auto at = sent.size();
        fake->step();
        system.ns += 1'000'000;
        if (sent.size() == at) return false;
        const auto number = numberAt (sent[at], 4);
        return eventually (50us, [&] {
            reading = device->read();
            return device->model().sample().axes[sequence] == static_cast<double> (number);
        });   // a thread that only yields may keep the kernel from passing the bytes on
    }

    /// The same with a force; waits until the fake has heard it.
    bool push (double force)
    {
        Reading reading;
        if (! step (reading)) return false;
        Effort effort;
        if (reading.valid) effort.force.z() = force;
        const auto before = heard.size();
        device->write (effort);
        return eventually ([&] { return fake->hear (fromNow (10ms)) || heard.size() > before; });
    }

    HidSystem& opener() { return capturing ? static_cast<HidSystem&> (*capturing) : system; }

    std::shared_ptr<const Profile> profile;
    NoHid system;
    std::optional<CapturingSystem> capturing;
    ConnectedDevice where;
    std::unique_ptr<FakeDevice> fake;
    std::unique_ptr<HidDevice> device;   // ends before the fake
    std::vector<Bytes> sent, heard;
    std::size_t sequence = 0;   // the index of the axis
};

/// A device in a run without a wire: the reports of a log, and the answers after encoding. A device rests before it pushes, on its first tick unless it
/// `has_rested`.
struct OffTheWire final : Device
{
    OffTheWire (std::shared_ptr<const Profile> p, std::span<const Bytes> r, bool has_rested = false)
        : model (std::move (p)), reports (r), resting (has_rested ? 0 : 1)
    {
    }

    void prepare (double) override {}

    Reading read() noexcept override
    {
        model.decode (reports[tick++]);
        auto reading = model.reading();
        reading.valid = reading.valid && tick > resting;
        reading.unrendered_force = force - model.renderedForce();
        reading.unrendered_torque = torque - model.renderedTorque();
        for (std::size_t i = 0; i < model.axisNames().size(); ++i)
            reading.axes.set (static_cast<int> (i), model.sample().axes[i]);
        return reading;
    }

    void write (const Effort& guarded) noexcept override
    {
        force = guarded.force;
        torque = guarded.torque;
        HidEffort effort { force, torque, model.restEfforts() };
        model.take (guarded.axes, effort);
        const auto bytes = model.encodeValues (0, model.drive (effort, 1e-3));
        answers.emplace_back (bytes.begin() + (usesIds (model.profile()) ? 0 : 1), bytes.end());
    }

    DeviceLayout layout() const override { return layoutOf (model); }

    HidModel model;
    std::span<const Bytes> reports;
    const std::size_t resting;   // ticks without a valid reading
    std::size_t tick = 0;
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    std::vector<Bytes> answers;
};

/// Closes a loop over a wire, in which the hand feels the force, and compares each report that the far end hears with the offline run. `there` is the device
/// of the run, and `isPush` tells a report that pushes. False if the port lost the device on the way, as over UDP after a second in which this computer did
/// nothing.
template <typename B, typename There, typename F>
[[nodiscard]] bool checkForces (B& bench, There& there, const std::shared_ptr<Plan>& plan, bool has_rested, F&& isPush)
{
    constexpr std::size_t ticks = 3000;
    const auto limits = limitsOf (*bench.profile, {});
    Engine engine { plan };
    engine.attach ("stylus", there, limits);
    const auto heard_before = bench.heard.size();
    for (std::size_t k = 0; k < ticks && there.works; ++k)
        engine.tick();
    INFO (bench.heard.size() - heard_before << " reports, trouble: " << bench.device->port().trouble());
    if (! there.works && bench.device->port().counts().departures > 0) return false;
    REQUIRE (there.works);

    OffTheWire offline { bench.profile, std::span (bench.sent).subspan (there.first.value()), has_rested };
    Engine again { plan };
    again.attach ("stylus", offline, limits);
    for (std::size_t k = 0; k < ticks; ++k)
        again.tick();

    REQUIRE (bench.heard.size() == heard_before + ticks);
    std::size_t different = 0, pushing = 0;
    for (std::size_t k = 0; k < ticks; ++k)
    {
        const auto& heard = bench.heard[heard_before + k];
        if (heard != offline.answers[k] && ++different == 1)
            UNSCOPED_INFO ("the first difference is at " << k << ": " << hexOf (heard) << " instead of " << hexOf (offline.answers[k]));
        pushing += isPush (heard) ? 1 : 0;
    }
    CHECK (different == 0);
    CHECK (pushing > ticks / 4);
    CHECK (bench.fake->counts().refused == 0);
    CHECK (bench.fake->counts().stray == 0);
    CHECK (bench.device->port().counts().write_errors == 0);
    CHECK (bench.device->port().counts().dropped == 0);
    return true;
}

}   // namespace tactus::test::wires
