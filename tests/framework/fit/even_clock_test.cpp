// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/fit/even_clock.hpp>
#include <tactus/fit/modes_fit.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace tactus;

namespace
{
constexpr double step = 1e-3;   // s

/// Times that are off by up to this share of a step.
std::vector<double> jittered (int rows, double most, unsigned seed)
{
    std::mt19937 random (seed);
    std::vector<double> time;
    for (int i = 0; i < rows; ++i)
        time.push_back (2.0 + step * (i + most * std::uniform_real_distribution { -1.0, 1.0 }(random)));
    return time;
}

double tonesAt (double t, double highest)
{
    return std::sin (2.0 * std::numbers::pi * highest * t) + 0.5 * std::cos (2.0 * std::numbers::pi * 0.3 * highest * t + 1.0);
}

double rms (const std::vector<double>& v) { return detail::rootMeanSquare (v); }
}   // namespace

TEST_CASE ("even clock: rows that jitter become the values at even times, and the stated error is the true one", "[fit]")
{
    test::property ("tones up to a fifth of the rate", [] {
        const double most = *rc::gen::inRange (2, 45) / 100.0, highest = *rc::gen::inRange (5, 200);
        const auto given = jittered (*rc::gen::inRange (200, 800), most, *rc::gen::arbitrary<unsigned>());
        auto time = given;
        std::vector<double> value, none;
        for (const double t : time)
            value.push_back (tonesAt (t, highest));
        const auto clock = detail::ontoEvenClock (time, { &value, &none });
        RC_ASSERT (bool (clock));
        RC_ASSERT (std::abs (clock->step / step - 1.0) < 0.01);
        RC_ASSERT (clock->jitter > 0.5 * most);
        RC_ASSERT (clock->jitter < 1.2 * most);
        std::vector<double> off;
        for (std::size_t i = 0; i < time.size(); ++i)
        {
            RC_ASSERT (std::abs (time[i] - time[0] - clock->step * static_cast<double> (i)) < 1e-9);
            if (i >= 3 && i + 3 < time.size()) off.push_back (value[i] - tonesAt (time[i], highest));
        }
        const double error = rms (off) / rms (value);
        RC_ASSERT (error < 4.0 * clock->difference + 1e-9);   // not understated
        // An even time may lie before the first row or after the last one, whose value it then has.
        const double ends = 2.0 * std::numbers::pi * highest * step * most * std::sqrt (2.0 / static_cast<double> (time.size()));
        RC_ASSERT (clock->difference < 20.0 * error + 2.0 * ends + 1e-3);
        if (highest < 50.0) RC_ASSERT (error < 1e-3);
    });
}

TEST_CASE ("even clock: even times and rounded ones keep their values, and lost rows are refused", "[fit]")
{
    for (const double digit : { 0.0, 1e-6, 1e-3 })
        for (const double rate : { 800.0, 1000.0, 3000.0 })
        {
            std::vector<double> time, value;
            for (int i = 0; i < 2000; ++i)
            {
                time.push_back (digit > 0.0 ? digit * std::round (i / rate / digit) : i / rate);
                value.push_back (std::sin (0.1 * i));
            }
            if (digit * rate > 0.9) continue;   // two rows would have one time
            const auto before = value;
            const auto clock = detail::ontoEvenClock (time, { &value });
            REQUIRE (clock);
            CHECK (clock->jitter == 0.0);
            CHECK (value == before);
        }

    test::property ("a row is lost", [] {
        auto time = jittered (400, *rc::gen::inRange (0, 20) / 100.0, *rc::gen::arbitrary<unsigned>());
        const auto lost = *rc::gen::inRange<std::size_t> (1, time.size() - 1);
        time.erase (time.begin() + static_cast<std::ptrdiff_t> (lost));
        std::vector<double> value (time.size(), 1.0);
        const auto clock = detail::ontoEvenClock (time, { &value });
        RC_ASSERT (! clock);
        RC_ASSERT (clock.error().id == "fit/uneven");
    });

    auto back = jittered (100, 0.1, 1);
    std::swap (back[40], back[41]);
    std::vector<double> value (back.size(), 1.0);
    const auto clock = detail::ontoEvenClock (back, { &value });
    REQUIRE_FALSE (clock);
    CHECK (clock.error().id == "fit/time");
}

TEST_CASE ("modes: a ring whose times jitter has the tone that it has, and the report says that its rows were interpolated", "[fit]")
{
    RecordedRing ring { .time = jittered (2000, 0.3, 5) };
    std::mt19937 random (1);
    for (const double t : ring.time)
    {
        const double tone = std::exp (-4.0 * (t - 2.0)) * std::sin (2.0 * std::numbers::pi * 80.0 * (t - 2.0));
        ring.value.push_back (tone + std::normal_distribution { 0.0, 1e-3 }(random));
    }
    const auto fit = fitModes (ring);
    REQUIRE (fit);
    REQUIRE (fit->tones.size() == 1);
    CHECK (fit->tones[0].frequency == Approx (80.0).epsilon (1e-3));
    CHECK (fit->tones[0].decay == Approx (4.0).epsilon (0.05));
    bool said = false;
    for (const auto& note : fit->report.notes)
        said = said || note.find ("jitter by up to 30 % of a step") != std::string::npos;
    CHECK (said);
}
