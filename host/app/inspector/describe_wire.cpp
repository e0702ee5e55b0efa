// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"

#include <framework/graph/endpoints.hpp>
#include <framework/graph/text.hpp>
#include <host/app/model/wire_rules.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
const graph::Wire* find (const Inspected& at, graph::Id id)
{
    const auto* in = at.in();
    if (in == nullptr) return nullptr;
    const auto w = std::ranges::find (in->wires, id, &graph::Wire::id);
    return w == in->wires.end() ? nullptr : &*w;
}

void change (const Inspected& at, graph::Id id, const std::function<void (graph::Wire&)>& f, bool goes_on = false)
{
    const auto* now = find (at, id);
    if (now == nullptr) return;
    auto to = *now;
    f (to);
    at.document.perform (graph::ChangeWire { at.patch, id, std::move (to) }, goes_on ? graph::Step::joined : graph::Step::own);
}

constexpr std::string_view open = "as wired";   // of a port that takes its unit from what it is wired to

/// "N, vector" of an end of a wire; "" if nobody knows.
std::string unitAt (const Inspected& at, const graph::Endpoint& e, bool start)
{
    const auto* in = at.in();
    const auto* node = in->find (graph::firstNameOf (e.node));
    if (node == nullptr) return {};
    const auto face = faceOf (at.document.graph(), *in, *node, at.catalogue);
    const auto* port = start ? face.startOf (e) : face.endOf (e);
    if (port == nullptr) return {};
    const auto unit = port->unit.kind == UnitRule::Kind::fixed ? std::string (port->unit.unit.symbol) : std::string (open);
    return unit + (port->width == 3 && e.component < 0 ? ", vector" : "");
}
}   // namespace

void describeWire (const Inspected& at, graph::Id id, Column& column)
{
    column.add ("Wire", Words::Kind::title);
    const auto end = [&] (const char* label, graph::Endpoint graph::Wire::*which, bool start)
    {
        column.add (textRow (
            label, [at, id, which]
            {
            const auto* w = find (at, id);
            return w == nullptr ? juce::String() : juce::String (graph::toText (w->*which)); },
            [at, id, which] (const juce::String& t)
            {
            auto e = graph::parseEndpoint (t.trim().toStdString());
            if (const auto* wrong = std::get_if<std::string> (&e))
                at.refused (juce::String (*wrong));
            else
                change (at, id, [&] (auto& w)
                        { w.*which = std::get<graph::Endpoint> (e); }); },
            start ? "Where it starts: node.output" : "Where it ends: node.input, or node.param"));
    };
    end ("from", &graph::Wire::from, true);
    end ("to", &graph::Wire::to, false);
    column.add (remark ([at, id]
                        {
        const auto* w = find (at, id);
        if (w == nullptr) return Remark {};
        const auto from = unitAt (at, w->from, true), to = unitAt (at, w->to, false);
        const bool one = from == to || to.starts_with (open) || from.starts_with (open);
        return Remark { juce::String (one ? "carries " + (from.starts_with (open) ? to : from) : from + "  into  " + to), false }; }));
    const Slot delay { [at, id]
                       {
                           const auto* w = find (at, id);
                           return w == nullptr || w->delay == 0 ? Json() : Json (w->delay);
                       },
                       [at, id] (std::optional<Json> v, bool goes_on)
                       {
                           const int ticks = v && v->is_number() ? static_cast<int> (std::lround (v->get<double>())) : 0;
                           change (
                               at, id, [&] (auto& w)
                               { w.delay = ticks; },
                               goes_on);
                       } };
    column.add (numberRow ("delay", sheetOfNumber ("delay", unit::count, "how many ticks it holds back; 1 opens a loop", { .hard = { 0, static_cast<double> (graph::longest_delay) }, .usual = { 0, 16 } }, 0.0), delay, at.refused));
    column.add (textRow (
        "gain", [at, id]
        {
        const auto* w = find (at, id);
        if (w == nullptr || w->gain.is_null()) return juce::String();
        return juce::String (w->gain.is_string() ? w->gain.template get<std::string>() : w->gain.dump()); },
        [at, id] (const juce::String& t)
        {
        const auto written = t.trim().toStdString();
        auto value = written.empty() ? Json() : Json::parse (written, nullptr, false);
        if (value.is_discarded()) value = Json (written);
        change (at, id, [&] (auto& w)
                { w.gain = value; }); },
        "Times this: a number, or one with a unit as \"1e-4 m/N\"; empty: 1"));
    column.add (switchRow (
        "enabled", [at, id]
        {
        const auto* w = find (at, id);
        return w != nullptr && w->enabled.value_or (true); },
        [at, id] (bool on)
        { change (at, id, [&] (auto& w)
                  { w.enabled = on ? std::nullopt : std::optional (false); }); },
        "A wire that is off carries nothing"));
    column.add (switchRow (
        "adds", [at, id]
        {
        const auto* w = find (at, id);
        return w != nullptr && w->add; },
        [at, id] (bool on)
        { change (at, id, [&] (auto& w)
                  { w.add = on; }); },
        "Onto a parameter: it adds to the stored value instead of taking its place"));
}

}   // namespace tactus::host
