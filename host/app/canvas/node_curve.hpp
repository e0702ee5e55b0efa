// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/inspector/blocks/plot_box.hpp>
#include <host/app/model/face.hpp>
#include <host/app/model/patch.hpp>

#include <map>
#include <memory>
#include <string>

namespace tactus::host
{

/// The small curve of a node, for a node in a patch of a graph. Null if the node has none. It comes from the node itself, so the nodes of
/// plugins have one, too:
///  - a law, or a curve that is in use, as the settings give it;
///  - the modes of what rings, as stems;
///  - the envelope of a clip;
///  - ridges and friction: the force along a stroke, from a node of the same type and values that is ticked here and not in the run;
///  - an output that depends on nothing but the one input: the output over the input, unless it is a straight line.
std::shared_ptr<const PlotData> curveOf (const graph::Graph&, const SeenPatch& patch, const graph::Node&, const Face&);

/// Keeps the curves of nodes that have not changed, because every edit lays the canvas out again.
class NodeCurves
{
public:
    std::shared_ptr<const PlotData> of (const graph::Graph&, const SeenPatch& patch, const graph::Node&, const Face&);
    void clear() { known.clear(); }   ///< the node types have changed

private:
    struct CacheEntry
    {
        std::string key;
        std::shared_ptr<const PlotData> curve;
    };

    static std::string keyOf (const graph::Graph&, const SeenPatch& patch, const graph::Node&, const Face&);

    std::map<graph::Id, CacheEntry> known;
};

/// Draws a curve without axes, in the colour of its quantity, over the line where it is 0.
void paintSmallCurve (juce::Graphics&, juce::Rectangle<float>, const PlotData&, const Theme&, float alpha);

}   // namespace tactus::host
