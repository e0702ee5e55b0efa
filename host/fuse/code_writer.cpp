// SPDX-License-Identifier: MIT
#include "code_writer.hpp"

#include <host/generate/sources/code.hpp>

#include <set>

namespace tactus::host
{

CodeWriter::Block::Block (CodeWriter& w, const std::string& head) : writer (w)
{
    if (! head.empty()) writer.line (head);
    writer.line ("{");
    writer.indent += 4;
    writer.values.openScope();
}

CodeWriter::Block::~Block()
{
    writer.values.closeScope();
    writer.indent -= 4;
    writer.line ("}");
}

std::string CodeWriter::end (const std::vector<const Known*>& nodes)
{
    std::set<std::string> headers { FusedCode::parts };
    std::set<std::string> checks;
    for (const auto* n : nodes)
    {
        headers.insert (n->header);
        const auto& type = *flatOf (*n).type;
        checks.insert ("static_assert (sizeof (" + n->type + "::Outputs) == " + std::to_string (type.outputs_size) + " && sizeof (" + n->type
                       + "::Params) == " + std::to_string (type.params_size) + ");\n");
    }
    std::string text;
    for (const auto& header : headers)
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
    code.clear();
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
}

void CodeWriter::endPart()
{
    indent = 0;
    line ("}");
    line ("");
}

std::string CodeWriter::read (const double* v)
{
    using Kind = FusedValues::Place::Kind;
    const auto place = values.find (v);
    switch (place.kind)
    {
    case Kind::variable:
        return place.name;
    case Kind::member:
    {
        const auto member = place.name + "." + std::string (place.sheet->id);
        return place.sheet->list || place.sheet->width == 3 ? member + "[" + std::to_string (place.slot) + "]" : member;
    }
    case Kind::constant:
        return literal (*v);
    case Kind::memory:
        break;
    }
    return value (v);
}

void CodeWriter::call (const Record& r)
{
    line ("p.run (" + values.numbers ({ reinterpret_cast<const void*> (r.step), r.self, r.sources, r.outputs }) + ");");
}

void CodeWriter::sum (const plan::Sum& s, bool is_inner)
{
    std::vector<std::string> terms;
    for (const auto& term : s.terms)
        terms.push_back ((term.gain == 1.0 ? "" : literal (term.gain) + " * ") + read (term.from));
    const auto name = fresh ("s");
    const auto memory = is_inner || values.isNeeded (&s.out) ? value (&s.out) + " = " : std::string {};
    line ("const double " + name + " = " + memory + "tactus::fused::sumOf (" + listed (terms) + ");");
    values.name (&s.out, name);
}

void CodeWriter::strike (const plan::Strike& s, bool is_inner)
{
    const auto name = fresh ("k");
    const auto memory = is_inner || values.isNeeded (&s.out) ? value (&s.out) + " = " : std::string {};
    line ("const double " + name + " = " + memory + "tactus::fused::struck (" + read (s.from) + ", " + value (&s.pulse->pending) + ");");
    values.name (&s.out, name);
}

void CodeWriter::readDelay (const plan::Line& wire)
{
    const auto name = fresh ("d");
    line ("const double " + name + " = tactus::fused::delayed (" + value (wire.samples.data()) + ", " + size (&wire.now) + ", " + value (&wire.out) + ");");
    values.name (&wire.out, name);
}

void CodeWriter::writeDelay (const double* from, const plan::Line& wire)
{
    line ("tactus::fused::delay (" + read (from) + ", " + value (wire.samples.data()) + ", " + size (&wire.now) + ", "
          + std::to_string (wire.samples.size()) + ");");
}

}   // namespace tactus::host
