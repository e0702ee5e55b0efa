// SPDX-License-Identifier: MIT
#include "number_reader.hpp"
#include "report_reader.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

namespace tactus::host::hid
{
namespace
{
Encoding readEncoding (ProfileFields& in, const Tables& tables, std::string& unit)
{
    Encoding e;
    e.scale = readScale (in, unit);
    e.offset = readOffset (in, unit);

    if (in.has ("log2") && in.has ("table")) in.error ("table", "profile/kind", "a field can have only one law", "use either log2 or table");
    in.within ("log2", [&] (ProfileFields& law) {
        e.law = Encoding::Law::log2;
        e.steps = law.number ("steps", unit::count, {}, 1.0);
        e.reference = law.number ("reference", unit::count, Bounds::positive(), 1.0);
        if (e.steps == 0.0) law.error ("steps", "profile/out_of_range", "steps is 0", "give the number of steps per octave");
    });
    if (in.has ("table"))
    {
        const auto name = in.name ("table");
        if (const auto it = tables.find (name); it != tables.end())
        {
            e.law = Encoding::Law::table;
            std::tie (e.x, e.y) = it->second;
        }
        else if (! name.empty())
            in.error ("table", "profile/unknown_name", "there is no table " + quote (name), "add it under \"tables\"");
    }
    return e;
}

OutputField readOutputField (ProfileFields& in, const Tables& tables)
{
    OutputField field;
    in.ignore ("about");
    field.bits = readBits (in);

    const auto source = in.has ("source") ? in.text ("source") : std::string ("effort");
    if (source == "enable")
        field.source = OutputField::Source::enable;
    else if (source == "echo")
        field.source = OutputField::Source::echo;
    else if (source != "effort")
        in.error ("source", "profile/kind", quote (source) + " is not a source", "write effort, enable or echo");

    if (field.source != OutputField::Source::enable) field.name = in.name ("name");
    if (field.source == OutputField::Source::effort)
    {
        field.encoding = readEncoding (in, tables, field.unit);
        field.min = in.number ("min", unit::count, {}, field.min);
        field.max = in.number ("max", unit::count, {}, field.max);
        if (field.min > field.max) in.error ("min", "profile/out_of_range", "min is above max", "swap them");
    }
    return field;
}

Stream readStream (ProfileFields& in)
{
    Stream s;
    for (const auto key : { "at", "frames", "channels", "rate" })
        in.require (key, "write \"at\", \"frames\" in each report, \"channels\" by name, and \"rate\" in Hz");
    s.at = static_cast<std::size_t> (in.whole ("at", 0, most_bytes - 1, 0));
    s.frames = static_cast<std::size_t> (in.whole ("frames", 1, most_bytes, 1));
    s.rate = in.number ("rate", unit::hertz, Bounds::positive(), 1.0);
    s.channels = in.texts ("channels");
    if (s.channels.empty() || s.channels.size() > most_channels)
        in.error ("channels", "profile/too_many", "there are " + std::to_string (s.channels.size()) + " channels",
                  "name 1 to " + std::to_string (most_channels) + " channels");
    for (const auto& channel : s.channels)
        if (! graph::isId (channel))
            in.error ("channels", "profile/name", quote (channel) + " is not a name", "write lower case letters, digits and _, a letter first");

    const auto type = in.has ("type") ? in.text ("type") : std::string ("s8");
    s.is_signed = type != "u8";
    s.bits = type == "s16le" ? 16 : 8;
    if (type != "u8" && type != "s8" && type != "s16le") in.error ("type", "profile/type", quote (type) + " is not a sample type", "write s8, u8 or s16le");
    return s;
}

/// Keeps track of which bits of an output report are in use, and reports an error if two items use the same bit.
class BitMap
{
public:
    BitMap (ProfileFields& r, std::size_t bytes) : report (r), taken (8 * bytes) {}

    void take (std::size_t at, std::size_t size, const std::string& by)
    {
        if (at + size > taken.size())
        {
            report.error ("fields", "profile/beyond",
                          by + " ends at byte " + std::to_string ((at + size + 7) / 8) + " of a report of " + std::to_string (taken.size() / 8)
                              + (taken.size() == 8 ? " byte" : " bytes"),
                          "make the report longer, or start the field earlier");
            return;
        }
        const auto from = taken.begin() + static_cast<std::ptrdiff_t> (at), to = from + static_cast<std::ptrdiff_t> (size);
        if (std::any_of (from, to, std::identity()))
            report.error ("fields", "profile/overlap", by + " overlaps another field", "move one of them");
        std::fill (from, to, true);
    }

private:
    ProfileFields& report;
    std::vector<bool> taken;
};

SequenceNibble readSequence (ProfileFields& s, BitMap& used)
{
    SequenceNibble n;
    s.require ("byte", "write \"byte\": the index of the byte that contains the sequence number");
    n.byte = static_cast<std::size_t> (s.whole ("byte", 0, most_bytes - 1, 0));
    n.shift = s.whole ("shift", 0, 7, 0);
    n.modulo = s.whole ("modulo", 2, 256, 16);
    std::size_t bits = 1;
    while (1 << bits < n.modulo)
        ++bits;
    if (1 << bits != n.modulo) s.error ("modulo", "profile/out_of_range", "modulo is not a power of two", "write 2, 4, 8, 16 … 256");
    if (static_cast<std::size_t> (n.shift) + bits > 8) s.error ("shift", "profile/beyond", "the counter goes beyond its byte", "use a smaller shift or modulo");
    used.take (8 * n.byte + static_cast<std::size_t> (n.shift), bits, "the sequence number");
    return n;
}

OutputReport readOutput (ProfileFields& in, const Tables& tables)
{
    OutputReport report;
    in.ignore ("about");
    report.name = in.name ("name");
    if (const auto id = in.id ("id", 255)) report.id = static_cast<std::uint8_t> (*id);

    const auto kind = in.has ("kind") ? in.text ("kind") : std::string ("output");
    report.is_feature = kind == "feature";
    if (kind != "output" && kind != "feature") in.error ("kind", "profile/kind", quote (kind) + " is not a kind of report", "write output or feature");

    if (! in.has ("neutral"))
        in.error ("neutral", "profile/no_neutral", "there is no report that makes the device do nothing", "write \"neutral\": the bytes of the whole report");
    report.neutral = in.has ("neutral") ? in.hex ("neutral") : Bytes {};
    report.body = in.has ("body") ? in.hex ("body") : report.neutral;
    if (report.body.size() != report.neutral.size())
        in.error ("body", "profile/beyond",
                  "body has " + std::to_string (report.body.size()) + " bytes, but neutral has " + std::to_string (report.neutral.size()),
                  "give both the same length");
    if (report.id && ! report.neutral.empty() && (report.neutral.front() != *report.id || report.body.empty() || report.body.front() != *report.id))
        in.error ("neutral", "profile/format", "the report does not begin with its id", "make the id the first byte of \"neutral\" and \"body\"");

    const auto bytes = std::min (report.body.size(), report.neutral.size());
    BitMap used (in, bytes);
    if (report.id) used.take (0, std::min<std::size_t> (8, 8 * bytes), "the id");
    in.each ("fields", [&] (ProfileFields& f) {
        report.fields.push_back (readOutputField (f, tables));
        const auto& field = report.fields.back();
        used.take (field.bits.at, field.bits.size, field.name.empty() ? "a field" : quote (field.name));
    });
    in.each ("sequences", [&] (ProfileFields& s) { report.sequences.push_back (readSequence (s, used)); });
    in.within ("stream",
               [&] (ProfileFields& s) {
                   report.stream = readStream (s);
                   used.take (8 * report.stream->at, report.stream->frames * report.stream->channels.size() * static_cast<std::size_t> (report.stream->bits),
                              "the stream");
               });
    in.within ("crc32",
               [&] (ProfileFields& c) {
                   report.checksum = Checksum { .prefix = c.has ("prefix") ? c.hex ("prefix") : Bytes {},
                                                .at = static_cast<std::size_t> (c.whole ("at", 0, most_bytes - 1, 0)) };
                   c.require ("at", "write \"at\": the index of the checksum's first byte");
                   used.take (8 * report.checksum->at, 32, "the checksum");
               });

    report.max_rate = in.number ("max_rate", unit::hertz, Bounds::positive(), report.max_rate);
    report.keepalive = in.number ("keepalive", unit::second, Bounds::notNegative(), 0.0);
    readVerified (in, report.verified, report.why_not);
    return report;
}
}   // namespace

Tables readTables (ProfileFields& profile)
{
    Tables tables;
    profile.within ("tables", [&] (ProfileFields& all) {
        const Json& json = all.json();
        if (! json.is_object()) return;
        for (const auto& [name, value] : json.items())
            all.within (name, [&, n = name] (ProfileFields& table) {
                const auto x = table.numbers ("x"), y = table.numbers ("y");
                const bool rising = std::ranges::adjacent_find (x, std::greater_equal()) == x.end();
                if (x.empty() || x.size() != y.size() || ! rising)
                    table.error ("x", "profile/kind", "a table needs as many x values as y values, and x must rise", "write {\"x\": [0, 1], \"y\": [0, 100]}");
                else
                    tables[n] = { x, y };
            });
    });
    return tables;
}

std::vector<OutputReport> readOutputs (ProfileFields& profile, const Tables& tables)
{
    std::vector<OutputReport> reports;
    profile.each ("outputs", [&] (ProfileFields& in) {
        reports.push_back (readOutput (in, tables));
        for (std::size_t i = 0; i + 1 < reports.size(); ++i)
            if (reports[i].name == reports.back().name)
                in.error ("name", "profile/duplicate", "there are two output reports with this name", "rename one");
    });
    return reports;
}

}   // namespace tactus::host::hid
