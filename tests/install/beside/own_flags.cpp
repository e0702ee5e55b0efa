// SPDX-License-Identifier: MIT
// Renders a graph as `tactus render` does. It contains functions of Eigen and Tactus that the library and its own node have, too, but compiled with
// other flags: those of the processor, with fused multiply-adds. They must not take their place.
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>

#include <cstdio>
#include <cstdlib>

using namespace tactus;

namespace
{
/// Uses Eigen as a simulator does.
double used (const Vec3& v)
{
    const Eigen::Matrix4d m = Eigen::Matrix4d::Identity() * v.norm();
    const Eigen::Quaterniond q = Eigen::Quaterniond { Eigen::AngleAxisd (v.norm(), v.normalized()) } * shortestRotation (v, Vec3::UnitX());
    return (rotationMatrix (v) * (q * v)).cross (v).dot (v) + length (v) + direction (v).sum() + v.stableNorm() + (m * m).trace();
}
}   // namespace

int main (int argc, char** argv)
{
    if (argc < 4) return 2;   // GRAPH TICKS PORT…
    const auto loaded = loadGraph (argv[1]);
    Run run { catalogue(), { .records = { argv + 3, argv + argc } }, [] (const std::string& role, const graph::Graph& g, auto&&...) {
                 auto made = makeDevice (*g.device (role), "");
                 return Run::RoleDevice { std::move (made.device), made.limits };
             } };
    auto messages = loaded.messages;
    if (! hasErrors (messages)) messages = run.load (loaded.graph);
    if (! hasErrors (messages)) run.openDevices (loaded.graph, messages);
    for (const auto& m : messages)
        std::fprintf (stderr, "%s\n", describe (m).c_str());
    if (hasErrors (messages) || catalogue().find ("my.ripple") == nullptr) return 1;

    std::printf ("t");
    for (const auto& tap : run.engine().newest().taps())
        std::printf (",%s", tap.name.c_str());
    double sum = 0.0;
    for (int k = 0, n = std::atoi (argv[2]); k < n; ++k)
    {
        run.tick();
        std::printf ("\n%.17g", k / run.rate());
        for (const auto& tap : run.engine().newest().taps())
            std::printf (",%.17g", *tap.value);
        sum += used (run.engine().role (0).applied.force + Vec3 { 1.0, 2.0, 3.0 });
    }
    std::printf ("\n");
    return sum == sum ? 0 : 1;
}
