// SPDX-License-Identifier: MIT
#include "wiring_writer.hpp"
#include "bitcode.hpp"

#include <host/generate/sources/code.hpp>

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

bool WiringWriter::has (const std::string& header) const { return ! findBitcode (header).empty(); }

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
}

void WiringWriter::endPart()
{
    // A function that is called once would be inlined, and all would be one large function again.
    functions += "define internal void @part" + std::to_string (parts) + " (i8** %objects) nounwind" + (isLarge() ? " noinline" : "") + "\n{\n"
                 + rooms + code + "  ret void\n}\n\n";
}

std::string WiringWriter::end (const std::vector<const Known*>&)
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

std::string WiringWriter::Array::entry (std::size_t i) const
{
    return writer.result ("getelementptr inbounds " + type + ", " + type + "* " + all + ", i64 0, i64 " + std::to_string (i));
}

std::string WiringWriter::bytes (std::size_t size) { return Array (*this, "i8", size).entry (0); }

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

std::string WiringWriter::called (const std::string& type, const std::string& function, const std::vector<std::string>& arguments)
{
    declare (type, function, arguments);
    return result ("call " + type + " @" + function + " (" + listed (arguments) + ")");
}

void WiringWriter::run (const std::string& function, const std::vector<std::string>& arguments, const std::string& how)
{
    declare ("void", function, arguments);
    line ("call void @" + function + " (" + listed (arguments) + ")" + how);
}

/// Calls a function of the bitcode of a node. It is inlined, however large it is, unless it would be repeated too often.
void WiringWriter::runNode (const Known& n, const std::string& function, const std::vector<std::string>& arguments)
{
    run (bitcodeName (function, n.header), arguments, isRare (n) ? " alwaysinline" : "");
}

void WiringWriter::declare (const std::string& type, const std::string& function, const std::vector<std::string>& arguments)
{
    std::vector<std::string> types;
    for (const auto& a : arguments)
        types.push_back (typeOf (a));
    declarations[function] = "declare " + type + " @" + function + " (" + listed (types) + ") nounwind\n";
}

void WiringWriter::branch (const std::string& condition, const std::string& yes, const std::string& no)
{
    line ("br i1 " + condition + ", label %" + yes + ", label %" + no);
}

std::string WiringWriter::read (const double* v)
{
    using Kind = FusedValues::Place::Kind;
    const auto place = values.find (v);
    switch (place.kind)
    {
    case Kind::variable:
        return place.name;
    case Kind::constant:
        return exactly (*v);
    case Kind::member:
        return load ("double", offset (place.name, place.sheet->offset + sizeof (double) * static_cast<std::size_t> (place.slot), "double"));
    case Kind::memory:
        break;
    }
    return load ("double", object (v, "double"));
}

std::string WiringWriter::pointerTo (const double* v)
{
    using Kind = FusedValues::Place::Kind;
    const auto place = values.find (v);
    switch (place.kind)
    {
    case Kind::constant:
        return "@c" + *constants.insert (exactly (*v)).first;
    case Kind::member:
        return offset (place.name, place.sheet->offset + sizeof (double) * static_cast<std::size_t> (place.slot), "double");
    case Kind::variable:
    {
        const auto copy = room ("double");
        store ("double", place.name, copy);
        return copy;
    }
    case Kind::memory:
        break;
    }
    return object (v, "double");
}

/// Gives a value a name, and puts it in memory if something else reads it there.
void WiringWriter::keep (const double* at, const std::string& value, bool is_inner)
{
    if (is_inner || values.isNeeded (at)) store ("double", value, object (at, "double"));
    values.name (at, value);
}

void WiringWriter::call (const Record& r)
{
    const auto first = values.numbers ({ reinterpret_cast<const void*> (r.step), r.self, r.sources, r.outputs });
    run ("tactus_fused_run", { "i8** %objects", "i64 " + first });
}

void WiringWriter::sum (const plan::Sum& s, bool is_inner)
{
    std::vector<std::string> terms;
    for (const auto& term : s.terms)
    {
        const auto value = read (term.from);
        terms.push_back ("double " + (term.gain == 1.0 ? value : result ("fmul double " + exactly (term.gain) + ", " + value)));
    }
    if (! terms.empty() && terms.size() <= plan::most_in_network)
        return keep (&s.out, called ("double", "tactus_fused_sum_" + std::to_string (terms.size()), terms), is_inner);
    const Array all (*this, "double", terms.size());
    for (std::size_t i = 0; i < terms.size(); ++i)
        line ("store " + terms[i] + ", double* " + all.entry (i));
    keep (&s.out, called ("double", "tactus_fused_sum", { "double* " + all.entry (0), "i32 " + std::to_string (terms.size()) }), is_inner);
}

void WiringWriter::strike (const plan::Strike& s, bool is_inner)
{
    keep (&s.out, called ("double", "tactus_fused_struck", { "double " + read (s.from), "double* " + object (&s.pulse->pending, "double") }), is_inner);
}

void WiringWriter::readDelay (const plan::Line& wire)
{
    const std::vector<std::string> arguments { "double* " + object (wire.samples.data(), "double"), "i64* " + object (&wire.now, "i64"),
                                               "double* " + object (&wire.out, "double") };
    values.name (&wire.out, called ("double", "tactus_fused_delayed", arguments));
}

void WiringWriter::writeDelay (const double* from, const plan::Line& wire)
{
    run ("tactus_fused_delay", { "double " + read (from), "double* " + object (wire.samples.data(), "double"), "i64* " + object (&wire.now, "i64"),
                                 "i64 " + std::to_string (wire.samples.size()) });
}

}   // namespace tactus::host
