// SPDX-License-Identifier: MIT
#include "wiring_writer.hpp"
#include "bitcode.hpp"

#include <host/code/generate/sources/code.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>

namespace tactus::host
{

namespace
{
/// The type of an argument: "double" of "double %v3".
std::string typeOf (const std::string& argument) { return argument.substr (0, argument.find (' ')); }
}   // namespace

std::string WiringWriter::exactly (double v)
{
    std::array<char, 24> text {};
    std::snprintf (text.data(), text.size(), "0x%016llX", static_cast<unsigned long long> (std::bit_cast<std::uint64_t> (v)));
    return text.data();
}

WiringWriter::WiringWriter (const Plan& p)
    : PlanWalk (p), values (p), nodes (p, {}, [] (const std::string& header) { return ! findBitcode (header).empty(); })
{
}

FusedCode WiringWriter::fused()
{
    write();
    return { FusedCode::Language::llvm, whole(), nodes.headers(), values.objects(), count - called, called };
}

void WiringWriter::begin()
{
    functions.clear();
    declarations.clear();
    constants.clear();
    names = 0;
}

void WiringWriter::beginPart()
{
    rooms.clear();
    code.clear();
    values.openScope();
}

void WiringWriter::endPart()
{
    values.closeScope();
    // A function that is called once would be inlined, and all would be one large function again.
    functions += "define internal void @part" + std::to_string (parts) + " (i8** %objects) nounwind" + (isLarge() ? " noinline" : "") + "\n{\n"
                 + rooms + code + "  ret void\n}\n\n";
}

std::string WiringWriter::whole() const
{
    std::string text;
    for (const auto& c : constants)
        text += "@c" + c + " = private unnamed_addr constant double " + c + "\n";
    for (const auto& [name, declaration] : declarations)
        text += declaration;
    text += "\n" + functions + "define void @" + FusedCode::function + " (i8** %objects) nounwind\n{\n";
    for (int i = 1; i <= parts; ++i)
        text += "  call void @part" + std::to_string (i) + " (i8** %objects)\n";
    return text + "  ret void\n}\n\n!0 = !{}\n";
}

std::string WiringWriter::room (const std::string& type)
{
    const auto name = "%r" + std::to_string (++names);
    rooms += "  " + name + " = alloca " + type + ", align 16\n";   // at the beginning of the function, because one in a loop would grow the stack
    return name;
}

std::string WiringWriter::array (const std::string& element, std::size_t size, const Texts& entries)
{
    const auto type = "[" + std::to_string (size) + " x " + element + "]", all = room (type);
    const auto base = "getelementptr inbounds " + type + ", " + type + "* " + all + ", i64 0, i64 ";
    for (std::size_t i = 0; i < entries.size(); ++i)
        store (element, entries[i], result (base + std::to_string (i)));
    return result (base + "0");
}

std::string WiringWriter::object (const void* address, const std::string& type)
{
    const auto at = result ("getelementptr inbounds i8*, i8** %objects, i64 " + values.number (address));
    const auto found = result ("load i8*, i8** " + at + ", align 8, !invariant.load !0");
    return type == "i8" ? found : result ("bitcast i8* " + found + " to " + type + "*");
}

std::string WiringWriter::load (const std::string& type, const std::string& from) { return result ("load " + type + ", " + type + "* " + from); }

void WiringWriter::store (const std::string& type, const std::string& value, const std::string& to)
{
    line ("store " + type + " " + value + ", " + type + "* " + to);
}

std::string WiringWriter::offset (const std::string& all, std::size_t by, const std::string& type)
{
    const auto at = result ("getelementptr inbounds i8, i8* " + all + ", i64 " + std::to_string (by));
    return type == "i8" ? at : result ("bitcast i8* " + at + " to " + type + "*");
}

std::string WiringWriter::result (const std::string& instruction)
{
    const auto name = "%v" + std::to_string (++names);
    line (name + " = " + instruction);
    return name;
}

std::string WiringWriter::valueOf (const std::string& type, const std::string& function, const std::vector<std::string>& arguments)
{
    declare (type, function, arguments);
    return result ("call " + type + " @" + function + " (" + listText (arguments) + ")");
}

void WiringWriter::run (const std::string& function, const std::vector<std::string>& arguments, const std::string& how)
{
    declare ("void", function, arguments);
    line ("call void @" + function + " (" + listText (arguments) + ")" + how);
}

/// Calls a function of the bitcode of a node. It is inlined, however large it is, unless it would be repeated too often.
void WiringWriter::runNode (const PlanNode& n, const std::string& function, const std::vector<std::string>& arguments)
{
    run (bitcodeName (function, n.header), arguments, nodes.isRare (n) ? " alwaysinline" : "");
}

void WiringWriter::declare (const std::string& type, const std::string& function, const std::vector<std::string>& arguments)
{
    std::vector<std::string> types;
    for (const auto& a : arguments)
        types.push_back (typeOf (a));
    declarations[function] = "declare " + type + " @" + function + " (" + listText (types) + ") nounwind\n";
}

/// Runs one of two blocks. The second one may be empty.
void WiringWriter::when (const std::string& condition, const Body& yes, const Body& no)
{
    const auto first = label(), second = no ? label() : std::string {}, end = label();
    line ("br i1 " + condition + ", label %" + first + ", label %" + (no ? second : end));
    const auto block = [&] (const std::string& name, const Body& body) {
        startBlock (name);
        values.openScope();
        body();
        values.closeScope();
        jump (end);
    };
    block (first, yes);
    if (no) block (second, no);
    startBlock (end);
}

std::string WiringWriter::read (const double* v)
{
    const auto place = values.find (v);
    if (place.kind == Kind::variable) return place.name;
    return place.kind == Kind::constant ? exactly (*v) : load ("double", addressOf (v, place));
}

std::string WiringWriter::pointerTo (const double* v)
{
    const auto place = values.find (v);
    if (place.kind == Kind::constant) return "@c" + *constants.insert (exactly (*v)).first;
    if (place.kind != Kind::variable) return addressOf (v, place);
    const auto copy = room ("double");
    store ("double", place.name, copy);
    return copy;
}

/// The address of a value that is not in a variable.
std::string WiringWriter::addressOf (const double* v, const FusedValues::Place& place)
{
    if (place.kind == Kind::memory) return object (v, "double");
    return offset (place.name, place.sheet->offset + sizeof (double) * static_cast<std::size_t> (place.slot), "double");
}

/// Gives a value a name, and puts it in memory if something else reads it there.
void WiringWriter::keep (const double* at, const std::string& value)
{
    if (is_inner || values.isNeeded (at)) store ("double", value, object (at, "double"));
    values.name (at, value);
}

void WiringWriter::call (const Record& r)
{
    values.need (r);
    const auto first = values.numbers ({ reinterpret_cast<const void*> (r.step), r.self, r.sources, r.outputs });
    run ("tactus_fused_run", { "i8** %objects", "i64 " + first });
}

void WiringWriter::sum (const plan::Sum& s)
{
    Texts terms;
    for (const auto& term : s.terms)
    {
        const auto value = read (term.from);
        terms.push_back (term.gain == 1.0 ? value : result ("fmul double " + exactly (term.gain) + ", " + value));
    }
    const auto size = std::to_string (terms.size());
    if (terms.empty() || terms.size() > plan::most_in_network)
        return keep (&s.out, valueOf ("double", "tactus_fused_sum", { "double* " + array ("double", terms.size(), terms), "i32 " + size }));
    for (auto& term : terms)
        term = "double " + term;
    keep (&s.out, valueOf ("double", "tactus_fused_sum_" + size, terms));
}

void WiringWriter::strike (const plan::Strike& s)
{
    keep (&s.out, valueOf ("double", "tactus_fused_struck", { "double " + read (s.from), "double* " + object (&s.pulse->pending, "double") }));
}

void WiringWriter::readDelay (const plan::Line& wire)
{
    const std::vector<std::string> arguments { "double* " + object (wire.samples.data(), "double"), "i64* " + object (&wire.now, "i64"),
                                               "double* " + object (&wire.out, "double") };
    values.name (&wire.out, valueOf ("double", "tactus_fused_delayed", arguments));
}

void WiringWriter::writeDelay (const plan::Line& wire, const double* from)
{
    run ("tactus_fused_delay", { "double " + read (from), "double* " + object (wire.samples.data(), "double"), "i64* " + object (&wire.now, "i64"),
                                 "i64 " + std::to_string (wire.samples.size()) });
}

}   // namespace tactus::host
