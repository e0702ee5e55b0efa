// SPDX-License-Identifier: MIT
// A wall that the device alone cannot render.

#include "support/sketch.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace tactus;

TEST_CASE ("braked wall: rests with its brake, and bounces without it, at 1 and 4 kHz", "[framework][devices][brake][graphs]")
{
    const double rate = GENERATE (1000.0, 4000.0);
    const bool has_brake = GENERATE (true, false);
    auto file = loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs/braked_wall.json");
    REQUIRE_FALSE (hasErrors (file.messages));
    auto& graph = file.graph;
    auto& device = graph.devices.at (0).second;
    CHECK (6000.0 > 2.0 * 0.2 * rate);   // the stiffness of the wall, and 2 B / T of the device alone
    if (! has_brake) device.erase ("brake");
    device.erase ("hand");
    device["position"] = { 0, 0, 1e-3 };
    device["hand_force"] = { 0, 0, -0.5 };
    graph.rate_hz = rate;
    const auto [plan, messages] = compile (graph, catalogue());
    INFO (test::text (messages));
    REQUIRE (plan);
    const auto made = makeDevice (device, {});
    REQUIRE (made.device);
    Engine engine { plan };
    engine.attach ("stylus", *made.device, made.limits);
    double low = inf, high = -inf;
    for (int k = 0; k < static_cast<int> (3.0 * rate); ++k)
    {
        engine.tick();
        if (k < static_cast<int> (2.0 * rate)) continue;
        const double z = made.device->read().true_position.z();
        low = std::min (low, z);
        high = std::max (high, z);
    }
    INFO (rate << " Hz, " << (has_brake ? "braked" : "bare") << ": " << 1e6 * (high - low) << " um");
    if (has_brake)
        CHECK (high - low < 1e-6);
    else
        CHECK (high - low > 5e-5);
}
