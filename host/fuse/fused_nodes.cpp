// SPDX-License-Identifier: GPL-3.0-or-later
#include "code_writer.hpp"

#include <host/generate/code.hpp>

#include <algorithm>

namespace tactus::host
{

/// The node, as a variable with the name nodeName().
std::string CodeWriter::reference (const Known& n)
{
    return "auto& " + nodeName (n) + " = p.as<" + n.type + "> (" + values.number (values.plan.instances()[n.instance].node.get()) + ");";
}

/// Gives the outputs of a node a name. They are put in memory if something else reads them there.
void CodeWriter::takeOutputs (const Known& n, const std::string& result, bool is_inner)
{
    const auto name = fresh ("o");
    const auto& instance = values.plan.instances()[n.instance];
    const bool in_memory = is_inner || values.isNeeded (n.instance);
    if (values.plan.flat().nodes[n.instance].type->outputs_size == 0 || ! in_memory)
        line ("[[maybe_unused]] const auto " + name + " = " + result + ";");
    else
        line ("[[maybe_unused]] const auto& " + name + " = *new (p.at (" + values.number (instance.outputs) + ")) " + n.type + "::Outputs (" + result + ");");
    values.nameOutputs (n.instance, name);
}

std::string CodeWriter::list (const Known& n, const PortSheet& row, const double* const* sources, int slots, const std::string& driven)
{
    const auto count = std::to_string (slots / row.width);
    const auto all = std::span (sources, at (slots));
    if (all.empty()) return "{ nullptr, 0 }";
    if (driven.empty() && std::ranges::none_of (all, [this] (const double* v) { return values.isInSight (v); }))
    {
        for (const auto* v : all)
            values.need (v);
        return "{ p.sources (" + values.number (sources) + "), " + count + " }";
    }
    const auto name = nodeName (n) + "_" + std::string (row.id);
    std::vector<std::string> numbers, addresses;
    for (int k = 0; k < slots; ++k)
    {
        numbers.push_back (values.read (sources[k]));
        const auto address = "&" + name + "_values[" + std::to_string (k) + "]";
        addresses.push_back (driven.empty() ? address : driven + ".in (" + address + ")");
    }
    line ("const double " + name + "_values[] { " + listed (numbers) + " };");
    line ("const double* const " + name + "_list[] { " + listed (addresses) + " };");
    return "{ " + name + "_list, " + count + " }";
}

/// The members of a node's Inputs, in the order of the struct. `driven` is the variable that knows whether a wire into a parameter is a
/// fault; empty if there is none.
std::vector<std::string> CodeWriter::inputs (const Known& n, const double* const* source, const std::string& driven)
{
    const auto& flat = values.plan.flat().nodes[n.instance];
    const auto passed = [&driven] (const std::string& v) { return driven.empty() ? v : driven + ".in (" + v + ")"; };
    std::vector<std::pair<std::size_t, std::string>> members;
    for (const auto& row : flat.type->inputs)
    {
        const int slots = flat.slots (row);
        std::string text;
        if (row.list)
            text = list (n, row, source, slots, driven);
        else if (row.width == 3)
            text = passed ("tactus::Vec3 { " + values.read (source[0]) + ", " + values.read (source[1]) + ", " + values.read (source[2]) + " }");
        else
            text = passed (values.read (source[0]));
        members.emplace_back (row.offset, "." + std::string (row.id) + " = " + text);
        source += slots;
    }
    return inOrder (std::move (members));
}

void CodeWriter::node (const Known& n, const Record& r, bool is_inner)
{
    const auto& flat = values.plan.flat().nodes[n.instance];
    if (flat.type->peek && r.step == flat.type->peek)
    {
        line (reference (n) + "   // " + comment (flat.path));
        return takeOutputs (n, nodeName (n) + ".peek()", is_inner);
    }
    line ("// " + comment (flat.path) + ": " + std::string (flat.type->info.id));
    const auto members = inputs (n, r.sources, {});
    const auto call = nodeName (n) + ".tick ({ " + listed (members) + " })";
    // The peek of a node may be in another part of the code.
    line ("auto& " + nodeName (n) + "_now = p.as<" + n.type + "> (" + values.number (r.self) + ");");
    const auto ticked = nodeName (n) + "_now" + call.substr (nodeName (n).size());
    flat.type->peek ? line (ticked + ";") : takeOutputs (n, ticked, is_inner);
}

void CodeWriter::driven (const Known& n, const Record& r, bool is_inner)
{
    const auto& d = *static_cast<plan::DrivenNode*> (r.self);
    const auto& flat = values.plan.flat().nodes[n.instance];
    const auto now = nodeName (n) + "_now", wires = nodeName (n) + "_driven", stored = nodeName (n) + "_stored";
    line ("// " + comment (flat.path) + ": " + std::string (flat.type->info.id));
    line ("auto& " + now + " = p.as<" + n.type + "> (" + values.number (d.node) + ");");
    line ("tactus::fused::Driven " + wires + ";");
    const auto limit = [] (double v) { return v == inf ? "tactus::inf" : v == -inf ? "-tactus::inf"
                                                                                   : exactly (v); };
    for (const auto& drive : d.drives)
        line (wires + " (" + value (drive.target) + ", " + (drive.replace ? values.read (drive.replace) : value (drive.stored)) + ", "
              + (drive.add ? values.read (drive.add) : "0.0") + ", " + limit (drive.hard.min) + ", " + limit (drive.hard.max) + ");");
    if (d.type->update) line ("if (" + wires + ".moved) " + now + ".update();");
    const auto members = inputs (n, r.sources, wires);
    if (! d.params.empty())
    {
        const auto* own = static_cast<const std::byte*> (d.type->paramsOf (d.node));
        line ("auto " + stored + " = " + now + ".params;");
        for (const auto& drive : d.drives)
            line ("tactus::fused::store (" + stored + ", " + std::to_string (reinterpret_cast<const std::byte*> (drive.target) - own) + ", "
                  + value (drive.stored) + ");");
    }
    const auto ticked = now + ".tick ({ " + listed (members) + " }" + (d.params.empty() ? ")" : ", " + stored + ")");
    if (d.type->peek) return line (ticked + ";");
    if (! d.faulted.empty()) return takeOutputs (n, ticked, is_inner);
    line ("auto " + nodeName (n) + "_result = " + ticked + ";");
    line ("if (" + wires + ".fault) " + nodeName (n) + "_result = {};");
    takeOutputs (n, nodeName (n) + "_result", is_inner);
}

}   // namespace tactus::host
