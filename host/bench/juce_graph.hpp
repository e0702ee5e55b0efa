// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>

#include <juce_audio_processors/juce_audio_processors.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tactus::bench
{

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
    using Apg = juce::AudioProcessorGraph;

    void connect (const graph::Graph&, const graph::Wire&);

    std::map<std::string, Apg::NodeID> ids;
    Apg processors;
    Apg::Connection last;
    juce::AudioBuffer<double> block { 1, 1 };
    juce::MidiBuffer midi;
};

}   // namespace tactus::bench
