// SPDX-License-Identifier: GPL-3.0-or-later
// A wall with friction and a grating for each of 64 contacts, as instances of one subgraph with different params: in lanes, and one by one.
#include "bench.hpp"

#include <tactus/file/graph_file.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace tactus::bench
{

namespace
{
constexpr int contacts = 64;

constexpr const char* contact = R"({
  "format": "tactus-graph", "version": 2, "rate_hz": 4000,
  "graphs": { "contact": {
    "nodes": {
      "at": { "type": "vector.add", "settings": { "inputs": 1 } },
      "board": { "type": "deform.plane", "params": { "stiffness": "2 N/mm", "damping": "1 N*s/m" } },
      "drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.4, "d_max": "0.4 mm", "static_ratio": 1.5 } },
      "touch": { "type": "contact.window", "params": { "window": "0.2 mm" } },
      "grain": { "type": "texture.grating", "params": { "spatial_frequency": "1200 1/m", "amplitude": "60 mN" } },
      "felt": { "type": "vector.scale" },
      "all": { "type": "vector.add", "settings": { "inputs": 3 } }
    },
    "wires": [
      "at.out -> board.position", "at.out -> drag.position", "at.out -> grain.position",
      "board.resistance -> drag.normal_force", "board.depth -> touch.depth", "grain.force -> felt.in", "touch.gain -> felt.gain",
      "board.force -> all.in[0]", "drag.force -> all.in[1]", "felt.out -> all.in[2]"
    ],
    "expose": { "inputs": { "position": "at.in[0]" }, "outputs": { "force": "all.out" } }
  } },
  "nodes": { "c": { "type": "graph:contact", "count": 64 } }
})";

std::string instance (int k) { return "c[" + std::to_string (k) + "]/"; }

graph::Graph graphOfContacts()
{
    auto g = readGraph (contact).graph;
    auto& overrides = g.root.nodes.front().overrides;
    for (int k = 0; k < contacts; ++k)
    {
        overrides["[" + std::to_string (k) + "]/drag.mu"] = 0.3 + 0.005 * k;
        overrides["[" + std::to_string (k) + "]/board.offset"] = 1e-5 * (k % 16);
    }
    return g;
}

/// Each contact has its own position, which follows the input. `lanes` as in CompileOptions.
class ManyContacts final : public Variant
{
public:
    explicit ManyContacts (std::size_t lanes)
    {
        CompileOptions options { .lanes = lanes };
        for (int k = 0; k < contacts; ++k)
        {
            for (const auto* component : { "x", "y", "z" })
                options.feeds.push_back (instance (k) + "at.in[0]." + component);
            options.records.push_back (instance (k) + "all.out");
            offsets[static_cast<std::size_t> (k)] = { 1e-3 * k, 5e-4 * (k % 7), 4e-4 * std::sin (k) };
        }
        auto compiled = compile (graphOfContacts(), catalogue(), options);
        if (! compiled.plan) throw std::logic_error (compiled.messages.front().text);
        plan = std::move (compiled.plan);
    }

    void tick (const double* in) noexcept override
    {
        auto* feed = plan->feeds().data();
        for (const auto& offset : offsets)
            for (std::size_t i = 0; i < offset.size(); ++i)
                *feed++ = in[i] + offset[i];
        plan->tick();
    }

    std::vector<double> outputs() const override
    {
        std::vector<double> values;
        for (const auto& tap : plan->taps())
            values.push_back (*tap.value);
        return values;
    }

private:
    std::array<std::array<double, 3>, contacts> offsets {};
    std::shared_ptr<Plan> plan;
};
}   // namespace

std::vector<Contest> contactContests()
{
    constexpr std::size_t lanes = 4;   // of AVX2
    if (widestLanes() < lanes)
    {
        std::fprintf (stderr, "note: this processor has no AVX2, so simd64/scalar64 is skipped\n");
        return {};
    }
    const auto in = [] (std::size_t count) { return [count] { return std::make_unique<ManyContacts> (count); }; };
    const auto* about = "plane, friction and grating for 64 contacts";
    return { { "simd64/scalar64", "lanes", "one by one", about, in (lanes), in (1), strokeOver (reference()) } };
}

}   // namespace tactus::bench
