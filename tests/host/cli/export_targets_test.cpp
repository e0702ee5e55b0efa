// SPDX-License-Identifier: GPL-3.0-or-later
// The same graph behind a C interface, as a unit for simulators and in an Arduino library.

#include "program.hpp"

#include "../code/generate/fmu.hpp"

#include <tactus/run/log/run_head.hpp>
#include <tactus/text/number_text.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

using namespace tactus::test;

namespace
{
constexpr const char* graph = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";
constexpr const char* recorded[] { "board.force.z", "drag.force.x", "drag.deflection.x" };
constexpr const char* flags = "-std=c++20 -O0 -fPIC -Wall -Wextra -Werror -ffp-contract=off -fno-math-errno -fno-trapping-math -isystem /usr/include/eigen3 ";
constexpr double h = 1.0 / 4000.0;

bool succeeds (const std::string& command, const std::string& said)
{
    const bool is_right = std::system ((command + " > '" + said + "' 2>&1").c_str()) == 0;
    INFO (command << "\n"
                  << textOf (said));
    CHECK (is_right);
    return is_right;
}

/// Down into the board, sideways with a turn, and out again.
std::array<double, 3> motion (int k)
{
    const double t = k * h;
    return { 0.004 * std::sin (9.0 * t), 0.0, 0.0006 - 0.0012 * std::sin (2.5 * t) };
}

std::vector<std::vector<double>> numbersOf (const std::string& csv)
{
    std::vector<std::vector<double>> rows;
    std::istringstream lines (csv);
    std::string line;
    std::getline (lines, line);
    while (std::getline (lines, line))
    {
        auto& row = rows.emplace_back();
        std::istringstream cells (line);
        for (std::string cell; std::getline (cells, cell, ',');)
            row.push_back (std::stod (cell));
    }
    return rows;
}

/// What `render` records while the stylus moves as this trace says.
std::vector<std::vector<double>> rendered (const Scratch& scratch, const std::string& trace, const std::string& ports)
{
    const auto in = scratch.write ("in.csv", trace), out = scratch.path ("out.csv");
    const auto ran = runTactus ({ "render", graph, "--device", "stylus=trace:" + in, "--record", ports, "--out", out });
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    return numbersOf (textOf (out));
}

/// The same for motion(); the columns are those of `recorded`.
std::vector<std::vector<double>> rendered (const Scratch& scratch, int ticks)
{
    std::ostringstream trace;
    trace.precision (17);
    trace << "t,x,y,z\n";
    for (int k = 0; k < ticks; ++k)
        trace << k * h << "," << motion (k)[0] << "," << motion (k)[1] << "," << motion (k)[2] << "\n";
    return rendered (scratch, trace.str(), "board.force.z,drag.force.x,drag.deflection.x");
}

/// Writes a graph for this target.
std::string written (const Scratch& scratch, const std::string& file, const std::string& target, std::vector<std::string> more = {})
{
    const auto folder = scratch.path (target);
    more.insert (more.begin(), { "export", file, "-o", folder, "--to", target });
    const auto ran = runTactus (more);
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    return folder;
}

std::string exportedTo (const Scratch& scratch, const std::string& target)
{
    return written (scratch, graph, target, { "--record", "board.force.z,drag.force.x,drag.deflection.x" });
}

/// A stylus on a plate, with this guard.
std::string plateWith (const std::string& guard)
{
    return R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
                "devices": { "stylus": { "driver": "sim", "mass": "50 g", "damping": 1.0, "guard": { )"
           + guard + R"( } } },
                "nodes": { "hand": { "type": "device.position", "role": "stylus" },
                           "plate": { "type": "deform.plane", "params": { "stiffness": 1000 } },
                           "motor": { "type": "device.force", "role": "stylus" } },
                "wires": ["hand.position -> plate.position", "plate.force -> motor.force"] })";
}

/// Compares ticks from `first` on with what render computed.
void checkTicks (Fmu& unit, const std::vector<std::vector<double>>& expected, int first)
{
    int different = 0;
    for (int k = first; k < static_cast<int> (expected.size()); ++k)
    {
        for (std::size_t i = 0; i < 3; ++i)
            REQUIRE (unit.set (std::string ("in.stylus.position.") + "xyz"[i], motion (k)[i]));
        REQUIRE (unit.step (k * h, h));
        for (std::size_t i = 0; i < 3; ++i)
            if (unit.get (std::string ("record.") + recorded[i]) != expected[static_cast<std::size_t> (k)][i + 1]) ++different;
    }
    CHECK (different == 0);
}

void checkUnit (const std::string& description, const std::string& library, const std::vector<std::vector<double>>& expected)
{
    CHECK_FALSE (Fmu (description, library, "{another}").isThere());
    Fmu unit { description, library };
    REQUIRE (unit.isThere());
    CHECK (unit.attribute ("fmiVersion") == "2.0");
    CHECK (unit.variables().at ("param.drag.mu").start == "0.4");
    CHECK (unit.variables().at ("out.stylus.force.z").causality == "output");
    CHECK_FALSE (unit.set ("out.stylus.force.z", 1.0));
    checkTicks (unit, expected, 0);

    REQUIRE (unit.reset());
    auto half = expected;
    half.resize (expected.size() / 2);
    checkTicks (unit, half, 0);
    auto* const state = unit.state();
    checkTicks (unit, expected, static_cast<int> (half.size()));
    REQUIRE (unit.setState (state));
    unit.freeState (state);
    checkTicks (unit, expected, static_cast<int> (half.size()));

    // One step for several ticks. The inputs are held.
    REQUIRE (unit.reset());
    REQUIRE (unit.step (0.0, 10.0 * h));
    REQUIRE (unit.set ("param.drag.mu", 0.1));
    REQUIRE (unit.step (10.0 * h, 2.5 * h));
    REQUIRE (unit.step (12.5 * h, 0.5 * h));

    // Limits can be tightened before the first step.
    CHECK (unit.variables().at ("limit.stylus.max_force").start == "6");
    CHECK_FALSE (unit.set ("limit.stylus.max_force", 1.0));
    for (const double most : { 1.0, 100.0 })
    {
        REQUIRE (unit.reset());
        CHECK (unit.set ("limit.stylus.max_force", most));
        CHECK (unit.set ("limit.stylus.dead_man_buttons", 2.0));
        REQUIRE (unit.set ("in.stylus.position.z", -0.01));
        REQUIRE (unit.step (0.0, 100.0 * h));
        CHECK (unit.get ("limit.stylus.max_force") == std::min (most, 6.0));
        CHECK (unit.get ("out.stylus.force.z") == 0.0);
        CHECK_FALSE (unit.set ("limit.stylus.dead_man_buttons", 0.0));
        REQUIRE (unit.set ("in.stylus.buttons", 2.0));
        REQUIRE (unit.step (100.0 * h, 100.0 * h));
        CHECK (unit.get ("out.stylus.force.z") == Approx (std::min (most, 6.0)));
    }
}

/// What a C program with this body prints, linked with a graph called plate.
std::string printedInC (const Scratch& scratch, const std::string& folder, const std::string& body)
{
    const auto said = scratch.path ("said"), source = scratch.write ("in_c.c", R"(#include "plate.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
int main (void)
{
    plate* const graph = plate_create (malloc (plate_size()), plate_size());
    plate_limits limits;
    plate_inputs inputs;
    plate_outputs outputs;
    plate_init (&inputs);
)" + body + "    return 0;\n}\n");
    const auto object = scratch.path ("in_c.o"), program = scratch.path ("in_c");
    REQUIRE (succeeds ("cc -std=c99 -Wall -Wextra -Wpedantic -Werror -I'" + folder + "' -c -o '" + object + "' '" + source + "'", said));
    REQUIRE (succeeds ("c++ -o '" + program + "' '" + object + "' '" + folder + "/libplate.a'", said));
    const auto ran = runProgram (program, {});
    CHECK (ran.status == 0);
    return ran.out;
}
}   // namespace

TEST_CASE ("a graph gives the same bits from C and in a simulator", "[cli][export]")
{
    const Scratch scratch;
    const auto c = exportedTo (scratch, "c-api"), said = scratch.path ("said");
    REQUIRE (succeeds ("make -s -C '" + c + "' libdry_wood.a CXXFLAGS='-O0 -fPIC -Wall -Wextra -Werror'", said));
    const std::string library = "'" + c + "/libdry_wood.a'", compile = "c++ " + std::string (flags);

    {   // C
        const auto program = scratch.path ("in_c"), object = scratch.path ("in_c.o");
        REQUIRE (succeeds ("cc -std=c99 -Wall -Wextra -Wpedantic -Werror -I'" + c + "' -c -o '" + object + "' '" + c + "/dry_wood_example.c'", said));
        REQUIRE (succeeds ("c++ -o '" + program + "' '" + object + "' " + library, said));
        std::ostringstream trace;
        trace.precision (17);
        trace << "t,x,y,z\n";
        for (int k = 0; k < 1000; ++k)
            trace << k * h << "," << 1e-5 * k << ",0," << 0.002 - 4e-6 * k << "\n";
        const auto expected = rendered (scratch, trace.str(), "motor.force");   // its guard does not act here
        const auto from_c = runProgram (program, {});
        CHECK (from_c.status == 0);
        std::istringstream lines (from_c.out);
        std::size_t different = 0, k = 0;
        for (std::string line; std::getline (lines, line); ++k)
        {
            REQUIRE (k < expected.size());
            char* next = line.data();
            std::strtod (next, &next);
            for (std::size_t part = 1; part <= 3; ++part)
                if (std::strtod (next, &next) != expected[k][part]) ++different;
        }
        CHECK (k == 1000);
        CHECK (different == 0);
        CHECK (expected[999][3] > 1.0);
    }

    {   // a unit for co-simulation
        const auto fmu = exportedTo (scratch, "fmu"), object = scratch.path ("dry_wood.so");
        REQUIRE (succeeds (compile + "-shared -fvisibility=hidden -I'" + fmu + "' -o '" + object + "' '" + fmu + "/dry_wood_fmu.cpp' " + library, said));
        checkUnit (textOf (fmu + "/modelDescription.xml"), object, rendered (scratch, 4000));
    }
}

TEST_CASE ("a board rests when its host stops, and every force on its motors passes the guard of the patch", "[cli][export]")
{
    // The limits of the sketch, 3 N, 500 N/s and 0.5 s, hold where the patch has none.
    const Scratch tight_scratch, loose_scratch, single_scratch, serial_scratch;
    const auto tight = R"("max_force": "0.5 N", "max_slew": "20 N/s", "ramp": "2 s", "max_impulse": "4 N*s", "impulse_window": "10 s")";
    const struct
    {
        const Scratch& scratch;
        std::string guard;
        std::vector<std::string> limits;
        std::vector<std::string> options;
        bool is_serial = false;
    } patches[] { { loose_scratch, R"("max_force": "6 N")", { "3", "500", "0.5" }, {} },
                  { serial_scratch, R"("max_force": "6 N")", { "3", "500", "0.5" }, {}, true },
                  { tight_scratch, tight, { "0.5", "20", "2" }, {} },
                  { single_scratch, tight, { "0.5", "20", "2" }, { "--float" } } };
    const std::string boards = TACTUS_SOURCE_DIR "/tests/host/code/generate/boards";
    double pushed_s[2] {};
    for (const auto& patch : patches)
    {
        const auto folder = written (patch.scratch, patch.scratch.write ("plate.json", plateWith (patch.guard)), "arduino", patch.options);
        if (! patch.options.empty())
            for (const auto* file : { "/src/plate.hpp", "/src/plate.cpp", "/src/tactus_board.hpp", "/examples/Board/Board.ino" })
                CHECK (textOf (folder + file).find ("double ") == std::string::npos);
        const auto sketch = "-DSKETCH='\"" + folder + "/examples/Board/Board.ino\"' -DOVER_SERIAL=" + (patch.is_serial ? "1" : "0");
        // As one file, which compiles in half the time.
        REQUIRE (succeeds ("cd '" + folder + "' && find src -name '*.cpp' -printf '#include \"%p\"\\n' >all.cpp && c++ " + flags + "-O1 -I. -Isrc -I'" + boards
                               + "' " + sketch + " -o board '" + boards + "/simulated_board.cpp' all.cpp",
                           patch.scratch.path ("said")));
        const auto run = [&] (const std::string& scenario, const std::string& seed) {
            auto arguments = patch.limits;
            arguments.insert (arguments.begin(), scenario);
            arguments.push_back (seed);
            const auto ran = runProgram (folder + "/board", arguments);
            INFO (patch.guard << ", " << scenario << " " << seed << ": " << ran.out);
            CHECK (ran.status == 0);
            return ran.out;
        };
        for (const auto* scenario : { "story", "opened", "shortened", "button", "limited", "wrapped", "late", "paced" })
            (void)run (scenario, "0");
        if (patch.guard == tight) (void)run ("latched", "0");
        for (int seed = 0; seed < 12; ++seed)
        {
            double by_board = 0.0, by_host = 0.0;
            CHECK (std::sscanf (run ("chaos", std::to_string (seed)).c_str(), "the board pushed for %lf s, the host for %lf s", &by_board, &by_host) == 2);
            pushed_s[0] += by_board;
            pushed_s[1] += by_host;
        }
    }
    CHECK (pushed_s[0] > 10.0);   // or the tests would show nothing
    CHECK (pushed_s[1] > 10.0);
}

TEST_CASE ("an Arduino library in single precision computes what Tactus does, as far as floats can", "[cli][export]")
{
    const Scratch scratch;
    const auto folder = written (scratch, graph, "arduino", { "--float" });
    const auto said = scratch.path ("said");
    REQUIRE (succeeds ("cd '" + folder + "' && c++ " + flags + "-Wdouble-promotion -Isrc extras/*.cpp $(find src -name '*.cpp') -o self_test && ./self_test",
                       said));
    const auto text = textOf (said);
    INFO (text);
    CHECK (text.find (", 0 differ by more than 0.001 of the largest") != std::string::npos);
    CHECK (text.find ("; 0 allocations from the heap") != std::string::npos);
}

TEST_CASE ("exported code keeps every limit of the guard, and lets C only tighten them", "[cli][export]")
{
    const Scratch scratch;
    std::string guard, show, tighter, expected, tightened;
    double value = 1.0;
    for (const auto& [key, limit] : tactus::guard_fields)
    {
        if (limit == &tactus::GuardLimits::workspace_scale) continue;   // not a limit: sessions set it
        const std::string name (key);
        const bool is_slew = name.find ("slew") != name.npos;
        const bool is_longest = name == "ramp" || name == "impulse_window" || name == "energy_window" || name == "dead_man_pressure" || name == "brake_at_stop";
        value += 0.125;
        const double here = is_slew ? 100.0 * value : value, tight = is_longest ? 2.0 * here : 0.5 * here, loose = is_longest ? 0.5 * here : 2.0 * here;
        guard += "\"" + name + "\": " + tactus::numberText (here) + ", ";
        show += "    printf (\"%g\\n\", limits." + name + ");\n";
        tighter += "    limits." + name + " = turn == 0 ? " + tactus::numberText (loose) + " : " + tactus::numberText (tight) + ";\n";
        expected += tactus::numberText (here) + "\n";
        tightened += tactus::numberText (tight) + "\n";
    }
    const auto folder = written (scratch, scratch.write ("plate.json", plateWith (guard + R"("dead_man_button": 1)")), "c-api");
    REQUIRE (succeeds ("make -s -C '" + folder + "' libplate.a CXXFLAGS='-O0 -Wall -Wextra -Werror'", scratch.path ("said")));
    const std::string print = "    plate_limits_of (graph, PLATE_ROLE_stylus, &limits);\n" + show + "    printf (\"%d\\n\", (int) limits.dead_man_buttons);\n";
    const auto said = printedInC (scratch, folder,
                                  "    int turn = 0;\n" + print
                                      + "    plate_no_limits (&limits);\n    limits.max_force = 1e300;\n    limits.ramp = 0.0;\n"
                                        "    if (! plate_tighten (graph, PLATE_ROLE_stylus, &limits)) return 1;\n"
                                      + print + "    for (; turn < 2; ++turn)\n    {\n    plate_no_limits (&limits);\n" + tighter
                                      + "    limits.dead_man_buttons = 4;\n    if (! plate_tighten (graph, PLATE_ROLE_stylus, &limits)) return 2;\n" + print
                                      + "    }\n"
                                      + "    plate_no_limits (&limits);\n    limits.max_speed = NAN;\n    limits.max_torque = -1.0;\n"
                                        "    if (! plate_tighten (graph, PLATE_ROLE_stylus, &limits)) return 3;\n"
                                        "    plate_limits_of (graph, PLATE_ROLE_stylus, &limits);\n"
                                        "    printf (\"%g %g\\n\", limits.max_speed, limits.max_torque);\n"
                                        "    plate_tick (graph, &inputs, &outputs);\n"
                                        "    if (plate_tighten (graph, PLATE_ROLE_stylus, &limits)) return 4;\n"
                                        "    if (plate_tighten (graph, (plate_role) 7, &limits)) return 5;\n");
    CHECK (said == expected + "2\n" + expected + "2\n" + expected + "6\n" + tightened + "6\n" + "0 0\n");
}

TEST_CASE ("units for simulators, libraries for boards and C interfaces build as their folders say", "[.export_targets]")
{
    const Scratch scratch;
    const auto fmu = exportedTo (scratch, "fmu"), said = scratch.path ("said"), unpacked = scratch.path ("unpacked");
    REQUIRE (succeeds ("make -s -C '" + fmu + "' fmu", said));
    REQUIRE (succeeds ("mkdir '" + unpacked + "' && cd '" + unpacked + "' && cmake -E tar xf '" + fmu + "/dry_wood.fmu'", said));
    CHECK (std::filesystem::exists (unpacked + "/sources/dry_wood.cpp"));
    checkUnit (textOf (unpacked + "/modelDescription.xml"), unpacked + "/binaries/linux64/dry_wood.so", rendered (scratch, 4000));

    const auto arduino = exportedTo (scratch, "arduino");
    REQUIRE (succeeds ("cd '" + arduino + "' && c++ " + flags + "-Isrc extras/*.cpp $(find src -name '*.cpp') -o self_test && ./self_test", said));
    const auto c = exportedTo (scratch, "c-api");
    CHECK (succeeds ("make -s -C '" + c + "' test", said));
}
