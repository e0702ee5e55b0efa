// SPDX-License-Identifier: GPL-3.0-or-later
#include "juce_graph.hpp"
#include "kernel_processor.hpp"

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
}   // namespace

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

}   // namespace tactus::bench
