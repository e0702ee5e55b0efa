// SPDX-License-Identifier: MIT
#include "wiring_writer.hpp"

#include <algorithm>

namespace tactus::host
{

void WiringWriter::copy (const std::string& from, const std::string& to, std::size_t size)
{
    run ("llvm.memcpy.p0i8.p0i8.i64", { "i8* " + to, "i8* " + from, "i64 " + std::to_string (size), "i1 false" });
}

/// Gives the outputs of a node a name, and copies them to where the plan has them if something else reads them there.
void WiringWriter::takeOutputs (const Known& n, const std::string& outputs, bool is_inner)
{
    const auto size = flatOf (n).type->outputs_size;
    if (size > 0 && (is_inner || values.isNeeded (n.instance)))
        copy (outputs, object (values.plan.instances()[n.instance].outputs), size);
    values.nameOutputs (n.instance, outputs);
}

/// Calls a function of a node's bitcode that takes these arguments and the outputs.
void WiringWriter::tick (const Known& n, const std::string& function, const std::vector<std::string>& arguments, bool is_inner)
{
    const auto outputs = bytes (std::max<std::size_t> (flatOf (n).type->outputs_size, 1));
    auto all = arguments;
    all.push_back ("i8* " + outputs);
    runNode (n, function, all);
    if (function == "peek" || ! flatOf (n).type->peek) takeOutputs (n, outputs, is_inner);
}

/// The addresses of what the node reads, as an array. `fault` is whether a wire into a parameter is at fault; empty if there is none.
std::string WiringWriter::sources (const Known& n, const double* const* all, const std::string& fault)
{
    const auto& flat = flatOf (n);
    std::vector<std::string> pointers;
    const double* const* source = all;
    for (const auto& row : flat.type->inputs)
        for (int k = 0; k < flat.slots (row); ++k, ++source)
        {
            if (fault.empty() && ! row.list)
            {
                pointers.push_back (pointerTo (*source));
                continue;
            }
            // LLVM cannot remove an array of pointers that a loop reads. With copies, at least all that it points to is used nowhere else.
            const auto value = read (*source), copy = room ("double");
            const auto passed = fault.empty() ? value : result ("select i1 " + fault + ", double 0x7FF8000000000000, double " + value);
            store ("double", passed, copy);
            pointers.push_back (copy);
        }
    const auto count = std::max<std::size_t> (pointers.size(), 1);
    const Array array (*this, "double*", count);
    for (std::size_t i = 0; i < pointers.size(); ++i)
        store ("double*", pointers[i], array.entry (i));
    return "double** " + array.entry (0);
}

void WiringWriter::peek (const Known& n, bool is_inner)
{
    tick (n, "peek", { "i8* " + object (values.plan.instances()[n.instance].node.get()) }, is_inner);
}

void WiringWriter::node (const Known& n, const Record& r, bool is_inner)
{
    const auto all = sources (n, r.sources, {});
    tick (n, "tick", { "i8* " + object (r.self), all }, is_inner);
}

/// Sets the parameters that wires and feeds drive. Returns whether a value was not finite.
std::string WiringWriter::drive (const plan::DrivenNode& d)
{
    const auto flags = bytes (sizeof (bool) * 2);
    store ("i8", "0", flags);
    store ("i8", "0", offset (flags, 1, "i8"));
    for (const auto& one : d.drives)
    {
        const auto value = one.replace != nullptr ? read (one.replace) : load ("double", object (one.stored, "double"));
        const auto added = one.add != nullptr ? read (one.add) : "0.0";
        run ("tactus_fused_drive", { "i8* " + flags, "double* " + object (one.target, "double"), "double " + value, "double " + added,
                                     "double " + exactly (one.hard.min), "double " + exactly (one.hard.max) });
    }
    return flags;
}

/// A copy of the parameters of a node, with the values that they have without the wires.
std::string WiringWriter::stored (const plan::DrivenNode& d)
{
    const auto* own = static_cast<const std::byte*> (d.type->paramsOf (d.node));
    const auto params = bytes (d.params.size());
    copy (object (own), params, d.params.size());
    for (const auto& one : d.drives)
    {
        const auto to = static_cast<std::size_t> (reinterpret_cast<const std::byte*> (one.target) - own);
        store ("double", load ("double", object (one.stored, "double")), offset (params, to, "double"));
    }
    return params;
}

void WiringWriter::driven (const Known& n, const Record& r, bool is_inner)
{
    const auto& d = *static_cast<plan::DrivenNode*> (r.self);
    const auto flags = drive (d), self = "i8* " + object (d.node);
    if (d.type->update)
    {
        const auto moved = label(), then = label();
        branch (result ("icmp ne i8 " + load ("i8", flags) + ", 0"), moved, then);
        startBlock (moved);
        runNode (n, "update", { self });
        jump (then);
        startBlock (then);
    }
    const auto fault = result ("icmp ne i8 " + load ("i8", offset (flags, 1, "i8")) + ", 0");
    const auto all = sources (n, r.sources, fault);
    const auto outputs = bytes (std::max<std::size_t> (d.type->outputs_size, 1));
    if (d.params.empty())
        runNode (n, "tick", { self, all, "i8* " + outputs });
    else
        runNode (n, "tick_stored", { self, "i8* " + stored (d), all, "i8* " + outputs });
    if (d.type->peek) return;
    if (d.faulted.empty())
    {
        const auto failed = label(), then = label();
        branch (fault, failed, then);
        startBlock (failed);
        runNode (n, "initialise", { "i8* " + outputs });
        jump (then);
        startBlock (then);
    }
    takeOutputs (n, outputs, is_inner);
}

}   // namespace tactus::host
