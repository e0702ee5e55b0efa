// SPDX-License-Identifier: MIT
#include <tactus/text/number_text.hpp>
#include <tactus/text/rounded_bound.hpp>

#include <support/property.hpp>

#include <cmath>
#include <cstdlib>

using namespace tactus;

TEST_CASE ("a rounded bound is on its side of the number, as near as three digits can be, also once it is written", "[text]")
{
    test::property ("any number, up and down", [] {
        const double v = std::pow (10.0, 1e-6 * *rc::gen::inRange (-9'000'000, 9'000'000));
        for (const bool is_up : { false, true })
        {
            const double bound = std::strtod (roundedText (roundedBound (v, is_up), 3).c_str(), nullptr);
            RC_ASSERT ((is_up ? bound - v : v - bound) >= 0.0);
            RC_ASSERT (std::abs (bound - v) <= 0.01 * v);
        }
    });
    CHECK (roundedBound (3999.9999, false) == 3990.0);
    CHECK (roundedBound (3999.9999, false, 1e-6) == 4000.0);
    CHECK (roundedBound (0.2991, true) == Approx (0.3));
    CHECK (std::isinf (roundedBound (HUGE_VAL, true)));
}
