// SPDX-License-Identifier: MIT
#include <host/tools/figures/axis.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus::host;

namespace
{
std::string labelFor (double low, double high, std::string_view unit)
{
    return axisScale ({ low, high }, "q", unit).label;
}

std::string textOf (const std::vector<Tick>& ticks)
{
    std::string text;
    for (const auto& tick : ticks)
        text += tick.text + " ";
    return text;
}
}   // namespace

TEST_CASE ("axis: the prefix keeps numbers short", "[host][io][plot]")
{
    CHECK (labelFor (-3e-4, 3e-4, "m") == "q (mm)");
    CHECK (labelFor (0, 2e-6, "m") == "q (µm)");
    CHECK (labelFor (0, 0.3, "m") == "q (m)");
    CHECK (labelFor (0, 0.05, "N") == "q (mN)");
    CHECK (labelFor (0, 25, "N") == "q (N)");
    CHECK (labelFor (0, 2e3, "N/m") == "q (kN/m)");
    CHECK (labelFor (0, 0.02, "s") == "q (ms)");
    CHECK (labelFor (0, 2000, "s") == "q (s)");
    CHECK (labelFor (0, 0.05, "kg") == "q (g)");
    CHECK (labelFor (0, 5, "kg") == "q (kg)");
    CHECK (labelFor (0, 0.02, "N*s/m") == "q (mN·s/m)");
    CHECK (labelFor (0, 0.02, "m/s2") == "q (mm/s²)");
    CHECK (labelFor (0, 0.0, "m") == "q (m)");

    const auto scale = axisScale ({ 0.0, 3e-4 }, "q", "m");
    CHECK (scale.shown (2e-4) == Approx (0.2));
}

TEST_CASE ("axis: a unit without prefixes takes a power of ten", "[host][io][plot]")
{
    CHECK (labelFor (0, 200, "1/m") == "q (1/m)");
    CHECK (labelFor (0, 2e7, "1/m") == "q (×10⁶ 1/m)");
    CHECK (labelFor (0, 1e-4, "m2") == "q (×10⁻⁶ m²)");   // mm2 could be mistaken for a thousandth of m2
    CHECK (labelFor (0, 0.5, "1") == "q");
    CHECK (labelFor (0, 5e-5, "") == "q (×10⁻⁶)");
}

TEST_CASE ("axis: values that vary little relative to their size are shown as a difference", "[host][io][plot]")
{
    const auto scale = axisScale ({ 1.200298, 1.200302 }, "position", "m");

    CHECK (scale.label == "position − 1.20029 m (µm)");
    CHECK (scale.shown (1.2003) == Approx (10.0).margin (1e-6));
    CHECK (labelFor (-1.200302, -1.200298, "m") == "q + 1.20031 m (µm)");
}

TEST_CASE ("axis: ticks are at multiples of 1, 2 or 5, with the same number of decimals", "[host][io][plot]")
{
    CHECK (textOf (ticksWithin ({ 0.0, 1.0 }, 5)) == "0.0 0.2 0.4 0.6 0.8 1.0 ");
    CHECK (textOf (ticksWithin ({ -1.2, 1.2 }, 4)) == "−1 0 1 ");
    CHECK (textOf (ticksWithin ({ 0.0, 0.3 }, 3)) == "0.0 0.1 0.2 0.3 ");
    CHECK (textOf (ticksWithin ({ -0.05, 1.05 }, 10, 1.0)) == "0 1 ");
    CHECK (textOf (ticksWithin ({ -0.2, 12.2 }, 5, 1.0)) == "0 5 10 ");
    CHECK (textOf (ticksWithin ({ 0.0, 60.0 }, 3)) == "0 20 40 60 ");
    CHECK (textOf (ticksWithin ({ -0.06, 0.0 }, 3)) == "−0.06 −0.04 −0.02 0.00 ");
}

TEST_CASE ("axis: a time axis that ends one sample before a round number is extended to it", "[host][io][plot]")
{
    const auto rounded = roundedOutwards ({ 0.0, 1.999 }, 10);

    CHECK (rounded.low == 0.0);
    CHECK (rounded.high == 2.0);
    CHECK (roundedOutwards ({ 0.0, 1.9 }, 10).high == 1.9);
}

TEST_CASE ("axis: a range is never empty, and ticks and scale are finite for any values", "[host][io][plot]")
{
    CHECK (widened ({}, 0.05).size() == 2.0);
    CHECK (widened ({ 0.0, 0.0 }, 0.05).size() == 2.0);
    CHECK (widened ({ 5.0, 5.0 }, 0.05).low == 4.5);
    CHECK (widened ({ 1.0, 1.0 + 1e-12 }, 0.05).low == Approx (0.9));

    const auto anything = [] (double a, double b) {
        const auto exponent = *rc::gen::inRange (-310, 310);
        Extent values;
        for (double value : { a * std::pow (10.0, exponent), b * std::pow (10.0, exponent) })
            if (isPlottable (value))
                values.include (value);

        const auto unit = *rc::gen::element<std::string> ("m", "kg", "1/m", "", "N*s/m");
        const auto scale = axisScale (values, "q", unit);
        const auto range = widened (scale.shown (values), 0.05);
        RC_ASSERT (std::isfinite (range.low));
        RC_ASSERT (range.size() > 0.0);

        const auto ticks = ticksWithin (range, 8);
        RC_ASSERT (ticks.size() <= 9u);
        for (const auto& tick : ticks)
            RC_ASSERT (tick.text.size() < 16u);
    };
    tactus::test::property ("any two values", anything);
}
