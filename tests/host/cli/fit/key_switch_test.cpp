// SPDX-License-Identifier: GPL-3.0-or-later
// Keys: measured force curves of real switches turned into graphs, and the made-up key in the presets. Plots go to
// build/figures/.

#include "host/cli/program.hpp"

#include "support/rig.hpp"
#include "support/sketch.hpp"

#include <host/tools/figures/plot.hpp>
#include <host/tools/fitting/fit_presets.hpp>
#include <support/property.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

using namespace tactus;

namespace
{
constexpr double noise = 2e-3;   // noise of the gauge that measured the switches, in N
constexpr double um = 1e-6, mN = 1e-3, mJ = 1e-3, gram_force = 9.80665e-3;

std::string figure (const std::string& name)
{
    const auto folder = std::filesystem::path (TACTUS_SOURCE_DIR) / "build" / "figures";
    std::filesystem::create_directories (folder);
    return (folder / name).string();
}

/// A finger at a given depth; it records the force on it.
class Finger final : public Device
{
public:
    double depth = 0.0, force = 0.0;   // m, N upwards

    void prepare (double) override {}
    Reading read() noexcept override
    {
        Reading r;
        r.position = { 0.0, 0.0, -depth };
        return r;
    }
    void write (const Effort& e) noexcept override { force = e.force.z(); }
};

/// A key under a finger that moves in small steps.
class PressedKey
{
public:
    PressedKey (const graph::Graph& g, double step_m, const std::vector<plan::Override>& overrides = {}) : step (step_m)
    {
        auto compiled = compile (g, catalogue(), { .overrides = overrides });
        INFO (test::text (compiled.messages));
        REQUIRE (compiled.plan);
        engine = std::make_unique<Engine> (compiled.plan);
        engine->attach ("finger", finger);
        engine->tick();
    }

    /// All steps have the same length, so that they hit the kinks of the laws exactly and the sum below is exact.
    void to (long place)
    {
        while (at != place)
        {
            at += at < place ? 1 : -1;
            const double before = finger.force, from = finger.depth;
            finger.depth = step * static_cast<double> (at);
            engine->tick();
            work += 0.5 * (before + finger.force) * (finger.depth - from);
            least = std::min (least, finger.force);
        }
    }

    /// Presses the key and returns to above it.
    void follow (const std::vector<long>& places)
    {
        for (const long place : places)
            to (place);
        to (-2);
    }

    double force() const noexcept { return finger.force; }

    double work = 0.0;    ///< work done by the finger, in J
    double least = 0.0;   ///< least force in N; below 0 the key would pull

private:
    Finger finger;
    std::unique_ptr<Engine> engine;
    double step;   // m
    long at = 0;   // steps
};

/// Positions that a restless finger visits in turn, in steps.
std::vector<long> randomStrokes (double deepest, double step)
{
    const int count = *rc::gen::inRange (1, 12);
    return *rc::gen::container<std::vector<long>> (static_cast<std::size_t> (count), rc::gen::inRange (-10L, std::lround (deepest / step)));
}

/// The largest error of a sum over steps: once per stroke, it misses the kink where a bristle of this stiffness begins to slip.
double missed (std::size_t strokes, double stiffness, double step) { return static_cast<double> (strokes + 1) * stiffness * step * step / 8.0 + 1e-12; }

/// Tolerance in N: a bristle may exceed its bound by a relative 1e-9 before it slips.
constexpr double slack = 2e-9;

/// A random key. It may have kinks anywhere, a falling force, and any loss that does not make the force on the way up negative.
SwitchLoop randomLoop()
{
    SwitchLoop loop { { 0.0 }, { 0.0 }, { 0.0 } };
    const int points = *rc::gen::inRange (2, 12);
    for (int i = 0; i < points; ++i)
    {
        loop.travel.push_back (loop.travel.back() + 1 * um * *rc::gen::inRange (20, 600));
        loop.press.push_back (1 * mN * *rc::gen::inRange (0, 1000));
        loop.release.push_back (loop.press.back() * 0.01 * *rc::gen::inRange (0, 101));
    }
    return loop;
}

double at (const std::vector<double>& x, const std::vector<double>& y, double where) { return Curve { x, y }(where); }

/// A recording, row by row.
struct Measured
{
    std::vector<double> x, force;   // m, N
    std::size_t turn = 0;           // first row of the release

    std::vector<double> part (const std::vector<double>& v, bool up) const
    {
        const auto middle = v.begin() + static_cast<std::ptrdiff_t> (turn);
        return up ? std::vector<double> (middle, v.end()) : std::vector<double> (v.begin(), middle);
    }
};

Measured readMeasured (const std::filesystem::path& path)
{
    const auto table = readTable (path);
    REQUIRE (table);
    Measured m;
    for (std::size_t r = 0; r < table->rows(); ++r)
    {
        m.x.push_back (um * table->at (r, *table->column ("x_um")));
        m.force.push_back (gram_force * table->at (r, *table->column ("force_gf")));
    }
    m.turn = static_cast<std::size_t> (std::ranges::max_element (m.x) - m.x.begin()) + 1;
    return m;
}

/// The work done by a finger that follows the measured positions.
double workAlong (const std::vector<double>& x, const std::vector<double>& force)
{
    double w = 0.0;
    for (std::size_t i = 1; i < x.size(); ++i)
        w += 0.5 * (force[i] + force[i - 1]) * (x[i] - x[i - 1]);
    return w;
}
}   // namespace

// Long because each key is one scenario: import, stroke, comparison with the measurement, and a plot of both.
TEST_CASE ("three key switches, measured both ways, are felt as measured wherever a passive key can follow", "[data]")
{
    const auto folder = test::sharedData ("buttons_switchcurves");
    if (folder.empty()) return;

    host::Figure picture { .title = "Key switches, measured and synthesised" };
    for (const std::string name : { "Cherry-MX-Red", "Cherry-MX-Blue-RGB", "Cherry-MX-Hyperglide-Brown" })
    {
        INFO (name);
        const test::Scratch scratch;
        const auto curve = folder + "/" + name + ".csv", key = scratch.path ("key.json");
        const auto made = test::runTactus ({ "fit", "switch", curve, "-o", key });
        INFO (made.err);
        REQUIRE (made.status == 0);

        const auto measured = readMeasured (curve);
        const int deepest = static_cast<int> (std::lround (*std::ranges::max_element (measured.x) / um));
        auto hand = TableWriter::create (scratch.path ("hand.csv"), std::vector<std::string> { "t", "x", "y", "z" });
        REQUIRE (hand);
        for (int i = 0; i <= 2 * deepest; ++i)
            REQUIRE (hand->row (std::vector { i / 4000.0, 0.0, 0.0, -um * (i <= deepest ? i : 2 * deepest - i) }));
        REQUIRE (hand->commit());

        const auto ran = test::runTactus ({ "render", key, "--device", "finger=trace:" + scratch.path ("hand.csv"),
                                            "--record", "key.depth,motor.force.z", "--out", scratch.path ("out.csv") });
        INFO (ran.err);
        REQUIRE (ran.status == 0);
        const auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
        REQUIRE (table);
        REQUIRE (table->rows() == static_cast<std::size_t> (2 * deepest + 1));
        std::vector<double> depth, force;
        for (std::size_t r = 0; r < table->rows(); ++r)
        {
            depth.push_back (table->at (r, 1));
            force.push_back (table->at (r, 2));
        }

        // Where the force was higher on the way up than on the way down, the meter's position was wrong: no passive key
        // can follow both curves there.
        const auto down_x = measured.part (measured.x, false), down = measured.part (measured.force, false);
        auto up_x = measured.part (measured.x, true), up = measured.part (measured.force, true);
        std::ranges::reverse (up_x);
        std::ranges::reverse (up);
        double squares = 0.0, worst = 0.0, all_squares = 0.0, passive_loss = 0.0;
        int followed = 0;
        for (std::size_t i = 0; i < measured.x.size(); ++i)
        {
            const double x = measured.x[i], difference = at (down_x, down, x) - at (up_x, up, x);
            const auto row = static_cast<std::size_t> (std::lround (x / um));
            const double off = force[i < measured.turn ? row : force.size() - 1 - row] - measured.force[i];
            REQUIRE (depth[row] == Approx (x).margin (1e-12));
            all_squares += off * off;
            if (i > 0 && i < measured.turn) passive_loss += std::max (0.0, difference) * (x - measured.x[i - 1]);
            if (difference < -noise) continue;
            ++followed;
            squares += off * off;
            worst = std::max (worst, std::abs (off));
        }
        const auto rows = static_cast<double> (measured.x.size());
        const double rms = std::sqrt (squares / followed), all_rms = std::sqrt (all_squares / rows);
        const double loss = workAlong (depth, force), measured_loss = workAlong (measured.x, measured.force);
        WARN (name << ": within " << rms / mN << " mN rms, " << worst / mN << " mN at most over " << 100.0 * followed / rows
                   << " % of the rows (" << all_rms / mN << " mN rms over all); loses " << loss / mJ << " mJ, measured "
                   << measured_loss / mJ << " mJ, of that " << passive_loss / mJ << " mJ where it loses and "
                   << (measured_loss - passive_loss) / mJ << " mJ where it gives");
        CHECK (followed > 0.9 * rows);
        CHECK (rms < 4 * mN);
        CHECK (worst < 12 * mN);
        CHECK (all_rms < 25 * mN);
        CHECK (loss == Approx (passive_loss).epsilon (0.02));
        CHECK (*std::ranges::min_element (force) >= 0.0);

        host::Axes panel { .title = name, .x = { "travel", "m" }, .y = { "force", "N" }, .series = {} };
        panel.series.push_back ({ .label = "measured, down", .x = down_x, .y = down, .style = host::Series::Style::points });
        panel.series.push_back ({ .label = "measured, up", .x = up_x, .y = up, .style = host::Series::Style::points });
        panel.series.push_back ({ .label = "deform.plane + friction.elasto_plastic", .x = depth, .y = force });
        picture.panels.push_back (panel);
    }
    REQUIRE (host::writeFigure (picture, figure ("key_switches.png")));
}

TEST_CASE ("a measured key releases no energy, whatever the finger does", "[data]")
{
    const auto folder = test::sharedData ("buttons_switchcurves");
    if (folder.empty()) return;
    for (const std::string name : { "Cherry-MX-Red", "Cherry-MX-Blue-RGB", "Cherry-MX-Hyperglide-Brown" })
    {
        const auto recording = readMeasured (folder + "/" + name + ".csv");
        const auto fit = fitSwitch ({ .depth = recording.x, .force = recording.force }, 10 * mN);
        REQUIRE (fit);
        CHECK (lostEnergy (fit->recorded) == Approx (workAlong (recording.x, recording.force)).epsilon (0.005));   // the gauge has an offset of -2 mN
        const double stiffness = 1e4, step = 5 * um;
        const auto key = host::switchPreset (fit->loop, stiffness, name);
        test::property (name, [&] {
            PressedKey pressed { key, step };
            const auto strokes = randomStrokes (fit->recorded.travel.back(), step);
            pressed.follow (strokes);
            RC_ASSERT (pressed.work >= -missed (strokes.size(), stiffness, step));
            RC_ASSERT (pressed.least >= -slack);
        });
    }
}

TEST_CASE ("any two curves, if down is above up, make a key that follows both, releases no energy and never pulls", "[cli]")
{
    test::property ("no closed path releases energy", [] {
        const auto loop = simplified (randomLoop(), 1 * mN);
        const double stiffness = *rc::gen::element (2e3, 1e4, 1e5), step = 1 * um;
        PressedKey pressed { host::switchPreset (loop, stiffness, "random"), step };
        const auto strokes = randomStrokes (1.1 * loop.travel.back(), step);
        pressed.follow (strokes);
        RC_ASSERT (pressed.work >= -missed (strokes.size(), stiffness, step));
        RC_ASSERT (pressed.least >= -slack);
    });

    test::property ("a stroke follows both curves if the bristle is stiff enough for their difference", [] {
        const auto loop = simplified (randomLoop(), 1 * mN);
        const double stiffness = 1e5, step = 1 * um;
        PressedKey pressed { host::switchPreset (loop, stiffness, "random"), step };

        for (std::size_t i = 1; i < loop.travel.size(); ++i)
        {
            pressed.to (std::lround (loop.travel[i] / step));
            RC_ASSERT (std::abs (pressed.force() - loop.press[i]) < 0.2 * mN + slack);
        }
        // The finger goes so far beyond the last point that the bristle, which needs 2 bound / stiffness to reverse, has reversed
        // when the finger is back there.
        pressed.to (std::lround (loop.travel.back() / step) + 20);
        for (std::size_t i = loop.travel.size() - 1; i > 0; --i)
        {
            pressed.to (std::lround (loop.travel[i] / step));
            RC_ASSERT (std::abs (pressed.force() - loop.release[i]) < 0.2 * mN + slack);
        }
    });
}

TEST_CASE ("a curve is simplified, and both directions stay within the tolerance", "[cli]")
{
    test::property ("for any curve and tolerance", [] {
        SwitchLoop fine { { 0.0 }, { 0.0 }, { 0.0 } };
        const int points = *rc::gen::inRange (2, 300);
        for (int i = 1; i <= points; ++i)
        {
            fine.travel.push_back (5 * um * i);
            fine.press.push_back (std::max (0.0, fine.press.back() + 1 * mN * *rc::gen::inRange (-20, 30)));
            fine.release.push_back (fine.press.back() * 0.01 * *rc::gen::inRange (80, 101));
        }
        const double tolerance = 1 * mN * *rc::gen::inRange (1, 50);
        const auto few = simplified (fine, tolerance);
        RC_ASSERT (few.travel.size() <= fine.travel.size());
        for (std::size_t i = 0; i < fine.travel.size(); ++i)
        {
            RC_ASSERT (std::abs (at (few.travel, few.press, fine.travel[i]) - fine.press[i]) <= tolerance + 0.11 * mN);
            RC_ASSERT (std::abs (at (few.travel, few.release, fine.travel[i]) - fine.release[i]) <= tolerance + 0.11 * mN);
        }
    });
}

TEST_CASE ("the law of a plane may fall with depth: it is still a potential, and never pulls", "[cli]")
{
    test::property ("the work equals the stored energy, on any path", [] {
        const auto loop = randomLoop();
        Rig plane { "deform.plane" };
        plane.set ("law", Law { .kind = Law::Kind::table, .table = { loop.travel, loop.press } }).prepare();
        const auto number = [&] (std::string_view id) {
            const auto found = std::ranges::find (plane.outputs, id, [] (const auto& c) { return c.port->id; });
            return static_cast<std::size_t> (found - plane.outputs.begin());
        };
        const auto resistance = number ("resistance"), stored = number ("stored_energy");

        long at = 0;
        double work = 0.0, force = 0.0;
        for (const long place : randomStrokes (loop.travel.back(), 1 * um))
            while (at != place)
            {
                const int way = at < place ? 1 : -1;
                at += way;
                plane.in.back() = -um * static_cast<double> (at);
                plane.tick();
                work += 0.5 * (plane.out (resistance) + force) * way * um;
                force = plane.out (resistance);
                RC_ASSERT (force >= 0.0);
                RC_ASSERT (std::abs (work - plane.out (stored)) < 1e-12);
            }
    });
}

TEST_CASE ("the preset key clicks, returns with less force than was needed to press it, and releases no energy", "[graphs]")
{
    const auto loaded = loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs" / "tactile_key.json");
    REQUIRE (loaded.messages.empty());
    constexpr double mm = 1e-3;

    constexpr double step = 5 * um, stiffness = 4e3;
    PressedKey key { loaded.graph, step };
    const auto felt = [&key] (double depth) {
        key.to (std::lround (depth / step));
        return key.force();
    };
    const double before = felt (0.8 * mm), top = felt (1.3 * mm), under = felt (1.9 * mm), bottom = felt (3.9 * mm);
    CHECK (top > before + 0.1);
    CHECK (top > under + 0.1);
    CHECK (bottom > under);
    const double top_again = felt (1.3 * mm), before_again = felt (0.8 * mm);
    CHECK (top_again < top - 0.05);
    CHECK (before_again < before - 0.03);
    CHECK (felt (0.0) == Approx (0.0).margin (1e-12));

    test::property ("at any setting, on any path", [&] {
        PressedKey pressed { loaded.graph, step, { { "click", 0.01 * *rc::gen::inRange (0, 101) } } };
        const auto strokes = randomStrokes (4.2 * mm, step);
        pressed.follow (strokes);
        RC_ASSERT (pressed.work >= -missed (strokes.size(), stiffness, step));
        RC_ASSERT (pressed.least >= -slack);
    });
}

TEST_CASE ("a key's curve may be in any unit, and errors in it are reported", "[cli]")
{
    const test::Scratch scratch;
    const auto preset = scratch.path ("key.json");
    const auto import = [&] (const std::string& text, const std::vector<std::string>& options = {}) {
        std::vector<std::string> arguments { "fit", "switch", scratch.write ("curve.csv", text), "-o", preset };
        arguments.insert (arguments.end(), options.begin(), options.end());
        return test::runTactus (arguments);
    };
    const auto nodesOf = [&] (const std::string& text, const std::vector<std::string>& options = {}) {
        const auto made = import (text, options);
        INFO (made.err);
        REQUIRE (made.status == 0);
        const auto read = loadGraph (preset);
        CHECK (read.messages.empty());
        CHECK (compile (read.graph, catalogue()).messages.empty());
        std::filesystem::remove (preset);
        return Json::parse (writeGraph (read.graph)).at ("nodes");
    };

    const auto made = nodesOf ("x_um,force_mN\n0,0\n100,300\n4000,600\n3900,500\n100,200\n0,0\n");
    CHECK (nodesOf ("force_N,x_mm,actuated\n0,0,0\n0.3,0.1,0\n0.6,4,1\n0.5,3.9,1\n0.2,0.1,0\n0,0,0\n") == made);

    // With a meter that has 100 um of play, the positions of the release appear 100 um too high.
    CHECK (nodesOf ("x_um,force_mN\n0,0\n100,300\n4000,600\n3900,600\n3800,500\n0,200\n-100,0\n", { "--backlash", "0.1 mm" }) == made);

    const auto refused = [&] (const std::string& text, const std::string& id) {
        const auto ran = import (text);
        INFO (text << ran.err);
        CHECK (ran.status == 1);
        CHECK (ran.err.find ("[" + id + "]") != std::string::npos);
        CHECK_FALSE (std::filesystem::exists (preset));
    };
    refused ("x_um,strength\n0,0\n", "fit/column");
    refused ("x_kg,force_N\n0,0\n", "fit/unit");
    refused ("x_um,force_N\n0,0\n1,nan\n0,0\n", "fit/not_finite");
    refused ("x_um,force_N\n0,0\n1,1\n2,2\n", "fit/one_way");
    refused ("x_um,force_N\n", "fit/too_short");
    refused ("x_um,force_N\n0,0\n1,1\n2,2\n1,1\n", "fit/not_released");
    refused ("x_um,force_N\n0,0\n1,1\n2,2\n1,1.5\n0,0\n", "fit/gains_energy");
    refused ("x_um,force_N\n0,0\n1,soft\n", "csv/not_a_number");
    CHECK (import ("x_um,force_N\n0,0\n", { "--stiffness", "2 N" }).status == 2);
    CHECK (test::runTactus ({ "fit", "switch", scratch.path ("none.csv"), "-o", preset }).status == 1);
}
