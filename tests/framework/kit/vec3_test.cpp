// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/vec3.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace tactus;

TEST_CASE ("length: correct for vectors of any size", "[framework][length]")
{
    test::property ("scaling a vector by a power of two scales its length, from tiny to huge", [] {
        const auto component = rc::gen::map (rc::gen::inRange (-1000, 1001), [] (int i) { return 1e-3 * i; });
        const Vec3 v { *component, *component, *component };
        const int exponent = *rc::gen::inRange (-1000, 1001);
        const double expected = std::sqrt (v.squaredNorm());
        const Vec3 scaled { std::ldexp (v.x(), exponent), std::ldexp (v.y(), exponent), std::ldexp (v.z(), exponent) };
        RC_ASSERT (std::abs (std::ldexp (length (scaled), -exponent) - expected) <= 1e-14 * expected);
    });

    CHECK (length (Vec3::Zero()) == 0.0);
    CHECK (length (Vec3 { 3e300, 4e300, 0.0 }) == Approx (5e300));
    CHECK (length (Vec3 { 3e-300, 0.0, -4e-300 }) == Approx (5e-300));
}

TEST_CASE ("length: NaN if a component is NaN, wherever it is", "[framework][length]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double other : { 0.0, 1.0, 1e300, infinity })
        for (int i = 0; i < 3; ++i)
        {
            Vec3 v = Vec3::Constant (other);
            v[i] = nan;
            CHECK (std::isnan (length (v)));
        }
    CHECK (length (Vec3 { 0.0, -infinity, 1.0 }) == infinity);
}

TEST_CASE ("direction: length 1 for vectors of any size, 0 for the zero vector", "[framework][length]")
{
    CHECK (direction (Vec3::Zero()) == Vec3::Zero());
    for (const double size : { 5e-324, 1e-300, 1.0, 1e300 })
        CHECK ((direction (Vec3 { 0.0, -size, 0.0 }) + Vec3::UnitY()).norm() == 0.0);
    CHECK ((direction (Vec3 { 3e300, 4e300, 0.0 }) - Vec3 { 0.6, 0.8, 0.0 }).norm() < 1e-15);
}

TEST_CASE ("isFinite: false if any component of any value is not finite", "[framework][length]")
{
    constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const Vec3 good { 1e308, -0.0, 5e-324 };
    CHECK (isFinite (good, 1.0, good));
    for (const double bad : { inf, -inf, nan })
    {
        CHECK_FALSE (isFinite (bad));
        CHECK_FALSE (isFinite (good, bad));
        CHECK_FALSE (isFinite (Vec3 { 0.0, bad, 0.0 }, 1.0));
        CHECK (finiteOrZero (bad) == 0.0);
        CHECK (finiteOrZero (Vec3 { 1.0, bad, 0.0 }) == Vec3::Zero());
    }
    CHECK (finiteOrZero (good) == good);
}

TEST_CASE ("isFinite: for every mixture of three or four special values, what std::isfinite says of each", "[framework][length]")
{
    constexpr double inf = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
    const double some[] { 0.0, -0.0, 1.0, -1.0, 5e-324, largest, -largest, 1e308, inf, -inf, std::nan (""), -std::nan ("7") };
    int wrong = 0, finite = 0;
    for (const double a : some)
        for (const double b : some)
            for (const double c : some)
            {
                const bool three = std::isfinite (a) && std::isfinite (b) && std::isfinite (c);
                wrong += isFinite (Vec3 { a, b, c }) != three;
                wrong += isFinite (a, b, c) != three;
                for (const double d : some)
                {
                    const bool four = three && std::isfinite (d);
                    wrong += isFinite (Vec3 { a, b, c }, d) != four;
                    wrong += isFinite (a, Vec3 { b, c, d }) != four;
                    finite += four;
                }
            }
    CHECK (finite == 8 * 8 * 8 * 8);
    CHECK (wrong == 0);
}
