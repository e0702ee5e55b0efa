// SPDX-License-Identifier: MIT
#include "plan_names.hpp"

#include <tactus/plan/find_hit.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

PlanNames::PlanNames (const Plan& p, const std::vector<std::string>& feeds, std::set<std::string> taken, PluginClasses of_plugins)
    : plan (p), addresses (p), members (std::move (taken)), plugin_classes (std::move (of_plugins))
{
    nameNodes();
    nameOutside (feeds);
    nameConsumers();
    nameRecords (plan.settled(), false);
    nameRecords (plan.records(), false);
}

void PlanNames::nameNodes()
{
    std::map<std::string_view, NodeClass> classes;
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& flat = plan.flat().nodes[i];
        const auto& instance = plan.instances()[i];
        for (std::size_t k = 0; instance.is_struck && k < instance.knobs->pulses.size(); ++k)
        {
            by_pulse.emplace (&instance.knobs->pulses[k], hits.size());
            hits.emplace_back (i, k);
            hit_names.push_back (plan::nameOfHit (plan, i, k));
        }
        if (! flat.runs() || ! instance.node) continue;
        auto& known = classes[flat.type->info.id];
        if (const auto ours = plugin_classes.find (flat.type->info.id); known.name.empty())
            known = ours != plugin_classes.end() ? ours->second : classOf (flat.type->info.id);
        by_address.emplace (instance.node.get(), nodes.size());
        by_instance.emplace (i, nodes.size());
        std::vector<std::string> endings { "_out", "_driven", "_stored" };
        for (const auto& row : flat.type->inputs)
            for (const auto* ending : { "_values", "_list" })
                if (row.list) endings.push_back ("_" + std::string (row.id) + ending);
        nodes.push_back ({ { .instance = i, .name = members.make (flat.path, endings), .type = known.name, .header = known.header } });
    }
}

void PlanNames::nameOutside (const std::vector<std::string>& feeds)
{
    Names inputs, outputs;
    for (const auto& role : plan.roles())
    {
        role_ports.push_back (inputs.make (role.name));
        outputs.make (role.name);
        role_names.push_back (members.make (role.name));
    }
    for (const auto& feed : feeds)
        feed_names.push_back (inputs.make (feed));
    for (const auto& tap : plan.taps())
        tap_names.push_back (outputs.make (tap.name));
}

std::string PlanNames::nameOf (const PortSheet& sheet, int slot)
{
    std::string name (sheet.id);
    if (sheet.list) name += "_" + std::to_string (slot / sheet.width);
    if (sheet.width == 3) name += std::string ("_") + "xyz"[slot % 3];
    return name;
}

std::string PlanNames::memberOf (const PortSheet& sheet, int slot)
{
    std::string name (sheet.id);
    if (sheet.list) return name + "[" + std::to_string (slot) + "]";
    return sheet.width == 3 ? name + "." + "xyz"[slot] + "()" : name;
}

/// A value is named after what reads it.
void PlanNames::nameConsumers()
{
    for (const auto& node : nodes)
    {
        const double* const* source = plan.instances()[node.instance].sources;
        for (const auto& row : type (node).inputs)
            for (int k = 0; k < flat (node).slots (row); ++k, ++source)
                consumers.emplace (*source, node.name + "_" + nameOf (row, k));
    }
}

/// Names what drives a parameter after the parameter.
void PlanNames::nameDriven (const plan::DrivenNode& driven)
{
    const auto& node = *nodeOf (driven.node);
    for (const auto& drive : driven.drives)
        if (const auto param = addresses.paramAt (drive.target))
        {
            const auto name = node.name + "_" + nameOf (*param->sheet, param->slot);
            if (drive.replace) consumers.emplace (drive.replace, name);
            if (drive.add) consumers.emplace (drive.add, name + "_added");
        }
}

/// The output of a node as a name.
std::string PlanNames::nameOf (const PlanAddresses::Found& output) const
{
    return plan.flat().nodes[output.instance].path + "_" + nameOf (*output.sheet, output.slot);
}

void PlanNames::nameValue (const double* value, const std::string& fallback, bool is_inner)
{
    const auto consumer = consumers.find (value);
    const auto name = members.make (consumer != consumers.end() ? consumer->second : fallback);
    if (is_inner) kept.emplace_back ("double", name);
    values.emplace (value, (is_inner ? "state." : "") + name);
}

/// Named after what reads it, or else after where it comes from.
std::string PlanNames::nameObject (const void* object, const double* out, const double* from, const std::string& type)
{
    const auto consumer = consumers.find (out);
    const auto output = addresses.outputAt (from);
    const auto source = output ? nameOf (*output) : "crossing";
    auto name = members.make (consumer != consumers.end() ? consumer->second + "_wire" : source + "_wire");
    kept.emplace_back (type, name);
    objects.emplace (object, "state." + name);
    return "state." + name;
}

/// The section of these records; their nodes know it.
int PlanNames::sectionOf (std::span<const Record> records) const
{
    std::optional<int> found;
    const auto ofNode = [&] (const void* self) {
        if (const auto node = by_address.find (self); node != by_address.end()) found = flat (nodes[node->second]).section;
    };
    const Cases cases { [] (const auto&) {},
                        [&] (const Record& r) { ofNode (r.self); },
                        [&] (const plan::DrivenNode& d) { ofNode (d.node); },
                        [&] (const SectionStep& s) { found = plan.flat().section (sectionOf (s.running.records)).around; },
                        [&] (const plan::Bypass& b) {
                            for (const auto& copy : b.copies)
                                if (const auto output = addresses.outputAt (copy.to)) found = plan.flat().nodes[output->instance].section;
                        } };
    for (auto r = records.begin(); r != records.end() && ! found; ++r)
        visitRecord (*r, cases);
    return found.value_or (0);
}

void PlanNames::nameSection (const plan::RunningSection& running)
{
    const int number = sectionOf (running.records);
    const auto name = members.make (number > 0 ? plan.flat().section (number).path : "section", { "_ticks", "_ticks_now" });
    kept.emplace_back ("std::uint64_t", name + "_ticks");
    sections.emplace (&running, name);
    const std::pair<const std::vector<plan::ConversionLink>*, const char*> kinds[] {
        { &running.latches, "Held" }, { &running.gathers, "Gathered" }, { &running.lines, "Line" }, { &running.pulses, "Held" }
    };
    for (const auto& [links, type] : kinds)
        for (const auto& link : *links)
            values.emplace (&link.converter->out,
                            nameObject (link.converter, &link.converter->out, link.from, std::string ("tactus::exported::") + type) + ".out");
    nameRecords (running.records, true);
}

void PlanNames::nameRecords (std::span<const Record> records, bool is_inner)
{
    const auto strike = [this] (const plan::Strike& s) {
        if (const auto consumer = consumers.find (&s.out); consumer != consumers.end()) consumers.emplace (s.from, consumer->second + "_wires");
    };
    for (const auto& r : records)
        visitRecord (r, Cases { [] (const auto&) {}, strike, [this] (const plan::DrivenNode& d) { nameDriven (d); } });

    const auto node = [&] (const void* self) {
        if (auto* n = nodeOf (self)) n->is_inner = is_inner;
    };
    const auto bypass = [&] (const plan::Bypass& b) {
        for (const auto& copy : b.copies)
            if (const auto output = addresses.outputAt (copy.to)) nameValue (copy.to, nameOf (*output), is_inner);
    };
    const auto delay = [&] (const DelayRead& d) {
        nameObject (d.line, &d.line->out, d.from, "tactus::exported::DelayLine<" + std::to_string (d.line->samples.size()) + ">");
        nameValue (&d.line->out, "delayed", is_inner);
    };
    for (const auto& r : records)
        visitRecord (r, Cases { [] (const auto&) {}, bypass, delay,
                                [&] (const Record& n) { node (n.self); },
                                [&] (const plan::DrivenNode& d) { node (d.node); },
                                [&] (const plan::Sum& s) { nameValue (&s.out, "sum", is_inner); },
                                [&] (const plan::Strike& s) { nameValue (&s.out, "hit", is_inner); },
                                [&] (const SectionStep& s) { nameSection (s.running); } });
}

bool PlanNames::noteReads()
{
    bool has_changed = false;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        const bool is_read = node_reads.contains (i);
        has_changed = has_changed || nodes[i].is_read != is_read;
        nodes[i].is_read = is_read;
    }
    has_changed = has_changed || ! has_noted || reads != known_reads;
    known_reads = std::move (reads);
    reads.clear();
    node_reads.clear();
    has_noted = true;
    return has_changed;
}

ExportedNode* PlanNames::nodeOf (const void* node)
{
    const auto found = by_address.find (node);
    return found != by_address.end() ? &nodes[found->second] : nullptr;
}

std::string PlanNames::ticksOf (const std::uint64_t* number) const
{
    const auto found = std::ranges::find (sections, number, [] (const auto& s) { return &s.first->number; });
    return found != sections.end() ? "state." + found->second + "_ticks" : "ticks";
}

std::string PlanNames::valueAt (const double* value)
{
    if (const auto known = values.find (value); known != values.end())
    {
        reads.insert (value);
        return known->second;
    }
    if (const auto* first = plan.feeds().data(); value >= first && value < first + plan.feeds().size())
        return "in." + feed_names[static_cast<std::size_t> (value - first)];
    if (const auto output = addresses.outputAt (value))
        if (const auto node = by_instance.find (output->instance); node != by_instance.end())
        {
            node_reads.insert (node->second);
            return outputsOf (nodes[node->second]) + "." + memberOf (*output->sheet, output->slot);
        }
    if (const auto param = addresses.paramAt (value))
        if (const auto node = by_instance.find (param->instance); node != by_instance.end())
            return nodes[node->second].name + ".params." + memberOf (*param->sheet, param->slot);
    return literal (*value);
}

std::string PlanNames::valueAt (const double* const* three, const std::string& type)
{
    const auto output = addresses.outputAt (three[0]);
    if (output && ! values.contains (three[0]) && output->sheet->width == 3 && output->slot == 0 && three[1] == three[0] + 1 && three[2] == three[0] + 2
        && by_instance.contains (output->instance))
    {
        valueAt (three[0]);
        return outputsOf (nodes[by_instance.at (output->instance)]) + "." + std::string (output->sheet->id);
    }
    return type + (type.empty() ? "{ " : " { ") + listText ({ valueAt (three[0]), valueAt (three[1]), valueAt (three[2]) }) + " }";
}

std::string PlanNames::target (const double* value, const std::string& type) const
{
    const auto& name = values.at (value);
    return name.starts_with ("state.") ? name : "const " + type + " " + name;
}

}   // namespace tactus::host
