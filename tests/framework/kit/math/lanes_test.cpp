// SPDX-License-Identifier: MIT
// A vector type takes the place of double in the elementary functions, and gives the same bits in each lane.
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/random.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cstdint>

namespace
{
using Pair [[gnu::vector_size (16)]] = double;
using PairOfWords [[gnu::vector_size (16)]] = std::uint64_t;
}   // namespace

template <>
struct tactus::math::Word<Pair>
{
    using type = PairOfWords;
};

namespace math = tactus::math;

TEST_CASE ("math: lanes give the bits of single numbers", "[framework][math]")
{
    tactus::Random random (11);
    int different = 0;
    const auto compare = [&] (const Pair& lanes, double first, double second) {
        const double alone[] { first, second };
        for (int i = 0; i < 2; ++i)
        {
            const double lane = lanes[i];
            different += ! (lane != lane && alone[i] != alone[i]) && std::bit_cast<std::uint64_t> (lane) != std::bit_cast<std::uint64_t> (alone[i]);
        }
    };
    for (int i = 0; i < 5000; ++i)
    {
        const auto number = [&] { return i % 3 != 0 ? 40.0 * random.uniform() - 20.0 : std::bit_cast<double> (random.bits()); };
        const double a = number(), b = 20.0 * random.uniform(), c = number(), d = number();
        const Pair x { a, b }, y { c, d };
        compare (math::exp (x), math::exp (a), math::exp (b));
        compare (math::exp2 (x), math::exp2 (a), math::exp2 (b));
        compare (math::expm1 (x), math::expm1 (a), math::expm1 (b));
        compare (math::log (x), math::log (a), math::log (b));
        compare (math::log1p (x), math::log1p (a), math::log1p (b));
        compare (math::log10 (x), math::log10 (a), math::log10 (b));
        compare (math::pow (x, y), math::pow (a, c), math::pow (b, d));
        compare (math::sin (x), math::sin (a), math::sin (b));
        compare (math::cos (x), math::cos (a), math::cos (b));
        compare (math::tan (x), math::tan (a), math::tan (b));
        compare (math::atan (x), math::atan (a), math::atan (b));
        compare (math::atan2 (y, x), math::atan2 (c, a), math::atan2 (d, b));
    }
    CHECK (different == 0);
}
