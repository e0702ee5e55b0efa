// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace tactus::host
{

namespace
{
class RemarkBlock final : public Block
{
public:
    explicit RemarkBlock (std::function<Remark()> g) : get (std::move (g)), shown (get()) {}

    int heightFor (int width) override { return shown.text.isEmpty() ? 0 : static_cast<int> (std::ceil (layout (width).getHeight())) + 8; }

    void refresh (const graph::Node*) override
    {
        const auto before = std::exchange (shown, get()).text;
        if (shown.text != before && getWidth() > 0 && heightFor (getWidth()) != getHeight() && onHeight) onHeight();
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
        return wrapText (shown.text, look.font (12.0f), shown.is_problem ? look.theme().warning : look.theme().dim, static_cast<float> (width));
    }

    std::function<Remark()> get;
    Remark shown;
};

void describeSubgraph (const InspectorContext& at, Column& column)
{
    column.add (fromUtf8 (at.patch), TextBlock::Kind::title);
    column.add (TRANS ("A subgraph. Its exposed ports can be wired and set from outside."), TextBlock::Kind::text);
    const auto* patch = at.in();
    if (patch == nullptr) return;
    const auto list = [&] (const juce::String& title, const std::vector<std::pair<std::string, graph::Endpoint>>& shown) {
        if (shown.empty()) return;
        column.add (title, TextBlock::Kind::heading);
        for (const auto& [name, end] : shown)
            column.add (fromUtf8 (name + " = " + graph::toText (end)), TextBlock::Kind::small);
    };
    list (TRANS ("Inputs"), patch->expose.inputs);
    list (TRANS ("Parameters"), patch->expose.params);
    list (TRANS ("Outputs"), patch->expose.outputs);
}
}   // namespace

std::unique_ptr<Block> remark (std::function<Remark()> get) { return std::make_unique<RemarkBlock> (std::move (get)); }

void describeGraph (const InspectorContext& at, Column& column)
{
    if (! at.patch.empty()) return describeSubgraph (at, column);
    auto& document = at.document;
    const auto& graph = document.graph();
    column.add (graph.name.empty() ? TRANS ("Untitled graph") : fromUtf8 (graph.name), TextBlock::Kind::title);

    const auto header = [&document, typed = std::make_shared<TypedStep> (document)] (auto set, bool is_typed = false) {
        graph::SetHeader h;
        set (h);
        const auto perform = [&] (graph::Step step) { return document.perform (std::move (h), step); };
        is_typed ? typed->perform (perform) : perform (graph::Step::own);
    };
    const auto row = [&] (const juce::String& label, std::string graph::Graph::*member, std::optional<std::string> graph::SetHeader::*to,
                          const juce::String& help, int lines) {
        column.add (textRow (
            label, [&document, member] { return fromUtf8 (document.graph().*member); },
            [header, to, lines] (const juce::String& t) { header ([&] (auto& h) { h.*to = t.trim().toStdString(); }, lines > 2); },
            help, lines));
    };
    row (TRANS ("name"), &graph::Graph::name, &graph::SetHeader::name, TRANS ("The name of the graph"), 1);
    row (TRANS ("about"), &graph::Graph::about, &graph::SetHeader::about, TRANS ("What the graph feels like"), 6);
    const auto tags = [&document] {
        juce::StringArray all;
        for (const auto& t : document.graph().tags)
            all.add (fromUtf8 (t));
        return all.joinIntoString (", ");
    };
    const auto setTags = [header] (const juce::String& t) {
        std::vector<std::string> all;
        for (const auto& tag : juce::StringArray::fromTokens (t, ",", ""))
            if (tag.trim().isNotEmpty()) all.push_back (tag.trim().toStdString());
        header ([&] (auto& h) { h.tags = all; });
    };
    column.add (textRow (TRANS ("tags"), tags, setTags, TRANS ("Search keywords, separated by commas"), 2));
    static constexpr double usual_rate_hz = 4000.0;
    const Limits limits { .hard = { 1, 1e6 }, .usual = { 1000, 16000 } };
    const auto rate = sheetOfNumber ("rate_hz", unit::hertz, lasting (TRANS ("the tick rate; takes effect at the next start")), limits, usual_rate_hz);
    const Binding rate_binding { [&document] { return Json (document.graph().rate_hz); },
                                 [&document, rate] (const std::optional<Json>& v, bool continues) {
                                     graph::SetHeader h;
                                     h.rate_hz = std::round (siOf (v.value_or (Json (usual_rate_hz)), rate, usual_rate_hz));
                                     document.perform (std::move (h), continues ? graph::Step::joined : graph::Step::own);
                                 } };
    column.add (numberRow (TRANS ("rate"), rate, rate_binding, at.refused));

    column.add (TRANS ("Controls"), TextBlock::Kind::heading);
    if (graph.controls.empty())
        column.add (TRANS ("A control moves several parameters at once. Add one here, or right-click a parameter."), TextBlock::Kind::small);
    for (const auto& c : graph.controls)
        column.add (controlEditor (document, at.catalogue, c.id, at.refused));
    column.add (buttonRow (
        TRANS ("+ control"), [&document] { document.perform (newControl (document.graph())); },
        TRANS ("Add a control")));
}

}   // namespace tactus::host
