// SPDX-License-Identifier: GPL-3.0-or-later
// Places of new nodes that bring places of their own.
#include "host/app/support/canvas_rig.hpp"

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
/// The pairs of nodes that cover each other.
juce::StringArray covered (const Canvas& canvas)
{
    juce::StringArray all;
    const auto& nodes = canvas.scene().nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t k = i + 1; k < nodes.size(); ++k)
            if (nodes[i].bounds().intersects (nodes[k].bounds())) all.add (juce::String (nodes[i].name + " " + nodes[k].name));
    return all;
}

/// The places of the selected nodes, from the first one on.
std::vector<juce::Point<float>> shapeOf (const Canvas& canvas)
{
    std::vector<juce::Point<float>> all;
    for (const auto& n : canvas.scene().nodes())
        if (canvas.selection().contains (n.id)) all.push_back (n.at);
    for (std::size_t i = all.size(); i-- > 0;)
        all[i] -= all[0];
    return all;
}

void selectAll (Canvas& canvas)
{
    Selection all;
    for (const auto& n : canvas.scene().nodes())
        all.insert (n.id);
    canvas.select (all);
}
}   // namespace

TEST_CASE ("pasted and duplicated nodes cover no others, and keep their places to each other", "[app][canvas][places]")
{
    for (const auto* name : { "dry_wood", "bronze_bell", "padded_bench" })
        for (const bool is_paste : { true, false })
        {
            INFO (name << (is_paste ? ", pasted" : ", duplicated"));
            CanvasRig rig { CanvasRig::preset (name) };
            auto& canvas = *rig.canvas;
            REQUIRE (covered (canvas).isEmpty());
            for (int times = 0; times < 3; ++times)
            {
                selectAll (canvas);
                const auto before = shapeOf (canvas);
                const auto steps = rig.document.history().position();
                if (is_paste) canvas.commands().copySelection();
                is_paste ? canvas.commands().pasteText() : canvas.commands().duplicateSelection();
                CHECK (covered (canvas).joinIntoString (", ") == juce::String());
                CHECK (shapeOf (canvas) == before);
                CHECK (rig.document.history().position() == steps + 1);
                if (rig.graph().root.nodes.size() > 60) break;
            }
        }
}
