// SPDX-License-Identifier: MIT
// How the interpreter runs one tick.
#include "interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace tactus::test
{

namespace
{
std::string entryName (const PortSheet& row, int entry)
{
    std::string name (row.id);
    if (row.list) name.append ("[").append (std::to_string (entry)).append ("]");
    return name;
}

double sorted (std::vector<double> values)
{
    std::ranges::sort (values);
    double total = values[0];
    for (std::size_t i = 1; i < values.size(); ++i)
        total += values[i];
    return total;
}
}   // namespace

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
    const auto ends_here = wires_to.find (path);
    if (ends_here == wires_to.end()) return false;
    std::vector<double> terms;
    for (const auto index : ends_here->second)
    {
        auto& w = wires[index];
        if (w.to.port != port || w.wire->add != add || (w.to.component >= 0 && w.to.component != component)) continue;
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

    bool moved = false, fault = false, any_driven = false;
    auto* const own = static_cast<char*> (i.type->paramsOf (i.node.get()));
    std::vector<char> stored (own, own + i.type->params_size);
    for (std::size_t p = 0; p < i.params.size(); ++p)
        for (std::size_t k = 0; k < i.params[p].size(); ++k)
        {
            const auto& row = i.type->params[p];
            double value = i.params[p][k], added = 0.0;
            const auto entry = entryName (row, static_cast<int> (k));
            const int component = row.list ? 0 : static_cast<int> (k);
            const bool replaced = driven (path, entry, component, false, value), plus = driven (path, entry, component, true, added);
            if (! replaced && ! plus) continue;
            any_driven = true;
            std::memcpy (stored.data() + row.offset + k * sizeof (double), &i.params[p][k], sizeof (double));
            value = row.limits.hard.clamp (value + added);
            auto& target = reinterpret_cast<double*> (own + row.offset)[k];
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
    if (any_driven && i.type->tickStored)
        i.type->tickStored (i.node.get(), stored.data(), sources.data(), i.outputs.data());
    else
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
