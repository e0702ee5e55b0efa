// SPDX-License-Identifier: MIT
// The driver of vests against a fake of bHaptics Player. Both are ours; no vest and no Player has been tried.

#include "host/drivers/websocket/service_bench.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/drivers/bhaptics/fake_player.hpp>
#include <host/drivers/bhaptics/vest.hpp>
#include <host/drivers/bhaptics/vest_messages.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::Patience;
using Fault = host::FakePlayer::Fault;

namespace
{
/// A Player with a vest, and the driver on it.
struct Vest : test::ServiceBench<host::FakePlayer>
{
    explicit Vest (Patience patience, const Json& more = Json::object(), double silence_s = 60.0)
        : ServiceBench (made(), "bhaptics", host::patient_bhaptics_driver, patience, more, silence_s)
    {
    }

    /// One tick with a signal on the first channel if the reading is valid; true if it is.
    bool tick (double amount)
    {
        return ServiceBench::tick ([&] (Effort& effort) { effort.signals.set (0, amount); });
    }

    /// True as soon as the Player drives a motor with a half from now on.
    bool shows()
    {
        const auto before = service->counts().frames;
        return eventually ([&] {
            tick (0.5);
            return service->counts().frames > before && service->intensity ("VestFront", 0) == 50;
        });
    }

private:
    static std::unique_ptr<host::FakePlayer> made()
    {
        auto made = host::FakePlayer::make (0);
        REQUIRE (made);
        return std::move (*made);
    }
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
        const auto heard = vest.service->counts().heard;
        vest.device->write (guarded);
        std::vector<double> signals (8);
        for (int c = 0; c < 8; ++c)
            signals[static_cast<std::size_t> (c)] = guarded.signals[c];
        dots.take (signals, guarded.force);
        const auto message = dots.message();
        if (! message.empty()) expected.push_back (message);
        works = works && eventually ([&] { return vest.device->counts().writes > writes && (message.empty() || vest.service->counts().heard > heard); });
    }

    DeviceLayout layout() const override { return vest.device->layout(); }

    Vest& vest;
    host::Dots dots = host::VestSettings::read (Json::object()).value().dots;
    std::vector<std::string> expected;
    bool works = true;
};
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

    constexpr std::size_t ticks = 3000;
    auto hand = makeDevice (*graph.device ("stylus"), {});
    REQUIRE (hand.device);
    Vest vest { Patience::ample, { { "rate", 1000 } } };
    REQUIRE (eventually ([&] { return vest.tick (0.0); }));
    const auto before = vest.service->heard().size();
    OnTheBench there { vest };
    Engine engine { compiled.plan };
    engine.attach ("stylus", *hand.device, {});
    engine.attach ("vest", there, vest.opened.limits);
    for (std::size_t k = 0; k < ticks && there.works; ++k)
        engine.tick();
    INFO (vest.device->trouble());
    REQUIRE (there.works);

    auto heard = vest.service->heard();
    heard.erase (heard.begin(), heard.begin() + static_cast<std::ptrdiff_t> (before));
    CHECK (heard.size() > ticks / 4);
    CHECK (heard == there.expected);
    CHECK (vest.service->counts().refused == 0);
}

TEST_CASE ("a vest shows what a graph asks for, and falls silent when the program ends", "[bhaptics][wires][safety]")
{
    Vest vest { Patience::ample, Json::object(), 0.1 };
    const auto silences = vest.device->counts().silences;
    CHECK (vest.opened.limits.max_signal == 1.0);
    CHECK (vest.device->layout().signal_outputs == 8);
    REQUIRE (vest.shows());
    CHECK (vest.service->intensity ("VestFront", 2) == 0);
    CHECK (vest.reading.fault == ReadingFault::none);

    // The program stops offering values: the vest is brought to rest, and then only asked whether it is there.
    CHECK (eventually ([&] { return vest.service->isSilent(); }));
    CHECK (eventually ([&] { return vest.device->counts().silences > silences; }));
    CHECK (vest.shows());
    vest.opened.device.reset();
    CHECK (vest.service->isSilent());
    CHECK (vest.service->counts().refused == 0);
    CHECK (vest.service->counts().largest == 50);
}

TEST_CASE ("a stop silences a vest at once, whatever the rate of its messages, and nothing from before it is shown", "[bhaptics][wires][safety]")
{
    Vest vest { Patience::ample, { { "rate", 10 } } };
    REQUIRE (vest.shows());
    const auto writesTwice = [&] (auto&& tick) {
        const auto writes = vest.device->counts().writes;
        return eventually ([&] {
            tick();
            return vest.device->counts().writes >= writes + 2;
        });
    };
    // On a busy computer, a message may become due before the stop, so there are many attempts.
    const bool is_silenced = eventually ([&] {
        const auto shown = vest.service->counts().frames;
        REQUIRE (eventually ([&] {
            vest.tick (0.5);
            return vest.service->counts().frames > shown;
        }));
        const auto frames = vest.service->counts().frames, offs = vest.service->counts().turned_off;
        REQUIRE (writesTwice ([&] { vest.tick (1.0); }));   // waits for the next message
        const auto stop = [&] {
            vest.device->read();
            vest.device->withhold();
            vest.device->write ({});
        };
        REQUIRE (writesTwice (stop));
        const auto at_stop = vest.device->counts().readings;
        REQUIRE (eventually ([&] {
            stop();
            return vest.service->counts().turned_off > offs;
        }));
        const bool is_prompt = vest.device->counts().readings <= at_stop + 2;   // answers: until a message is due, it asks every 20 ms
        REQUIRE (eventually ([&] {
            stop();
            return vest.device->counts().readings > at_stop + 8;   // what was on its way has arrived
        }));
        return is_prompt && vest.service->counts().frames == frames;
    });
    CHECK (is_silenced);
    CHECK (vest.service->isSilent());
    CHECK (vest.shows());
}

TEST_CASE ("the limit of signals holds for each motor of a vest, whatever drives it", "[bhaptics][wires][safety]")
{
    const auto front = Json { { "dots", { { "VestFront", Json::array ({ 0, 1 }) } } } };
    Vest vest { Patience::ample, { { "rate", 1000 }, { "full_force", 4 }, { "channels", Json::array ({ front, front, front }) } } };
    CHECK (vest.opened.limits.max_force == 4.0);
    vest.device->limitSignals (0.25, GuardLimits::none);
    const auto drives = [&] (const Effort& all, std::uint64_t more) {
        const auto before = vest.service->counts().frames;
        return eventually ([&] {
            static_cast<test::ServiceBench<host::FakePlayer>&> (vest).tick ([&] (Effort& effort) { effort = all; });
            return vest.service->counts().frames > before + more;
        });
    };
    REQUIRE (drives ({ .force = { 0.0, -4.0, 0.0 } }, 20));
    CHECK (vest.service->counts().largest == 25);
    REQUIRE (drives ({ .signals = { 0.25, 0.25, 0.25 } }, 20));
    CHECK (vest.service->counts().largest == 25);
    vest.device->limitSignals (0.117, GuardLimits::none);   // from now on
    REQUIRE (drives ({ .force = { 0.0, -4.0, 0.0 }, .signals = { 0.117 } }, 4));
    CHECK (vest.service->intensity ("VestFront", 0) == 11);
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
    Vest vest { fault == Fault::silent ? Patience::promised : Patience::ample };
    REQUIRE (vest.shows());
    vest.service->fail (fault);
    CHECK (eventually ([&] {
        vest.tick (0.5);
        return vest.device->counts().departures > 0;
    }));
    vest.service->fail (Fault::none);
    CHECK (eventually ([&] { return vest.service->isSilent(); }));
    CHECK (eventually ([&] { return vest.tick (0.0); }));
    CHECK (vest.shows());
    CHECK (vest.service->counts().largest <= 100);
}

TEST_CASE ("a vest that the Player has lost is not trusted", "[bhaptics][wires][safety]")
{
    Vest vest { Patience::ample };
    REQUIRE (vest.shows());
    vest.service->fail (Fault::unworn);
    CHECK (eventually ([&] {
        vest.tick (0.5);
        return vest.reading.fault == ReadingFault::not_driven && ! vest.reading.valid;
    }));
    CHECK (eventually ([&] {
        vest.tick (0.5);
        return vest.service->isSilent();
    }));
    vest.service->fail (Fault::none);
    CHECK (vest.shows());
}

TEST_CASE ("a vest is driven by one role", "[bhaptics][wires][safety]")
{
    Vest vest { Patience::ample };
    const int port = vest.service->port();
    CHECK_FALSE (test::lockOn (port));
    vest.opened.device.reset();
    const auto other = test::lockOn (port);
    REQUIRE (other);
    const auto refused = host::openPluginDevice ({ { "driver", "bhaptics" }, { "port", std::to_string (port) } });
    CHECK (test::text (refused.messages).find ("another role or another instance of Tactus is using it") != std::string::npos);
}

TEST_CASE ("at most one message for a vest is on its way, and no more than its rate", "[bhaptics][wires]")
{
    Vest vest { Patience::ample, { { "rate", 10 } } };
    REQUIRE (eventually ([&] { return vest.tick (0.0); }));
    const test::Stopwatch watch;
    const auto before = vest.service->counts().frames;
    for (int k = 0; k < 300; ++k)
    {
        vest.tick (0.5);
        test::letPass (1ms);
    }
    const auto sent = vest.service->counts().frames - before;   // before the clock is read: the rate is never more than it seems
    CHECK (static_cast<double> (sent) <= 2.0 + 10.0 * watch.s());
    CHECK (vest.device->counts().departures == 0);
}

TEST_CASE ("what is wrong with a description of a vest, or with its Player, is said", "[bhaptics][wires]")
{
    Vest vest { Patience::ample };
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
    CHECK_FALSE (host::FakePlayer::make (vest.service->port()));
}
