// SPDX-License-Identifier: MIT
#include <tactus/nodes/filter/butterworth2.hpp>
#include <tactus/nodes/filter/reconstruction.hpp>

#include <support/ready.hpp>
#include <tactus/kit/geometry/rotation.hpp>

#include <catch2/catch.hpp>

using tactus::Vec3;
using tactus::nodes::Butterworth2;
using tactus::nodes::Reconstruction;
using tactus::test::ready;

namespace
{
Vec3 forceAt (int k) { return { std::sin (0.3 * k), k % 50 < 25 ? 1.0 : -0.5, 0.01 * k }; }
}   // namespace

TEST_CASE ("reconstruction: each component passes the Butterworth low-pass, bit for bit", "[nodes][filter]")
{
    auto node = ready<Reconstruction> ({ .cutoff = 30.0 });
    auto x = ready<Butterworth2> ({ .cutoff = 30.0 }), y = x, z = x;
    for (int k = 0; k < 1000; ++k)
    {
        const Vec3 f = forceAt (k);
        const Vec3 expected { x.tick ({ .in = f.x() }).out, y.tick ({ .in = f.y() }).out, z.tick ({ .in = f.z() }).out };
        REQUIRE (node.tick ({ .in = f }).out == expected);
    }
}

TEST_CASE ("reconstruction: it does not matter how the axes are turned", "[nodes][filter]")
{
    const auto turn = tactus::rotationMatrix (Vec3 (0.3, -1.1, 0.7));
    auto straight = ready<Reconstruction> ({ .cutoff = 30.0 }), turned = straight;
    for (int k = 0; k < 500; ++k)
        REQUIRE ((turn * straight.tick ({ .in = forceAt (k) }).out - turned.tick ({ .in = turn * forceAt (k) }).out).norm() < 1e-12);
}

TEST_CASE ("reconstruction: a slow force comes 1/(pi sqrt 2 cutoff) later", "[nodes][filter]")
{
    for (const double cutoff : { 30.0, 400.0 })
    {
        constexpr double rate = 20'000.0;
        auto node = ready<Reconstruction> ({ .cutoff = cutoff }, rate);
        double lag = 0.0;
        for (int k = 0; k < 4000; ++k)   // a ramp of 1 N/s
            lag = k / rate - node.tick ({ .in = { 0.0, k / rate, 0.0 } }).out.y();
        CHECK (lag == Approx (1.0 / (std::numbers::pi * std::numbers::sqrt2 * cutoff)).epsilon (2e-3));
    }
}

TEST_CASE ("reconstruction: one component that is not finite gives 0 on all, and has no effect afterwards", "[nodes][filter]")
{
    auto node = ready<Reconstruction> ({ .cutoff = 30.0 }), fresh = node;
    for (int k = 0; k < 20; ++k)
        node.tick ({ .in = forceAt (k) });
    CHECK (node.tick ({ .in = { 1.0, std::numeric_limits<double>::quiet_NaN(), 2.0 } }).out == Vec3 (0, 0, 0));
    for (int k = 0; k < 20; ++k)
        CHECK (node.tick ({ .in = forceAt (k) }).out == fresh.tick ({ .in = forceAt (k) }).out);
}
