// SPDX-License-Identifier: MIT
#include <host/devices/sessions/rate_meter.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus::host;

TEST_CASE ("a rate is accurate to a few millionths within ten seconds, even if readings are late", "[sessions]")
{
    tactus::test::property ("rate", [] {
        const double hz = *rc::gen::element (60.0, 125.0, 1000.0, 8000.0) * (1.0 + 1e-6 * *rc::gen::inRange (-300, 301));
        const double begin = *rc::gen::inRange (0, 1'000'000);
        RateMeter meter;
        for (int k = 0; k < 100; ++k)
        {
            // The time of a report, up to 0.1 ms late, and a count that may be off by one report.
            const auto count = static_cast<std::uint64_t> ((0.1 * k + 1.0) * hz);
            const double late = 1e-7 * *rc::gen::inRange (0, 1000);
            meter.add (begin + static_cast<double> (count) / hz + late, 77 + count);
        }
        const auto rate = meter.rate();
        RC_ASSERT (rate.has_value());
        RC_ASSERT (std::abs (rate->hz / hz - 1.0) < 12e-6);
        RC_ASSERT (rate->error / hz < 5e-6);
    });
}

TEST_CASE ("without readings at different times there is no rate", "[sessions]")
{
    RateMeter meter;
    CHECK_FALSE (meter.rate());
    for (int k = 0; k < 5; ++k)
        meter.add (3.0, 100);
    CHECK_FALSE (meter.rate());
    meter.add (4.0, 1100);
    REQUIRE (meter.rate());
    CHECK (meter.rate()->hz == Approx (1000.0));
    meter.add (2.0, 0);   // a clock that goes backwards is ignored
    CHECK (meter.rate()->hz == Approx (1000.0));
    meter.reset();
    CHECK_FALSE (meter.rate());
}
