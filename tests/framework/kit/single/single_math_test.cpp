// SPDX-License-Identifier: MIT
// The functions in single precision against those in double precision.

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/single/math.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

using namespace tactus;

namespace
{
constexpr int samples = 200000;

/// The distance of a result from the right one, in units of the last place of a float.
double ulps (float result, double right)
{
    const auto nearest = static_cast<float> (right);
    if (nearest != nearest) return result != result ? 0.0 : 1e9;
    if (std::isinf (nearest) || std::isinf (result)) return nearest == result ? 0.0 : std::abs (right) > 3.4028e38 ? 1.0
                                                                                                                   : 1e9;
    const float size = std::max (std::abs (nearest), std::numeric_limits<float>::min());
    const double unit = static_cast<double> (std::nextafter (size, std::numeric_limits<float>::infinity())) - static_cast<double> (size);
    return std::abs (static_cast<double> (result) - right) / unit;
}

/// The largest error on numbers of all sizes whose exponents are within these bounds.
template <typename Single, typename Double>
double worst (Single single_function, Double double_function, int least, int most, bool with_negative = true)
{
    std::mt19937 random { 3 };
    double error = 0.0;
    for (int i = 0; i < samples; ++i)
    {
        const auto mantissa = 1.0f + static_cast<float> (random() >> 9) * 0x1p-23f;
        float x = std::ldexp (mantissa, least + static_cast<int> (random() % static_cast<unsigned> (most - least + 1)));
        if (with_negative && random() % 2 == 0) x = -x;
        error = std::max (error, ulps (single_function (x), double_function (static_cast<double> (x))));
    }
    return error;
}

#define TACTUS_WORST(name, ...) worst ([] (float x) { return single::name (x); }, [] (double x) { return math::name (x); }, __VA_ARGS__)
}   // namespace

TEST_CASE ("functions in single precision are right to three units in the last place", "[kit][single]")
{
    CHECK (TACTUS_WORST (exp, -30, 7) <= 2.0);
    CHECK (TACTUS_WORST (exp2, -30, 7) <= 2.0);
    CHECK (TACTUS_WORST (expm1, -40, 7) <= 3.0);
    CHECK (TACTUS_WORST (log, -140, 127, false) <= 2.0);
    CHECK (TACTUS_WORST (log1p, -40, 40, false) <= 3.0);
    CHECK (TACTUS_WORST (log2, -140, 127, false) <= 2.0);
    CHECK (TACTUS_WORST (log10, -140, 127, false) <= 2.0);
    CHECK (TACTUS_WORST (sin, -40, 127) <= 3.0);
    CHECK (TACTUS_WORST (cos, -40, 127) <= 3.0);
    CHECK (TACTUS_WORST (tan, -40, 127) <= 4.0);
    CHECK (TACTUS_WORST (atan, -60, 60) <= 3.0);
    CHECK (TACTUS_WORST (asin, -40, -1) <= 3.0);
    CHECK (TACTUS_WORST (acos, -40, -1) <= 3.0);
}

TEST_CASE ("functions of two numbers in single precision are right", "[kit][single]")
{
    std::mt19937 random { 4 };
    const auto number = [&random] (int least, int most) {
        const int exponent = least + static_cast<int> (random() % static_cast<unsigned> (most - least + 1));
        return std::ldexp (1.0f + static_cast<float> (random() >> 9) * 0x1p-23f, exponent);
    };
    double power = 0.0, angle = 0.0, length = 0.0;
    int wrong = 0;
    for (int i = 0; i < samples; ++i)
    {
        const float x = number (-10, 10), y = random() % 2 == 0 ? number (-6, 4) : -number (-6, 4);
        const double xd = static_cast<double> (x), yd = static_cast<double> (y);
        power = std::max (power, ulps (single::pow (x, y), math::pow (xd, yd)));
        angle = std::max (angle, ulps (single::atan2 (y, -x), math::atan2 (yd, -xd)));
        length = std::max (length, ulps (single::hypot (x, y), math::hypot (xd, yd)));
        const float large = number (-20, 60), small = number (-20, 20);
        if (single::fmod (large, small) != static_cast<float> (std::fmod (static_cast<double> (large), static_cast<double> (small)))) ++wrong;
        if (single::remainder (large, small) != std::remainder (large, small)) ++wrong;
    }
    CHECK (power <= 3.0);
    CHECK (angle <= 3.0);
    CHECK (length <= 2.0);
    CHECK (wrong == 0);
}

TEST_CASE ("functions in single precision treat infinities, NaN and zeros as in double precision", "[kit][single]")
{
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const auto same = [] (float a, double b) {
        const auto right = static_cast<float> (b);
        return (a != a && right != right) || std::bit_cast<std::uint32_t> (a) == std::bit_cast<std::uint32_t> (right);
    };
    for (const float x : { 0.0f, -0.0f, 1.0f, -1.0f, inf, -inf, nan, 1e-45f })
    {
        const double d = static_cast<double> (x);
        CAPTURE (x);
        CHECK (same (single::exp (x), math::exp (d)));
        CHECK (ulps (single::expm1 (x), math::expm1 (d)) <= 3.0);
        CHECK (ulps (single::log (x), math::log (d)) <= 2.0);
        CHECK (ulps (single::sin (x), math::sin (d)) <= 2.0);
        CHECK (ulps (single::atan (x), math::atan (d)) <= 2.0);
        for (const float y : { 0.0f, -0.0f, 2.0f, -3.0f, 0.5f, inf, -inf, nan })
        {
            CAPTURE (y);
            CHECK (ulps (single::pow (x, y), math::pow (d, static_cast<double> (y))) <= 2.0);
            CHECK (ulps (single::atan2 (x, y), math::atan2 (d, static_cast<double> (y))) <= 2.0);
        }
    }
    CHECK (std::signbit (single::expm1 (-0.0f)));
    CHECK (std::signbit (single::atan2 (-0.0f, 1.0f)));
    CHECK (same (single::exp (100.0f), math::exp (100.0)));
    CHECK (single::exp (-200.0f) == 0.0f);
}

TEST_CASE ("the sine of an angle with more digits than a float has the digits of the angle", "[kit][single]")
{
    std::mt19937 random { 5 };
    double worst = 0.0;
    for (int i = 0; i < samples; ++i)
    {
        const double angle = 1e-5 * (static_cast<int> (random() % 20000000u) - 10000000);   // up to 100 rad
        worst = std::max (worst, std::abs (static_cast<double> (single::sin (Extended (angle))) - math::sin (angle)));
    }
    CHECK (worst <= 1.5e-7);
}
