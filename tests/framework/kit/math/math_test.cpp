// SPDX-License-Identifier: MIT
// The elementary functions against reference values (reference.csv, written by reference.py with mpmath), the rules of C for special
// values, and the C library where it must be exact.
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/random.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace math = tactus::math;

namespace
{
constexpr double inf = std::numeric_limits<double>::infinity();
using One = double (*) (double);
using Two = double (*) (double, double);

struct OneFunction
{
    const char* name;
    One ours, theirs;
    double most_ulp;
};

struct TwoFunction
{
    const char* name;
    Two ours, theirs;
    double most_ulp;
};

// clang-format off
#define ONE(name, most_ulp) { #name, [] (double x) { return math::name (x); }, [] (double x) { return std::name (x); }, most_ulp }
#define TWO(name, most_ulp) { #name, [] (double x, double y) { return math::name (x, y); }, [] (double x, double y) { return std::name (x, y); }, most_ulp }
// clang-format on
// The doc blocks promise these errors.
const OneFunction of_one[] { ONE (exp, 1.2), ONE (exp2, 1.2), ONE (expm1, 1.2), ONE (log, 1.4), ONE (log1p, 1.4), ONE (log2, 1.0), ONE (log10, 1.0),
                             ONE (sin, 1.0), ONE (cos, 1.0), ONE (tan, 1.5), ONE (asin, 1.6), ONE (acos, 1.8), ONE (atan, 1.1) };
const TwoFunction of_two[] { TWO (pow, 1.2), TWO (atan2, 1.1), TWO (hypot, 1.2) };
const TwoFunction exact[] { TWO (fmod, 0.0), TWO (remainder, 0.0) };
#undef ONE
#undef TWO

double unitOf (double value)
{
    return std::ldexp (1.0, std::max (std::ilogb (value) - 52, -1074));
}

/// Any double that is a number or infinite, with every exponent alike.
double anyDouble (tactus::Random& random)
{
    const auto value = std::bit_cast<double> (random.bits());
    return value == value ? value : 1.0;
}

/// The same kind of value: not a number, the same infinity, a zero of the same sign, or finite with the same sign.
bool alike (double a, double b)
{
    if (a != a || b != b) return a != a && b != b;
    return std::fpclassify (a) == std::fpclassify (b) && std::signbit (a) == std::signbit (b) && (std::abs (b) < inf || a == b);
}

const std::vector<double> special { 0.0, 1.0, 0.5, 2.0, 3.0, 1.5, 4.0, 1e-310, 5e-324, 0x1p-1022, 1e-200, 1e-30,
                                    1e30, 1e200, 1e308, 709.7, 709.8, 745.1, 745.2, 1074.0, 1023.0, 1024.0, inf, std::nan ("") };

std::vector<double> withBothSigns (const std::vector<double>& values)
{
    auto all = values;
    for (const double v : values)
        all.push_back (-v);
    return all;
}
}   // namespace

TEST_CASE ("math: the errors are below those promised, and below 2 ulp", "[framework][math]")
{
    std::ifstream file (TACTUS_SOURCE_DIR "/tests/framework/kit/math/reference.csv");
    REQUIRE (file.is_open());
    std::map<std::string, double> worst;
    std::map<std::string, int> count;
    std::string line;
    std::getline (file, line);
    while (std::getline (file, line))
    {
        std::istringstream cells (line);
        std::string name, text;
        std::getline (cells, name, ',');
        double cell[4] {};
        for (double& v : cell)
        {
            std::getline (cells, text, ',');
            v = std::strtod (text.c_str(), nullptr);
        }
        const auto [x, y, value, missing] = cell;
        double ours = std::nan ("");
        for (const auto& f : of_one)
            if (name == f.name) ours = f.ours (x);
        for (const auto& f : of_two)
            if (name == f.name) ours = f.ours (x, y);
        const double error = std::abs ((ours - value) / unitOf (value) - missing);
        worst[name] = ! (error <= worst[name]) ? error : worst[name];
        ++count[name];
        INFO (line << ": " << ours);
        if (! (error < 2.0)) CHECK (error < 2.0);
    }
    const auto check = [&] (const auto& f) {
        INFO (f.name << ": " << worst[f.name] << " ulp");
        CHECK (count[f.name] >= 70);
        CHECK (worst[f.name] <= f.most_ulp);
    };
    for (const auto& f : of_one)
        check (f);
    for (const auto& f : of_two)
        check (f);
}

TEST_CASE ("math: infinities, NaN, zeros and the ends of the range are treated as in C", "[framework][math]")
{
    for (const auto& f : of_one)
        for (const double x : withBothSigns (special))
        {
            INFO (f.name << " (" << x << ") is " << f.ours (x) << ", in C " << f.theirs (x));
            CHECK (alike (f.ours (x), f.theirs (x)));
        }
    const auto check = [] (const TwoFunction& f) {
        for (const double x : withBothSigns (special))
            for (const double y : withBothSigns (special))
            {
                INFO (f.name << " (" << x << ", " << y << ") is " << f.ours (x, y) << ", in C " << f.theirs (x, y));
                CHECK (alike (f.ours (x, y), f.theirs (x, y)));
            }
    };
    for (const auto& f : of_two)
        check (f);
    for (const auto& f : exact)
        check (f);
}

TEST_CASE ("math: what is exact in C is exact", "[framework][math]")
{
    tactus::Random random (3);
    const auto same = [] (double a, double b) { return (a != a && b != b) || std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b); };
    int different = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const double x = anyDouble (random), y = i % 2 != 0 ? anyDouble (random) : x * random.uniform() * 0x1p-3, z = 20.0 * random.uniform();
        for (const auto& f : exact)
            different += ! same (f.ours (x, y), f.theirs (x, y)) + ! same (f.ours (y, x), f.theirs (y, x)) + ! same (f.ours (x, z), f.theirs (x, z));
    }
    for (int n = -8; n <= 8; ++n)   // ties
        for (const double y : { 1.0, 1e-323, 0x1p1023 })
            different += ! same (math::remainder (0.5 * n * y, y), std::remainder (0.5 * n * y, y));
    CHECK (different == 0);

    for (int n = -1074; n <= 1023; ++n)
    {
        CHECK (math::exp2 (1.0 * n) == std::ldexp (1.0, n));
        CHECK (math::log2 (std::ldexp (1.0, n)) == n);
    }
    double power = 1.0;
    for (int n = 0; n <= 22; ++n, power *= 10.0)
    {
        CHECK (math::log10 (power) == n);
        CHECK (math::pow (10.0, n) == power);
    }
}

TEST_CASE ("math: odd functions are odd and even ones even, to the last bit", "[framework][math]")
{
    tactus::Random random (5);
    int different = 0;
    for (int i = 0; i < 20000; ++i)
    {
        const double x = i % 2 != 0 ? anyDouble (random) : 200.0 * random.uniform() - 100.0;
        if (std::abs (x) == inf) continue;
        different += math::sin (x) != -math::sin (-x);
        different += math::tan (x) != -math::tan (-x);
        different += math::atan (x) != -math::atan (-x);
        different += math::cos (x) != math::cos (-x);
    }
    CHECK (different == 0);
}

TEST_CASE ("math: the bits are the same on every machine", "[framework][math]")
{
    // If a function changes on purpose: put the new number here, and raise math::revision.
    tactus::Random random (7);
    std::uint64_t hash = 0;
    const auto add = [&] (double v) { hash = (hash ^ (v == v ? std::bit_cast<std::uint64_t> (v) : 1u)) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29; };
    for (int i = 0; i < 4000; ++i)
    {
        const double wild = anyDouble (random), x = 60.0 * random.uniform() - 30.0, y = 60.0 * random.uniform() - 30.0;
        for (const auto& f : of_one)
        {
            add (f.ours (x));
            add (f.ours (0.03 * x));
            add (f.ours (wild));
        }
        for (const auto& f : of_two)
        {
            add (f.ours (x, y));
            add (f.ours (std::abs (x), y));
            add (f.ours (wild, x));
        }
        add (math::hypot (x, y, wild));
        add (math::hypot (x, y, 3.0));
    }
    INFO ("the hash is now 0x" << std::hex << hash);
    CHECK (hash == 0x2c257f10bee5867fu);
}

TEST_CASE ("math: in float, the result is that in double, rounded", "[framework][math]")
{
    for (const float x : { 1e-30f, 0.1f, 0.7f, 3.0f, 50.0f })
    {
        const double wide = x;
        CHECK (math::sin (x) == static_cast<float> (math::sin (wide)));
        CHECK (math::exp (x) == static_cast<float> (math::exp (wide)));
        CHECK (math::log (x) == static_cast<float> (math::log (wide)));
        CHECK (math::pow (x, 1.5f) == static_cast<float> (math::pow (wide, 1.5)));
        CHECK (math::atan2 (x, 2.0f) == static_cast<float> (math::atan2 (wide, 2.0)));
    }
}

TEST_CASE ("math: the length of three numbers is right from the smallest to the largest", "[framework][math]")
{
    for (const double scale : { 5e-324, 1e-300, 1e-150, 1.0, 1e150, 1e307 })
        CHECK (math::hypot (2.0 * scale, -3.0 * scale, 6.0 * scale) == Approx (7.0 * scale).epsilon (1e-15));
    CHECK (math::hypot (1.0, inf, std::nan ("")) == inf);
    CHECK (std::isnan (math::hypot (1.0, 2.0, std::nan (""))));
    CHECK (math::hypot (0.0, -0.0, 0.0) == 0.0);
}
