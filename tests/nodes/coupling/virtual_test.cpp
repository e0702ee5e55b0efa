// SPDX-License-Identifier: MIT
#include <tactus/nodes/coupling/virtual.hpp>

#include <golden/golden.hpp>
#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using tactus::Vec3;
using tactus::nodes::VirtualCoupling;
using tactus::test::Golden;
using tactus::test::ready;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A mass-damper under a constant hand force. The force of the coupling is held over each sample; the wall is at x > 0.
struct Device
{
    double M = 0.1, B = 2.0, T = 1e-3, hand = 0.5;
    double x = -1e-3, v = 0.1;

    void hold (double force)
    {
        const double a = std::exp (-B * T / M), g = M * (1.0 - a) / B, F = force + hand;
        x += g * v + (T - g) / B * F;
        v = a * v + (1.0 - a) / B * F;
    }
};

/// Peak-to-peak motion in the last fifth of twenty seconds against a wall.
double restlessness (double stiffness, double wall)
{
    auto node = ready<VirtualCoupling> ({ .stiffness = stiffness, .damping = 0.2, .normal = -Vec3::UnitX(), .wall_stiffness = wall });
    Device device;
    double lowest = tactus::inf, highest = -tactus::inf;
    for (int k = 0; k < 20'000; ++k)
    {
        device.hold (node.tick ({ .position = { device.x, 0, 0 } }).force.x());
        if (k < 16'000) continue;
        lowest = std::min (lowest, device.x);
        highest = std::max (highest, device.x);
    }
    return highest - lowest;
}
}   // namespace

TEST_CASE ("coupling: a mass against a hard wall matches the golden columns", "[nodes][coupling][golden]")
{
    const Golden golden ("wallsim");
    Device device { golden.param ("M"), golden.param ("B"), golden.dt_s(), golden.param ("hand_force"), golden.param ("x0"), golden.param ("v0") };
    const VirtualCoupling::Params params {
        .stiffness = golden.param ("kc"),
        .damping = golden.param ("bc"),
        .normal = -Vec3::UnitX(),
        .wall_stiffness = golden.param ("sigma_wall"),
    };
    auto node = ready<VirtualCoupling> (params, 1.0 / device.T);

    std::vector<double> xs, vs, fs;
    for (std::size_t i = 0; i < golden.rows(); ++i)
    {
        const double f = node.tick ({ .position = { device.x, 0, 0 } }).force.x();
        xs.push_back (device.x);
        vs.push_back (device.v);
        fs.push_back (f);
        device.hold (f);
    }
    const auto off = [&] (const std::string& column, const std::vector<double>& actual) {
        const auto actualAt = [&] (std::size_t i) { return actual[i]; };
        return golden.worst (column, actualAt);
    };
    CHECK (off ("x_vc", xs) <= 1.0);
    CHECK (off ("v_vc", vs) <= 1.0);
    CHECK (off ("f_vc", fs) <= 1.0);
}

TEST_CASE ("coupling: walls of any hardness come to rest, up to 0.8 of the stiffness the device can bear", "[nodes][coupling]")
{
    const double limit = 2.0 * Device {}.B / Device {}.T;
    for (const double wall : { 1e3, 1e4, 1e5, 1e6, 1e7, 1e8 })
    {
        INFO (wall);
        CHECK (restlessness (0.4 * limit, wall) < 1e-17);
        CHECK (restlessness (0.8 * limit, wall) < 1e-17);
    }
}

TEST_CASE ("coupling: beyond what the device can bear it buzzes, but does not diverge", "[nodes][coupling]")
{
    const double limit = 2.0 * Device {}.B / Device {}.T;
    for (const double wall : { 1e5, 1e6, 1e8 })
    {
        INFO (wall);
        CHECK (restlessness (1.3 * limit, wall) > 5e-5);
        CHECK (restlessness (1.3 * limit, wall) < 1e-3);
    }
}

TEST_CASE ("coupling: at rest the tool feels coupling and wall in series, and the proxy shares the load", "[nodes][coupling]")
{
    auto node = ready<VirtualCoupling> ({ .stiffness = 1000.0, .damping = 0.5, .normal = { 0, 0, 7 }, .offset = 0.01, .wall_stiffness = 4000.0 });
    VirtualCoupling::Outputs out;
    for (int k = 0; k < 200; ++k)
        out = node.tick ({ .position = { 0.1, -0.2, 0.008 } });
    CHECK (out.depth == Approx (0.002));
    CHECK (out.force.z() == Approx (800.0 * 0.002));
    CHECK (out.force.head<2>().isZero (0.0));
    CHECK (out.proxy.x() == 0.1);
    CHECK (out.proxy.y() == -0.2);
    CHECK (0.01 - out.proxy.z() == Approx (0.0004));   // 1.6 N into 4000 N/m
    CHECK (out.state == 1.0);
    CHECK (node.claims().stiffness == Approx (800.0));
}

TEST_CASE ("coupling: apart there is no force, and the proxy is at the tool", "[nodes][coupling]")
{
    auto node = ready<VirtualCoupling> ({});
    for (int k = 0; k < 10; ++k)
    {
        const Vec3 p { 0.01 * k, 0.0, 0.05 - 0.004 * k };
        const auto out = node.tick ({ .position = p });
        CHECK (out.force.isZero (0.0));
        CHECK (out.proxy == p);
        CHECK (out.depth == Approx (-p.z()));
        CHECK (out.state == 0.0);
    }
}

TEST_CASE ("coupling: a tool that is inside from the start feels nothing on the first sample", "[nodes][coupling]")
{
    auto node = ready<VirtualCoupling> ({ .stiffness = 1000.0, .damping = 0.0 });
    const auto first = node.tick ({ .position = { 0, 0, -0.003 } });
    CHECK (first.force.isZero (0.0));
    CHECK (first.proxy.z() == -0.003);
    CHECK (node.tick ({ .position = { 0, 0, -0.003 } }).force.z() == Approx (3.0).epsilon (2e-3));
}

TEST_CASE ("coupling: after the tool leaves, the proxy catches up and does not pull", "[nodes][coupling]")
{
    auto node = ready<VirtualCoupling> ({ .stiffness = 1000.0, .damping = 2.0 });
    node.tick ({});
    node.tick ({ .position = { 0, 0, -0.005 } });
    double behind = tactus::inf;
    for (int k = 0; k < 30; ++k)
    {
        const auto out = node.tick ({ .position = { 0, 0, 0.002 } });
        CHECK (out.force.isZero (0.0));
        CHECK (out.proxy.z() >= 0.002);
        CHECK (out.proxy.z() - 0.002 < behind);
        behind = out.proxy.z() - 0.002;
    }
    CHECK (behind < 1e-7);
}

TEST_CASE ("coupling: it never pulls, and its force equals the force of the wall", "[nodes][coupling]")
{
    tactus::test::property ("any motion, any wall", [] {
        const double wall = *rc::gen::element (0.0, 10.0, 1e4, 1e6, 1e8), kc = *rc::gen::element (0.0, 100.0, 3000.0),
                     bc = *rc::gen::element (0.0, 0.5, 10.0);
        auto node = ready<VirtualCoupling> ({ .stiffness = kc, .damping = bc, .wall_stiffness = wall });
        node.tick ({ .position = { 0, 0, 0.001 } });
        for (int k = 0; k < 50; ++k)
        {
            const double z = 1e-6 * *rc::gen::inRange (-5000, 3000);
            const auto out = node.tick ({ .position = { 0, 0, z } });
            RC_ASSERT (out.force.z() >= 0.0);
            const double inside = std::max (0.0, -out.proxy.z());
            RC_ASSERT (std::abs (out.force.z() - wall * inside) <= 1e-6 * out.force.z() + wall * 1e-17);
        }
    });
}

TEST_CASE ("coupling: a closed path generates no energy, damped or not", "[nodes][coupling][energy]")
{
    for (const double bc : { 0.0, 0.5, 5.0 })
    {
        auto node = ready<VirtualCoupling> ({ .stiffness = 2000.0, .damping = bc, .normal = { 1, 2, 2 } }, 4000.0);
        const int n = 20'000;
        double given = 0.0, handled = 0.0;
        Vec3 p = Vec3::Zero(), f = node.tick ({}).force;
        for (int k = 1; k <= n; ++k)
        {
            const double s = 2.0 * M_PI * k / n;
            const Vec3 next { 3e-3 * std::sin (s), -4e-3 * std::sin (2 * s), 2e-3 * std::sin (3 * s) };
            const Vec3 force = node.tick ({ .position = next }).force;
            const double work = 0.5 * (f + force).dot (next - p);
            given += work;
            handled += std::abs (work);
            p = next;
            f = force;
        }
        INFO (bc);
        CHECK (handled > 1e-3);
        CHECK (given <= 1e-6 * handled);
        if (bc == 0.0) CHECK (given >= -1e-6 * handled);
    }
}

TEST_CASE ("coupling: a fault gives 0, and the next sample counts as the first", "[nodes][coupling]")
{
    for (const Vec3& bad : { Vec3 { 0, 0, not_a_number }, Vec3 { tactus::inf, 0, 0 } })
    {
        auto node = ready<VirtualCoupling> ({});
        node.tick ({});
        node.tick ({ .position = { 0, 0, -0.001 } });
        const auto out = node.tick ({ .position = bad });
        CHECK (out.state == -1.0);
        CHECK (out.force.isZero (0.0));
        CHECK (out.proxy.isZero (0.0));
        CHECK (out.depth == 0.0);
        CHECK (node.tick ({ .position = { 0, 0, -0.001 } }).force.isZero (0.0));
        CHECK (node.tick ({ .position = { 0, 0, -0.001 } }).force.z() > 0.9);
    }
    CHECK (ready<VirtualCoupling> ({ .normal = Vec3::Zero() }).tick ({ .position = { 0, 0, -0.001 } }).state == -1.0);
}

TEST_CASE ("coupling: no input breaks it", "[nodes][coupling]")
{
    tactus::test::property ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -1.0, -1e-3, 1e-320, -1e160, 1e300, -1.7e308, not_a_number, tactus::inf);
        const auto size = rc::gen::element (0.0, 1e-320, 1.0, 1e3, 1e300);
        const double kc = *size, bc = *size, wall = *size;
        auto node = ready<VirtualCoupling> ({ .stiffness = kc, .damping = bc, .wall_stiffness = wall });
        for (int k = 0; k < 20; ++k)
        {
            const double x = *number, y = *number, z = *number;
            const auto out = node.tick ({ .position = { x, y, z } });
            RC_ASSERT (tactus::isFinite (out.proxy, out.force, out.depth));
        }
    });
}

TEST_CASE ("coupling: a new instance adopts the stretch", "[nodes][coupling]")
{
    auto old = ready<VirtualCoupling> ({}), next = ready<VirtualCoupling> ({});
    old.tick ({});
    old.tick ({ .position = { 0, 0, -0.001 } });
    next.adopt (old);
    CHECK (next.tick ({ .position = { 0, 0, -0.002 } }).force == old.tick ({ .position = { 0, 0, -0.002 } }).force);
}
