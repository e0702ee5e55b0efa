// SPDX-License-Identifier: MIT
#include <tactus/kit/law.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using tactus::Law;

namespace
{
const Law laws[] {
    { .kind = Law::Kind::power, .a = 2000.0 },
    { .kind = Law::Kind::power, .a = 5e5, .b = 1.5 },
    { .kind = Law::Kind::power, .a = 10.0, .b = 0.5 },
    { .kind = Law::Kind::exponential, .a = 0.1, .b = 400.0 },
    { .kind = Law::Kind::table, .table = { { 0.0, 1e-3, 2e-3, 4e-3 }, { 0.0, 0.5, 0.7, 3.0 } } },
    { .kind = Law::Kind::table, .table = { { 1e-3, 2e-3 }, { 0.5, 4.0 } } },
};
constexpr double never = std::numeric_limits<double>::infinity();
}   // namespace

TEST_CASE ("law: its inverse is the deflection at that force", "[law]")
{
    for (const Law& law : laws)
        for (const double e : { 1e-6, 3e-4, 1e-3, 1.7e-3, 2.5e-3, 9e-3 })
        {
            INFO (int (law.kind) << " " << law.b << " " << e);
            CHECK (law.inverse (law (e)) == Approx (e).epsilon (1e-12));
        }
}

TEST_CASE ("law: its inverse is the first such deflection, and infinite if there is none", "[law]")
{
    const Law steps { .kind = Law::Kind::table, .table = { { 1e-3, 2e-3, 3e-3, 4e-3 }, { 1.0, 1.0, 2.0, 2.0 } } };
    CHECK (steps.inverse (1.0) == 1e-3);
    CHECK (steps.inverse (2.0) == 3e-3);
    CHECK (steps.inverse (2.1) == never);
    CHECK (steps.inverse (0.0) == 0.0);
    CHECK (steps.inverse (-1.0) == 0.0);
    CHECK (Law { .kind = Law::Kind::power, .a = 0.0 }.inverse (1.0) == never);
    CHECK (Law { .kind = Law::Kind::exponential, .a = 0.0 }.inverse (1.0) == never);
    CHECK (Law {}.inverse (1.0) == never);
}

TEST_CASE ("law: the powers with a short cut have the values of all others", "[law]")
{
    for (const double n : { 0.5, 1.0, 1.5, 2.0, 2.5, 3.0 })
        for (const double e : { 1e-9, 3e-4, 0.7, 20.0 })
        {
            const Law law { .kind = Law::Kind::power, .a = 3.0, .b = n };
            INFO (n << " " << e);
            CHECK (law (e) == Approx (3.0 * std::pow (e, n)).epsilon (1e-15));
            CHECK (law.energy (e) == Approx (3.0 * std::pow (e, n + 1.0) / (n + 1.0)).epsilon (1e-15));
        }
}

TEST_CASE ("law: a table may rise or fall", "[law]")
{
    for (const Law& law : laws)
        CHECK (law.rises());
    CHECK (Law {}.rises());
    CHECK_FALSE (Law { .kind = Law::Kind::table, .table = { { 1.0, 2.0 }, { 2.0, 1.0 } } }.rises());
    CHECK_FALSE (Law { .kind = Law::Kind::table, .table = { { 1.0, 2.0 }, { -1.0, 1.0 } } }.rises());
}

TEST_CASE ("law: no slope is steeper than the steepest", "[law]")
{
    for (const Law& law : laws)
        for (const double to : { 5e-4, 1e-3, 3e-3, 8e-3 })
        {
            const double steepest = law.steepest (to);
            double most = 0.0;
            for (int i = 0; i < 1000; ++i)
                most = std::max (most, (law (to * (i + 1) / 1000) - law (to * i / 1000)) / (to / 1000));
            INFO (int (law.kind) << " " << law.b << " " << to);
            CHECK (most <= steepest * (1.0 + 1e-9));
            if (law.b >= 1.0) CHECK (most >= steepest * 0.99);
        }
    CHECK (laws[0].steepest() == 2000.0);
    CHECK (laws[1].steepest() == never);
    CHECK (laws[2].steepest (1e-3) == never);
    CHECK (laws[3].steepest() == never);
    CHECK (laws[4].steepest() == Approx (1150.0));
    CHECK (Law { .kind = Law::Kind::power, .a = 0.0, .b = 2.0 }.steepest() == 0.0);
    CHECK (Law {}.steepest() == 0.0);
}
