// SPDX-License-Identifier: MIT
// The driver of vests against a fake of bHaptics Player. Both are ours; no vest and no Player has been tried.

#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <host/bhaptics/dots.hpp>
#include <host/bhaptics/fake_player.hpp>
#include <host/device_plugins/open_plugin_device.hpp>
#include <host/device_plugins/plugin_device.hpp>
#include <vest_map.hpp>

#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/text/json_text.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace tactus;
using namespace std::chrono_literals;
using host::Dots;
using Fault = host::FakePlayer::Fault;

namespace
{
template <typename F>
bool eventually (F&& so)
{
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (! so())
    {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for (200us);
    }
    return true;
}

Dots dotsOf (const Json& description = Json::object())
{
    auto dots = Dots::read (readJson (vest_map).root, description);
    INFO ((dots ? std::string() : dots.error().text));
    REQUIRE (dots);
    return std::move (*dots);
}

/// A Player with a vest, and the driver on it.
struct Vest
{
    explicit Vest (Json more = Json::object())
    {
        auto made = host::FakePlayer::make (0);
        REQUIRE (made);
        player = std::move (*made);
        more["driver"] = "bhaptics";
        more["port"] = "localhost:" + std::to_string (player->port());
        description = std::move (more);
        opened = host::openPluginDevice (description);
        INFO (test::text (opened.messages));
        REQUIRE (opened.device);
        device = dynamic_cast<host::PluginDevice*> (opened.device.get());
        REQUIRE (device != nullptr);
        device->prepare (1e-3);
    }

    /// One tick with a signal on the first channel if the reading is valid; true if it is.
    bool tick (double amount)
    {
        reading = device->read();
        Effort effort;
        if (reading.valid) effort.signals.set (0, amount);
        device->write (effort);
        return reading.valid;
    }

    bool shows()
    {
        return eventually ([&] {
            tick (0.5);
            return player->intensity ("VestFront", 0) == 50;
        });
    }

    std::unique_ptr<host::FakePlayer> player;   // ends after the device
    Json description;
    MadeDevice opened;
    host::PluginDevice* device = nullptr;
    Reading reading;
};
/// `tactus` with these words, without output. Killed at the end.
struct Program
{
    explicit Program (std::vector<std::string> words)
    {
        words.insert (words.begin(), TACTUS_PROGRAM);
        std::vector<char*> all;
        for (auto& word : words)
            all.push_back (word.data());
        all.push_back (nullptr);
        posix_spawn_file_actions_t files;
        posix_spawn_file_actions_init (&files);
        for (const int descriptor : { 1, 2 })
            posix_spawn_file_actions_addopen (&files, descriptor, "/dev/null", O_WRONLY, 0);
        REQUIRE (posix_spawn (&id, all[0], &files, nullptr, all.data(), environ) == 0);
        posix_spawn_file_actions_destroy (&files);
    }

    ~Program()
    {
        ::kill (id, SIGKILL);
        ::waitpid (id, nullptr, 0);
    }

    Program (const Program&) = delete;
    Program& operator= (const Program&) = delete;

    pid_t id = 0;
};
}   // namespace

TEST_CASE ("signals drive the motors of their channel, places those around them, and a force those that it presses", "[bhaptics][wires]")
{
    auto dots = dotsOf();
    CHECK (dots.channels() == 8);
    CHECK (dots.message().empty());
    dots.take (std::vector<double> { 0.25 }, Vec3::Zero());
    dots.take (std::vector<double> { -0.5 }, Vec3::Zero());   // the largest since the last message counts
    CHECK (dots.message()
           == R"({"Submit":[{"Type":"frame","Key":"tactus_VestFront","Frame":{"position":"VestFront","dotPoints":[{"index":0,"intensity":50},)"
              R"({"index":1,"intensity":50},{"index":4,"intensity":50},{"index":5,"intensity":50}],"pathPoints":[],"durationMillis":100}}]})");
    CHECK (dots.isShowing());
    CHECK (dots.message() == R"({"Submit":[{"Type":"turnOff","Key":"tactus_VestFront"}]})");
    CHECK (dots.message().empty());

    // 5 N towards the person, so from the front, at the full force of 10 N.
    dots.take ({}, Vec3 (3.0, -5.0, 2.0));
    const auto pressed = dots.message();
    CHECK (pressed.find ("VestBack") == pressed.npos);
    CHECK (pressed.find (R"({"index":19,"intensity":50})") != pressed.npos);
    CHECK (dots.silence() == R"({"Submit":[{"Type":"turnOff","Key":"tactus_VestFront"},{"Type":"turnOff","Key":"tactus_VestBack"}]})");
    CHECK (dots.message().empty());

    auto around = dotsOf ({ { "channels", Json::array ({ { { "at", Json::array ({ 0.12, 0.11, 0.2 }) }, { "radius", 0.1 } } }) }, { "full_force", 1 } });
    around.take (std::vector<double> { 1.0 }, Vec3::Zero());
    const auto text = around.message();
    CHECK (text.find (R"({"index":3,"intensity":100})") != text.npos);
    CHECK (text.find (R"({"index":2,"intensity":25})") != text.npos);
    CHECK (text.find (R"({"index":7,"intensity":30})") != text.npos);
    CHECK (text.find (R"("index":0)") == text.npos);
}

TEST_CASE ("whatever the values, a message has intensities from 0 to 100 and is JSON", "[bhaptics][wires][property]")
{
    test::property ("any signals and any force", [] {
        auto dots = dotsOf();
        for (int k = 0; k < 3; ++k)
        {
            std::vector<double> signals (*rc::gen::inRange<std::size_t> (0, 40));
            for (auto& s : signals)
                s = *rc::gen::arbitrary<double>();
            dots.take (signals, Vec3 (*rc::gen::arbitrary<double>(), *rc::gen::arbitrary<double>(), *rc::gen::arbitrary<double>()));
            const auto text = dots.message();
            if (text.empty()) continue;
            const auto read = readJson (text);
            RC_ASSERT (read.messages.empty());
            for (std::size_t i = 0; i < read.root["Submit"].size(); ++i)
            {
                const auto& one = read.root["Submit"][i];
                if (one["Type"] == Json ("turnOff")) continue;
                for (const auto& point : one["Frame"]["dotPoints"])
                    RC_ASSERT (point["intensity"].get<double>() >= 1.0 && point["intensity"].get<double>() <= 100.0);
            }
        }
    });
}

TEST_CASE ("what is wrong with the channels of a vest is said", "[bhaptics][wires]")
{
    const auto problem = [] (const char* channels) {
        const auto read = Dots::read (readJson (vest_map).root, { { "channels", readJson (channels).root } });
        return read ? std::string() : read.error().text;
    };
    CHECK (problem (R"([{"dots": {"VestFront": [19], "VestBack": [0]}}])").empty());
    CHECK (problem ("[]").find ("1 to 32") != std::string::npos);
    CHECK (problem ("7").find ("1 to 32") != std::string::npos);
    CHECK (problem (R"([{"dots": {"Head": [0]}}])").find ("channel 1 names a place") != std::string::npos);
    CHECK (problem (R"([{"dots": {"VestFront": [0]}}, {"dots": {"VestFront": [20]}}])").find ("channel 2 names a motor") != std::string::npos);
    CHECK (problem (R"([{"at": [0, 0], "radius": 1}])").find ("radius") != std::string::npos);
    CHECK (problem (R"([{"at": [0, 0, 9], "radius": 0.1}])").find ("no motor") != std::string::npos);
    CHECK (problem (R"([{"loud": true}])").find ("neither") != std::string::npos);
    CHECK_FALSE (Dots::read (readJson (vest_map).root, { { "full_force", -1 } }));
}

namespace
{
/// The vest of a bench in a run. Each tick waits until its values have been taken, and if they make a message, until the Player has it.
struct OnTheBench final : Device
{
    explicit OnTheBench (Vest& v) : vest (v) {}

    void prepare (double) override {}

    Reading read() noexcept override
    {
        auto reading = vest.device->read();
        reading.age = 0.0;   // a busy machine does not end this run
        reading.valid = true;
        return reading;
    }

    void write (const Effort& guarded) noexcept override
    {
        const auto writes = vest.device->counts().writes;
        const auto heard = vest.player->counts().heard;
        vest.device->write (guarded);
        std::vector<double> signals (8);
        for (int c = 0; c < 8; ++c)
            signals[static_cast<std::size_t> (c)] = guarded.signals[c];
        dots.take (signals, guarded.force);
        const auto message = dots.message();
        if (! message.empty()) expected.push_back (message);
        works = works && eventually ([&] { return vest.device->counts().writes > writes && (message.empty() || vest.player->counts().heard > heard); });
    }

    DeviceLayout layout() const override { return vest.device->layout(); }

    Vest& vest;
    Dots dots = dotsOf();
    std::vector<std::string> expected;
    bool works = true;
};

/// False if the computer stood still for so long that the vest was brought to rest meanwhile.
bool showsAll (const graph::Graph& graph, const std::shared_ptr<Plan>& plan)
{
    constexpr std::size_t ticks = 3000;
    auto hand = makeDevice (*graph.device ("stylus"), {});
    REQUIRE (hand.device);
    Vest vest { { { "rate", 1000 } } };
    REQUIRE (eventually ([&] { return vest.tick (0.0); }));
    const auto before = vest.player->heard().size();
    OnTheBench there { vest };
    Engine engine { plan };
    engine.attach ("stylus", *hand.device, {});
    engine.attach ("vest", there, vest.opened.limits);
    for (std::size_t k = 0; k < ticks && there.works; ++k)
        engine.tick();
    if (vest.device->counts().silences > 0 || vest.device->counts().departures > 0) return false;
    INFO (vest.device->trouble());
    REQUIRE (there.works);

    auto heard = vest.player->heard();
    heard.erase (heard.begin(), heard.begin() + static_cast<std::ptrdiff_t> (before));
    CHECK (heard.size() > ticks / 4);
    CHECK (heard == there.expected);
    CHECK (vest.player->counts().refused == 0);
    return true;
}
}   // namespace

TEST_CASE ("dry wood on a vest: each message that the Player hears is that of the run after encoding", "[bhaptics][wires]")
{
    auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    const auto text = R"({ "format": "tactus-graph", "version": 2, "name": "vest", "rate_hz": 1000,
      "nodes": {
        "hand": { "type": "device.position", "role": "stylus" },
        "board": { "type": "deform.plane", "params": { "stiffness": 2000 } },
        "drag": { "type": "friction.elasto_plastic" },
        "chest": { "type": "device.signal_out", "role": "vest", "settings": { "channel": 1 } },
        "back": { "type": "device.signal_out", "role": "vest", "settings": { "channel": 6 } },
        "push": { "type": "device.force", "role": "vest" } },
      "wires": [ "hand.position -> board.position", "hand.position -> drag.position", "board.resistance -> drag.normal_force",
        "drag.force.x -> chest.in", "board.resistance -> back.in", "drag.force.x -> push.force.y" ] })";
    auto both = readGraph (text);
    INFO (test::text (both.messages));
    both.graph.devices = graph.devices;
    const auto compiled = compile (both.graph, catalogue(), { .rate_hz = 1000.0 });
    INFO (test::text (compiled.messages));
    REQUIRE (compiled.plan);
    bool all = false;
    for (int tries = 0; tries < 10 && ! all; ++tries)
        all = showsAll (graph, compiled.plan);
    CHECK (all);
}

TEST_CASE ("a vest shows what a graph asks for, and falls silent when the program ends", "[bhaptics][wires][safety]")
{
    Vest vest;
    CHECK (vest.opened.limits.max_signal == 1.0);
    CHECK (vest.device->layout().signal_outputs == 8);
    REQUIRE (vest.shows());
    CHECK (vest.player->intensity ("VestFront", 2) == 0);
    CHECK (vest.reading.fault == ReadingFault::none);

    // The program stops offering values: the vest is brought to rest, and then only asked whether it is there.
    CHECK (eventually ([&] { return vest.player->isSilent(); }));
    CHECK (eventually ([&] { return vest.device->counts().silences == 1; }));
    CHECK (vest.shows());
    vest.opened.device.reset();
    CHECK (vest.player->isSilent());
    CHECK (vest.player->counts().refused == 0);
    CHECK (vest.player->counts().largest == 50);
}

TEST_CASE ("a program that is killed or frozen while it drives a vest leaves it silent", "[bhaptics][wires][safety]")
{
    const auto signal = GENERATE (SIGKILL, SIGSTOP);
    auto player = host::FakePlayer::make (0);
    REQUIRE (player);
    const TemporaryFolder folder;
    const auto graph = (folder / "buzz.json").string();
    std::ofstream (graph) << R"({ "format": "tactus-graph", "version": 2, "name": "buzz", "rate_hz": 1000,
      "nodes": { "half": { "type": "signal.constant", "params": { "value": 0.5 } },
                 "motor": { "type": "device.signal_out", "role": "vest", "settings": { "channel": 1 } } },
      "wires": ["half.out -> motor.in"] })";
    const Program play { { "play", graph, "--device", "vest=bhaptics:localhost:" + std::to_string ((*player)->port()), "--session", "off", "--osc", "off" } };
    REQUIRE (eventually ([&] { return (*player)->intensity ("VestFront", 0) == 50; }));
    ::kill (play.id, signal);
    CHECK (eventually ([&] { return (*player)->isSilent(); }));
    CHECK ((*player)->counts().refused == 0);
}

TEST_CASE ("a Player that fails leaves the vest silent, and is found again", "[bhaptics][wires][safety]")
{
    const auto fault = GENERATE (Fault::silent, Fault::restart, Fault::garbage);
    Vest vest;
    REQUIRE (vest.shows());
    vest.player->fail (fault);
    CHECK (eventually ([&] {
        vest.tick (0.5);
        return vest.device->counts().departures > 0;
    }));
    vest.player->fail (Fault::none);
    CHECK (eventually ([&] { return vest.player->isSilent(); }));
    CHECK (eventually ([&] { return vest.tick (0.0); }));
    CHECK (vest.shows());
    CHECK (vest.player->counts().largest <= 100);
}

TEST_CASE ("a vest that the Player has lost is not trusted", "[bhaptics][wires][safety]")
{
    Vest vest;
    REQUIRE (vest.shows());
    vest.player->fail (Fault::unworn);
    CHECK (eventually ([&] {
        vest.tick (0.5);
        return vest.reading.fault == ReadingFault::not_driven && ! vest.reading.valid;
    }));
    CHECK (eventually ([&] {
        vest.tick (0.5);
        return vest.player->isSilent();
    }));
    vest.player->fail (Fault::none);
    CHECK (vest.shows());
}

TEST_CASE ("at most one message for a vest is on its way, and no more than its rate", "[bhaptics][wires]")
{
    Vest vest { { { "rate", 10 } } };
    REQUIRE (eventually ([&] { return vest.tick (0.0); }));
    const auto before = vest.player->counts().frames;
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < 300; ++k)
    {
        vest.tick (0.5);
        std::this_thread::sleep_for (1ms);
    }
    const auto seconds = std::chrono::duration<double> (std::chrono::steady_clock::now() - begin).count();
    CHECK (static_cast<double> (vest.player->counts().frames - before) <= 2.0 + 10.0 * seconds);
    CHECK (vest.device->counts().departures == 0);
}

TEST_CASE ("what is wrong with a description of a vest, or with its Player, is said", "[bhaptics][wires]")
{
    Vest vest;
    const auto problem = [&] (const char* key, const Json& value) {
        auto d = vest.description;
        d[key] = value;
        return test::text (host::openPluginDevice (d).messages);
    };
    CHECK (problem ("port", "localhost:one").find ("written as") != std::string::npos);
    CHECK (problem ("port", "localhost:9").find ("refused") != std::string::npos);
    CHECK (problem ("rate", 0).find ("messages per second") != std::string::npos);
    CHECK (problem ("channels", 3).find ("1 to 32") != std::string::npos);
    CHECK (problem ("colour", "red").find ("colour") != std::string::npos);
    CHECK_FALSE (host::FakePlayer::make (vest.player->port()));
}
