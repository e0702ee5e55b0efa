// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/tools/stems/stem_clips.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr double rate_hz = 4000.0;

/// A held force, and a vibration of 200 Hz, each along its direction, for a second.
Stretch pressed (const std::array<double, 3>& held_n, const std::array<double, 3>& vibration_n)
{
    Stretch s { .rate_hz = rate_hz, .until = 4000, .names = { "motor.force.x", "motor.force.y", "motor.force.z" }, .unit = "N" };
    for (int k = 0; k < 4000; ++k)
        for (std::size_t c = 0; c < 3; ++c)
            s.values.push_back (held_n[c] + vibration_n[c] * std::sin (2.0 * std::numbers::pi * 200.0 * k / rate_hz));
    return s;
}

double largest (const Stretch& s)
{
    return std::abs (*std::ranges::max_element (s.values, {}, [] (double v) { return std::abs (v); }));
}

double meanOf (const Stretch& s)
{
    double sum = 0.0;
    for (const double v : s.values)
        sum += v;
    return sum / static_cast<double> (s.values.size());
}
}   // namespace

TEST_CASE ("a force of a take vibrates as strongly as it was recorded, and does not push", "[stems][take]")
{
    Messages losses;
    const auto played = playableStretch (pressed ({ 0.3, 0.4, 0.94 }, { 0.18, 0.0, 0.24 }), losses);
    REQUIRE (played.names.size() == 1);
    CHECK (played.names[0].starts_with ("motor.force along "));
    CHECK (played.unit == "N");
    CHECK (played.ticks() == 4000);
    REQUIRE (played.values.size() == 4000);
    CHECK (largest (played) == Approx (0.3).epsilon (0.08));
    CHECK (std::abs (meanOf (played)) < 0.005);
    REQUIRE (losses.size() == 1);
    CHECK (losses[0].id == "clip/held");
}

TEST_CASE ("a clip of a held force that is reversed says how far it peaks above the force", "[stems][take]")
{
    auto reversed = pressed ({ 0.0, 0.0, 0.5 }, {});
    for (std::size_t k = 3 * 2000 + 2; k < reversed.values.size(); k += 3)
        reversed.values[k] = -0.5;
    Messages losses;
    CHECK (largest (playableStretch (reversed, losses)) == Approx (1.0).epsilon (0.01));   // the step, twice the force
    REQUIRE (losses.size() == 1);
    CHECK (losses[0].text.find ("peaks at 1.98 times its peak") != std::string::npos);
}

TEST_CASE ("a force that is held alone is a clip of silence", "[stems][take]")
{
    Messages losses;
    CHECK (largest (playableStretch (pressed ({ 0.0, 0.0, 0.94 }, {}), losses)) < 1e-6);
    CHECK (losses.size() == 1);
}

TEST_CASE ("what is no force stays as it was recorded", "[stems][take]")
{
    auto positions = pressed ({ 0.1, 0.2, 0.3 }, {});
    positions.unit = "m";
    Messages losses;
    const auto same = playableStretch (positions, losses);
    CHECK (same.names == positions.names);
    CHECK (same.values == positions.values);
    CHECK (losses.empty());
}
