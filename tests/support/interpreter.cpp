// SPDX-License-Identifier: MIT
// How the interpreter reads a graph; interpreter_tick.cpp runs it.
#include "interpreter.hpp"

#include <tactus/plan/compile.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace tactus::test
{

namespace
{
std::string withIndex (std::string name, int index)
{
    if (index >= 0) name.append ("[").append (std::to_string (index)).append ("]");
    return name;
}

/// Splits "finger[2]/drag" into "finger", the index in the brackets, and the rest of the path.
struct Head
{
    std::string name, instance, rest;
};

Head headOf (const std::string& path)
{
    const auto slash = path.find ('/');
    Head head { path.substr (0, slash), "", slash == std::string::npos ? "" : path.substr (slash + 1) };
    if (const auto bracket = head.name.find ('['); bracket != std::string::npos)
    {
        head.instance = head.name.substr (bracket + 1, head.name.size() - bracket - 2);
        head.name.resize (bracket);
    }
    return head;
}

/// The instances that an index selects: "finger[0]", "finger[1]" …; just "finger" if the node has no count.
std::vector<std::string> instancesOf (const graph::Node& n, const std::string& meant)
{
    if (! n.extra.contains ("count")) return { n.name };
    std::vector<std::string> all;
    for (int k = 0; k < n.extra.at ("count").get<int>(); ++k)
        if (meant.empty() || meant == "*" || meant == std::to_string (k)) all.push_back (withIndex (n.name, k));
    return all;
}
}   // namespace

Interpreter::Interpreter (const graph::Graph& graph_, double rate_hz) : g (graph_)
{
    expand (g.root, "", {}, 0);
    for (auto& [path, i] : instances)
    {
        const auto& section = sections[static_cast<std::size_t> (i.section)];
        if (i.type->prepare) i.type->prepare (i.node.get(), { .rate_hz = rate_hz * (section.up / section.down) });
        if (i.type->update) i.type->update (i.node.get());
    }
    for (std::size_t w = 0; w < wires.size(); ++w)
        wires_to[wires[w].to.node].push_back (w);
    route();
    if (sections.size() > 1) findWhatIsCarried();
}

void Interpreter::expand (const graph::Patch& patch, const std::string& prefix, const Roles& outer, int section)
{
    for (const auto& n : patch.nodes)
        if (n.type.starts_with ("graph:"))
            expandInstances (n, prefix, outer, section);
        else
            add (n, prefix + n.name, outer, section);
    for (const auto& w : patch.wires)
    {
        double gain = 1.0;
        if (w.gain.is_number()) gain = w.gain.get<double>();
        if (w.gain.is_string()) gain = parseMeasure (w.gain.get<std::string>())->value;
        for (const auto& from : resolve (patch, prefix, w.from, true))
            for (const auto& to : resolve (patch, prefix, w.to, false))
                wires.push_back ({ from, to, &w, section, gain, {}, {}, {}, {}, {}, {}, {} });
    }
}

void Interpreter::expandInstances (const graph::Node& n, const std::string& prefix, const Roles& outer, int section)
{
    for (std::size_t k = 0; const auto& name : instancesOf (n, ""))
    {
        auto inner = outer;
        for (const auto& [role, means] : n.roles.items())
        {
            const auto called = means.is_array() ? means.at (k).get<std::string>() : means.get<std::string>();
            inner[role] = outer.contains (called) ? outer.at (called) : called;
        }
        expand (*g.find (n.type.substr (6)), prefix + name + "/", inner, sectionOf (n, section));
        ++k;
    }
    override (n, prefix);
}

/// Overrides of a single instance are applied last.
void Interpreter::override (const graph::Node& n, const std::string& prefix)
{
    for (const bool of_one : { false, true })
        for (const auto& [key, value] : n.overrides.items())
        {
            const auto bracket = key.starts_with ('[') ? key.find (']') : std::string::npos;
            const auto meant = bracket == std::string::npos ? "*" : key.substr (1, bracket - 1);
            if (of_one != (meant != "*")) continue;
            const auto inside = bracket == std::string::npos ? key : key.substr (bracket + 2);
            const auto dot = inside.find ('.');
            for (const auto& name : instancesOf (n, meant))
            {
                auto& i = instances.at (prefix + name + "/" + inside.substr (0, dot));
                const auto row = std::ranges::find (i.type->params, inside.substr (dot + 1), &PortSheet::id);
                if (! row->choices.empty())
                {
                    choose (i, *row, value);
                    continue;
                }
                auto& all = i.params[static_cast<std::size_t> (row - i.type->params.begin())];
                if (value.is_array())
                    for (std::size_t k = 0; k < value.size(); ++k)
                        all[k] = value[k].get<double>();
                else
                    all[0] = value.get<double>();
                std::ranges::copy (all, reinterpret_cast<double*> (static_cast<char*> (i.type->paramsOf (i.node.get())) + row->offset));
            }
        }
}

/// Sets a parameter whose value is one of several words.
void Interpreter::choose (Instance& i, const PortSheet& row, const Json& word)
{
    const int chosen = static_cast<int> (std::ranges::find (row.choices, word.get<std::string>()) - row.choices.begin());
    std::memcpy (static_cast<char*> (i.type->paramsOf (i.node.get())) + row.offset, &chosen, sizeof chosen);
}

/// Each instance of a subgraph with its own rate is a separate section.
int Interpreter::sectionOf (const graph::Node& n, int around)
{
    const int every = n.extra.value ("every", 1), times = n.extra.value ("times", 1);
    if (every <= 1 && times <= 1) return around;
    const auto outer = sections[static_cast<std::size_t> (around)];
    sections.push_back ({ around, every, times, n.extra.value ("hold", "latch") == std::string ("linear"), outer.up * times, outer.down * every });
    return static_cast<int> (sections.size()) - 1;
}

void Interpreter::add (const graph::Node& n, const std::string& path, const Roles& outer, int section)
{
    auto& i = instances[path];
    i.type = catalogue().find (n.type);
    i.source = &n;
    i.section = section;
    i.role = outer.contains (n.role) ? outer.at (n.role) : n.role;
    i.node = i.type->make();
    i.outputs.assign (i.type->outputs_size / sizeof (double) + 1, 0.0);
    i.type->initialiseOutputs (i.outputs.data());

    for (const auto& s : i.type->settings)
    {
        if (s.id == "inputs") i.entries = n.settings.value ("inputs", static_cast<int> (std::get<double> (s.initial)));
        if (! n.settings.contains (s.id)) continue;
        const auto& v = n.settings.at (std::string (s.id));
        if (v.is_number()) s.set (i.node.get(), v.get<double>());
        if (v.is_string()) s.set (i.node.get(), v.get<std::string>());
        if (v.is_array())
            s.set (i.node.get(), Records { { v[0]["frequency"].get<double>(), v[0]["decay"].get<double>(), v[0]["amplitude"].get<double>() } });
    }
    for (const auto& p : i.type->params)
    {
        i.params.emplace_back (static_cast<std::size_t> (p.list ? i.entries : p.width), p.initial[0]);
        if (p.width == 3) i.params.back().assign (p.initial, p.initial + 3);
        if (! p.choices.empty() && n.params.contains (p.id)) choose (i, p, n.params.at (std::string (p.id)));
    }
    if (i.type->bind && ! n.bypass)
    {
        auto& state = roles[i.role];
        if (! state) state = std::make_unique<DeviceState>();
        bindFirst (*i.type, i.node.get(), *state);
    }
}

const PortSheet& Interpreter::sheet (const End& end, bool start) const
{
    const auto& type = *instances.at (end.node).type;
    const auto id = end.port.substr (0, end.port.find ('['));
    for (const auto* rows : start ? std::vector { &type.outputs } : std::vector { &type.inputs, &type.params })
        if (const auto row = std::ranges::find (*rows, id, &PortSheet::id); row != rows->end()) return *row;
    throw std::out_of_range (end.node + "." + end.port);
}

std::vector<int> Interpreter::components (const Wire& w) const
{
    if (w.to.component >= 0) return { w.to.component };
    const auto& row = sheet (w.to, false);
    return row.width == 3 ? std::vector { 0, 1, 2 } : std::vector { 0 };
}

int Interpreter::fromComponent (const Wire& w, int component)
{
    if (w.from.component >= 0) return w.from.component;
    return w.to.component >= 0 ? 0 : component;
}

/// Finds, for each wire, the sections it leaves (innermost first) and the sections it enters (outermost first).
void Interpreter::route()
{
    for (auto& w : wires)
    {
        for (int s = instances.at (w.from.node).section; s != w.section; s = sections[static_cast<std::size_t> (s)].around)
            w.leaves.push_back (s);
        for (int s = instances.at (w.to.node).section; s != w.section; s = sections[static_cast<std::size_t> (s)].around)
            w.enters.insert (w.enters.begin(), s);
        if (w.wire->delay > 0)
            for (const int c : components (w))
                w.line[c].assign (static_cast<std::size_t> (w.wire->delay), 0.0);
    }
}

void Interpreter::findWhatIsCarried()
{
    CompileOptions options { .rate_hz = g.rate_hz };
    const auto nameOf = [] (const End& e) { return e.node + "." + e.port; };
    for (const auto& w : wires)
        for (const auto* end : { &w.from, &w.to })
            options.records.push_back (nameOf (*end));
    const auto compiled = compile (g, catalogue(), options);
    std::map<std::string, Quantity> quantities;
    for (const auto& tap : compiled.plan->taps())
        quantities.emplace (tap.name, tap.quantity);
    const auto quantityOf = [&] (const End& e) {
        const auto scalar = quantities.find (nameOf (e));
        return scalar != quantities.end() ? scalar->second : quantities.at (nameOf (e) + ".x");
    };
    for (auto& w : wires)
    {
        const auto& row = sheet (w.from, true);
        const auto a = quantityOf (w.from), b = quantityOf (w.to);
        w.hits = a == Quantity::hit || b == Quantity::hit;
        const bool counts = row.width == 1 && row.unit.kind == UnitRule::Kind::fixed && row.unit.unit == unit::count;
        w.steps = ! w.hits && (a == Quantity::state || b == Quantity::state || counts);
    }
}

std::vector<Interpreter::End> Interpreter::resolve (const graph::Patch& patch, const std::string& prefix, const graph::Endpoint& e, bool start) const
{
    const auto head = headOf (e.node);
    const auto& n = *patch.find (head.name);
    if (! n.type.starts_with ("graph:"))
        return { { prefix + head.name, withIndex (e.port, e.index), e.component } };

    const auto& inside = *g.find (n.type.substr (6));
    std::vector<End> ends;
    for (const auto& name : instancesOf (n, head.instance))
    {
        const auto deeper = prefix + name + "/";
        if (! head.rest.empty())
        {
            std::ranges::move (resolve (inside, deeper, { head.rest, e.port, e.index, e.component }, start), std::back_inserter (ends));
            continue;
        }
        const auto look = [&] {
            for (const auto* list : start ? std::vector { &inside.expose.outputs } : std::vector { &inside.expose.inputs, &inside.expose.params })
                for (const auto& [shown, to] : *list)
                    if (shown == e.port) return resolve (inside, deeper, to, start);
            return std::vector<End> {};
        };
        for (auto& end : look())
        {
            if (e.component >= 0) end.component = e.component;
            ends.push_back (std::move (end));
        }
    }
    return ends;
}

}   // namespace tactus::test
