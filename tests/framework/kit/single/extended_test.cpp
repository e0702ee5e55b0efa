// SPDX-License-Identifier: MIT

#include <tactus/kit/single/extended.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using tactus::Extended;

namespace
{
/// A position as a device reports it, from -0.2 to 0.2 m.
double place (std::mt19937& random) { return 4e-8 * (static_cast<int> (random() % 10000001u) - 5000000); }
}   // namespace

TEST_CASE ("a position of two floats keeps fractions of a nanometre", "[kit][single]")
{
    std::mt19937 random { 1 };
    for (int i = 0; i < 10000; ++i)
    {
        const double a = place (random), b = a + 1e-9 * (static_cast<int> (random() % 2001u) - 1000);
        const Extended x = a, y = b;
        CHECK (std::abs (static_cast<double> (x) - a) <= 0x1p-48 * std::abs (a));
        const float difference = y - x;
        CHECK (std::abs (static_cast<double> (difference) - (b - a)) <= 2e-15 + 0x1p-24 * std::abs (b - a));
    }
    CHECK (static_cast<float> (0.1f + 1e-9f) - 0.1f == 0.0f);   // a float alone does not keep it
}

TEST_CASE ("sums, products and quotients of two floats have 45 bits", "[kit][single]")
{
    std::mt19937 random { 2 };
    for (int i = 0; i < 10000; ++i)
    {
        const double a = place (random), b = 100.0 * place (random), bound = 0x1p-44;
        const Extended x = a, y = b;
        CHECK (std::abs (static_cast<double> (x + y) - (a + b)) <= bound * (std::abs (a) + std::abs (b)));
        CHECK (std::abs (static_cast<double> (x * y) - a * b) <= bound * std::abs (a * b));
        if (b != 0.0) CHECK (std::abs (static_cast<double> (x / y) - a / b) <= bound * std::abs (a / b));
        CHECK ((x < y) == (a < b));
        CHECK (static_cast<double> (floor (y)) == std::floor (b));
        CHECK (static_cast<double> (abs (x)) == static_cast<double> (Extended (std::abs (a))));
    }
}

TEST_CASE ("steps of an encoder and long times are exact", "[kit][single]")
{
    CHECK (static_cast<double> (Extended (123456789)) == 123456789.0);
    CHECK (static_cast<double> (Extended (std::int64_t { 1 } << 40) + 1) == static_cast<double> ((std::int64_t { 1 } << 40) + 1));
    CHECK (static_cast<double> (Extended::steps (-123456789, 0x1p-30)) == -123456789.0 * 0x1p-30);
    const auto day = Extended (std::int64_t { 86400 } * 4000) * 0.00025f;   // ticks
    const auto later = Extended (std::int64_t { 86400 } * 4000 + 1) * 0.00025f;
    CHECK (std::abs (static_cast<double> (later - day) - 0.00025) < 1e-9);
}

TEST_CASE ("a position that is not a number is not finite", "[kit][single]")
{
    CHECK (isFinite (Extended (1.0f)));
    CHECK_FALSE (isFinite (Extended (std::nan (""))));
    CHECK_FALSE (isFinite (Extended (1e300)));
    CHECK (finiteOrZero (Extended (std::nan (""))) == 0.0f);
}
