// SPDX-License-Identifier: MIT
#include "wiring_writer.hpp"

namespace tactus::host
{

void WiringWriter::copy (const std::string& from, const std::string& to, std::size_t size)
{
    run ("llvm.memcpy.p0i8.p0i8.i64", { "i8* " + to, "i8* " + from, "i64 " + std::to_string (size), "i1 false" });
}

/// Gives the outputs of a node a name, and copies them to where the plan has them if something else reads them there.
void WiringWriter::takeOutputs (const PlanNode& n, const std::string& outputs)
{
    const auto size = type (n).outputs_size;
    if (size > 0 && (is_inner || values.isNeeded (n.instance))) copy (outputs, object (plan.instances()[n.instance].outputs), size);
    values.nameOutputs (n.instance, outputs);
}

/// The node, as an argument. The first call for a node must not be in a block that may be skipped.
const std::string& WiringWriter::selfOf (const PlanNode& n)
{
    if (self.empty()) self = "i8* " + object (PlanWalk::object (n));
    return self;
}

/// The addresses of what the node reads, as an array.
WiringWriter::Texts WiringWriter::inputs (const PlanNode& n, const double* const* source, const Text& fault)
{
    Texts pointers;
    for (const auto& row : type (n).inputs)
        for (int k = 0; k < flat (n).slots (row); ++k, ++source)
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
    return { "double** " + array ("double*", std::max<std::size_t> (pointers.size(), 1), pointers) };
}

void WiringWriter::peek (const PlanNode& n)
{
    title (n);
    const auto node = selfOf (n), outputs = outputsOf (n);
    runNode (n, "peek", { node, "i8* " + outputs });
    takeOutputs (n, outputs);
}

void WiringWriter::tick (const PlanNode& n, const Texts& inputs, const Text& stored, const Text& reset)
{
    const auto node = selfOf (n), outputs = outputsOf (n);
    if (stored.empty())
        runNode (n, "tick", { node, inputs.front(), "i8* " + outputs });
    else
        runNode (n, "tick_stored", { node, "i8* " + stored, inputs.front(), "i8* " + outputs });
    if (type (n).peek) return;
    if (! reset.empty()) when (reset, [&] { runNode (n, "initialise", { "i8* " + outputs }); });
    takeOutputs (n, outputs);
}

/// The flags of fused::Driven.
WiringWriter::Text WiringWriter::drives (const PlanNode&)
{
    const auto flags = bytes (sizeof (bool) * 2);
    store ("i8", "0", flags);
    store ("i8", "0", offset (flags, 1, "i8"));
    return flags;
}

void WiringWriter::drive (const PlanNode&, const Text& flags, const plan::DrivenNode::Drive& d)
{
    const auto value = d.replace != nullptr ? read (d.replace) : load ("double", object (d.stored, "double"));
    const auto added = d.add != nullptr ? read (d.add) : "0.0";
    run ("tactus_fused_drive", { "i8* " + flags, "double* " + object (d.target, "double"), "double " + value, "double " + added,
                                 "double " + exactly (d.hard.min), "double " + exactly (d.hard.max) });
}

void WiringWriter::updateIfMoved (const PlanNode& n, const Text& flags)
{
    const auto node = selfOf (n);
    when (isSet (flags), [&] { runNode (n, "update", { node }); });
}

/// A copy of the parameters of a node, with the values that they have without the wires.
WiringWriter::Text WiringWriter::stored (const PlanNode&, const plan::DrivenNode& d)
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

/// As in the C++ code, the values in a section are all in memory.
void WiringWriter::convert (Action action, const plan::ConversionLink& link, const Text& part)
{
    const auto& [from, c] = link;
    const auto number = [this] (const double* value) { return "double* " + object (value, "double"); };
    if (action == Action::latch) store ("double", read (from), object (&c->out, "double"));
    if (action == Action::silence) store ("double", "0.0", object (&c->out, "double"));
    if (action == Action::deliver) run ("tactus_fused_deliver", { number (&c->out), number (&c->gathered) });
    if (action == Action::head)
        run ("tactus_fused_head", { "double " + read (from), number (&c->before), number (&c->newest), "i8* " + object (&c->begun) });
    if (action == Action::gather)
    {
        const auto value = read (from), to = object (&c->gathered, "double");
        store ("double", result ("fadd double " + load ("double", to) + ", " + value), to);
    }
    if (action != Action::follow) return;
    const std::vector<std::string> arguments { "double " + read (from), number (&c->before), number (&c->newest), "i8* " + object (&c->begun),
                                               "double " + part };
    store ("double", valueOf ("double", "tactus_fused_follow", arguments), object (&c->out, "double"));
}

WiringWriter::Text WiringWriter::onPhase (const plan::RunningSection& s, const Body& first, const Body& others)
{
    const auto factor = std::to_string (s.factor), around = load ("i64", object (s.around, "i64"));
    const auto phase = result ("urem i64 " + around + ", " + factor);
    const auto advance = [&] {
        store ("i64", result ("udiv i64 " + around + ", " + factor), object (&s.number, "i64"));
        first();
    };
    when (result ("icmp eq i64 " + phase + ", 0"), advance, others);
    return phase;
}

void WiringWriter::repeat (const plan::RunningSection& s, const std::function<void (const Turn&)>& body)
{
    const auto factor = std::to_string (s.factor), again = label(), end = label(), turns = room ("i64");
    store ("i64", "0", turns);
    jump (again);
    startBlock (again);
    values.openScope();
    const auto i = load ("i64", turns), next = result ("add i64 " + i + ", 1");
    store ("i64", next, turns);
    const auto first = result ("mul i64 " + load ("i64", object (s.around, "i64")) + ", " + factor), number = result ("add i64 " + first + ", " + i);
    store ("i64", number, object (&s.number, "i64"));
    body ({ i, next, number });
    values.closeScope();
    line ("br i1 " + result ("icmp ult i64 " + next + ", " + factor) + ", label %" + again + ", label %" + end);
    startBlock (end);
}

WiringWriter::Text WiringWriter::partOf (const Text& steps, std::uint64_t factor)
{
    return result ("fdiv double " + result ("uitofp i64 " + steps + " to double") + ", " + exactly (static_cast<double> (factor)));
}

void WiringWriter::sample (const Turn& turn, const plan::RunningSection::Samples& tap)
{
    const auto at = result ("urem i64 " + turn.number + ", " + std::to_string (tap.per_tick)), value = read (tap.from);
    store ("double", value, result ("getelementptr inbounds double, double* " + object (tap.to, "double") + ", i64 " + at));
}

}   // namespace tactus::host
