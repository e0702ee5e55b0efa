// SPDX-License-Identifier: MIT
// A recorded run is bit-identical when it runs again.

#include "support/chance_hand.hpp"
#include "support/no_allocation.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <support/property.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/find_hit.hpp>
#include <tactus/plan/find_param.hpp>
#include <tactus/run/log/graph_snapshot.hpp>
#include <tactus/run/log/run_log.hpp>
#include <tactus/run/log/run_log_reader.hpp>
#include <tactus/run/turn.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <sstream>
#include <thread>

using namespace tactus;

namespace
{
constexpr double rate_hz = 1000.0;
const GuardLimits limits {
    .max_force = 2.0,
    .max_slew = 500.0,
    .ramp = 0.01,
    .max_axis_effort = 0.7,
    .max_axis_slew = 100.0,
    .max_signal = 0.15,
    .max_impulse = 0.05,
    .impulse_window = 0.1,
    .dead_man_buttons = 0,
};

const DeviceLayout odd_layout { .axes = { "a", "b", "c" },
                                .efforts = { "b" },
                                .buttons = { "", "grip" },
                                .signal_inputs = 2,
                                .signal_outputs = 1,
                                .mechanics = { 0.07, 0.3 } };

/// A hand that exercises every field of a reading, including values that are not numbers.
class OddHand final : public Device
{
public:
    explicit OddHand (unsigned seed) : random (seed), hand (seed) {}

    void prepare (double) override {}
    void write (const Effort&) noexcept override {}
    DeviceLayout layout() const override { return odd_layout; }

    Reading read() noexcept override
    {
        auto r = hand.read();
        r.rotation = -0.0 * r.position;
        r.buttons = random() % 7 == 0 ? static_cast<std::uint32_t> (random()) : 0u;
        r.age = random() % 5 == 0 ? 1e-3 : 0.0;
        r.valid = random() % 50 != 0;
        if (! r.valid) r.fault = static_cast<ReadingFault> (random() % reading_faults.size());
        constexpr double odd[] { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity(), -0.0, 5e-324, 1.7976931348623157e308 };
        if (random() % 20 == 0) r.position[static_cast<int> (random() % 3)] = odd[random() % 6];
        if (random() % 20 == 0) r.true_velocity[static_cast<int> (random() % 3)] = odd[random() % 6];
        if (random() % 4 == 0) r.unrendered_force.x() = 1e-3 * static_cast<double> (random() % 1000);
        if (random() % 20 == 0) r.unrendered_torque[static_cast<int> (random() % 3)] = odd[random() % 6];
        for (unsigned i = 0; i < random() % 4; ++i)
            r.axes.set (static_cast<int> (i), random() % 20 == 0 ? odd[random() % 6] : 1e-3 * static_cast<double> (random() % 1000));
        if (random() % 2 == 0) r.signals = { 0.1 * static_cast<double> (random() % 3), -0.0 };
        return r;
    }

private:
    std::mt19937 random;
    test::ChanceHand hand;
};

struct Held final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return reading; }
    void write (const Effort&) noexcept override {}
    DeviceLayout layout() const override { return has; }

    Reading reading;
    DeviceLayout has;
};

graph::Graph anyGraph (unsigned seed)
{
    test::Sketch felt;
    felt.node ("hand", "device.position").node ("wall", "deform.plane").node ("drag", "friction.elasto_plastic").node ("motor", "device.force");
    felt.wire ("hand.position -> wall.position").wire ("hand.position -> drag.position").wire ("wall.resistance -> drag.normal_force");
    felt.wire ("wall.force -> motor.force").wire ("drag.force -> motor.force");
    felt.node ("bell", "vibration.modal", {}, { { "modes", Json::array ({ { { "frequency", 100.0 }, { "decay", 20.0 }, { "amplitude", 0.1 } } }) } });
    felt.wire ("bell.value -> motor.force.z");
    felt.node ("lever", "device.axis", {}, { { "axis", "b" } }).node ("brake", "device.effort", {}, { { "axis", "b" } });
    felt.node ("ear", "device.signal_in", {}, { { "channel", 2 } }).node ("mouth", "device.signal_out");
    felt.node ("grip", "device.button", {}, { { "button", "grip" } });
    felt.wire ("lever.axis -> brake.effort").wire ("ear.out -> mouth.in").wire ("grip.pressed -> mouth.in");
    return test::sideBySide (felt.graph, test::prefixed (test::randomGraph (seed, 10), "e_", "stylus"));
}

/// A digest of all recorded bits, and of the guarded efforts.
std::uint64_t digestOf (const Plan& plan)
{
    std::uint64_t digest = 0;
    const auto add = [&] (double v) { digest = (digest ^ (v != v ? 1u : std::bit_cast<std::uint64_t> (v))) * 0x100000001b3ull; };
    for (const auto& tap : plan.taps())
        add (*tap.value);
    for (const auto& role : plan.roles())
    {
        for (const double v : role.state->applied.force)
            add (v);
        for (const auto* channels : { &role.state->applied.axes, &role.state->applied.signals })
            for (const double v : *channels)
                add (v);
    }
    return digest;
}

/// A run with random edits, knob changes and halts, written to a log.
std::vector<std::uint64_t> run (const std::filesystem::path& file, unsigned seed, int ticks)
{
    std::mt19937 random (seed);
    const auto dice = [&] (unsigned sides) { return random() % sides == 0; };

    graph::History edits (anyGraph (seed));
    auto first = compile (edits.graph(), catalogue(), { .rate_hz = rate_hz }).plan;
    Engine engine (first);
    OddHand hand (seed);
    engine.attach ("stylus", hand, limits);
    auto log = *RunLog::create (file, { .program = "test", .rate_hz = rate_hz, .guards = { { "stylus", limits } }, .devices = { { "stylus", odd_layout } } });
    log->expect (first, snapshotOf (edits.graph(), {}, file.parent_path()));
    engine.report (log->journal());
    first.reset();

    const auto turn = [&] {
        const auto& plan = engine.newest();
        const auto i = random() % plan.instances().size();
        const auto& node = plan.flat().nodes[i];
        if (! plan.instances()[i].knobs || node.type->params.empty() || node.type->params[0].list) return;
        const auto param = engine.param (plan::nameOf (plan, i, 0));
        engine.set (*param, std::generate_canonical<double, 53> (random));
    };

    const auto hit = [&] {
        const auto& plan = engine.newest();
        for (std::size_t i = 0; i < plan.instances().size(); ++i)
            if (plan.instances()[i].is_struck && dice (3))
                static_cast<void> (tactus::strike (engine, plan::nameOfHit (plan, i, 0), 1.0 + std::generate_canonical<double, 53> (random)));
    };

    std::vector<std::uint64_t> digests;
    for (int k = 0; k < ticks; ++k)
    {
        while (dice (20))
        {
            auto waiting = engine.withdraw();
            (void)edits.perform (dice (3) ? test::randomRegrouping (random, edits.graph()) : test::randomEdit (random, edits.graph(), "e_", "stylus"));
            if (dice (4)) edits.undo();
            auto plan = compile (edits.graph(), catalogue(), { .rate_hz = rate_hz, .before = &engine.newest(), .withdrawn = waiting.get() }).plan;
            if (dice (3)) turn();   // after the edit is compiled, before its plan is submitted
            if (plan) log->expect (plan, snapshotOf (edits.graph(), {}, file.parent_path()));
            engine.submit (plan ? plan : waiting);
        }
        while (dice (10))
            turn();
        while (dice (10))
            hit();
        if (k >= ticks * 8 / 10 && k < ticks * 9 / 10) engine.halt();
        if (k == ticks * 9 / 10) engine.resume();
        if (dice (60)) engine.emergencyStop();
        if (dice (30)) engine.rearm();
        engine.tick();
        digests.push_back (digestOf (engine.plan()));
        if (dice (30)) REQUIRE (log->drain());
    }
    REQUIRE (log->finish());
    REQUIRE_FALSE (log->brokenAt());
    return digests;
}

int hits_again = 0;   // total over all runs from logs

/// Repeats the run from its log.
/// Long because the parts of a log line must be applied in one fixed order, and all of them act on the same engine.
std::vector<std::uint64_t> runAgain (const std::filesystem::path& file)
{
    auto log = *RunLogReader::open (file.string());
    std::unique_ptr<Engine> engine;
    Held hand;
    bool halting = false;
    std::vector<std::uint64_t> digests;
    for (;;)
    {
        const auto read = log.next();
        INFO ((read ? "" : describe (read.error())));
        REQUIRE (read);
        REQUIRE (*read);
        const RunTick& line = **read;
        while (digests.size() < line.tick)
        {
            if (halting) engine->halt();
            engine->tick();
            digests.push_back (digestOf (engine->plan()));
        }
        if (line.last != RunTick::Last::no) break;
        if (line.graph)
        {
            const auto graph = readSnapshot (*line.graph, file.parent_path());
            REQUIRE (graph);
            const CompileOptions options { .rate_hz = log.head().rate_hz, .before = engine ? &engine->newest() : nullptr, .kept = line.kept };
            auto plan = compile (*graph, catalogue(), options).plan;
            REQUIRE (plan);
            if (engine)
            {
                engine->submit (plan);
                engine->takeSubmitted();
            }
            else
            {
                engine = std::make_unique<Engine> (plan);
                hand.has = log.head().devices.at ("stylus");
                engine->attach ("stylus", hand, log.head().guards.at ("stylus"));
            }
        }
        for (const auto& [param, target] : line.turns)
        {
            const auto found = engine->param (param);
            REQUIRE (found.has_value());
            engine->set (*found, target);
        }
        for (const auto& [input, speed] : line.hits)
        {
            ++hits_again;
            const auto found = engine->hits (input);
            REQUIRE (found.has_value());
            engine->strike (found->front(), speed);
        }
        if (line.halt) halting = *line.halt;
        if (line.halt == false) engine->resume();
        if (halting) engine->halt();
        if (line.rearm) engine->rearm();
        if (line.emergency) engine->emergencyStop();
        for (const auto& [role, reading] : line.readings)
            hand.reading = reading;
    }
    REQUIRE_FALSE (log.isCutOff());
    return digests;
}
}   // namespace

TEST_CASE ("a run repeated from its log is bit-identical, no matter what was edited and turned", "[runlog][property]")
{
    const TemporaryFolder folder;
    const auto file = folder / GENERATE ("run.jsonl", "run.tlog");
    test::property ("any run", [&] {
        const auto seed = *rc::gen::arbitrary<unsigned>();
        std::filesystem::remove (file);   // a packed log is never replaced
        const auto live = run (file, seed, 600);
        RC_ASSERT (runAgain (file) == live);
    });
    CHECK (hits_again > 0);
}

namespace
{
std::vector<std::string> linesOf (const std::filesystem::path& file)
{
    LogLines lines { std::make_unique<std::ifstream> (file, std::ios::binary) };
    std::vector<std::string> all;
    for (auto line = lines.next(); line; line = lines.next())
        all.push_back (*line);
    CHECK_FALSE (lines.isDamaged());
    return all;
}
}   // namespace

TEST_CASE ("a packed log holds the same lines in fewer bytes, and is never replaced", "[runlog][packed]")
{
    const TemporaryFolder folder;
    const auto text = folder / "run.jsonl", packed = folder / "run.tlog";
    for (const unsigned seed : { 1u, 2u, 3u })
    {
        std::filesystem::remove (packed);
        REQUIRE (run (text, seed, 600) == run (packed, seed, 600));
        const auto lines = linesOf (text), same = linesOf (packed);
        REQUIRE (lines.size() > 600);
        CHECK (same.front().find ("\"packed\":true") != std::string::npos);
        const auto common = [] (const std::vector<std::string>& all) {   // ticks, readings and feeds: the ids in a graph are those of one run
            std::vector<std::string> some;
            for (const auto& line : all)
                if (const auto read = line.find (",\"read\":"); read != line.npos) some.push_back (line.substr (0, line.find (',')) + line.substr (read));
            return some;
        };
        CHECK (common (lines).size() > 500);
        CHECK ((common (lines) == common (same)));
        CHECK (lines.back() == same.back());
        CHECK (std::filesystem::file_size (packed) < std::filesystem::file_size (text));
    }
    const auto again = RunLog::create (packed, { .program = "test", .rate_hz = rate_hz });
    REQUIRE_FALSE (again);
    CHECK (again.error().id == "output/exists");
    CHECK (linesOf (packed).size() > 600);
}

TEST_CASE ("a packed log with a changed or a missing byte is read up to there, or refused", "[runlog][packed]")
{
    const TemporaryFolder folder;
    const auto file = folder / "run.tlog";
    (void)run (file, 5, 40);
    std::ifstream in (file, std::ios::binary);
    const std::string bytes { std::istreambuf_iterator<char> (in), {} };
    const auto head = bytes.find ('\n') + 1;
    const auto read = [] (const std::string& some) {
        auto reader = RunLogReader::open (std::make_unique<std::istringstream> (some), "some.tlog");
        if (! reader) return reader.error().id;
        for (;;)
        {
            const auto next = reader->next();
            if (! next) return next.error().id;
            if (! *next) return std::string (reader->isCutOff() ? "cut off" : "whole");
        }
    };
    CHECK (read (bytes) == "whole");
    std::map<std::string, int> ends;
    std::mt19937 random (1);
    for (auto i = head; i < bytes.size(); i += 1 + random() % 7)
    {
        CHECK (read (bytes.substr (0, i)) == "cut off");
        auto changed = bytes;
        changed[i] = static_cast<char> (random());
        ++ends[read (changed)];
    }
    CHECK (ends["log/value"] > 0);

    // 30 000 readings of a role in 60 KB: each would take as much memory as a true one.
    std::string many ("\0\4\xb0\xea\1\0\1a\0", 9);
    for (int i = 1; i < 30'000; ++i)
        many += std::string (2, '\0');
    REQUIRE (many.size() == 60'007);
    CHECK (read (bytes.substr (0, head) + "\xe7\xd4\3" + many) == "log/value");
}

TEST_CASE ("every reading is read back bit for bit", "[runlog]")
{
    const TemporaryFolder folder;
    const auto file = folder / GENERATE ("run.jsonl", "run.tlog");
    auto plan = test::Sketch {}.node ("hand", "device.position").compile().plan;
    Engine engine (plan);
    OddHand hand (7), same (7);
    engine.attach ("stylus", hand);
    auto log = *RunLog::create (file, { .program = "test", .rate_hz = 4000.0, .guards = { { "stylus", {} } } });
    log->expect (plan, snapshotOf (test::Sketch {}.node ("hand", "device.position").graph, {}, folder.path()));
    engine.report (log->journal());
    for (int k = 0; k < 2000; ++k)
        engine.tick();
    REQUIRE (log->finish());

    auto reader = *RunLogReader::open (file.string());
    CHECK (reader.head().program == "test");
    CHECK (reader.head().rate_hz == 4000.0);
    CHECK (reader.head().guards.at ("stylus") == GuardLimits {});
    int ticks = 0, different = 0;
    const auto sameBits = [] (double a, double b) {
        if (std::isnan (a)) return std::isnan (b);
        return std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b);
    };
    for (auto line = *reader.next(); line && line->last == RunTick::Last::no; line = *reader.next(), ++ticks)
    {
        REQUIRE (line->tick == static_cast<std::uint64_t> (ticks));
        const auto read = toLogged (same.read()), got = toLogged (line->readings.at (0).second);
        for (std::size_t i = 0; i < reading_size; ++i)
            different += ! sameBits (read.numbers[i], got.numbers[i]);
        different += ! std::ranges::equal (read.axes, got.axes, sameBits) || ! std::ranges::equal (read.signals, got.signals, sameBits);
    }
    CHECK (ticks == 2000);
    CHECK (different == 0);
}

TEST_CASE ("a log that cannot keep up ends where data was lost, and reports it", "[runlog]")
{
    const TemporaryFolder folder;
    const auto file = folder / "run.jsonl";
    const auto sketch = test::Sketch {}.node ("hand", "device.position");
    auto plan = sketch.compile().plan;
    Engine engine (plan);
    OddHand hand (7);
    engine.attach ("stylus", hand);
    auto log = *RunLog::create (file, { .program = "test", .rate_hz = 1.0, .guards = { { "stylus", {} } } });
    log->expect (plan, snapshotOf (sketch.graph, {}, folder.path()));
    engine.report (log->journal());
    std::uint64_t ticks = 0;
    for (; ! log->brokenAt() && ticks < 100'000; ++ticks)   // the log is not drained meanwhile
        engine.tick();
    REQUIRE (log->brokenAt() == ticks - 1);
    REQUIRE (log->drain());
    for (int k = 0; k < 10; ++k)
        engine.tick();
    REQUIRE (log->finish());
    CHECK (log->brokenAt() == ticks - 1);

    auto reader = *RunLogReader::open (file.string());
    std::optional<RunTick> last;
    std::uint64_t lines = 0;
    for (auto line = *reader.next(); line; line = *reader.next(), ++lines)
        last = line;
    REQUIRE (last);
    CHECK (last->last == RunTick::Last::broken);
    CHECK (last->tick == ticks - 1);
    CHECK (lines == ticks);
    CHECK_FALSE (reader.isCutOff());
}

TEST_CASE ("writing to a log from the tick thread allocates nothing and takes no lock", "[runlog]")
{
    if (! NoAllocation::watches)
    {
        WARN ("skipped: a sanitizer has its own allocator");
        return;
    }
    const TemporaryFolder folder;
    const auto sketch = test::Sketch {}.node ("hand", "device.position").node ("amp", "signal.gain");
    auto plan = sketch.compile().plan;
    Engine engine (plan);
    OddHand hand (7);
    engine.attach ("stylus", hand);
    auto log = *RunLog::create (folder / "run.jsonl", { .program = "test", .rate_hz = 4000.0, .guards = { { "stylus", {} } } });
    log->expect (plan, snapshotOf (sketch.graph, {}, folder.path()));
    engine.report (log->journal());
    const auto gain = *engine.param ("amp.gain");
    auto next = compile (sketch.graph, catalogue(), { .before = &engine.newest() }).plan;
    log->expect (next, snapshotOf (sketch.graph, {}, folder.path()));
    engine.submit (next);
    int allocations = 0, locks = 0;
    {
        const NoAllocation watch;
        for (int k = 0; k < 20'000; ++k)   // continues long after the log is full
        {
            engine.set (gain, 1e-3 * k);
            engine.tick();
        }
        engine.halt();
        engine.tick();
        allocations = watch.allocations();
        locks = watch.locks();
    }
    CHECK (allocations == 0);
    CHECK (locks == 0);
    CHECK (log->brokenAt());
}
