// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
const graph::Wire* find (const InspectorContext& at, graph::Id id)
{
    const auto* in = at.in();
    if (in == nullptr) return nullptr;
    const auto w = std::ranges::find (in->wires, id, &graph::Wire::id);
    return w == in->wires.end() ? nullptr : &*w;
}

void change (const InspectorContext& at, graph::Id id, const std::function<void (graph::Wire&)>& f, bool continues = false)
{
    const auto* now = find (at, id);
    if (now == nullptr) return;
    auto to = *now;
    f (to);
    at.document.perform (graph::ChangeWire { at.patch, id, std::move (to) }, continues ? graph::Step::joined : graph::Step::own);
}

/// The unit of a port that takes its unit from what is wired to it.
std::string anyUnit() { return TRANS ("any unit").toStdString(); }

/// The unit at one end of a wire, such as "N, vector". Empty if unknown.
std::string unitAt (const InspectorContext& at, const graph::Endpoint& e, bool start)
{
    const auto* in = at.in();
    const auto* node = in->find (graph::firstNameOf (e.node));
    if (node == nullptr) return {};
    const auto face = faceOf (at.document.graph(), *in, *node, at.catalogue);
    const auto* port = start ? face.startOf (e) : face.endOf (e);
    if (port == nullptr) return {};
    const auto unit = port->unit.kind == UnitRule::Kind::fixed ? unitShown (std::string (port->unit.unit.symbol)) : anyUnit();
    return unit + (port->width == 3 && e.component < 0 ? ", " + TRANS ("vector").toStdString() : "");
}

void addEnd (const InspectorContext& at, graph::Id id, const juce::String& label, graph::Endpoint graph::Wire::*which, const juce::String& help,
             Column& column)
{
    const auto get = [at, id, which] {
        const auto* w = find (at, id);
        return w == nullptr ? juce::String() : juce::String (graph::toText (w->*which));
    };
    const auto set = [at, id, which] (const juce::String& t) {
        const auto e = graph::parseEndpoint (t.trim().toStdString());
        if (! e) return at.refused (fromUtf8 (e.error().text));
        change (at, id, [&] (auto& w) { w.*which = *e; });
    };
    column.add (textRow (label, get, set, help));
}

void addDelay (const InspectorContext& at, graph::Id id, Column& column)
{
    const Binding delay { [at, id] {
                             const auto* w = find (at, id);
                             return w == nullptr || w->delay == 0 ? Json() : Json (w->delay);
                         },
                          [at, id] (std::optional<Json> v, bool continues) {
                              const int ticks = v && v->is_number() ? static_cast<int> (std::lround (v->get<double>())) : 0;
                              change (
                                  at, id, [&] (auto& w) { w.delay = ticks; },
                                  continues);
                          } };
    const Limits limits { .hard = { 0, static_cast<double> (graph::longest_delay) }, .usual = { 0, 16 } };
    column.add (
        numberRow (TRANS ("delay"), sheetOfNumber ("delay", unit::count, lasting (TRANS ("delay in ticks; 1 breaks a loop")), limits, 0.0), delay, at.refused));
}
}   // namespace

void describeWire (const InspectorContext& at, graph::Id id, Column& column)
{
    column.add (TRANS ("Wire"), TextBlock::Kind::title);
    addEnd (at, id, TRANS ("from"), &graph::Wire::from, TRANS ("Source: node.output"), column);
    addEnd (at, id, TRANS ("to"), &graph::Wire::to, TRANS ("Destination: node.input or node.param"), column);
    column.add (remark ([at, id] {
        const auto* w = find (at, id);
        if (w == nullptr) return Remark {};
        const auto open = anyUnit();
        const auto from = unitAt (at, w->from, true), to = unitAt (at, w->to, false);
        if (from != to && ! to.starts_with (open) && ! from.starts_with (open)) return Remark { filled (TRANS ("leads from %1 to %2"), from, to), false };
        return Remark { filled (TRANS ("carries %1"), from.starts_with (open) ? to : from), false };
    }));
    addDelay (at, id, column);
    column.add (textRow (
        TRANS ("gain"), [at, id] {
        const auto* w = find (at, id);
        return w == nullptr ? juce::String() : editText (w->gain); },
        [at, id] (const juce::String& t) {
        const auto value = t.trim().isEmpty() ? Json() : parseText (t);
        change (at, id, [&] (auto& w)
                { w.gain = value; }); },
        TRANS ("A factor, with or without a unit, such as \"1e-4 m/N\". Empty means 1.")));
    column.add (switchRow (
        TRANS ("enabled"), [at, id] {
        const auto* w = find (at, id);
        return w != nullptr && w->enabled.value_or (true); },
        [at, id] (bool on) { change (at, id, [&] (auto& w) { w.enabled = on ? std::nullopt : std::optional (false); }); },
        TRANS ("A disabled wire carries nothing")));
    column.add (switchRow (
        TRANS ("adds"), [at, id] {
        const auto* w = find (at, id);
        return w != nullptr && w->add; },
        [at, id] (bool on) { change (at, id, [&] (auto& w) { w.add = on; }); },
        TRANS ("For a parameter: adds to the stored value instead of replacing it")));
}

}   // namespace tactus::host
