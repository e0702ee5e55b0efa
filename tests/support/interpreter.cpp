// SPDX-License-Identifier: MIT
#include "interpreter.hpp"

#include <framework/plan/compile.hpp>
#include <framework/text/units.hpp>

#include <algorithm>
#include <cmath>
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

std::string entryName (const PortSheet& row, int entry) { return withIndex (std::string (row.id), row.list ? entry : -1); }

double sorted (std::vector<double> values)
{
    std::ranges::sort (values);
    double total = values[0];
    for (std::size_t i = 1; i < values.size(); ++i)
        total += values[i];
    return total;
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
                i.params[static_cast<std::size_t> (row - i.type->params.begin())][0] = value.get<double>();
                *reinterpret_cast<double*> (static_cast<char*> (i.type->paramsOf (i.node.get())) + row->offset) = value.get<double>();
            }
        }
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
        if (! p.choices.empty() && n.params.contains (p.id))
        {
            const int chosen = static_cast<int> (std::ranges::find (p.choices, n.params.at (std::string (p.id)).get<std::string>()) - p.choices.begin());
            std::memcpy (static_cast<char*> (i.type->paramsOf (i.node.get())) + p.offset, &chosen, sizeof chosen);
        }
    }
    if (i.type->bind && ! n.bypass)
    {
        auto& state = roles[i.role];
        if (! state) state = std::make_unique<DeviceState>();
        i.type->bind (i.node.get(), *state);
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
    const auto quantityOf = [&] (const End& e) {
        for (const auto& tap : compiled.plan->taps())
            if (tap.name == nameOf (e) || tap.name == nameOf (e) + ".x") return tap.quantity;
        throw std::out_of_range (nameOf (e));
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

double Interpreter::currentValue (const End& end, int component) const
{
    const auto bracket = end.port.find ('[');
    const auto entry = bracket == std::string::npos ? std::max (component, 0) : std::stoi (end.port.substr (bracket + 1));
    return instances.at (end.node).outputs[sheet (end, true).offset / sizeof (double) + static_cast<std::size_t> (entry)];
}

double Interpreter::output (const End& end, int component)
{
    const auto& i = instances.at (end.node);
    if (! i.type->peek || i.source->bypass) evaluate (end.node);   // a peeking node's outputs have been valid since the start of the tick
    return currentValue (end, component);
}

/// The value of a wire after it has entered this many sections.
double Interpreter::arrives (Wire& w, int component, std::size_t entered)
{
    if (entered > 0) return w.entering[component][w.enters[entered - 1]].out;
    if (w.wire->delay > 0) return w.line.at (component).front();
    if (w.leaves.empty()) return output (w.from, fromComponent (w, component));
    step (w.leaves.back());
    return w.leaving[component][w.leaves.back()].out;
}

double Interpreter::enteringValue (Wire& w, int section, int component)
{
    const auto entered = std::ranges::find (w.enters, section) - w.enters.begin();
    return arrives (w, component, static_cast<std::size_t> (entered));
}

double Interpreter::leavingValue (Wire& w, int section, int component)
{
    const auto left = std::ranges::find (w.leaves, section) - w.leaves.begin();
    return left == 0 ? currentValue (w.from, fromComponent (w, component)) : w.leaving[component][w.leaves[static_cast<std::size_t> (left) - 1]].out;
}

/// Sums the wires into one component of a port. Returns false if there are none.
bool Interpreter::driven (const std::string& path, const std::string& port, int component, bool add, double& value)
{
    std::vector<double> terms;
    for (auto& w : wires)
    {
        if (w.to.node != path || w.to.port != port || w.wire->add != add || (w.to.component >= 0 && w.to.component != component)) continue;
        const double v = arrives (w, component, w.enters.size());
        terms.push_back (v * w.gain);
    }
    if (! terms.empty()) value = sorted (terms);
    return ! terms.empty();
}

/// Long because it does all steps of a node in order (inputs, params, bypass, tick), and the later steps use the inputs.
void Interpreter::evaluate (const std::string& path)
{
    auto& i = instances.at (path);
    if (i.done) return;
    i.done = true;

    std::vector<double> in;
    std::vector<bool> wired;
    for (const auto& row : i.type->inputs)
        for (int entry = 0; entry < (row.list ? i.entries : 1); ++entry)
            for (int c = 0; c < row.width; ++c)
            {
                in.push_back (row.list ? row.initial[0] : row.initial[c]);
                wired.push_back (driven (path, entryName (row, entry), c, false, in.back()));
            }

    bool moved = false, fault = false;
    for (std::size_t p = 0; p < i.params.size(); ++p)
        for (std::size_t k = 0; k < i.params[p].size(); ++k)
        {
            const auto& row = i.type->params[p];
            double value = i.params[p][k], added = 0.0;
            const auto entry = entryName (row, static_cast<int> (k));
            const int component = row.list ? 0 : static_cast<int> (k);
            const bool replaced = driven (path, entry, component, false, value), plus = driven (path, entry, component, true, added);
            if (! replaced && ! plus) continue;
            value = row.limits.hard.clamp (value + added);
            auto& target = reinterpret_cast<double*> (static_cast<char*> (i.type->paramsOf (i.node.get())) + row.offset)[k];
            if (! std::isfinite (value))
                fault = true;
            else if (value != target)
            {
                target = value;
                moved = true;
            }
        }

    if (i.source->bypass)
    {
        for (const auto& out : i.type->outputs)
            for (int c = 0; c < out.width; ++c)
            {
                double value = out.width == 1 && out.unit.kind == UnitRule::Kind::fixed && out.unit.unit.quantity == Quantity::gain ? 1.0 : 0.0;
                for (std::size_t first = 0; const auto& row : i.type->inputs)
                {
                    const auto n = static_cast<std::size_t> (row.list ? i.entries : 1), width = static_cast<std::size_t> (row.width);
                    if (row.width == out.width && ! out.list && (row.id == out.id || (row.id == "in" && out.id == "out")))
                    {
                        std::vector<double> values;
                        for (std::size_t e = 0; e < n; ++e)
                            if (const auto slot = first + e * width + static_cast<std::size_t> (c); ! row.list || wired[slot]) values.push_back (in[slot]);
                        value = values.empty() ? 0.0 : sorted (values);
                    }
                    first += n * width;
                }
                i.outputs[out.offset / sizeof (double) + static_cast<std::size_t> (c)] = value;
            }
        return;
    }

    if (moved && i.type->update) i.type->update (i.node.get());
    std::vector<const double*> sources;
    const double nan = std::nan ("");
    for (const auto& v : in)
        sources.push_back (fault ? &nan : &v);
    i.type->tick (i.node.get(), sources.data(), i.outputs.data());
    if (fault && in.empty()) i.type->initialiseOutputs (i.outputs.data());
}

/// Runs one tick of a section.
void Interpreter::run (int section)
{
    for (auto& s : sections)
        if (s.around == section) s.done = false;
    for (auto& [path, i] : instances)
    {
        if (i.section != section) continue;
        i.done = false;
        if (i.type->peek && ! i.source->bypass) i.type->peek (i.node.get(), nullptr, i.outputs.data());
    }
    for (auto& [path, i] : instances)
        if (i.section == section) evaluate (path);
    for (std::size_t s = 1; s < sections.size(); ++s)
        if (sections[s].around == section) step (static_cast<int> (s));
    for (auto& w : wires)
        if (w.section == section)
            for (auto& [component, line] : w.line)
            {
                line.push_back (w.leaves.empty() ? output (w.from, fromComponent (w, component)) : w.leaving[component][w.leaves.back()].out);
                line.pop_front();
            }
}

/// What a section does in one tick of the enclosing section.
/// Long because it covers both kinds of rate, `every` and `times`, which share the helpers for crossing wires.
void Interpreter::step (int section)
{
    auto& s = sections[static_cast<std::size_t> (section)];
    if (s.done) return;
    s.done = true;

    const auto passing = [&] (std::vector<int> Wire::*way, std::map<int, std::map<int, Crossing>> Wire::*crossings, auto visit) {
        for (auto& w : wires)
            if (std::ranges::count (w.*way, section) > 0)
                for (const int c : components (w))
                    visit (w, c, (w.*crossings)[c][section]);
    };
    const auto entering = [&] (auto visit) { passing (&Wire::enters, &Wire::entering, visit); };
    const auto leaving = [&] (auto visit) { passing (&Wire::leaves, &Wire::leaving, visit); };
    const auto newEnd = [] (Crossing& x, double value) {
        x.before = x.begun ? x.newest : value;
        x.newest = value;
        x.begun = true;
    };

    const auto number = sections[static_cast<std::size_t> (s.around)].number;
    if (s.every > 1)
    {
        const auto every = static_cast<std::uint64_t> (s.every), phase = number % every;
        entering ([&] (Wire& w, int c, Crossing& x) {
            const double value = enteringValue (w, section, c);
            if (w.hits)
            {
                x.gathered += value;
                if (phase == 0) x.out = std::exchange (x.gathered, 0.0);
            }
            else if (phase == 0)
                x.out = value;
        });
        if (phase == 0)
        {
            s.number = number / every;
            run (section);
        }
        leaving ([&] (Wire& w, int c, Crossing& x) {
            const double value = leavingValue (w, section, c);
            if (phase == 0) newEnd (x, value);
            if (w.hits)
                x.out = phase == 0 ? value : 0.0;
            else if (s.linear && ! w.steps)
                x.out = std::lerp (x.before, x.newest, static_cast<double> (phase) / s.every);
            else
                x.out = value;
        });
        return;
    }

    entering ([&] (Wire& w, int c, Crossing& x) { newEnd (x, enteringValue (w, section, c)); });
    for (int i = 0; i < s.times; ++i)
    {
        s.number = number * static_cast<std::uint64_t> (s.times) + static_cast<std::uint64_t> (i);
        entering ([&] (Wire& w, int, Crossing& x) {
            if (w.hits)
                x.out = i == 0 ? x.newest : 0.0;
            else if (w.steps)
                x.out = x.newest;
            else
                x.out = std::lerp (x.before, x.newest, (i + 1.0) / s.times);
        });
        run (section);
        leaving ([&] (Wire& w, int c, Crossing& x) { x.gathered += leavingValue (w, section, c); });
    }
    leaving ([&] (Wire& w, int c, Crossing& x) {
        const double sum = std::exchange (x.gathered, 0.0);
        x.out = w.hits ? sum : leavingValue (w, section, c);
    });
}

void Interpreter::tick (const std::map<std::string, Reading>& readings)
{
    for (auto& [role, state] : roles)
        if (const auto r = readings.find (role); r != readings.end()) state->reading = r->second;
    run (0);
    ++sections[0].number;
}

std::map<std::string, double> Interpreter::outputs() const
{
    std::map<std::string, double> all;
    for (const auto& [path, i] : instances)
        for (const auto& row : i.type->outputs)
            for (int k = 0; k < (row.list ? i.entries : row.width); ++k)
            {
                const char* components[] = { ".x", ".y", ".z" };
                const auto name = path + "." + entryName (row, k) + (row.width == 3 ? components[k] : "");
                all[name] = i.outputs[row.offset / sizeof (double) + static_cast<std::size_t> (k)];
            }
    return all;
}

}   // namespace tactus::test
