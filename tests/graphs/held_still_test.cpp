// SPDX-License-Identifier: MIT
// A hand that stops in the middle of a preset's gesture and then holds still, while its pressure trembles, keeps its drag.

#include "support/sketch.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/nodes/friction/elasto_plastic.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace tactus;
namespace fs = std::filesystem;
using nodes::ElastoPlastic;

namespace
{
const fs::path folder = fs::path (TACTUS_SOURCE_DIR) / "graphs";

/// Plays readings back, then repeats the last one forever.
class Repeated final : public Device
{
public:
    std::vector<Reading> readings;
    std::size_t next = 0;

    void prepare (double) override {}
    Reading read() noexcept override { return readings[std::min (next++, readings.size() - 1)]; }
    void write (const Effort&) noexcept override {}
};

std::shared_ptr<Plan> compiled (const graph::Graph& g, std::vector<std::string> feeds = {})
{
    static host::FileAssets assets;
    const CompileOptions options { .feeds = std::move (feeds), .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } };
    auto [plan, messages] = compile (g, catalogue(), options);
    INFO (test::text (messages));
    REQUIRE (plan);
    return plan;
}

/// The indices of a plan's friction nodes.
std::vector<std::size_t> contactsOf (const Plan& plan)
{
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < plan.flat().nodes.size(); ++i)
        if (plan.flat().nodes[i].type->info.id == ElastoPlastic::info.id) all.push_back (i);
    return all;
}

const ElastoPlastic::Outputs& outputsOf (const Plan& plan, std::size_t node)
{
    return *static_cast<const ElastoPlastic::Outputs*> (plan.instances()[node].outputs);
}
const ElastoPlastic& contactOf (const Plan& plan, std::size_t node) { return *static_cast<const ElastoPlastic*> (plan.instances()[node].node.get()); }
double loadOn (const Plan& plan, std::size_t node) { return *plan.instances()[node].sources[6]; }

/// The gesture of a preset: by role, the readings of its device; by tick, the load on a contact. It ends where the drag is largest.
struct Stroke
{
    std::vector<std::vector<Reading>> readings;
    std::vector<double> loads;   // N
    double drag = 0.0;           // N
};

Stroke strokeOf (const graph::Graph& g, std::size_t node)
{
    Engine engine { compiled (g) };
    const auto& roles = engine.plan().roles();
    std::vector<MadeDevice> devices;
    double duration = 0.0;
    for (const auto& role : roles)
    {
        devices.push_back (makeDevice (std::ranges::find (g.devices, role.name, &std::pair<std::string, Json>::first)->second, folder));
        duration = std::max (duration, devices.back().device->duration());
        engine.attach (role.name, *devices.back().device, devices.back().limits);
    }

    Stroke all { std::vector<std::vector<Reading>> (roles.size()), {}, 0.0 };
    std::size_t best = 0;
    for (int k = 0; k < static_cast<int> (duration * g.rate_hz); ++k)
    {
        engine.tick();
        for (std::size_t r = 0; r < roles.size(); ++r)
            all.readings[r].push_back (roles[r].state->reading);
        all.loads.push_back (loadOn (engine.plan(), node));
        const double drag = outputsOf (engine.plan(), node).force.norm();
        if (! (drag > all.drag)) continue;
        all.drag = drag;
        best = all.loads.size();
    }
    for (auto& readings : all.readings)
        readings.resize (best);
    all.loads.resize (best);
    return all;
}
}   // namespace

TEST_CASE ("a hand held still on every preset keeps its drag, while its pressure trembles", "[graphs]")
{
    for (const auto& entry : fs::directory_iterator (folder))
    {
        if (entry.path().extension() != ".json") continue;
        const auto g = loadGraph (entry.path()).graph;
        for (const auto node : contactsOf (*compiled (g)))
        {
            const auto stroke = strokeOf (g, node);
            if (stroke.drag == 0.0) continue;   // the preset's gesture does not stroke this contact
            const auto name = std::string (compiled (g)->flat().nodes[node].path);
            INFO (entry.path().stem().string() << ": " << name);

            Engine engine { compiled (g, { name + ".normal_force" }) };
            std::vector<Repeated> hands (engine.plan().roles().size());
            for (std::size_t r = 0; r < hands.size(); ++r)
            {
                hands[r].readings = stroke.readings[r];
                engine.attach (engine.plan().roles()[r].name, hands[r]);
            }
            // The hand stops, a texture that is filtered over time comes to rest, and then the pressure trembles.
            double at_rest = 0.0, after_ten_cycles = 0.0;
            const auto ticks = [&] (double s) { return static_cast<std::size_t> (s * g.rate_hz); };
            const auto begin = stroke.loads.size() + ticks (0.1), ten_cycles = ticks (1.0);
            for (std::size_t k = 0; k < begin + ticks (4.0); ++k)
            {
                const auto still = k < begin ? 0 : k - begin + 1;
                const double tremor = 0.1 * std::sin (2.0 * M_PI * 10.0 * static_cast<double> (still) / g.rate_hz);
                engine.plan().feeds()[0] = stroke.loads[std::min (k, stroke.loads.size() - 1)] * (1.0 + tremor);
                engine.tick();
                if (k + 1 == begin) at_rest = outputsOf (engine.plan(), node).force.norm();
                if (still == ten_cycles) after_ten_cycles = outputsOf (engine.plan(), node).force.norm();
            }
            const double static_ratio = contactOf (engine.plan(), node).params.static_ratio;
            CHECK (at_rest > 0.8 * stroke.drag / static_ratio);
            CHECK (after_ten_cycles >= 0.89 * at_rest / static_ratio);
            CHECK (outputsOf (engine.plan(), node).force.norm() == Approx (after_ten_cycles).epsilon (1e-9));
        }
    }
}
