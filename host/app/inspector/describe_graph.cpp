// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"
#include <host/app/model/held.hpp>

#include <framework/graph/text.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
juce::String text (const std::string& s) { return juce::String::fromUTF8 (s.c_str()); }

class RemarkBlock final : public Block
{
public:
    explicit RemarkBlock (std::function<Remark()> g) : get (std::move (g)), shown (get()) {}

    int heightFor (int width) override { return shown.text.isEmpty() ? 0 : static_cast<int> (std::ceil (layout (width).getHeight())) + 8; }

    void refresh (const graph::Node*) override
    {
        shown = get();
        repaint();
    }

    void paint (juce::Graphics& g) override
    {
        if (shown.text.isNotEmpty()) layout (getWidth()).draw (g, getLocalBounds().toFloat());
    }

private:
    juce::TextLayout layout (int width) const
    {
        const auto& look = lookOf (*this);
        juce::AttributedString s;
        s.append (shown.text, look.font (12.0f), shown.is_wrong ? look.theme().warning : look.theme().dim);
        juce::TextLayout l;
        l.createLayout (s, static_cast<float> (width));
        return l;
    }

    std::function<Remark()> get;
    Remark shown;
};

void describeSubgraph (const Inspected& at, Column& column)
{
    column.add (text (at.patch), Words::Kind::title);
    column.add ("A subgraph. What it shows of its inside can be wired and set from outside.", Words::Kind::text);
    const auto* patch = at.in();
    if (patch == nullptr) return;
    const auto list = [&] (const char* title, const std::vector<std::pair<std::string, graph::Endpoint>>& shown)
    {
        if (shown.empty()) return;
        column.add (title, Words::Kind::heading);
        for (const auto& [name, end] : shown)
            column.add (text (name + "  is  " + graph::toText (end)), Words::Kind::small);
    };
    list ("Inputs", patch->expose.inputs);
    list ("Parameters", patch->expose.params);
    list ("Outputs", patch->expose.outputs);
}
}   // namespace

std::unique_ptr<Block> remark (std::function<Remark()> get) { return std::make_unique<RemarkBlock> (std::move (get)); }

void describeGraph (const Inspected& at, Column& column)
{
    if (! at.patch.empty()) return describeSubgraph (at, column);
    auto& document = at.document;
    const auto& graph = document.graph();
    column.add (graph.name.empty() ? juce::String ("A graph without a name") : text (graph.name), Words::Kind::title);

    const auto header = [&document] (auto set)
    {
        graph::SetHeader h;
        set (h);
        document.perform (std::move (h));
    };
    column.add (textRow (
        "name", [&document]
        { return text (document.graph().name); },
        [header] (const juce::String& t)
        { header ([&] (auto& h)
                  { h.name = t.trim().toStdString(); }); },
        "What the graph is called"));
    column.add (textRow (
        "about", [&document]
        { return text (document.graph().about); },
        [header] (const juce::String& t)
        { header ([&] (auto& h)
                  { h.about = t.trim().toStdString(); }); },
        "What it feels like", 6));
    const auto tags = [&document]
    {
        juce::StringArray all;
        for (const auto& t : document.graph().tags)
            all.add (text (t));
        return all.joinIntoString (", ");
    };
    column.add (textRow (
        "tags", tags, [header] (const juce::String& t)
        {
        std::vector<std::string> all;
        for (const auto& tag : juce::StringArray::fromTokens (t, ",", ""))
            if (tag.trim().isNotEmpty()) all.push_back (tag.trim().toStdString());
        header ([&] (auto& h)
                { h.tags = all; }); },
        "Words to find it by, separated by commas", 2));
    column.add (numberRow ("rate", sheetOfNumber ("rate_hz", unit::hertz, "how often it ticks; takes effect when it starts anew", { .hard = { 1, 1e6 }, .usual = { 1000, 16000 } }, 4000.0), { [&document]
                                                                                                                                                                                               { return Json (document.graph().rate_hz); },
                                                                                                                                                                                               [&document] (std::optional<Json> v, bool goes_on)
                                                                                                                                                                                               {
                                                                                                                                                                                                   const auto sheet = sheetOfNumber ("rate_hz", unit::hertz, "", {}, 4000.0);
                                                                                                                                                                                                   const auto read = readQuantity (v.value_or (Json (4000.0)), sheet);
                                                                                                                                                                                                   graph::SetHeader h;
                                                                                                                                                                                                   if (const auto* q = std::get_if<QuantityText> (&read)) h.rate_hz = std::round (q->si());
                                                                                                                                                                                                   document.perform (std::move (h), goes_on ? graph::Step::joined : graph::Step::own);
                                                                                                                                                                                               } },
                           at.refused));

    column.add ("Controls", Words::Kind::heading);
    if (graph.controls.empty()) column.add ("One knob for several parameters. Add one here, or press the right button on a parameter.", Words::Kind::small);
    for (const auto& c : graph.controls)
        column.add (controlEditor (document, at.catalogue, c.id, at.refused));
    column.add (buttonRow (
        "+ control", [&document]
        { document.perform (newControl (document.graph())); },
        "Add a control, which moves parameters between two ends"));
}

}   // namespace tactus::host
