// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspector.hpp"

#include <algorithm>

namespace tactus::host
{

Inspector::Inspector (Document& d, const Catalogue& c) : document (d), catalogue (c)
{
    setTitle ("Inspector");
    setFocusContainerType (FocusContainerType::keyboardFocusContainer);
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

void Inspector::setHelp (bool on)
{
    help = on;
    rebuild();
}

Inspected Inspector::inspected()
{
    const auto refused = [this] (const juce::String& why)
    {
        if (onHint) onHint (why);
    };
    return { document, catalogue, patch, refused, EditorContext { files, [this]
                                                                  { return document.graph().folder; },
                                                                  refused },
             [this]
             { return messagesNow ? messagesNow() : Messages {}; } };
}

void Inspector::rebuild()
{
    const auto at = inspected();
    const auto* in = at.in();
    std::vector<const graph::Node*> nodes;
    std::vector<graph::Id> wires;
    if (in != nullptr)
    {
        for (const auto& n : in->nodes)
            if (selection.contains (n.id)) nodes.push_back (&n);
        for (const auto& w : in->wires)
            if (selection.contains (w.id)) wires.push_back (w.id);
    }

    const bool one_wire = nodes.empty() && wires.size() == 1;
    std::string key = patch + '|' + std::to_string (nodes.size()) + '|' + std::to_string (wires.size()) + (help ? "?" : "");
    if (nodes.size() == 1) key += shapeOf (at, *nodes[0]);
    if (one_wire) key += std::to_string (wires[0]);
    if (nodes.empty() && wires.empty())
    {
        key += document.graph().name;
        for (const auto& c : document.graph().controls)
            key += '/' + c.id;
    }
    if (key != made_for || ! column)
    {
        made_for = key;
        auto made = std::make_unique<Column>();
        if (nodes.size() == 1)
            describeNode (
                at, *nodes[0], help, [this]
                { setHelp (! help); },
                *made);
        else if (one_wire)
            describeWire (at, wires[0], *made);
        else if (nodes.empty() && wires.empty())
            describeGraph (at, *made);
        else
        {
            made->add (juce::String (nodes.size()) + " nodes, " + juce::String (wires.size()) + " wires", Words::Kind::title);
            made->add ("Drag moves them, B bypasses them, G makes a subgraph of them, Delete takes them away.", Words::Kind::small);
        }
        made->onHeight = [this]
        { resized(); };
        const auto of = std::make_pair (patch, selection);
        const auto place = column && of == shown_of ? scroll.getViewPosition() : juce::Point<int>();
        shown_of = of;
        retired = std::move (column);
        column = std::move (made);
        scroll.setViewedComponent (column.get(), false);
        column->refresh (nodes.size() == 1 ? nodes[0] : nullptr);
        resized();
        scroll.setViewPosition (place);
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
