// SPDX-License-Identifier: GPL-3.0-or-later
#include "juce_variants.hpp"
#include "juce_graph.hpp"
#include "kernel_processor.hpp"
#include "kernels.hpp"
#include "one_poles.hpp"
#include "reference.hpp"

#include <tactus/nodes/filter/one_pole.hpp>

namespace tactus::bench
{

namespace
{
class JuceReference final : public Variant
{
public:
    JuceReference();

    void tick (const double* in) noexcept override
    {
        device.reading.position = { in[0], in[1], in[2] };
        graph->tick (0.0);
    }

    std::vector<double> outputs() const override
    {
        const Vec3 f = motor->effort().force;
        return { f.x(), f.y(), f.z() };
    }

private:
    DeviceState device;
    const nodes::DeviceForce* motor = nullptr;
    std::unique_ptr<JuceGraph> graph;
};

class JuceOnePoles final : public Variant
{
public:
    explicit JuceOnePoles (const graph::Graph&);

    void tick (const double* in) noexcept override { graph->tick (*in); }
    void edit() { graph->edit(); }

    std::vector<double> outputs() const override
    {
        std::vector<double> values;
        for (const auto* end : ends)
            values.push_back (end->last().out);
        return values;
    }

private:
    std::vector<const KernelProcessor<nodes::OnePole>*> ends;
    std::unique_ptr<JuceGraph> graph;
};

JuceReference::JuceReference()
{
    Kernels k { device };
    JuceGraph::Processors made;
    const auto add = [&]<Node N> (const char* name, N& node) {
        auto processor = std::make_unique<KernelProcessor<N>> (std::move (node));
        if constexpr (std::is_same_v<N, nodes::DeviceForce>) motor = &processor->kernel();
        made[name] = std::move (processor);
    };
    add ("hand", k.hand), add ("motion", k.motion), add ("foam", k.foam), add ("drag", k.drag);
    add ("ribs", k.ribs), add ("warp", k.warp), add ("weft", k.weft), add ("hiss", k.hiss);
    add ("touch", k.touch), add ("cloth", k.cloth), add ("felt", k.felt), add ("landing", k.landing);
    add ("thud", k.thud), add ("wood", k.wood), add ("bump", k.bump), add ("up", k.up);
    add ("all", k.all), add ("calm", k.calm), add ("limit", k.limit), add ("motor", k.motor);
    graph = std::make_unique<JuceGraph> (reference(), std::move (made));
    graph->prepare();
}

JuceOnePoles::JuceOnePoles (const graph::Graph& g)
{
    JuceGraph::Processors made;
    std::map<std::string, const KernelProcessor<nodes::OnePole>*> by_port;
    for (const auto& node : g.root.nodes)
    {
        nodes::OnePole pole;
        pole.params.cutoff = node.params["cutoff"].get<double>();
        pole.prepare ({ .rate_hz = g.rate_hz });
        pole.update();
        auto processor = std::make_unique<KernelProcessor<nodes::OnePole>> (pole);
        by_port[node.name + ".out"] = processor.get();
        made[node.name] = std::move (processor);
    }
    const auto outside = endsOf (g);
    for (const auto& end : outside.records)
        ends.push_back (by_port.at (end));

    graph = std::make_unique<JuceGraph> (g, std::move (made));
    graph->feed ("p0");
    graph->prepare();
}
}   // namespace

std::unique_ptr<Variant> juceReference() { return std::make_unique<JuceReference>(); }
std::unique_ptr<Variant> juceOnePoles (const graph::Graph& g) { return std::make_unique<JuceOnePoles> (g); }

std::function<void()> juceEdits (const graph::Graph& g)
{
    return [edited = std::make_shared<JuceOnePoles> (g)] { edited->edit(); };
}

}   // namespace tactus::bench
