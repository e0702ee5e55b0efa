// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace tactus::bench
{

std::string_view referenceText() noexcept;   // written by embed.cmake

namespace
{
std::string nameOf (int pole) { return "p" + std::to_string (pole); }

graph::Graph onePoles (int n, int (*feederOf) (int pole))
{
    graph::Graph g;
    for (int i = 0; i < n; ++i)
    {
        graph::Node node;
        node.name = nameOf (i);
        node.type = "filter.one_pole";
        node.params["cutoff"] = 200.0 + 10.0 * (i % 100);
        g.root.nodes.push_back (std::move (node));
        if (i > 0) g.root.wires.push_back (*graph::parseWire (nameOf (feederOf (i)) + ".out -> " + nameOf (i) + ".in"));
    }
    return g;
}
}   // namespace

Planned::Planned (const graph::Graph& g, const CompileOptions& options, const Catalogue& types)
{
    auto compiled = compile (g, types, options);
    if (! compiled.plan) throw std::logic_error (compiled.messages.empty() ? "no plan" : compiled.messages.front().text);
    plan = std::move (compiled.plan);
    if (! plan->roles().empty()) device = plan->roles().front().state.get();
}

void Planned::tick (const double* in) noexcept
{
    if (device)
        device->reading.position = { in[0], in[1], in[2] };
    else
        plan->feeds().front() = in[0];
    plan->tick();
}

std::vector<double> Planned::outputs() const
{
    if (device)
    {
        const auto& sink = plan->roles().front().sinks.front();
        const Vec3 f = sink.effort (sink.node).force;
        return { f.x(), f.y(), f.z() };
    }
    std::vector<double> values;
    for (const auto& tap : plan->taps())
        values.push_back (*tap.value);
    return values;
}

Contest::Make planOf (graph::Graph g)
{
    return [g = std::move (g)] { return std::make_unique<Planned> (g, g.root.find ("p0") ? endsOf (g) : CompileOptions {}); };
}

const graph::Graph& reference()
{
    static const graph::Graph g = readGraph (referenceText()).graph;
    return g;
}

std::vector<Contest::Row> strokeOver (const graph::Graph& g)
{
    Engine engine { compile (g, catalogue()).plan };
    const auto& [role, description] = g.devices.front();
    const auto hand = makeDevice (description, {});
    engine.attach (role, *hand.device, hand.limits);

    std::vector<Contest::Row> rows (static_cast<std::size_t> (hand.device->duration() * g.rate_hz));
    for (auto& row : rows)
    {
        engine.tick();
        const Vec3& p = engine.plan().roles().front().state->reading.position;
        row = { p.x(), p.y(), p.z() };
    }
    return rows;
}

std::vector<Contest::Row> chirp()
{
    constexpr int ticks = 4000;
    std::vector<Contest::Row> rows;
    for (int k = 0; k < ticks; ++k)
        rows.push_back ({ std::sin (0.25 * 3.0 * k * k / ticks) });
    return rows;
}

graph::Graph chainOfOnePoles (int n)
{
    return onePoles (n, [] (int pole) { return pole - 1; });
}

graph::Graph treeOfOnePoles (int n)
{
    return onePoles (n, [] (int pole) { return (pole - 1) / 2; });
}

graph::Graph shuffled (graph::Graph g)
{
    Random random { 1 };
    auto& nodes = g.root.nodes;
    for (std::size_t i = nodes.size(); i > 1; --i)
        std::swap (nodes[i - 1], nodes[random.bits() % i]);
    return g;
}

CompileOptions endsOf (const graph::Graph& g)
{
    CompileOptions options { .feeds = { "p0.in" } };
    for (const auto& node : g.root.nodes)
        if (std::ranges::none_of (g.root.wires, [&] (const graph::Wire& w) { return w.from.node == node.name; }))
            options.records.push_back (node.name + ".out");
    return options;
}

}   // namespace tactus::bench
