// SPDX-License-Identifier: MIT
// The elementary functions against MPFR, for random arguments of every size.
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/random.hpp>

#include <catch2/catch.hpp>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace math = tactus::math;

namespace
{
constexpr int draws = 4000;   // for each kind of argument

/// A number of MPFR. 120 bits leave 67 below the last place of a double.
class Exact
{
public:
    Exact (double x)
    {
        mpfr_init2 (value, 120);
        mpfr_set_d (value, x, MPFR_RNDN);
    }
    Exact (const Exact&) = delete;
    Exact& operator= (const Exact&) = delete;
    ~Exact() { mpfr_clear (value); }

    mpfr_t value;
};

/// The distance of a double from the exact value, in units of the last place of the double nearest to the exact value.
double errorOf (double ours, Exact& exact)
{
    const double nearest = mpfr_get_d (exact.value, MPFR_RNDN);
    if (! std::isfinite (nearest) || ! std::isfinite (ours))
    {
        const bool same = nearest == ours || (std::isnan (nearest) && std::isnan (ours));
        return same ? 0.0 : std::numeric_limits<double>::infinity();
    }
    const double unit = std::ldexp (1.0, std::max ((nearest == 0.0 ? -1074 : std::ilogb (nearest)) - 52, -1074));
    mpfr_sub_d (exact.value, exact.value, ours, MPFR_RNDN);
    mpfr_div_d (exact.value, exact.value, unit, MPFR_RNDN);
    return std::abs (mpfr_get_d (exact.value, MPFR_RNDN));
}

using Random = tactus::Random;

double between (Random& dice, double least, double most)
{
    return least + (most - least) * dice.uniform();
}

/// A double with a random exponent and either sign.
double ofAnySize (Random& dice, double least = -1074.0, double most = 1023.0)
{
    const double size = std::ldexp (between (dice, 1.0, 2.0), static_cast<int> (std::floor (between (dice, least, most + 1.0))));
    return dice.uniform() < 0.5 ? -size : size;
}

using Draw = std::function<double (Random&)>;
using OfOne = int (*) (mpfr_t, const mpfr_t, mpfr_rnd_t);
using OfTwo = int (*) (mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);

template <typename Ours>
void check (const char* name, Ours ours, OfOne exact, std::initializer_list<Draw> kinds)
{
    Random dice { 1 };
    double worst = 0.0, at = 0.0;
    for (const auto& draw : kinds)
        for (int i = 0; i < draws; ++i)
        {
            const double x = draw (dice);
            Exact result { x };
            exact (result.value, result.value, MPFR_RNDN);
            const double error = errorOf (ours (x), result);
            if (error > worst) worst = error, at = x;
        }
    INFO (name << " (" << at << ") is wrong by " << worst << " ulp");
    CHECK (worst < 2.0);
}

template <typename Ours>
void check (const char* name, Ours ours, OfTwo exact, std::initializer_list<std::pair<Draw, Draw>> kinds)
{
    Random dice { 2 };
    double worst = 0.0, at_x = 0.0, at_y = 0.0;
    for (const auto& [draw_x, draw_y] : kinds)
        for (int i = 0; i < draws; ++i)
        {
            const double x = draw_x (dice), y = draw_y (dice);
            Exact result { x };
            const Exact second { y };
            exact (result.value, result.value, second.value, MPFR_RNDN);
            const double error = errorOf (ours (x, y), result);
            if (error > worst) worst = error, at_x = x, at_y = y;
        }
    INFO (name << " (" << at_x << ", " << at_y << ") is wrong by " << worst << " ulp");
    CHECK (worst < 2.0);
}

Draw range (double least, double most)
{
    return [=] (Random& dice) { return between (dice, least, most); };
}

Draw size (double least, double most)
{
    return [=] (Random& dice) { return ofAnySize (dice, least, most); };
}

Draw positive (double least, double most)
{
    return [=] (Random& dice) { return std::abs (ofAnySize (dice, least, most)); };
}

double nearOne (Random& dice)
{
    return 1.0 + ofAnySize (dice, -52.0, -8.0);
}

double nearHalfTurn (Random& dice)
{
    return std::floor (between (dice, 1.0, 1e6)) * std::numbers::pi / 2.0;
}
}   // namespace

#define CALL_ONE(name) #name, [](double x) { return math::name (x); }, mpfr_##name
#define CALL_TWO(name) #name, [](double x, double y) { return math::name (x, y); }, mpfr_##name

TEST_CASE ("math: no function is wrong by 2 ulp, compared with MPFR", "[framework][math]")
{
    const auto exponents = { range (-746.0, 710.0), range (-1.0, 1.0), size (-60.0, 9.0) };
    check (CALL_ONE (exp), exponents);
    check (CALL_ONE (exp2), { range (-1075.0, 1024.0), range (-1.0, 1.0), size (-60.0, 10.0) });
    check (CALL_ONE (expm1), exponents);

    const auto positives = { positive (-1074.0, 1023.0), range (0.4, 2.5), Draw (nearOne) };
    check (CALL_ONE (log), positives);
    check (CALL_ONE (log2), positives);
    check (CALL_ONE (log10), positives);
    check (CALL_ONE (log1p), { positive (-1074.0, 1023.0), range (-1.0, 1.0), size (-60.0, -1.0) });

    const auto angles = { range (-8.0, 8.0), range (-60000.0, 60000.0), size (-1074.0, 1023.0), Draw (nearHalfTurn) };
    check (CALL_ONE (sin), angles);
    check (CALL_ONE (cos), angles);
    check (CALL_ONE (tan), angles);

    const auto sines = { range (-1.0, 1.0), size (-1074.0, -1.0), Draw ([] (Random& dice) { return 1.0 - positive (-53.0, -2.0) (dice); }) };
    check (CALL_ONE (asin), sines);
    check (CALL_ONE (acos), sines);
    check (CALL_ONE (atan), { range (-3.0, 3.0), size (-1074.0, 1023.0) });

    const auto any = size (-1074.0, 1023.0), moderate = size (-500.0, 500.0), small = range (-2.0, 2.0);
    check (CALL_TWO (atan2), { { small, small }, { any, any }, { moderate, small } });
    check (CALL_TWO (hypot), { { small, small }, { any, any }, { moderate, moderate } });
    check (CALL_TWO (pow), { { positive (-1074.0, 1023.0), small }, { range (0.0, 10.0), range (-300.0, 300.0) }, { nearOne, size (0.0, 40.0) } });
}
