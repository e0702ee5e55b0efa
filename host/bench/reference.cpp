// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference.hpp"
#include "embedded.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <string_view>

namespace tactus::bench
{

const graph::Graph& reference()
{
    static const graph::Graph g = readGraph (referenceText()).graph;
    return g;
}

const graph::Graph& dryWood()
{
    static const graph::Graph g = readGraph (dryWoodText()).graph;
    return g;
}

std::vector<Vec3> strokeOver (const graph::Graph& g)
{
    Engine engine { compile (g, catalogue()).plan };
    const auto& [role, description] = g.devices.front();
    const auto hand = makeDevice (description, {});
    engine.attach (role, *hand.device, hand.limits);

    std::vector<Vec3> positions (static_cast<std::size_t> (hand.device->duration() * g.rate_hz));
    for (auto& p : positions)
    {
        engine.tick();
        p = engine.plan().roles().front().state->reading.position;
    }
    return positions;
}

}   // namespace tactus::bench
