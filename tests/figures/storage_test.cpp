// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <nodes/deform/bodies.hpp>
#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

#ifdef __GLIBC__
#include <malloc.h>
#endif

using namespace tactus;

namespace
{
/// Bytes in use on the heap.
double heap()
{
#ifdef __GLIBC__
    const auto all = mallinfo2();
    return static_cast<double> (all.uordblks + all.hblkhd);
#else
    return 0.0;
#endif
}

/// What an elastic cube with n x n cells on each side and its own curves at every node keeps, in bytes.
double bytesOf (int n)
{
    const double before = heap();
    auto node = std::make_unique<nodes::ElasticSurface>();
    node->settings.surface = test::uneven (test::box (Vec3::Constant (0.04), n), 7);
    node->prepare ({ .rate_hz = 1000.0 });
    return heap() - before;
}
}   // namespace

TEST_CASE ("figure: what an elastic body stores grows with its surface, not with its volume", "[figures]")
{
    if (! NoAllocation::watches) return;   // the sanitizers have a heap of their own

    test::Columns rows;
    for (const int n : { 4, 8, 16, 32, 64 })
    {
        const auto nodes = static_cast<double> (test::box (Vec3::Constant (0.04), n).points.size());
        const double solid = std::pow (n + 1, 3);
        CHECK (nodes == 6.0 * n * n + 2.0);
        rows.push_back ({ static_cast<double> (n), nodes, solid, bytesOf (n) });
    }
    for (std::size_t i = 1; i < rows.size(); ++i)
    {
        INFO (rows[i][0] << " cells");
        CHECK (rows[i][3] / rows[i - 1][3] == Approx (rows[i][1] / rows[i - 1][1]).epsilon (0.2));   // as the surface, 4 times
    }
    const double twice = rows[4][3] / rows[3][3];
    CHECK (twice == Approx (4.0).epsilon (0.05));   // 8 times would be the volume
    CHECK (rows[4][1] == 24'578.0);                 // as docs/chapter.md says
    CHECK (rows[4][2] == 274'625.0);
    CHECK (rows[4][3] == Approx (30e6).epsilon (0.1));
    test::writeFigure ("storage", { "cells", "surface", "volume", "bytes" }, rows);
}
