// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"
#include "kernels.hpp"

#include <algorithm>
#include <numbers>

namespace tactus::bench
{

namespace
{
constexpr double degree = std::numbers::pi / 180.0;

/// A cushion of 8 by 8 points, 10 mm apart, firmer towards its seams.
std::shared_ptr<const Surface> cushion()
{
    constexpr int side = 8;
    Mesh mesh;
    std::vector<Surface::Curves> curves;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
        {
            const int seam = std::max (std::abs (2 * i - 7), std::abs (2 * j - 7));
            const Law across { .kind = Law::Kind::power, .a = 300.0, .b = 1.0 };
            mesh.points.push_back ({ (10 * i - 35) / 1000.0, (10 * j - 35) / 1000.0, 0.0 });
            curves.push_back ({ across, across, { .kind = Law::Kind::exponential, .a = (100 + seam) / 100.0, .b = 240.0 + 2 * seam } });
        }
    for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < side; ++i)
        {
            const int a = j * side + i, b = a + 1, c = a + side, d = c + 1;
            mesh.triangles.push_back ({ a, b, d });
            mesh.triangles.push_back ({ a, d, c });
        }
    auto shared = std::make_shared<Mesh> (std::move (mesh));
    return std::make_shared<Surface> (Surface { .mesh = std::move (shared), .frames = {}, .curves = { curves }, .mu = { { .number = 2.0 } } });
}

std::vector<nodes::TextureNoise::Model> weave()
{
    const double rate = kernel_setup.rate_hz;
    return {
        { 0.02, 0.2, rate, { 1.08, -0.729, 0.3645, -0.19683, 0.118098, -0.063773, 0.038264, -0.021523, 0.011623, -0.006974 }, 2e-05 },
        { 0.15, 0.2, rate, { 1.14, -0.81225, 0.428687, -0.244352, 0.154756, -0.088211, 0.055867, -0.033171, 0.018907, -0.011975 }, 0.0001 },
        { 0.02, 2.0, rate, { 1.104, -0.76176, 0.389344, -0.214918, 0.131816, -0.072763, 0.044628, -0.025661, 0.014165, -0.008688 }, 6e-05 },
        { 0.15, 2.0, rate, { 1.2, -0.9, 0.5, -0.3, 0.2, -0.12, 0.08, -0.05, 0.03, -0.02 }, 0.0004 },
    };
}
}   // namespace

Kernels::Kernels (const DeviceState& device)
{
    hand.bind (device);
    foam.settings.surface = cushion();
    motion.settings.window = 0.01;
    drag.params = { .mu = 0.3, .d_max = 6e-4, .static_ratio = 1.3, .reference_load = 0.4 };
    ribs.params = { .amplitude = 0.06, .spatial_frequency = 400.0 };
    warp.params = { .amplitude = 0.04, .spatial_frequency = 900.0, .angle = 30.0 * degree };
    weft.params = { .amplitude = 0.04, .spatial_frequency = 900.0, .angle = 120.0 * degree };
    hiss.settings.models = weave();
    touch.params.window = 2e-4;
    cloth.settings.inputs = 3;
    landing.params = { .release = 5e-5, .min_speed = 5e-3, .refractory = 0.02 };
    thud.params.mass = 0.02;
    thud.settings.stiffness = { .kind = Law::Kind::power, .a = 1e5, .b = 1.5 };
    thud.settings.damping.a = 0.5;
    wood.settings.modes = {
        { 110.0, 40.0, 6.0 },
        { 175.0, 48.0, 4.5 },
        { 260.0, 60.0, 3.5 },
        { 305.0, 70.0, 2.5 },
        { 420.0, 85.0, 2.0 },
        { 510.0, 100.0, 1.5 },
        { 655.0, 120.0, 1.0 },
        { 830.0, 150.0, 0.75 },
    };
    bump.settings.inputs = 3;
    all.settings.inputs = 4;
    calm.params.mass = 0.05;
    limit.params.limit = 7.0;
    motor.bind (device);

    start (motion), start (foam), start (drag), start (ribs), start (warp), start (weft), start (hiss), start (landing);
    start (thud), start (wood), start (calm), start (limit);
}

std::vector<Contest> handContests()
{
    const auto stroke = strokeOver (reference());
    return {
        { "plan/hand", "plan", "hand-written", "reference graph", planOf (reference()), handwritten, stroke },
        { "export/hand", "export", "hand-written", "reference graph and guard", exportedReference, handwrittenWithGuard, stroke },
    };
}

}   // namespace tactus::bench
