// SPDX-License-Identifier: MIT
// What the one-pole and the Butterworth low-pass have in common.

#include "response.hpp"

#include <tactus/nodes/filter/butterworth2.hpp>
#include <tactus/nodes/filter/one_pole.hpp>

#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <limits>

using tactus::nodes::Butterworth2;
using tactus::nodes::OnePole;
using tactus::test::ready;

namespace
{
std::complex<double> prototypeOf (const OnePole&, std::complex<double> s) { return 1.0 / (1.0 + s); }
std::complex<double> prototypeOf (const Butterworth2&, std::complex<double> s) { return 1.0 / (s * s + std::numbers::sqrt2 * s + 1.0); }
}   // namespace

TEMPLATE_TEST_CASE ("low-pass: the response is the response of the analogue filter, after the bilinear transform", "[nodes][filter]", OnePole, Butterworth2)
{
    tactus::test::property ("any cutoff and frequency", [] {
        const double cutoff = *rc::gen::inRange (5, 495) / 1000.0, turns = *rc::gen::inRange (0, 500) / 1000.0;
        const auto filter = ready<TestType> ({ .cutoff = 1000.0 * cutoff });
        RC_ASSERT (std::abs (Response { filter }(turns)-prototypeOf (filter, bilinear (turns, cutoff))) < 1e-9);
    });
}

TEMPLATE_TEST_CASE ("low-pass: 3 dB down at the cutoff, unity gain at 0 Hz, nothing at half the rate", "[nodes][filter]", OnePole, Butterworth2)
{
    const double cutoff = GENERATE (5.0, 100.0, 250.0, 480.0);
    const Response response { ready<TestType> ({ .cutoff = cutoff }) };
    CHECK (std::norm (response (cutoff / 1000.0)) == Approx (0.5));
    CHECK (std::abs (response (0.0)) == Approx (1.0));
    CHECK (std::abs (response (0.5)) < 1e-9);
}

TEMPLATE_TEST_CASE ("low-pass: stable at any cutoff, even above half the rate", "[nodes][filter]", OnePole, Butterworth2)
{
    const double cutoff = GENERATE (0.0, 1e-9, 1.0, 499.9, 500.0, 501.0, 1e6, 1e300);
    auto node = ready<TestType> ({ .cutoff = cutoff });
    double out = 0.0;
    for (int k = 0; k < 100'000; ++k)
    {
        out = node.tick ({ .in = k % 3 == 0 ? 1.0 : -0.5 }).out;
        REQUIRE (std::abs (out) <= 2.0);
    }
    if (cutoff >= 500.0)
        for (int k = 0; k < 30'000; ++k)
            out = node.tick ({ .in = 1.0 }).out;
    if (cutoff >= 500.0) CHECK (out == Approx (1.0));
}

TEMPLATE_TEST_CASE ("low-pass: starts from rest after a sample that is nan", "[nodes][filter]", OnePole, Butterworth2)
{
    auto used = ready<TestType> ({ .cutoff = 50.0 }), fresh = ready<TestType> ({ .cutoff = 50.0 });
    for (int k = 0; k < 10; ++k)
        used.tick ({ .in = 1.0 });
    CHECK (used.tick ({ .in = std::numeric_limits<double>::quiet_NaN() }).out == 0.0);
    for (int k = 0; k < 10; ++k)
        CHECK (used.tick ({ .in = 2.0 }).out == fresh.tick ({ .in = 2.0 }).out);
}
