// SPDX-License-Identifier: GPL-3.0-or-later
#include "code_writer.hpp"

#include <host/generate/code.hpp>
#include <host/generate/sources.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// Records in one function. A compiler takes much longer for one function of thousands of nodes than for several smaller ones.
constexpr std::size_t records_in_part = 150;
}   // namespace

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

CodeWriter::CodeWriter (const Plan& plan, const FusedCode::Classes& more) : values (plan)
{
    auto classes = more;
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& type = *plan.flat().nodes[i].type;
        const auto& node = plan.instances()[i].node;
        if (! node || ! plan.flat().nodes[i].runs() || type.owner || ! type.origin.empty()) continue;
        const auto [entry, is_new] = classes.try_emplace (std::string (type.info.id));
        if (is_new) entry->second = classOf (type.info.id);
        const auto& [name, header] = entry->second;
        if (! name.empty()) known.emplace (node.get(), Known { i, name, header });
    }
}

const CodeWriter::Known* CodeWriter::knownOf (const void* node) const
{
    const auto found = known.find (node);
    return found != known.end() ? &found->second : nullptr;
}

FusedCode CodeWriter::write()
{
    do
        writeOnce();
    while (! values.settled());

    std::set<std::string> headers { "tactus/run/fused_parts.hpp" };
    std::string top, checks;
    for (const auto& [node, n] : known)
        headers.insert (n.header);
    for (const auto& header : headers)
        top += "#include <" + header + ">\n";
    std::set<std::string> checked;
    for (const auto& [node, n] : known)
    {
        const auto& type = *values.plan.flat().nodes[n.instance].type;
        checked.insert ("static_assert (sizeof (" + n.type + "::Outputs) == " + std::to_string (type.outputs_size) + " && sizeof (" + n.type
                        + "::Params) == " + std::to_string (type.params_size) + ");\n");
    }
    for (const auto& check : checked)
        checks += check;
    std::string tick = std::string ("extern \"C\" [[gnu::visibility (\"default\")]] void ") + FusedCode::function + " (void* const* objects) noexcept\n{\n";
    for (std::size_t i = 1; i <= parts; ++i)
        tick += "    part" + std::to_string (i) + " (tactus::fused::Objects { objects });\n";
    made.text = top + "\n" + checks + "\n" + code + tick + "}\n";
    made.headers = std::move (headers);
    made.objects = values.objects();
    return std::move (made);
}

void CodeWriter::writeOnce()
{
    code.clear();
    made = {};
    names = parts = in_part = 0;
    beginPart();
    records (values.plan.records(), false);
    indent = 0;
    line ("}");
    line ("");
}

void CodeWriter::beginPart()
{
    in_part = 0;
    ++parts;
    // A function that is called once would be inlined, and all would be one large function again.
    const auto* kind = values.plan.records().size() > records_in_part ? "[[gnu::noinline]] static void part" : "static inline void part";
    line (kind + std::to_string (parts) + " (const tactus::fused::Objects p) noexcept");
    line ("{");
    indent = 4;
    line ("(void) p;");
}

void CodeWriter::records (std::span<const Record> all, bool is_inner)
{
    for (const auto& r : all)
    {
        if (! is_inner && in_part++ == records_in_part)
        {
            indent = 0;
            line ("}");
            line ("");
            values.closeScope();
            values.openScope();
            beginPart();
        }
        if (fuse (r, is_inner))
            ++made.fused;
        else
            call (r);
    }
}

bool CodeWriter::fuse (const Record& r, bool is_inner)
{
    bool is_sum = false;
    plan::eachSum (r, [&] (const plan::Sum& s) {
        is_sum = true;
        sum (s, is_inner);
    });
    if (is_sum) return true;
    if (r.step == &plan::Strike::step)
        strike (*static_cast<plan::Strike*> (r.self), is_inner);
    else if (r.step == &plan::DelayLine::read || r.step == &plan::DelayLine::write)
        delay (r);
    else if (r.step == &plan::RunningSection::every)
        every (*static_cast<plan::RunningSection*> (r.self));
    else if (r.step == &plan::RunningSection::times)
        times (*static_cast<plan::RunningSection*> (r.self));
    else if (r.step == &plan::DrivenNode::step)
    {
        const auto& d = *static_cast<plan::DrivenNode*> (r.self);
        const auto* n = knownOf (d.node);
        if (n == nullptr || (d.type->peek && d.faulted.empty())) return false;
        driven (*n, r, is_inner);
    }
    else
    {
        const auto* n = knownOf (r.self);
        if (n == nullptr) return false;
        const auto& type = *values.plan.flat().nodes[n->instance].type;
        if (r.step != type.tick && r.step != type.peek) return false;
        node (*n, r, is_inner);
    }
    return true;
}

/// Lets a record run as the plan runs it, with everything that it reads in memory.
void CodeWriter::call (const Record& r)
{
    ++made.called;
    const auto& plan = values.plan;
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        if (plan.instances()[i].sources != r.sources) continue;   // a node without inputs has the same sources as the next one
        const auto& flat = plan.flat().nodes[i];
        std::size_t slot = 0;
        for (const auto& row : flat.type->inputs)
            for (int k = 0; k < flat.slots (row); ++k, ++slot)
                if (! flat.muted) values.need (r.sources[slot]);
    }
    if (r.step == &plan::LaneStep::step)
        for (const auto& copy : static_cast<plan::LaneStep*> (r.self)->copies)   // everything else comes from other lanes
            values.need (copy.from);
    if (r.step == &plan::DrivenNode::step)
        for (const auto& drive : static_cast<plan::DrivenNode*> (r.self)->drives)
            for (const auto* from : { drive.replace, drive.add })
                if (from != nullptr) values.need (from);
    line ("p.run (" + values.numbers ({ reinterpret_cast<const void*> (r.step), r.self, r.sources, r.outputs }) + ");");
}

void CodeWriter::sum (const plan::Sum& s, bool is_inner)
{
    std::vector<std::string> terms;
    for (const auto& term : s.terms)
        terms.push_back ((term.gain == 1.0 ? "" : exactly (term.gain) + " * ") + values.read (term.from));
    const auto name = fresh ("s");
    const auto memory = is_inner || values.isNeeded (&s.out) ? value (&s.out) + " = " : std::string {};
    line ("const double " + name + " = " + memory + "tactus::fused::sumOf (" + listed (terms) + ");");
    values.name (&s.out, name);
}

void CodeWriter::strike (const plan::Strike& s, bool is_inner)
{
    const auto name = fresh ("k");
    const auto memory = is_inner || values.isNeeded (&s.out) ? value (&s.out) + " = " : std::string {};
    line ("const double " + name + " = " + memory + "tactus::fused::struck (" + values.read (s.from) + ", " + value (&s.pulse->pending) + ");");
    values.name (&s.out, name);
}

void CodeWriter::delay (const Record& r)
{
    const auto& [from, wire] = *static_cast<plan::DelayLine*> (r.self);
    const auto samples = value (wire->samples.data()), now = "p.as<std::size_t> (" + values.number (&wire->now) + ")";
    if (r.step == &plan::DelayLine::read)
    {
        const auto name = fresh ("d");
        line ("const double " + name + " = tactus::fused::delayed (" + samples + ", " + now + ", " + value (&wire->out) + ");");
        values.name (&wire->out, name);
    }
    else
        line ("tactus::fused::delay (" + values.read (from) + ", " + samples + ", " + now + ", " + std::to_string (wire->samples.size()) + ");");
}

}   // namespace tactus::host
