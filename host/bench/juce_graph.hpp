// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>

#include <juce_audio_processors/juce_audio_processors.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tactus::bench
{

/// A graph as JUCE's AudioProcessorGraph runs it: blocks of one sample, double precision, a processor for each node and
/// one more for each wire with a gain, which its connections do not have. On the message thread only.
class JuceGraph
{
public:
    /// By the names of the nodes; a channel for each component of a port, in the order of the datasheet.
    using Processors = std::map<std::string, std::unique_ptr<juce::AudioProcessor>>;

    JuceGraph (const graph::Graph&, Processors);

    /// What comes in goes to the first channel of this node.
    void feed (const std::string& node);

    void prepare();

    void tick (double in) noexcept
    {
        block.setSample (0, 0, in);
        processors.processBlock (block, midi);
    }

    /// One edit, after which JUCE works out anew what it runs: takes the last wire out, or puts it back.
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
