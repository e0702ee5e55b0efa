// SPDX-License-Identifier: MIT
#include "code_writer.hpp"

#include <host/code/generate/sources/code.hpp>

#include <algorithm>
#include <set>

namespace tactus::host
{

CodeWriter::CodeWriter (const Plan& p, const FusedCode::Classes& more)
    : CppWalk (p, "tactus::fused::"), values (p), nodes (p, more, [] (const std::string&) { return true; })
{
}

FusedCode CodeWriter::fused()
{
    write();
    return { FusedCode::Language::cpp, whole(), nodes.headers(), values.objects(), count - called, called };
}

std::string CodeWriter::whole() const
{
    std::set<std::string> checks;
    for (const auto& n : nodes.all())
        checks.insert ("static_assert (sizeof (" + n.type + "::Outputs) == " + std::to_string (type (n).outputs_size) + " && sizeof (" + n.type
                       + "::Params) == " + std::to_string (type (n).params_size) + ");\n");
    std::string text;
    for (const auto& header : nodes.headers())
        text += "#include <" + header + ">\n";
    text += "\n";
    for (const auto& check : checks)
        text += check;
    text += "\n" + code + "extern \"C\" [[gnu::visibility (\"default\"), gnu::externally_visible]] void " + FusedCode::function
            + " (void* const* objects) noexcept\n{\n";
    for (int i = 1; i <= parts; ++i)
        text += "    part" + std::to_string (i) + " (tactus::fused::Objects { objects });\n";
    return text + "}\n";
}

void CodeWriter::begin()
{
    CppWalk::begin();
    names = 0;
}

void CodeWriter::beginPart()
{
    // A function that is called once would be inlined, and all would be one large function again.
    const auto* kind = isLarge() ? "[[gnu::noinline]] static void part" : "static inline void part";
    line (kind + std::to_string (parts) + " (const tactus::fused::Objects p) noexcept");
    line ("{");
    indent = 4;
    line ("(void) p;");
    values.openScope();
}

void CodeWriter::endPart()
{
    values.closeScope();
    indent = 0;
    line ("}");
    line();
}

void CodeWriter::block (const Text& head, const Body& body)
{
    values.openScope();
    CppWalk::block (head, body);
    values.closeScope();
}

CodeWriter::Text CodeWriter::read (const double* v)
{
    using Kind = FusedValues::Place::Kind;
    const auto place = values.find (v);
    if (place.kind == Kind::variable) return place.name;
    if (place.kind == Kind::constant) return literal (*v);
    if (place.kind == Kind::memory) return value (v);
    const bool is_entry = place.sheet->list || place.sheet->width == 3;
    return place.name + "." + std::string (place.sheet->id) + (is_entry ? "[" + std::to_string (place.slot) + "]" : "");
}

CodeWriter::Text CodeWriter::vector (const double* const* three, const Text&)
{
    return "tactus::Vec3 { " + read (three[0]) + ", " + read (three[1]) + ", " + read (three[2]) + " }";
}

void CodeWriter::call (const Record& r)
{
    values.need (r);
    line ("p.run (" + values.numbers ({ reinterpret_cast<const void*> (r.step), r.self, r.sources, r.outputs }) + ");");
}

/// Gives a value a name, and puts it in memory if something else reads it there.
void CodeWriter::keep (const double* out, const char* stem, const Text& is)
{
    const auto name = fresh (stem);
    const auto memory = is_inner || values.isNeeded (out) ? value (out) + " = " : Text {};
    line ("const double " + name + " = " + memory + "tactus::fused::" + is + ";");
    values.name (out, name);
}

void CodeWriter::sum (const plan::Sum& s) { keep (&s.out, "s", sumOf (s)); }

void CodeWriter::strike (const plan::Strike& s) { keep (&s.out, "k", "struck (" + read (s.from) + ", " + value (&s.pulse->pending) + ")"); }

void CodeWriter::readDelay (const plan::Line& wire)
{
    const auto name = fresh ("d");
    line ("const double " + name + " = tactus::fused::delayed (" + value (wire.samples.data()) + ", " + size (&wire.now) + ", " + value (&wire.out) + ");");
    values.name (&wire.out, name);
}

void CodeWriter::writeDelay (const plan::Line& wire, const double* from)
{
    line ("tactus::fused::delay (" + read (from) + ", " + value (wire.samples.data()) + ", " + size (&wire.now) + ", "
          + std::to_string (wire.samples.size()) + ");");
}

CodeWriter::Text CodeWriter::list (const PlanNode& n, const PortSheet& row, const double* const* sources, int slots, const Text& fault)
{
    const auto all = std::span (sources, at (slots));
    if (all.empty()) return "{ nullptr, 0 }";
    if (! fault.empty() || std::ranges::any_of (all, [this] (const double* v) { return values.isInSight (v); }))
        return CppWalk::list (n, row, sources, slots, fault);
    for (const auto* v : all)
        values.need (v);
    return "{ p.sources (" + values.number (sources) + "), " + std::to_string (slots / row.width) + " }";
}

void CodeWriter::title (const PlanNode& n)
{
    line (titleOf (n));
    line ("auto& " + self (n) + " = p.as<" + n.type + "> (" + values.number (object (n)) + ");");
}

void CodeWriter::peek (const PlanNode& n)
{
    line ("auto& " + n.name + " = p.as<" + n.type + "> (" + values.number (object (n)) + ");   // " + comment (flat (n).path));
    const auto [before, after] = outputs (n);
    line (before + n.name + ".peek()" + after + ";");
}

/// Gives the outputs of a node a name. They are put in memory if something else reads them there. Returns what stands before and after them.
std::pair<CodeWriter::Text, CodeWriter::Text> CodeWriter::outputs (const PlanNode& n)
{
    const auto name = fresh ("o");
    values.nameOutputs (n.instance, name);
    const bool in_memory = is_inner || values.isNeeded (n.instance);
    if (type (n).outputs_size == 0 || ! in_memory) return { "[[maybe_unused]] const auto " + name + " = ", "" };
    const auto place = values.number (plan.instances()[n.instance].outputs);
    return { "[[maybe_unused]] const auto& " + name + " = *new (p.at (" + place + ")) " + n.type + "::Outputs (", ")" };
}

void CodeWriter::tick (const PlanNode& n, const Texts& inputs, const Text& stored, const Text& reset)
{
    if (type (n).peek) return callTick (n, {}, inputs, stored);
    if (reset.empty())
    {
        const auto [before, after] = outputs (n);
        return callTick (n, before, inputs, stored, after);
    }
    const auto result = n.name + "_result";
    callTick (n, "auto " + result + " = ", inputs, stored);
    line ("if (" + reset + ".fault) " + result + " = {};");
    const auto [before, after] = outputs (n);
    line (before + result + after + ";");
}

std::pair<CodeWriter::Text, CodeWriter::Text> CodeWriter::placeOf (const PlanNode&, const plan::DrivenNode::Drive& d)
{
    return { value (d.target), d.replace ? Text {} : value (d.stored) };
}

CodeWriter::Text CodeWriter::store (const PlanNode& n, const plan::DrivenNode& d, const plan::DrivenNode::Drive& drive)
{
    const auto offset = reinterpret_cast<const std::byte*> (drive.target) - static_cast<const std::byte*> (d.type->paramsOf (d.node));
    return "tactus::fused::store (" + n.name + "_stored, " + std::to_string (offset) + ", " + value (drive.stored) + ");";
}

void CodeWriter::section (const SectionStep& s, const Body& body)
{
    const auto factor = std::to_string (s.running.factor);
    block ("// A section that runs " + (s.kind == plan::Section::Kind::every ? "on every tick of " + factor : factor + " times a tick"), body);
}

/// The values in a section are all in memory, because outside of it, and on ticks on which it does not run, they keep their last value.
void CodeWriter::convert (Action action, const plan::ConversionLink& link, const Text& part)
{
    const auto& [from, c] = link;
    if (action == Action::latch) line (value (&c->out) + " = " + read (from) + ";");
    if (action == Action::silence) line (value (&c->out) + " = 0.0;");
    if (action == Action::gather) line (value (&c->gathered) + " += " + read (from) + ";");
    if (action == Action::deliver) line ("tactus::fused::deliver (" + value (&c->out) + ", " + value (&c->gathered) + ");");
    if (action == Action::head)
        line ("tactus::fused::head (" + read (from) + ", " + value (&c->before) + ", " + value (&c->newest) + ", " + flag (&c->begun) + ");");
    if (action == Action::follow)
        line (value (&c->out) + " = tactus::fused::follow (" + read (from) + ", " + value (&c->before) + ", " + value (&c->newest) + ", "
              + flag (&c->begun) + ", " + part + ");");
}

}   // namespace tactus::host
