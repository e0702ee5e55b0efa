// SPDX-License-Identifier: MIT
// Captures of the messages between a driver and its service: what is recorded, and what it gives when it is replayed.

#include "host/cli/program.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <host/devices/hid_link/capture.hpp>
#include <host/drivers/bhaptics/fake_player.hpp>
#include <host/drivers/bhaptics/vest.hpp>
#include <host/drivers/haply/fake_inverse3.hpp>
#include <host/drivers/haply/inverse3.hpp>
#include <host/drivers/websocket/service_relay.hpp>
#include <host/drivers/websocket/web_server.hpp>

#include <tactus/file/text_file.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/text/caught.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

using namespace tactus;
using namespace std::chrono_literals;
using host::hid::Capture;
using host::hid::CaptureFile;
using host::hid::readCapture;
using test::eventually;
using What = Capture::Line::What;

namespace
{
/// A service that says what was captured, each message after those that the driver had sent before it.
class Replayed
{
public:
    explicit Replayed (Capture c) : capture (std::move (c))
    {
        runs = std::jthread ([this] (const std::stop_token& stop) {
            static_cast<void> (caught ("the replayed service", [&] { serve (stop); }));
        });
    }

    int port() const { return server.port(); }
    bool isAtEnd() const { return is_at_end; }   // nothing follows the message that it says now

private:
    void serve (const std::stop_token& stop)
    {
        std::unique_ptr<host::WebServer::Client> client;
        while (client == nullptr && ! stop.stop_requested())
            client = server.next (2);
        if (client == nullptr) return;
        auto left = std::ranges::count (capture.lines, What::in, &Capture::Line::what);
        for (const auto& line : capture.lines)
        {
            if (line.what == What::in && --left == 0) is_at_end = true;   // first, because the driver may read the last message at once
            if (line.what == What::in) client->say ({ line.bytes.begin(), line.bytes.end() });
            if (line.what == What::out) waitFor (*client, stop);
        }
        while (! stop.stop_requested())
            waitFor (*client, stop);
    }

    static void waitFor (host::WebServer::Client& client, const std::stop_token& stop)
    {
        while (! stop.stop_requested())
            if (client.says (2)) return static_cast<void> (client.hear());
    }

    const Capture capture;
    host::WebServer server { 0 };
    std::atomic<bool> is_at_end = false;
    std::jthread runs;
};

const tactus_device_driver& driverNamed (const std::string& name) { return name == "haply" ? host::patient_haply_driver : host::patient_bhaptics_driver; }

/// A device of a driver at a port of this computer, read without its threads: no reading is left out.
struct Opened
{
    Opened (const std::string& name, int port, const Json& more)
    {
        auto description = more;
        description["driver"] = name;
        description["port"] = std::to_string (port);
        const auto driver = host::DeviceDriver::within (driverNamed (name));
        REQUIRE (driver);
        Messages messages;
        device = (*driver)->open (description, messages);
        INFO (test::text (messages));
        REQUIRE (device);
    }

    /// The next reading. False if there is none in a long time.
    bool next()
    {
        return eventually ([&] { return device->read (50ms, reading, stamp, why) == TACTUS_DEVICE_OK; });
    }

    std::unique_ptr<host::OpenedDevice> device;
    tactus_reading reading {};
    tactus_device_stamp stamp {};
    host::DriverReport why;
};

/// What a reading is about.
std::vector<double> numbersOf (const tactus_reading& r)
{
    std::vector<double> all (r.position, r.position + 3);
    all.insert (all.end(), r.rotation, r.rotation + 3);
    all.push_back (r.buttons);
    return all;
}

Capture captureAt (const std::filesystem::path& path)
{
    const auto text = readTextFile (path);
    REQUIRE (text);
    auto capture = readCapture (*text);
    INFO ((capture ? std::string() : capture.error().text));
    REQUIRE (capture);
    return std::move (*capture);
}

/// Records what passes between a driver and the service at a port.
struct Recorder
{
    Recorder (const std::filesystem::path& path, const std::string& name, int port)
    {
        auto made = CaptureFile::createForMessages (path.string(), name);
        REQUIRE (made);
        file = std::move (*made);
        auto between = host::ServiceRelay::make ({ "localhost", std::to_string (port) }, [this] (bool is_from_service, const std::string& message) {
            file->add (is_from_service ? What::in : What::out, { reinterpret_cast<const std::uint8_t*> (message.data()), message.size() });
        });
        REQUIRE (between);
        relay = std::move (*between);
    }

    std::unique_ptr<CaptureFile> file;
    std::unique_ptr<host::ServiceRelay> relay;
};
}   // namespace

TEST_CASE ("a capture of an Inverse3 has all its messages, and replays to the same readings", "[capture][haply][wires]")
{
    /// Each reading differs from those before.
    struct Hand final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override
        {
            const double n = ++number;
            return { .position = { 1e-5 * n, -0.1, 1.0 / n }, .rotation = { 0.0, 1e-4 * n, 0.2 }, .buttons = static_cast<std::uint32_t> (number % 16) };
        }
        void write (const Effort&) noexcept override {}
        int number = 0;
    };
    constexpr std::size_t readings = 60;
    const Json more { { "grip", "wireless" } };
    const TemporaryFolder folder;
    std::vector<std::vector<double>> live, again;
    {
        auto service = host::FakeInverse3::make (0, std::make_unique<Hand>());
        REQUIRE (service);
        Recorder recorder { folder / "arm.jsonl", "haply", (*service)->port() };
        Opened arm { "haply", recorder.relay->port(), more };
        while (live.size() < readings)
        {
            REQUIRE (arm.next());
            live.push_back (numbersOf (arm.reading));
            Effort effort;
            effort.force.x() = 0.01 * static_cast<double> (live.size());
            if (live.size() % 2 == 0) CHECK (arm.device->write (effort, false, GuardLimits::none, arm.why) == TACTUS_DEVICE_OK);
        }
        CHECK (recorder.file->isGood());
    }
    const auto capture = captureAt (folder / "arm.jsonl");
    CHECK (capture.driver == "haply");
    CHECK_FALSE (capture.wire);
    CHECK (std::ranges::is_sorted (capture.lines, {}, &Capture::Line::t));
    CHECK (capture.lines.front().what == What::in);   // the inventory

    // One answer to each message, and each force of the program is there.
    const auto ins = std::ranges::count (capture.lines, What::in, &Capture::Line::what);
    const auto outs = std::ranges::count (capture.lines, What::out, &Capture::Line::what);
    CHECK (static_cast<std::size_t> (ins) >= readings);
    CHECK (ins - 1 <= outs);
    CHECK (outs <= ins);
    CHECK (std::ranges::any_of (capture.lines, [] (const Capture::Line& line) {
        const std::string text (line.bytes.begin(), line.bytes.end());
        return line.what == What::out && text.find (R"("x":0.02,)") != text.npos;
    }));

    Replayed replayed { capture };
    Opened arm { "haply", replayed.port(), more };
    while (again.size() < readings)
    {
        REQUIRE (arm.next());
        again.push_back (numbersOf (arm.reading));
    }
    CHECK (again == live);
}

TEST_CASE ("a capture of a vest has what was shown on it, and replays to the same trouble", "[capture][bhaptics][wires]")
{
    const TemporaryFolder folder;
    {
        auto player = host::FakePlayer::make (0);
        REQUIRE (player);
        Recorder recorder { folder / "vest.jsonl", "bhaptics", (*player)->port() };
        Opened vest { "bhaptics", recorder.relay->port(), Json::object() };
        REQUIRE (vest.next());
        CHECK (vest.stamp.fault == 0);
        Effort effort;
        effort.signals.set (0, 0.5);
        CHECK (vest.device->write (effort, false, GuardLimits::none, vest.why) == TACTUS_DEVICE_OK);
        REQUIRE (eventually ([&] { return vest.next() && (*player)->counts().frames > 0; }));
        (*player)->fail (host::FakePlayer::Fault::unworn);
        REQUIRE (eventually ([&] { return vest.next() && vest.stamp.fault == TACTUS_DEVICE_NOT_DRIVEN; }));
        CHECK ((*player)->counts().refused == 0);   // the relay has asked for what the driver has asked for
    }
    const auto capture = captureAt (folder / "vest.jsonl");
    CHECK (capture.driver == "bhaptics");
    CHECK (std::ranges::count (capture.lines, What::in, &Capture::Line::what) == 2);
    CHECK (std::ranges::any_of (capture.lines, [] (const Capture::Line& line) {
        const std::string text (line.bytes.begin(), line.bytes.end());
        return line.what == What::out && text.find (R"("intensity":50)") != text.npos;
    }));

    Replayed replayed { capture };
    Opened vest { "bhaptics", replayed.port(), Json::object() };
    Effort effort;
    effort.signals.set (0, 0.5);
    CHECK (vest.device->write (effort, false, GuardLimits::none, vest.why) == TACTUS_DEVICE_OK);
    REQUIRE (eventually ([&] { return vest.next() && vest.stamp.fault == TACTUS_DEVICE_NOT_DRIVEN; }));
    CHECK (replayed.isAtEnd());
}

TEST_CASE ("every capture of a service replays through its driver", "[capture][haply][bhaptics][wires]")
{
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/tests/host/devices/hid_link/captures"))
    {
        const auto capture = captureAt (entry.path());
        if (capture.driver.empty()) continue;   // capture_test.cpp replays it through its profile
        INFO (entry.path().string());
        Replayed replayed { capture };
        Opened opened { capture.driver, replayed.port(), Json::object() };
        do
        {
            REQUIRE (opened.next());
            CHECK (opened.reading.valid == 1);
        } while (! replayed.isAtEnd());
        ++files;
    }
    CHECK (files >= 2);
}

TEST_CASE ("tactus devices --capture records a service, and says why it cannot", "[capture][haply][cli][wires]")
{
    const TemporaryFolder folder;
    auto hand = makeDevice ({ { "driver", "sim" } }, {});
    REQUIRE (hand.device);
    auto service = host::FakeInverse3::make (0, std::move (hand.device));
    REQUIRE (service);
    const auto file = (folder / "arm.jsonl").string();
    const auto ran = test::runTactus (
        { "devices", "--capture", file, "--device", "haply:localhost:" + std::to_string ((*service)->port()), "--duration", "0.2" });
    INFO (ran.out + ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.out.find ("messages; ") != std::string::npos);
    const auto capture = captureAt (folder / "arm.jsonl");
    CHECK (capture.driver == "haply");
    CHECK (capture.lines.size() >= 2);
    CHECK ((*service)->counts().pushes == 0);   // nothing is driven

    const auto refused = test::runTactus ({ "devices", "--capture", file, "--device", "bhaptics:localhost:9", "--duration", "0.2" });
    CHECK (refused.status == 1);
    CHECK (refused.err.find ("refused") != std::string::npos);
    CHECK (refused.err.find ("capture/device") != std::string::npos);
    const auto nowhere = test::runTactus ({ "devices", "--capture", file, "--device", "haply:localhost:one" });
    CHECK (nowhere.status == 1);
    CHECK (nowhere.err.find ("no address") != std::string::npos);
}
