// SPDX-License-Identifier: MIT
#include "cpp_walk.hpp"

#include <host/code/generate/sources/code.hpp>

namespace tactus::host
{

void CppWalk::block (const Text& head, const Body& body)
{
    line (head);
    line ("{");
    indent += 4;
    body();
    indent -= 4;
    line ("}");
}

void CppWalk::statement (const Text& head, const Texts& pieces, const Text& end) { code += wrapped (std::string (indent, ' '), head, pieces, end); }

CppWalk::Text CppWalk::titleOf (const PlanNode& n) const { return "// " + comment (flat (n).path) + ": " + std::string (type (n).info.id); }

CppWalk::Text CppWalk::sumOf (const plan::Sum& sum)
{
    Texts terms;
    for (const auto& term : sum.terms)
        terms.push_back ((term.gain == 1.0 ? "" : literal (term.gain) + " * ") + read (term.from));
    return "sumOf (" + listText (terms) + ")";
}

/// An array port gets its values and their addresses as arrays.
CppWalk::Text CppWalk::list (const PlanNode& n, const PortSheet& row, const double* const* sources, int slots, const Text& fault)
{
    const auto name = n.name + "_" + std::string (row.id);
    Texts all, addresses;
    for (int k = 0; k < slots; ++k)
    {
        const auto address = "&" + name + "_values[" + std::to_string (k) + "]";
        all.push_back (read (sources[k]));
        addresses.push_back (fault.empty() ? address : fault + ".in (" + address + ")");
    }
    statement ("const double " + name + "_values[] {", all, "};");
    statement ("const double* const " + name + "_list[] {", addresses, "};");
    return "{ " + name + "_list, " + std::to_string (slots / row.width) + " }";
}

/// The members of a node's Inputs, in the order of the struct. `fault` is the variable that knows whether a wire into a parameter is at fault.
CppWalk::Texts CppWalk::inputs (const PlanNode& n, const double* const* source, const Text& fault)
{
    const auto passed = [&fault] (const Text& value) { return fault.empty() ? value : fault + ".in (" + value + ")"; };
    std::vector<std::pair<std::size_t, std::string>> members;
    for (const auto& row : type (n).inputs)
    {
        const int slots = flat (n).slots (row);
        const auto value = row.list         ? list (n, row, source, slots, fault)
                           : row.width == 3 ? passed (vector (source, fault.empty() ? "" : "tactus::Vec3"))
                                            : passed (read (source[0]));
        members.emplace_back (row.offset, "." + std::string (row.id) + " = " + value);
        source += slots;
    }
    return inOrder (std::move (members));
}

void CppWalk::callTick (const PlanNode& n, const Text& head, const Texts& inputs, const Text& stored, const Text& end)
{
    statement (head + self (n) + ".tick ({", inputs, "}" + (stored.empty() ? "" : ", " + stored) + ")" + end + ";");
}

CppWalk::Text CppWalk::drives (const PlanNode& n)
{
    line (parts_space + "Driven " + n.name + "_driven;");
    return n.name + "_driven";
}

void CppWalk::drive (const PlanNode& n, const Text& drives, const plan::DrivenNode::Drive& d)
{
    const auto [target, kept] = placeOf (n, d);
    const auto wanted = (d.replace ? read (d.replace) : kept) + ", " + (d.add ? read (d.add) : "0.0");
    line (drives + " (" + target + ", " + wanted + ", " + literal (d.hard.min) + ", " + literal (d.hard.max) + ");");
}

void CppWalk::updateIfMoved (const PlanNode& n, const Text& drives) { line ("if (" + drives + ".moved) " + self (n) + ".update();"); }

CppWalk::Text CppWalk::stored (const PlanNode& n, const plan::DrivenNode& d)
{
    const auto name = n.name + "_stored";
    Texts statements;
    for (const auto& one : d.drives)
        statements.push_back (store (n, d, one));
    line ("auto " + name + " = " + self (n) + ".params;");
    line (listText (statements, " "));
    return name;
}

CppWalk::Text CppWalk::onPhase (const plan::RunningSection& s, const Body& first, const Body& others)
{
    const auto factor = std::to_string (s.factor);
    line ("const auto phase = " + ticks (s.around) + " % " + factor + ";");
    block ("if (phase == 0)", [&] {
        line (ticks (&s.number) + " = " + ticks (s.around) + " / " + factor + ";");
        first();
    });
    if (others) block ("else", others);
    return "phase";
}

void CppWalk::repeat (const plan::RunningSection& s, const std::function<void (const Turn&)>& body)
{
    const auto factor = std::to_string (s.factor), i = indexOf (s);
    block ("for (std::uint64_t " + i + " = 0; " + i + " < " + factor + "; ++" + i + ")", [&] {
        const auto number = ticks (&s.number);
        line (number + " = " + ticks (s.around) + " * " + factor + " + " + i + ";");
        body ({ i, i + " + 1", number });
    });
}

void CppWalk::onSecond (const Turn& turn, const Body& body) { block ("if (" + turn.index + " == 1)", body); }

CppWalk::Text CppWalk::partOf (const Text& steps, std::uint64_t factor)
{
    line ("const double part = static_cast<double> (" + steps + ") / " + literal (static_cast<double> (factor)) + ";");
    return "part";
}

void CppWalk::sample (const Turn& turn, const plan::RunningSection::Samples& tap)
{
    line (samples (tap.to) + "[" + turn.number + " % " + std::to_string (tap.per_tick) + "] = " + read (tap.from) + ";");
}

}   // namespace tactus::host
