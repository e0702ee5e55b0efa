// SPDX-License-Identifier: MIT
#include "code_writer.hpp"

#include <host/generate/sources/code.hpp>

#include <algorithm>

namespace tactus::host
{

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
        numbers.push_back (read (sources[k]));
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
            text = passed ("tactus::Vec3 { " + read (source[0]) + ", " + read (source[1]) + ", " + read (source[2]) + " }");
        else
            text = passed (read (source[0]));
        members.emplace_back (row.offset, "." + std::string (row.id) + " = " + text);
        source += slots;
    }
    return inOrder (std::move (members));
}

void CodeWriter::title (const Known& n) { line ("// " + comment (flatOf (n).path) + ": " + std::string (flatOf (n).type->info.id)); }

void CodeWriter::peek (const Known& n, bool is_inner)
{
    line ("auto& " + nodeName (n) + " = p.as<" + n.type + "> (" + values.number (values.plan.instances()[n.instance].node.get()) + ");   // "
          + comment (flatOf (n).path));
    takeOutputs (n, nodeName (n) + ".peek()", is_inner);
}

void CodeWriter::node (const Known& n, const Record& r, bool is_inner)
{
    title (n);
    const auto members = inputs (n, r.sources, {});
    const auto now = nodeName (n) + "_now";   // the peek of a node may be in another part of the code
    line ("auto& " + now + " = p.as<" + n.type + "> (" + values.number (r.self) + ");");
    const auto ticked = now + ".tick ({ " + listed (members) + " })";
    flatOf (n).type->peek ? line (ticked + ";") : takeOutputs (n, ticked, is_inner);
}

/// Sets a parameter from a wire or feed.
void CodeWriter::drive (const std::string& wires, const plan::DrivenNode::Drive& d)
{
    line (wires + " (" + value (d.target) + ", " + (d.replace ? read (d.replace) : value (d.stored)) + ", " + (d.add ? read (d.add) : "0.0") + ", "
          + literal (d.hard.min) + ", " + literal (d.hard.max) + ");");
}

/// A variable with the parameters of a node, with the values that they have without the wires.
std::string CodeWriter::stored (const Known& n, const plan::DrivenNode& d)
{
    const auto name = nodeName (n) + "_stored";
    const auto* own = static_cast<const std::byte*> (d.type->paramsOf (d.node));
    line ("auto " + name + " = " + nodeName (n) + "_now.params;");
    for (const auto& drive : d.drives)
        line ("tactus::fused::store (" + name + ", " + std::to_string (reinterpret_cast<const std::byte*> (drive.target) - own) + ", " + value (drive.stored)
              + ");");
    return name;
}

void CodeWriter::driven (const Known& n, const Record& r, bool is_inner)
{
    const auto& d = *static_cast<plan::DrivenNode*> (r.self);
    const auto now = nodeName (n) + "_now", wires = nodeName (n) + "_driven";
    title (n);
    line ("auto& " + now + " = p.as<" + n.type + "> (" + values.number (d.node) + ");");
    line ("tactus::fused::Driven " + wires + ";");
    for (const auto& one : d.drives)
        drive (wires, one);
    if (d.type->update) line ("if (" + wires + ".moved) " + now + ".update();");
    const auto members = inputs (n, r.sources, wires);
    const auto ticked = now + ".tick ({ " + listed (members) + " }" + (d.params.empty() ? "" : ", " + stored (n, d)) + ")";
    if (d.type->peek) return line (ticked + ";");
    if (! d.faulted.empty()) return takeOutputs (n, ticked, is_inner);
    line ("auto " + nodeName (n) + "_result = " + ticked + ";");
    line ("if (" + wires + ".fault) " + nodeName (n) + "_result = {};");
    takeOutputs (n, nodeName (n) + "_result", is_inner);
}

}   // namespace tactus::host
