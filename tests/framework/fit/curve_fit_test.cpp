// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/fit/curve_fit.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

using namespace tactus;

namespace
{
/// A slow push to 3 mm and back, with rows every 5 um, beginning and ending outside.
RecordedLoop push (const std::function<double (double)>& in, const std::function<double (double)>& out)
{
    RecordedLoop loop;
    const auto row = [&] (double d, double f) {
        loop.depth.push_back (d);
        loop.force.push_back (f);
    };
    for (int i = -20; i <= 600; ++i)
        row (5e-6 * i, i > 0 ? in (5e-6 * i) : 0.0);
    for (int i = 599; i >= -20; --i)
        row (5e-6 * i, i > 0 ? out (5e-6 * i) : 0.0);
    return loop;
}

double hertz (double d) { return 1257.0 * std::pow (d, 1.5); }

/// One of the key switches of the shared data, in m and N; empty if the data are absent.
RecordedLoop keySwitch (const std::string& name)
{
    std::ifstream file (std::string (TACTUS_SHARED_DATA) + "/buttons_switchcurves/" + name);
    RecordedLoop loop;
    std::string line;
    std::getline (file, line);
    for (double x = 0.0, f = 0.0; std::getline (file, line);)
    {
        char comma = 0;
        std::istringstream (line) >> x >> comma >> f;
        loop.depth.push_back (1e-6 * x);
        loop.force.push_back (9.80665e-3 * f);
    }
    return loop;
}
}   // namespace

TEST_CASE ("curve fit: the curve is the mean of both ways, and the hysteresis is the area between them", "[kit][fit]")
{
    const auto fit = fitCurve (push ([] (double d) { return 1.2 * hertz (d); }, [] (double d) { return 0.8 * hertz (d); }), 30);
    REQUIRE (fit);
    for (const double d : { 5e-4, 1e-3, 2.2e-3, 3e-3 })
        CHECK (fit->law (d) == Approx (hertz (d)).epsilon (0.01));
    CHECK (fit->area == Approx (0.4 * 1257.0 * std::pow (3e-3, 2.5) / 2.5).epsilon (0.01));
    CHECK (fit->work == Approx (1.2 * 1257.0 * std::pow (3e-3, 2.5) / 2.5).epsilon (0.01));
    CHECK (fit->residual < 1e-3 * fit->peak);
    CHECK (fit->drop == 0.0);
}

TEST_CASE ("curve fit: the interval of the work holds if the depth has noise", "[kit][fit]")
{
    int holds = 0;
    constexpr int seeds = 40, rows = 1000;
    constexpr double deepest = 2e-3, true_work = 2e2 * deepest * deepest / 2.0 + 1e5 * deepest * deepest * deepest / 3.0;
    for (unsigned seed = 0; seed < seeds; ++seed)
    {
        std::mt19937 dice (seed);
        std::normal_distribution<double> noise (0.0, 1.0);
        RecordedLoop loop;
        for (int i = 0; i < 2 * rows; ++i)
        {
            const double d = deepest * (i < rows ? i : 2 * rows - 1 - i) / (rows - 1.0);
            loop.depth.push_back (d + 1e-6 * noise (dice));
            loop.force.push_back ((i < rows ? 1.0 : 0.9) * (2e2 * d + 1e5 * d * d) + 3e-3 * noise (dice));
        }
        const auto fit = fitCurve (loop, 40);
        REQUIRE (fit);
        const auto& work = fit->report.values.front();
        REQUIRE (work.name == "work on the way in");
        holds += work.low <= true_work && true_work <= work.high ? 1 : 0;
        CHECK (fit->report.notes.size() == 1);
    }
    CHECK (holds >= 35);
}

TEST_CASE ("curve fit: without a way out, the curve is the way in", "[kit][fit]")
{
    auto loop = push (hertz, hertz);
    const auto deepest = std::ranges::max_element (loop.depth) - loop.depth.begin() + 1;
    loop.depth.resize (static_cast<std::size_t> (deepest));
    loop.force.resize (static_cast<std::size_t> (deepest));
    const auto fit = fitCurve (loop);
    REQUIRE (fit);
    CHECK (fit->out.empty());
    CHECK (fit->area == 0.0);
    CHECK (fit->law (2e-3) == Approx (hertz (2e-3)).epsilon (0.01));
}

TEST_CASE ("curve fit: whatever was recorded, the curve never falls and never pulls", "[kit][fit]")
{
    test::property ("noise, snaps and forces below 0", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const double noise = 0.05 * (1.0 + one (dice)), snap = 2e-3 * (1.0 + one (dice)), fall = 0.1 * one (dice);
        const auto force = [&] (double d) { return hertz (d) + noise * one (dice) - (d > snap ? fall : 0.0); };
        const auto fit = fitCurve (push (force, force), 2 + static_cast<int> (dice() % 100));
        if (! fit) return RC_ASSERT (fit.error().id == "fit/pulls");
        RC_ASSERT (fit->law.rises());
        double before = 0.0;
        for (int i = 1; i < 1000; ++i)
        {
            const double now = fit->law (4e-6 * i);
            RC_ASSERT (now >= before * (1.0 - 1e-12));   // where the curve is flat, its values are rounded
            before = now;
        }
    });
}

TEST_CASE ("curve fit: rows far apart leave no gap in the curve", "[kit][fit]")
{
    RecordedLoop loop;
    for (int i = 0; i <= 10; ++i)
    {
        loop.depth.push_back (1e-4 * i);
        loop.force.push_back (0.5 * 1e-4 * i * 1000.0);
    }
    const auto fit = fitCurve (loop, 100);
    REQUIRE (fit);
    for (const double d : { 5e-6, 3.3e-4, 9.7e-4 })
        CHECK (fit->law (d) == Approx (500.0 * d).epsilon (1e-3));
}

TEST_CASE ("curve fit: a recording that cannot be used is refused", "[kit][fit]")
{
    const auto id = [] (const RecordedLoop& loop) {
        const auto fit = fitCurve (loop);
        return fit ? std::string() : fit.error().id;
    };
    CHECK (id ({ .depth = { 1.0, 2.0 }, .force = { 1.0, 2.0 } }) == "fit/too_short");
    auto loop = push (hertz, hertz);
    loop.force[50] = std::nan ("");
    CHECK (id (loop) == "fit/not_finite");
    loop = push (hertz, hertz);
    for (double& d : loop.depth)
        d -= 1.0;
    CHECK (id (loop) == "fit/no_contact");
    loop = push (hertz, hertz);
    for (double& f : loop.force)
        f = -f;
    CHECK (id (loop) == "fit/pulls");
}

TEST_CASE ("curve fit: recorded key switches show their hysteresis, and where they snap", "[kit][fit]")
{
    const std::pair<const char*, double> switches[] { { "Cherry-MX-Red.csv", 0.117e-3 }, { "Cherry-MX-Blue-RGB.csv", 0.261e-3 } };
    for (const auto& [name, area] : switches)
    {
        const auto loop = keySwitch (name);
        if (loop.depth.empty())
        {
            WARN ("skipped: " << TACTUS_SHARED_DATA << "/buttons_switchcurves/" << name << " does not exist");
            continue;
        }
        const auto fit = fitCurve (loop, 40);
        CAPTURE (name);
        REQUIRE (fit);
        CHECK (fit->area == Approx (area).margin (0.02e-3));
        CHECK (fit->law.rises());
        CHECK (fit->residual < 0.1 * fit->peak);
        const bool does_click = std::string (name) == "Cherry-MX-Blue-RGB.csv";
        CHECK (fit->clicks() == does_click);
        CHECK (fit->report.is_good == ! does_click);
        if (does_click) CHECK (fit->drop == Approx (0.17).margin (0.02));
    }
}

TEST_CASE ("curve fit: a click that the curve flattens gets a poor verdict that names the program for keys, but noise and a tiny dent do not", "[kit][fit]")
{
    const auto says = [] (const CurveFit& fit, const std::string& words) {
        return std::ranges::any_of (fit.report.lacking, [&] (const std::string& text) { return text.find (words) != std::string::npos; });
    };
    std::mt19937 dice (3);
    std::normal_distribution<double> noise (0.0, 1.0);
    const auto key = [&] (double fall, double deviation) {
        const auto force = [&, fall, deviation] (double d) {   // a force of 0.6 N that falls within 0.4 mm, and a stop
            const double down = std::clamp ((d - 1.5e-3) / 0.4e-3, 0.0, 1.0) * fall;
            return 0.6 * std::min (1.0, d / 1e-3) - down + 600.0 * std::max (0.0, d - 2.2e-3) + deviation * noise (dice);
        };
        const auto fit = fitCurve (push (force, force));
        REQUIRE (fit);
        return *fit;
    };
    const auto clicks = key (0.19, 0.005);
    CHECK (clicks.drop == Approx (0.19).margin (0.01));
    CHECK_FALSE (clicks.report.is_good);
    CHECK (says (clicks, "tactus fit switch"));
    CHECK (says (clicks, "flattens a fall"));
    CHECK (key (0.0, 0.005).report.is_good);
    CHECK (key (0.0, 0.05).drop == 0.0);
    CHECK (key (0.02, 0.002).report.is_good);   // 3 % are not felt
    CHECK (key (0.0, 0.0).drop == 0.0);
}
