// SPDX-License-Identifier: MIT
#include <tactus/text/units.hpp>

#include <catch2/catch.hpp>

#include <numbers>

using namespace tactus;
using Catch::Matchers::Contains;

namespace
{
Measure read (std::string_view text)
{
    const auto result = parseMeasure (text);
    if (! result) FAIL (result.error().text);
    return *result;
}

std::string refusal (std::string_view text)
{
    const auto result = parseMeasure (text);
    return result ? "" : result.error().text;
}

constexpr Dimension none {};
}   // namespace

TEST_CASE ("a value in any unit reads to the same double as the value in SI")
{
    CHECK (read ("0.4 mm").value == 0.0004);
    CHECK (read ("0.7 mm").value == 0.0007);
    CHECK (read ("2 N/mm").value == 2000.0);
    CHECK (read ("60 mN").value == 0.06);
    CHECK (read ("1e-4 m/N").value == 1e-4);
    CHECK (read ("50 g").value == 0.05);
    CHECK (read ("3e2 µm").value == 3e-4);
    CHECK (read ("3e+2 μm").value == 3e-4);
    CHECK (read ("3 mm2").value == 3e-6);
    CHECK (read ("5 %").value == 0.05);
    CHECK (read ("180 deg").value == std::numbers::pi);
    CHECK (read ("-1.5 kHz").value == -1500.0);
    CHECK (read ("+2").value == 2.0);
    CHECK (read ("  7um ").value == 7e-6);
    CHECK (read ("0 pm").value == 0.0);
}

TEST_CASE ("units carry their dimension")
{
    CHECK (read ("0.5").dimension == none);
    CHECK (read ("5 %").dimension == none);
    CHECK (read ("30 deg").dimension == none);
    CHECK (read ("30 mrad").dimension == none);
    CHECK (read ("0.5 1").dimension == none);
    CHECK (read ("1200 1/m").dimension == unit::per_metre.dimension);
    CHECK (read ("1200/m").dimension == unit::per_metre.dimension);
    CHECK (read ("1 m").dimension == unit::metre.dimension);
    CHECK (read ("1 mm").dimension == unit::metre.dimension);
    CHECK (read ("1 ms").dimension == unit::second.dimension);
    CHECK (read ("1 m s").dimension == (Dimension { 1, 0, 1 }));
    CHECK (read ("1 N*s/m").dimension == unit::damping.dimension);
    CHECK (read ("1 N s/m").dimension == unit::damping.dimension);
    CHECK (read ("1 N * s / m").dimension == unit::damping.dimension);
    CHECK (read ("1 J/m2").dimension == unit::toughness.dimension);
    CHECK (read ("1 m^2").dimension == (Dimension { 2, 0, 0 }));
    CHECK (read ("1 s-1").dimension == unit::hertz.dimension);
    CHECK (read ("1 m/s/s").dimension == (Dimension { 1, 0, -2 }));
    CHECK (read ("1 N m").dimension == unit::joule.dimension);
    CHECK (read ("1 W/N").dimension == unit::speed.dimension);
    CHECK (read ("1 kPa").dimension == (Dimension { -1, 1, -2 }));
}

TEST_CASE ("text that is not a value is refused with the reason")
{
    CHECK_THAT (refusal (""), Contains ("empty"));
    CHECK_THAT (refusal ("   "), Contains ("empty"));
    CHECK_THAT (refusal ("mm"), Contains ("does not begin with a number"));
    CHECK_THAT (refusal ("+-2"), Contains ("does not begin with a number"));
    CHECK_THAT (refusal ("nan"), Contains ("finite"));
    CHECK_THAT (refusal ("inf N"), Contains ("finite"));
    CHECK_THAT (refusal ("-infinity"), Contains ("finite"));
    CHECK_THAT (refusal ("1e999"), Contains ("too large"));
    CHECK_THAT (refusal ("1e308 km"), Contains ("too large"));
    CHECK_THAT (refusal ("0,4 mm"), Contains ("decimal point"));
    CHECK_THAT (refusal ("0.4 foo"), Contains ("unknown unit 'foo'; the known units are m, g, s,"));
    CHECK_THAT (refusal ("3 min"), Contains ("unknown unit 'min'"));
    CHECK_THAT (refusal ("3 kdeg"), Contains ("unknown unit 'kdeg'"));
    CHECK_THAT (refusal ("3 m²"), Contains ("unknown unit 'm²'"));
    CHECK_THAT (refusal ("-6 dB"), Contains ("bare number"));
    CHECK_THAT (refusal ("3 N/"), Contains ("a unit is missing at the end"));
    CHECK_THAT (refusal ("3 N//m"), Contains ("a unit is missing before '/m'"));
    CHECK_THAT (refusal ("3 4"), Contains ("a unit is missing before"));
    CHECK_THAT (refusal ("3 N/4"), Contains ("a unit is missing before"));
    CHECK_THAT (refusal ("3 m2s"), Contains ("side by side"));
    CHECK_THAT (refusal ("3 m^x"), Contains ("integer"));
    CHECK_THAT (refusal ("3 m99999999999"), Contains ("integer"));
    CHECK_THAT (refusal ("3 m9 m9"), Contains ("higher than in any physical quantity"));
    CHECK_THAT (refusal (std::string (100000, '1')), Contains ("too long"));
    CHECK_THAT (refusal ("1 \xFF\x01"), Contains ("'\\xFF\\x01'"));
}

TEST_CASE ("a dimension is written so that it can be read back")
{
    CHECK (symbolOf (none) == "1");
    CHECK (symbolOf (unit::newton.dimension) == "N");
    CHECK (symbolOf (unit::stiffness.dimension) == "N/m");
    CHECK (symbolOf (unit::damping.dimension) == "N*s/m");
    CHECK (symbolOf (unit::speed.dimension) == "m/s");
    CHECK (symbolOf (unit::hertz.dimension) == "1/s");
    CHECK (symbolOf ({ 2, 1, -4 }) == "kg*m2/s4");
    for (int m = -4; m <= 4; ++m)
        for (int kg = -4; kg <= 4; ++kg)
            for (int s = -4; s <= 4; ++s)
            {
                const Dimension d { static_cast<signed char> (m), static_cast<signed char> (kg), static_cast<signed char> (s) };
                const auto back = read ("3 " + symbolOf (d));
                CHECK (back.dimension == d);
                CHECK (back.value == 3.0);
            }
}
