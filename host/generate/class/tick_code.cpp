// SPDX-License-Identifier: MIT
#include "tick_code.hpp"

#include <algorithm>

namespace tactus::host
{

std::string TickCode::write()
{
    // A value that is not read is left out. What it was computed from may then be unread, too.
    do
    {
        code.clear();
        records (wiring.plan.settled(), "    ", "ticks");   // on each tick, because exported code does not know which params were written
        records (wiring.plan.records(), "    ", "ticks");
        for (const auto& tap : wiring.plan.taps())
            if (tap.samples == nullptr) wiring.valueAt (tap.value);
    } while (wiring.noteReads());
    return code;
}

void TickCode::records (std::span<const Record> all, const std::string& indent, const std::string& ticks)
{
    for (const auto& r : all)
        record (r, indent, ticks);
}

void TickCode::record (const Record& r, const std::string& indent, const std::string& ticks)
{
    bool is_sum = false;
    plan::eachSum (r, [&] (const plan::Sum& sum) {
        is_sum = true;
        if (wiring.isRead (&sum.out)) line (indent, wiring.target (&sum.out, "auto") + " = " + sumOf (sum) + ";");
    });
    if (is_sum) return;
    if (r.step == &plan::Strike::step)
    {
        const auto& strike = *static_cast<plan::Strike*> (r.self);
        const auto target = wiring.isRead (&strike.out) ? wiring.target (&strike.out) + " = " : std::string {};
        line (indent, target + "hits[" + std::to_string (wiring.hitOf (strike.pulse)) + "] (" + wiring.valueAt (strike.from) + ");");
    }
    else if (r.step == &plan::DelayLine::read)
    {
        const auto* delay = static_cast<plan::DelayLine*> (r.self)->line;
        if (wiring.isRead (&delay->out)) line (indent, wiring.target (&delay->out) + " = " + wiring.object (delay) + ".read();");
    }
    else if (r.step == &plan::DelayLine::write)
    {
        const auto& delay = *static_cast<plan::DelayLine*> (r.self);
        line (indent, wiring.object (delay.line) + ".write (" + wiring.valueAt (delay.from) + ");");
    }
    else if (r.step == &plan::Bypass::step)
        bypass (*static_cast<plan::Bypass*> (r.self), r.sources, indent);
    else if (r.step == &plan::RunningSection::every)
        every (wiring.sections.at (r.self), indent, ticks);
    else if (r.step == &plan::RunningSection::times)
        times (wiring.sections.at (r.self), indent, ticks);
    else if (r.step == &plan::DrivenNode::step)
    {
        const auto& d = *static_cast<plan::DrivenNode*> (r.self);
        driven (*wiring.nodeOf (d.node), d, indent);
    }
    else
        node (*wiring.nodeOf (r.self), r, indent);
}

std::string TickCode::sumOf (const plan::Sum& sum)
{
    std::vector<std::string> terms;
    for (const auto& term : sum.terms)
        terms.push_back ((term.gain == 1.0 ? "" : literal (term.gain) + " * ") + wiring.valueAt (term.from));
    return "sumOf (" + listed (terms) + ")";
}

/// The members of a node's Inputs, in the order of the struct. Array ports first get their own lists. `driven` is the variable that
/// knows whether a wire into a parameter is a fault; empty if there is none.
std::vector<std::string> TickCode::inputs (const ExportedNode& n, const std::string& driven, const std::string& indent)
{
    const auto& type = wiring.type (n);
    const double* const* source = wiring.plan.instances()[n.instance].sources;
    std::vector<std::pair<std::size_t, std::string>> members;
    const auto passed = [&driven] (const std::string& value) { return driven.empty() ? value : driven + ".in (" + value + ")"; };
    for (const auto& row : type.inputs)
    {
        const int slots = wiring.flat (n).slots (row);
        std::string value;
        if (row.list)
        {
            const auto name = n.name + "_" + std::string (row.id);
            std::vector<std::string> values, addresses;
            for (int k = 0; k < slots; ++k)
            {
                values.push_back (wiring.valueAt (source[k]));
                addresses.push_back (passed ("&" + name + "_values[" + std::to_string (k) + "]"));
            }
            code += wrapped (indent, "const double " + name + "_values[] {", values, "};");
            code += wrapped (indent, "const double* const " + name + "_list[] {", addresses, "};");
            value = "{ " + name + "_list, " + std::to_string (slots / row.width) + " }";
        }
        else if (row.width == 3)
            value = driven.empty() ? wiring.valueAt (source) : passed (wiring.valueAt (source, "tactus::Vec3"));
        else
            value = passed (wiring.valueAt (source[0]));
        members.emplace_back (row.offset, "." + std::string (row.id) + " = " + value);
        source += slots;
    }
    return inOrder (std::move (members));
}

void TickCode::node (const ExportedNode& n, const Record& r, const std::string& indent)
{
    const auto& type = wiring.type (n);
    const auto result = (n.is_inner ? "" : "const auto ") + PlanNames::outputsOf (n) + " = ";
    if (type.peek && r.step == type.peek)
    {
        if (n.is_read) line (indent, result + n.name + ".peek();");
        return;
    }
    line ("", "");
    line (indent, "// " + comment (wiring.flat (n).path) + ": " + std::string (type.info.id));
    const auto members = inputs (n, {}, indent);
    code += wrapped (indent, (type.peek || ! n.is_read ? "" : result) + n.name + ".tick ({", members, "});");
}

/// Sets one parameter. If the node asks for the stored values, adds this one to `stored`.
std::string TickCode::parameter (const plan::DrivenNode::Drive& drive, const ExportedNode& n, std::string& stored)
{
    const auto& type = wiring.type (n);
    const auto knobs = wiring.plan.instances()[n.instance].knobs;
    std::size_t number = n.parameters, knob = 0;
    for (const auto& row : type.params)
    {
        for (int k = 0; k < wiring.flat (n).slots (row); ++k, ++number)
        {
            if (&knobs->all[knob + static_cast<std::size_t> (k)].value != drive.stored) continue;
            const auto member = PlanNames::memberOf (row, k), value = "parameters.stored (" + std::to_string (number) + ")";
            stored += n.name + "_stored." + member + " = " + value + "; ";
            return n.name + "_driven (" + n.name + ".params." + member + ", " + (drive.replace ? wiring.valueAt (drive.replace) : value) + ", "
                   + (drive.add ? wiring.valueAt (drive.add) : "0.0") + ", " + literal (drive.hard.min) + ", " + literal (drive.hard.max) + ");";
        }
        knob += plan::Knobs::roomOf (row);
    }
    return {};
}

void TickCode::driven (const ExportedNode& n, const plan::DrivenNode& d, const std::string& indent)
{
    const auto& type = wiring.type (n);
    const auto wires = n.name + "_driven";
    line ("", "");
    line (indent, "// " + comment (wiring.flat (n).path) + ": " + std::string (type.info.id));
    line (indent, "tactus::exported::Driven " + wires + ";");
    std::string stored;
    for (const auto& drive : d.drives)
        line (indent, parameter (drive, n, stored));
    if (type.update) line (indent, "if (" + wires + ".moved) " + n.name + ".update();");
    const auto members = inputs (n, wires, indent);
    const bool asks_for_stored = type.tickStored != nullptr;
    if (asks_for_stored)
    {
        line (indent, "auto " + n.name + "_stored = " + n.name + ".params;");
        stored.pop_back();
        line (indent, stored);
    }
    const bool has_result = ! type.peek && n.is_read, has_no_inputs = d.faulted.empty();
    const auto result = ! has_result ? "" : (n.is_inner ? "" : has_no_inputs ? "auto "
                                                                             : "const auto ")
                                                + PlanNames::outputsOf (n) + " = ";
    code += wrapped (indent, result + n.name + ".tick ({", members, asks_for_stored ? "}, " + n.name + "_stored);" : "});");
    if (has_result && has_no_inputs) line (indent, "if (" + wires + ".fault) " + PlanNames::outputsOf (n) + " = {};");
}

void TickCode::bypass (const plan::Bypass& b, const double* const* sources, const std::string& indent)
{
    for (const auto& copy : b.copies)
    {
        if (! wiring.isRead (copy.to)) continue;
        std::vector<std::string> all;
        for (const auto slot : copy.slots)
            all.push_back (wiring.valueAt (sources[slot]));
        line (indent, wiring.target (copy.to) + " = " + (all.size() == 1 ? all.front() : all.empty() ? "0.0"
                                                                                                     : "sumOf (" + listed (all) + ")")
                          + ";   // bypassed");
    }
}

void TickCode::each (const std::vector<plan::ConversionLink>& links, const std::string& indent,
                     std::string (*call) (const std::string& object, const std::string& from))
{
    for (const auto& link : links)
        line (indent, call (wiring.object (link.converter), wiring.valueAt (link.from)));
}

namespace
{
using Text = const std::string&;
std::string latch (Text object, Text from) { return object + ".out = " + from + ";"; }
std::string silence (Text object, Text) { return object + ".out = 0.0;"; }
std::string gather (Text object, Text from) { return object + ".gather (" + from + ");"; }
std::string deliver (Text object, Text) { return object + ".deliver();"; }
std::string head (Text object, Text from) { return object + ".head (" + from + ");"; }
std::string follow (Text object, Text from) { return object + ".follow (" + from + ", part);"; }
}   // namespace

void TickCode::every (const ExportedSection& s, const std::string& indent, const std::string& ticks)
{
    const auto& r = *s.running;
    const auto factor = std::to_string (r.factor), inside = indent + "    ", deeper = inside + "    ";
    line ("", "");
    line (indent, "{   // " + comment (s.name) + " runs on every tick of " + factor);
    each (r.gathers, inside, gather);
    line (inside, "const auto phase = " + ticks + " % " + factor + ";");
    line (inside, "if (phase == 0)");
    line (inside, "{");
    line (deeper, s.ticks + " = " + ticks + " / " + factor + ";");
    each (r.latches, deeper, latch);
    each (r.gathers, deeper, deliver);
    records (r.records, deeper, s.ticks);
    each (r.lines, deeper, head);
    each (r.pulses, deeper, latch);
    line (inside, "}");
    if (! r.pulses.empty())
    {
        line (inside, "else");
        line (inside, "{");
        each (r.pulses, deeper, silence);
        line (inside, "}");
    }
    if (! r.lines.empty()) line (inside, "const double part = static_cast<double> (phase) / " + literal (static_cast<double> (r.factor)) + ";");
    each (r.lines, inside, follow);
    line (indent, "}");
}

void TickCode::times (const ExportedSection& s, const std::string& indent, const std::string& ticks)
{
    const auto& r = *s.running;
    const auto factor = std::to_string (r.factor), inside = indent + "    ", deeper = inside + "    ";
    line ("", "");
    line (indent, "// " + comment (s.name) + " runs " + factor + " times a tick");
    each (r.lines, indent, head);
    each (r.pulses, indent, latch);
    const auto i = s.ticks.substr (s.ticks.find ('.') + 1) + "_now";
    line (indent, "for (std::uint64_t " + i + " = 0; " + i + " < " + factor + "; ++" + i + ")");
    line (indent, "{");
    line (inside, s.ticks + " = " + ticks + " * " + factor + " + " + i + ";");
    if (! r.lines.empty()) line (inside, "const double part = static_cast<double> (" + i + " + 1) / " + literal (static_cast<double> (r.factor)) + ";");
    each (r.lines, inside, follow);
    if (! r.pulses.empty())
    {
        line (inside, "if (" + i + " == 1)");
        line (inside, "{");
        each (r.pulses, deeper, silence);
        line (inside, "}");
    }
    records (r.records, inside, s.ticks);
    each (r.gathers, inside, gather);
    for (const auto& tap : r.samples)
        for (std::size_t t = 0; t < wiring.plan.taps().size(); ++t)
            if (wiring.plan.taps()[t].samples == tap.to)
                line (inside, "out." + wiring.tap_names[t] + "[" + s.ticks + " % " + std::to_string (tap.per_tick) + "] = " + wiring.valueAt (tap.from) + ";");
    line (indent, "}");
    each (r.gathers, indent, deliver);
}

}   // namespace tactus::host
