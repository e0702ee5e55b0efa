// SPDX-License-Identifier: MIT
#include <framework/length.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <cmath>

using namespace tactus;

TEST_CASE ("length: right for vectors of any size", "[framework][length]")
{
    rc::prop ("scaled by a power of two it is as much longer, from tiny to huge", []
              {
                  const auto component = rc::gen::map (rc::gen::inRange (-1000, 1001), [] (int i)
                                                       { return 1e-3 * i; });
                  const Vec3 v { *component, *component, *component };
                  const int exponent = *rc::gen::inRange (-1000, 1001);
                  const double wanted = std::sqrt (v.squaredNorm());
                  RC_ASSERT (std::abs (std::ldexp (length (Vec3 { std::ldexp (v.x(), exponent), std::ldexp (v.y(), exponent), std::ldexp (v.z(), exponent) }), -exponent) - wanted) <= 1e-14 * wanted); });

    CHECK (length (Vec3::Zero()) == 0.0);
    CHECK (length (Vec3 { 3e300, 4e300, 0.0 }) == Approx (5e300));
    CHECK (length (Vec3 { 3e-300, 0.0, -4e-300 }) == Approx (5e-300));
}
