// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench.hpp"
#include "kernel_processor.hpp"
#include "kernels.hpp"

#include <tactus/nodes/filter/one_pole.hpp>

#include <algorithm>

namespace tactus::bench
{

namespace
{
using Apg = juce::AudioProcessorGraph;
constexpr auto later = Apg::UpdateKind::async;   // updates wait until prepare()

class GainProcessor : public PlainProcessor
{
public:
    GainProcessor (int channels, double g) : PlainProcessor (channels, channels), gain (g) {}

    using PlainProcessor::processBlock;
    void processBlock (juce::AudioBuffer<double>& buffer, juce::MidiBuffer&) override
    {
        for (int c = 0; c < buffer.getNumChannels(); ++c)
            *buffer.getWritePointer (c) *= gain;
    }

private:
    double gain;
};

/// The channels of one end of a wire.
struct Channels
{
    int first = 0, count = 0;
};

Channels channelsOf (const graph::Graph& g, const graph::Endpoint& end, Role role)
{
    const auto& node = *g.root.find (end.node);
    const auto& type = *catalogue().find (node.type);
    Channels channels;
    for (const auto& port : role == Role::input ? type.inputs : type.outputs)
    {
        if (port.id == end.port)
        {
            channels.first += std::max (end.index, 0) * port.width + std::max (end.component, 0);
            channels.count = end.component >= 0 ? 1 : port.width;
            return channels;
        }
        channels.first += port.width * (port.list ? node.settings["inputs"].get<int>() : 1);
    }
    return channels;
}

/// A graph run by JUCE's AudioProcessorGraph: blocks of one sample, double precision, one processor for each node, and one more
/// for each wire with a gain, because JUCE's connections have no gain. [message thread]
class JuceGraph
{
public:
    /// The processors by node name. Each has one channel for each component of a port, in the order of the datasheet.
    using Processors = std::map<std::string, std::unique_ptr<juce::AudioProcessor>>;

    JuceGraph (const graph::Graph&, Processors);

    /// Sends the input to the first channel of this node.
    void feed (const std::string& node);

    void prepare();

    void tick (double in) noexcept
    {
        block.setSample (0, 0, in);
        processors.processBlock (block, midi);
    }

    /// Makes one edit: removes the last wire, or restores it. JUCE then rebuilds what it runs.
    void edit();

private:
    void connect (const graph::Graph&, const graph::Wire&);

    std::map<std::string, Apg::NodeID> ids;
    Apg processors;
    Apg::Connection last;
    juce::AudioBuffer<double> block { 1, 1 };
    juce::MidiBuffer midi;
};

JuceGraph::JuceGraph (const graph::Graph& g, Processors made)
{
    processors.setProcessingPrecision (juce::AudioProcessor::doublePrecision);
    processors.setPlayConfigDetails (1, 0, g.rate_hz, 1);
    for (const auto& node : g.root.nodes)
        ids[node.name] = processors.addNode (std::move (made.at (node.name)), {}, later)->nodeID;
    for (const auto& wire : g.root.wires)
        connect (g, wire);
}

void JuceGraph::connect (const graph::Graph& g, const graph::Wire& wire)
{
    const auto from = channelsOf (g, wire.from, Role::output), to = channelsOf (g, wire.to, Role::input);
    auto source = ids.at (wire.from.node);
    int channel = from.first;
    if (! wire.gain.is_null())
    {
        const auto gain = processors.addNode (std::make_unique<GainProcessor> (from.count, wire.gain.get<double>()), {}, later)->nodeID;
        for (int c = 0; c < from.count; ++c)
            processors.addConnection ({ { source, channel + c }, { gain, c } }, later);
        source = gain;
        channel = 0;
    }
    for (int c = 0; c < from.count; ++c)
        processors.addConnection (last = { { source, channel + c }, { ids.at (wire.to.node), to.first + c } }, later);
}

void JuceGraph::feed (const std::string& node)
{
    const auto in = processors.addNode (std::make_unique<Apg::AudioGraphIOProcessor> (Apg::AudioGraphIOProcessor::audioInputNode), {}, later)->nodeID;
    processors.addConnection ({ { in, 0 }, { ids.at (node), 0 } }, later);
}

void JuceGraph::prepare() { processors.prepareToPlay (processors.getSampleRate(), 1); }

void JuceGraph::edit()
{
    if (! processors.removeConnection (last)) processors.addConnection (last);
}

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

std::vector<Contest> juceContests()
{
    const auto tree = treeOfOnePoles (100);
    const auto juceTree = [tree] { return std::make_unique<JuceOnePoles> (tree); };
    const std::string juce = "JUCE AudioProcessorGraph";
    return {
        { "juce/plan", juce, "plan", "reference graph", make<JuceReference>, planOf (reference()), strokeOver (reference()) },
        { "juce_tree100/plan", juce, "plan", "tree of 100 one-poles", juceTree, planOf (tree), chirp() },
    };
}

Pair juceRebuild (bool quick)
{
    const auto edited = std::make_shared<JuceOnePoles> (shuffled (treeOfOnePoles (1000)));
    return { "juce_rebuild1000/compile1000", [edited] (int) { edited->edit(); }, compiling (1000, 20), 1.0, 20.0, quick ? 1 : 15 };
}

}   // namespace tactus::bench
