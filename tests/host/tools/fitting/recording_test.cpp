// SPDX-License-Identifier: MIT
#include "support/temporary_folder.hpp"

#include <host/tools/fitting/fitting.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <fstream>
#include <string>
#include <vector>

using namespace tactus;
using Names = std::vector<std::string>;

namespace
{
Result<Table> read (const std::string& text)
{
    const TemporaryFolder folder;
    const auto file = folder / "recording.csv";
    std::ofstream (file, std::ios::binary) << text;
    auto table = host::readRecording (file);
    if (! table) return table;
    return *table;
}

Table tableOf (const std::string& text)
{
    auto table = read (text);
    INFO (text << (table ? "" : describe (table.error())));
    REQUIRE (table);
    return *table;
}
}   // namespace

TEST_CASE ("a recording may begin with lines about the measurement, and its rows may end with empty fields", "[fit]")
{
    const auto profile = tableOf ("Scan Parameters\r\nStylus,Radius: 2.5 \xB5m\r\nLocation,0.0 um, 0.0 um\r\nID,0\r\n\r\nScan Data\r\n"
                                  "Lateral um,Raw Micrometer,\r\n0.0,-0.5,,\r\n0.2,0.25,,\r\n0.3,0.5,,\r\n");
    CHECK (profile.columns == Names { "Lateral um", "Raw Micrometer" });
    CHECK (profile.values == std::vector<double> { 0.0, -0.5, 0.2, 0.25, 0.3, 0.5 });
    const auto& columns = host::infoOf (host::FitKind::grating).columns;
    const auto position = host::columnOf (profile, "", columns[0]), height = host::columnOf (profile, "", columns[1]);
    REQUIRE (position);
    REQUIRE (height);
    CHECK (position->at (1) == Approx (0.2e-6));
    CHECK (height->at (0) == Approx (-0.5e-6));

    CHECK (tableOf ("# 2024-11-12, 10:33\n# x_mm force_mN\n1 2\n3 4\n").columns == Names { "x_mm", "force_mN" });
    CHECK (tableOf ("sep=;\nx;f;\n1;2;\n3;4;\n").columns == Names { "x", "f" });
    CHECK (tableOf ("\xEF\xBB\xBFposition,force,\n1,2,\n3,4,\n").columns == Names { "position", "force" });
    CHECK (tableOf ("Measured by hand\n\n1\t2\n3\t4\n").rows() == 2);
    CHECK (tableOf ("x,height [\xB5m]\n1,2,\n3,4,\n").columns == Names { "x", "height [um]" });
    CHECK (tableOf ("a,b,\n1,2,3\n4,5,6\n").columns == Names { "a", "b", "column 3" });
    CHECK (tableOf ("1,2,\n3,4,\n").columns == Names { "column 1", "column 2" });
}

TEST_CASE ("a recording may have decimal commas where semicolons or tabs separate, and UTF-16", "[fit]")
{
    const std::vector<double> wanted { 0.5, 1.25, -3.0, 4.0 };
    CHECK (tableOf ("x;f\n0,5;1,25\n-3,0;4\n").values == wanted);
    CHECK (tableOf ("x\tf\r\n0,5\t1,25\r\n-3\t4,0\r\n").values == wanted);
    std::string wide = "\xff\xfe";
    for (const char c : std::string ("x;f\n0,5;1,25\n-3;4\n"))
        (wide += c) += '\0';
    CHECK (tableOf (wide).values == wanted);
    CHECK (tableOf ("x,f\n1,2\n3,4\n").values == std::vector<double> { 1.0, 2.0, 3.0, 4.0 });
}

TEST_CASE ("a damaged row of a recording is an error, and is not taken for a line about the measurement", "[fit]")
{
    const auto where = [] (const std::string& text) {
        const auto table = read (text);
        return table ? std::string ("read") : table.error().where.substr (table.error().where.find (".csv"));
    };
    CHECK (where ("x,f\n1,two\n2,3\n4,5\n").starts_with (".csv:2"));
    CHECK (where ("x;f\n1;two\n2;3\n4;5\n").starts_with (".csv:2"));
    CHECK (where ("About\nx,f\n1,2\n3,four\n5,6\n").starts_with (".csv:4"));
    CHECK (where ("x,f\n1,2\n3,4\n5\n").starts_with (".csv:4"));
    CHECK (where ("x,f,\n1,2,\n3,,\n").starts_with (".csv:3"));
    CHECK (where ("only words\nand more words\n") != "read");
}

TEST_CASE ("the unit in the name of a column may be its last word, or written in full", "[fit]")
{
    CHECK (host::unitIn ("Lateral um") == "um");
    CHECK (host::unitIn ("Time (sec)") == "sec");
    CHECK (host::unitIn ("column 2") == "");
    CHECK (host::unitIn ("normal force") == "");
    CHECK (*host::factorOf ("Micrometers", "m") == Approx (1e-6));
    CHECK (*host::factorOf ("micron", "m") == Approx (1e-6));
    CHECK (*host::factorOf ("Millinewton", "N") == Approx (1e-3));
    CHECK (*host::factorOf ("sec", "s") == 1.0);
    CHECK (*host::factorOf ("g", "N") == Approx (9.80665e-3));
    CHECK (*host::factorOf ("g", "kg") == Approx (1e-3));
    CHECK_FALSE (host::factorOf ("Micrometer", "N"));
    CHECK (host::bareName ("Raw Micrometer") == "raw");
}

TEST_CASE ("the unit of a column may follow an underscore, and the usual short names of forces and places are known", "[fit]")
{
    using host::FitKind;
    const std::vector<std::array<const char*, 3>> columns {
        { "fz_N", "N", "fz" },
        { "Fz_mN", "mN", "fz" },
        { "depth_mm", "mm", "depth" },
        { "x_um", "um", "x" },
        { "z_m", "m", "z" },
        { "time_s", "s", "time" },
        { "t_ms", "ms", "t" },
        { "speed_m_s", "m/s", "speed" },
        { "velocity_mm_s", "mm/s", "velocity" },
        { "acc_m_s2", "m/s2", "acc" },
        { "normal_force_N", "N", "normal_force" },
        { "force_2_N", "N", "force_2" },
        { "normal_force", "", "normal_force" },
        { "m_s", "s", "m" },
    };
    for (const auto& [column, unit, name] : columns)
    {
        INFO (column);
        CHECK (host::unitIn (column) == unit);
        CHECK (host::bareName (column) == name);
    }
    const auto speed = tableOf ("speed_mm_s,t_ms\n20,1\n30,2\n");
    const auto values = host::columnOf (speed, "", { "speed", "m/s", true, { "speed" }, {} });
    REQUIRE (values);
    CHECK (values->at (1) == Approx (0.03));
    const auto kindOf = [] (const std::string& text) { return host::guessKind (tableOf (text)); };
    CHECK (kindOf ("depth_mm,fz_N\n0,0\n1,2\n") == FitKind::curve);
    CHECK (kindOf ("time_s,z_mm,Fz_mN\n0,0,0\n1,-1,-2\n") == FitKind::curve);
    CHECK (kindOf ("x_mm,z_mm,Fx_N,Fz_N\n0,0,0,1\n1,0,1,1\n") == FitKind::friction);
    CHECK (kindOf ("x_mm,z_um\n0,0\n1,3\n") == FitKind::grating);
}
