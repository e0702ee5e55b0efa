// SPDX-License-Identifier: MIT
#include <host/base/files/evemu.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// Writes the event lines that a pen tablet would produce.
class Pen
{
public:
    Pen& at (double t, int x, int y) { return abs (t, 0, x).abs (t, 1, y); }
    Pen& pressing (double t, int units) { return abs (t, 0x18, units).line (t, 1, 0x14a, units > 0); }
    Pen& near (double t, bool is_near) { return line (t, 1, 0x140, is_near); }
    Pen& report (double t) { return line (t, 0, 0, 0); }

    std::string text;

private:
    Pen& abs (double t, int code, int value) { return line (t, 3, code, value); }

    Pen& line (double t, int type, int code, int value)
    {
        char line[80];
        std::snprintf (line, sizeof line, "E: %.6f %04x %04x %d\n", 1364787581.0 + t, static_cast<unsigned> (type), static_cast<unsigned> (code), value);
        text += line;
        return *this;
    }
};

/// Hovers, draws 10 mm to the right and 5 mm towards the user, lifts, and leaves.
Pen drawing()
{
    Pen pen;
    pen.near (0.0, true).at (0.0, 10'000, 20'000).report (0.0);
    for (int k = 1; k <= 50; ++k)
        pen.at (0.1 + 0.004 * k, 10'000 + 40 * k, 20'000 + 20 * k).pressing (0.1 + 0.004 * k, 1024).report (0.1 + 0.004 * k);
    pen.pressing (0.4, 0).report (0.4);
    return pen;
}

Pen leaving (Pen pen, double t)
{
    pen.at (t, 0, 0).near (t, false).report (t);
    return pen;
}

TraceData traceOf (const std::string& text, const EvemuOptions& options = {})
{
    auto trace = readEvemu (text, options);
    if (! trace) FAIL (trace.error().where << ": " << trace.error().text);
    return std::move (*trace);
}

struct Motion
{
    double speed = 0.0, landing_speed = 0.0, landing_acceleration = 0.0, lowest = 1.0, highest = -1.0, hardest = 0.0;
};

Motion motionOf (const TraceData& trace)
{
    Motion m;
    const auto& rows = trace.rows;
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
        m.lowest = std::min (m.lowest, rows[k].position.z());
        m.highest = std::max (m.highest, rows[k].position.z());
        m.hardest = std::max (m.hardest, rows[k].pressure);
        if (k == 0) continue;
        const double dt = rows[k].t - rows[k - 1].t;
        const Vec3 step = rows[k].position - rows[k - 1].position;
        m.speed = std::max (m.speed, step.head<2>().norm() / dt);
        m.landing_speed = std::max (m.landing_speed, std::abs (step.z()) / dt);
        if (k > 1)
            m.landing_acceleration = std::max (m.landing_acceleration, std::abs (step.z() - (rows[k - 1].position - rows[k - 2].position).z()) / (dt * dt));
    }
    return m;
}

const TraceData::Row& rowAt (const TraceData& trace, double t)
{
    return *std::ranges::find_if (trace.rows, [t] (const auto& row) { return row.t >= t - 1e-9; });
}
}   // namespace

TEST_CASE ("evemu: units are converted to metres and centred, with y away from the user", "[host][devices]")
{
    const auto trace = traceOf (drawing().text);

    CHECK (trace.rows.front().t == 0.0);
    CHECK (trace.step() == Approx (1e-3));
    CHECK (rowAt (trace, 0.02).position.x() == Approx (-5e-3).margin (1.1e-3));
    CHECK ((rowAt (trace, 0.0).position.head<2>() - Eigen::Vector2d (-5e-3, 2.5e-3)).norm() < 1e-9);
    CHECK ((rowAt (trace, 0.3).position.head<2>() - Eigen::Vector2d (5e-3, -2.5e-3)).norm() < 1e-9);
    CHECK ((rowAt (trace, 0.202).position.head<2>() - Eigen::Vector2d (0.1e-3, -0.05e-3)).norm() < 1e-9);

    const auto coarse = traceOf (drawing().text, { .pitch = 1e-4 });
    CHECK (rowAt (coarse, 0.3).position.x() == Approx (0.1));
}

TEST_CASE ("evemu: pressure gives the force and the depth of the tip, and a lifted pen is above the surface", "[host][devices]")
{
    const auto trace = traceOf (drawing().text, { .full_pressure = 2048, .full_force = 5.0, .full_depth = 3e-3, .lift = 8e-3 });

    CHECK (rowAt (trace, 0.01).position.z() == Approx (8e-3));
    CHECK (rowAt (trace, 0.01).pressure == 0.0);
    CHECK (rowAt (trace, 0.25).position.z() == Approx (-1.5e-3));
    CHECK (rowAt (trace, 0.25).pressure == Approx (2.5));
    CHECK (rowAt (trace, 0.44).position.z() == Approx (8e-3).epsilon (0.02));
    CHECK (rowAt (trace, 0.44).pressure == 0.0);
}

TEST_CASE ("evemu: a landing has a finite speed and no delay", "[host][devices]")
{
    const auto trace = traceOf (drawing().text);
    const auto motion = motionOf (trace);
    CHECK (motion.landing_speed < 0.5);
    CHECK (motion.landing_acceleration < 50.0);

    const auto touch = std::ranges::find_if (trace.rows, [] (const auto& row) { return row.position.z() < 0.0; });
    CHECK (touch->t == Approx (0.104).margin (0.0101));
}

TEST_CASE ("evemu: a pen that leaves by reporting 0, 0 is not a jump of the hand", "[host][devices]")
{
    // Drawn at 50 mm/s; the corner of the tablet is 110 mm away.
    const auto stays = traceOf (drawing().text), leaves = traceOf (leaving (drawing(), 0.41).text);

    CHECK (motionOf (leaves).speed < 0.07);
    CHECK ((leaves.rows.back().position.head<2>() - stays.rows.back().position.head<2>()).norm() < 1e-12);
    CHECK (leaves.rows.back().position.z() == Approx (5e-3));
}

TEST_CASE ("evemu: without tool events, a jump to the corner also means that the pen leaves", "[host][devices]")
{
    Pen pen;
    for (int k = 0; k < 10; ++k)
        pen.at (0.01 * k, 5000 + 10 * k, 5000).report (0.01 * k);
    pen.at (0.2, 0, 0).report (0.2);

    CHECK (motionOf (traceOf (pen.text)).speed < 0.01);
}

TEST_CASE ("evemu: while the pen is away, the hand moves through the air to where it returns", "[host][devices]")
{
    auto pen = leaving (drawing(), 0.41);
    pen.near (1.41, true).at (1.41, 2000, 21'000).report (1.41).at (1.5, 2000, 21'000).report (1.5);

    // A minimum-jerk movement of 50 mm in one second: its peak speed is 15/8 of 50 mm/s.
    const auto trace = traceOf (pen.text);
    CHECK (motionOf (trace).speed == Approx (0.05 * 15.0 / 8.0).epsilon (0.01));
    CHECK (rowAt (trace, 0.91).position.z() == Approx (5e-3));
    CHECK (rowAt (trace, 1.0).pressure == 0.0);
}

TEST_CASE ("evemu: without a touch button, pressure counts as touch", "[host][devices]")
{
    std::string text = "E: 0.000000 0003 0000 100\nE: 0.000000 0003 0001 100\nE: 0.000000 0003 0018 2047\nE: 0.000000 0000 0000 0\n"
                       "E: 0.500000 0000 0000 0\n";
    const auto trace = traceOf (text);
    CHECK (rowAt (trace, 0.25).position.z() == Approx (-2e-3));
    CHECK (rowAt (trace, 0.25).pressure == Approx (3.0));
}

TEST_CASE ("evemu: the axes in the header are used", "[host][devices]")
{
    const std::string header = "# EVEMU 1.3\nN: Some pen\nI: 0003 056a 00b9 0104\nP: 01 00\nB: 00 0b\n\n"
                               "A: 00 0 9000 4 0 100\nA: 01 0 9000 4 0 100\nA: 18 0 1024 0 0\n";
    const auto trace = traceOf (header + drawing().text);

    CHECK (rowAt (trace, 0.3).position.x() - rowAt (trace, 0.0).position.x() == Approx (0.02));
    CHECK (rowAt (trace, 0.25).pressure == Approx (3.0));
}

TEST_CASE ("evemu: a bad line is reported by number", "[host][devices]")
{
    const std::string good = "E: 1.000000 0003 0000 5\n", report = "E: 1.000000 0003 0001 5\nE: 1.000000 0000 0000 0\n";
    const auto [bad, id] = GENERATE (table<std::string, std::string> ({
        { "E: 1.000000 0003 0000", "evemu/bad_line" },
        { "E: 1.000000 0003 0000 5 6", "evemu/bad_line" },
        { "E: 1.000000 0003 0000 0x5", "evemu/bad_line" },
        { "E: 1.000000 000g 0000 5", "evemu/bad_line" },
        { "E: 1.5 0003 0000 5", "evemu/bad_line" },
        { "E: 99999999999999999999.000000 0003 0000 5", "evemu/bad_line" },
        { "E: 1,000000 0003 0000 5", "evemu/bad_line" },
        { "1.000000 0003 0000 5", "evemu/bad_line" },
        { "t,x,y,z", "evemu/bad_line" },
        { "A: 18 0 many", "evemu/bad_line" },
        { "E: 0.999999 0003 0000 5", "evemu/time_order" },
    }));

    const auto result = readEvemu ("# a pen\n" + good + bad + "\n" + report);
    CAPTURE (bad);
    REQUIRE_FALSE (result);
    CHECK (result.error().id == id);
    CHECK (result.error().where == "line 3");
}

TEST_CASE ("evemu: a recording without a pen, or one that lasts for years, is refused", "[host][devices]")
{
    for (const char* text : { "", "# nothing\n", "E: 1.000000 0003 0000 5\nE: 1.000000 0000 0000 0\n" })
    {
        const auto result = readEvemu (text);
        REQUIRE_FALSE (result);
        CHECK (result.error().id == "evemu/no_motion");
    }

    const std::string at = " 0003 0000 5\n", and_at = " 0003 0001 5\n", report = " 0000 0000 0\n";
    const auto moment = [&] (const std::string& t) { return "E: " + t + at + "E: " + t + and_at + "E: " + t + report; };
    const auto result = readEvemu (moment ("0.000000") + moment ("1364787581.497486"));
    REQUIRE_FALSE (result);
    CHECK (result.error().id == "evemu/too_long");
}

TEST_CASE ("evemu: any text is either converted or refused", "[host][devices]")
{
    test::property ("words of such files in any order", [] {
        const auto word =
            rc::gen::element<std::string> ("E:", "A:", "#", "N:", "\n", "\n", "\r\n", " ", " ", "0003", "0000", "0018", "ffff", "0001", "014a",
                                           "1.000000", "2.000000", "-1.000000", "5", "-5", "9223372036854775807", "1e9", "nan", "\0", "\xff");
        std::string text;
        for (const auto& part : *rc::gen::container<std::vector<std::string>> (word))
            text += part;
        const auto result = readEvemu (text);
        RC_ASSERT ((! result || ! result->rows.empty()));
    });
}

TEST_CASE ("evemu: recorded strokes give plausible hand movements", "[host][devices]")
{
    const std::filesystem::path folder = std::filesystem::path (TACTUS_SHARED_DATA) / "strokes_evemu";
    if (! std::filesystem::is_directory (folder))
    {
        WARN ("skipped: " << folder << " does not exist");
        return;
    }

    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator (folder))
    {
        if (entry.path().extension() != ".events") continue;
        ++files;

        std::ifstream file (entry.path(), std::ios::binary);
        const auto trace = traceOf ({ std::istreambuf_iterator<char> (file), {} });
        const auto motion = motionOf (trace);

        CAPTURE (entry.path().filename().string(), motion.speed, motion.landing_speed, motion.landing_acceleration);
        CHECK (motion.speed < 0.5);
        CHECK (motion.landing_speed < 0.5);
        CHECK (motion.landing_acceleration < 50.0);
        CHECK (motion.lowest == Approx (-2e-3));
        CHECK (motion.highest == Approx (5e-3));
        CHECK (motion.hardest == Approx (3.0));
    }
    CHECK (files >= 2);
}
