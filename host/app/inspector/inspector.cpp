// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspector.hpp"

#include <framework/number_text.hpp>

namespace tactus::host
{

namespace
{
juce::String text (std::string_view s) { return juce::String (std::string (s)); }
}   // namespace

Inspector::Inspector (Document& d, const Catalogue& c) : document (d), catalogue (c)
{
    setTitle ("Inspector");
    scroll.setScrollBarsShown (true, false);
    scroll.setScrollBarThickness (8);
    addAndMakeVisible (scroll);
    document.add (*this);
    rebuild();
}

Inspector::~Inspector() { document.remove (*this); }

void Inspector::inspect (const std::string& p, std::set<graph::Id> s)
{
    patch = p;
    selection = std::move (s);
    rebuild();
}

void Inspector::documentChanged() { rebuild(); }

void Inspector::describeGraph (Column& made) const
{
    const auto& graph = document.graph();
    if (! patch.empty())
    {
        made.add (juce::String (patch), Words::Kind::title);
        made.add ("A subgraph. What it shows of its inside can be wired and set from outside.", Words::Kind::text);
        return;
    }
    made.add (graph.name.empty() ? juce::String ("A graph without a name") : text (graph.name), Words::Kind::title);
    made.add (text (graph.about), Words::Kind::text);
    made.add (text (numberText (graph.rate_hz)) + " Hz", Words::Kind::small);
    if (! graph.controls.empty()) made.add ("Controls", Words::Kind::heading);
    for (const auto& c : graph.controls)
        made.add (controlRow (document, c.id));
}

void Inspector::describe (const graph::Patch& in, const graph::Node& node, Column& made) const
{
    const auto face = faceOf (document.graph(), in, node, catalogue);
    made.add (text (node.name), Words::Kind::title);
    made.add (text (node.type), Words::Kind::small);
    if (face.type != nullptr) made.add (text (face.type->info.summary), Words::Kind::text);
    if (face.kind == Face::Kind::placeholder) made.add ("There is no such type here. The node keeps what it has and gives 0.", Words::Kind::text);

    if (! face.params.empty()) made.add ("Parameters", Words::Kind::heading);
    for (const auto& p : face.params)
        if (p.sheet != nullptr) made.add (paramRow (document, patch, node.name, p, onHint));
    if (face.type == nullptr) return;
    if (! face.type->settings.empty()) made.add ("Settings", Words::Kind::heading);
    for (const auto& s : face.type->settings)
        made.add (settingRow (document, patch, node.name, s));
    made.add ("Source", Words::Kind::heading);
    made.add (text (face.type->info.source), Words::Kind::small);
}

void Inspector::rebuild()
{
    const auto& graph = document.graph();
    const auto* in = patch.empty() ? &graph.root : graph.find (patch);
    std::vector<const graph::Node*> nodes;
    if (in != nullptr)
        for (const auto& n : in->nodes)
            if (selection.contains (n.id)) nodes.push_back (&n);

    std::string key = patch + '|' + std::to_string (nodes.size());
    if (nodes.size() == 1)
    {
        key += nodes[0]->name + '|' + nodes[0]->type;
        if (const auto inputs = nodes[0]->settings.find ("inputs"); inputs != nodes[0]->settings.end()) key += inputs->dump();
    }
    if (nodes.empty())
    {
        key += graph.name + graph.about + numberText (graph.rate_hz);
        for (const auto& c : graph.controls)
            key += '/' + c.id;
    }
    if (key != made_for || ! column)
    {
        made_for = key;
        auto made = std::make_unique<Column>();
        if (nodes.empty())
            describeGraph (*made);
        else if (nodes.size() == 1)
            describe (*in, *nodes[0], *made);
        else
        {
            made->add (juce::String (nodes.size()) + " nodes", Words::Kind::title);
            made->add ("Drag moves them, B bypasses them, G makes a subgraph of them, Delete takes them away.", Words::Kind::small);
        }
        column = std::move (made);
        scroll.setViewedComponent (column.get(), false);
    }
    column->refresh (nodes.size() == 1 ? nodes[0] : nullptr);
    resized();
}

void Inspector::paint (juce::Graphics& g)
{
    g.fillAll (themeOf (*this).panel);
    g.setColour (themeOf (*this).hairline);
    g.drawVerticalLine (0, 0.0f, static_cast<float> (getHeight()));
}

void Inspector::resized()
{
    scroll.setBounds (getLocalBounds().withTrimmedLeft (1));
    if (column) column->layOut (scroll.getMaximumVisibleWidth());
}

}   // namespace tactus::host
