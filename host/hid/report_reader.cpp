// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid/report_reader.hpp>

#include <framework/graph/text.hpp>
#include <framework/in_quotes.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

namespace tactus::host::hid
{
namespace
{
constexpr double largest_scale = 1e15;   // SI; whatever a counter counts stays finite
constexpr int most_bytes = static_cast<int> (longest_report);

/// "u8", "s16le", "u32be", "f32le", and "u3" … "s31" for as many bits from the lowest on.
bool readType (std::string_view type, Bits& bits)
{
    if (type.empty()) return false;
    bits.is_float = type.front() == 'f';
    bits.is_signed = type.front() == 's';
    if (! bits.is_float && ! bits.is_signed && type.front() != 'u') return false;

    const char* const end = type.data() + type.size();
    const auto [stop, failed] = std::from_chars (type.data() + 1, end, bits.size);
    const std::string_view order (stop, static_cast<std::size_t> (end - stop));
    bits.big_endian = order == "be";
    const bool whole = bits.size == 8 || bits.size == 16 || bits.size == 24 || bits.size == 32;
    return failed == std::errc() && bits.size >= 1 && bits.size <= 32
           && (order.empty() || ((order == "le" || bits.big_endian) && whole))
           && (! bits.is_float || (bits.size == 32 && ! order.empty()));
}

Bits readBits (ProfileFields& in)
{
    Bits bits;
    in.require ("at", "write \"at\": the byte it begins in");
    in.require ("type", "write \"type\": \"s16le\"");
    const auto byte = in.whole ("at", 0, most_bytes - 1, 0);
    const auto bit = in.whole ("bit", 0, 7, 0);
    const auto type = in.text ("type");
    if (! type.empty() && ! readType (type, bits))
    {
        in.error ("type", "profile/type", inQuotes (type) + " is not a type", "write u8, s8, u16le, s16be, u32le, f32le …, or u1 … u32 and s1 … s32 for bits");
        bits = {};
    }
    bits.at = static_cast<std::size_t> (8 * byte + bit);
    if (bits.big_endian && bit != 0) in.error ("bit", "profile/type", "a big-endian number begins with a byte", "leave \"bit\" out");
    return bits;
}

/// The unit of a scale, or the one that is written where the scale is a bare number.
std::string readUnit (ProfileFields& in, const std::string& of_scale)
{
    const auto written = in.has ("unit") ? in.text ("unit") : std::string();
    if (! of_scale.empty() && ! written.empty())
        in.error ("unit", "profile/unit", "the unit is said twice", "leave \"unit\" out: it is " + of_scale);
    if (! of_scale.empty()) return of_scale;
    return written.empty() ? "1" : written;
}

double readOffset (ProfileFields& in, const std::string& unit)
{
    const auto offset = in.scale ("offset", 0.0);
    if (! (std::abs (offset.value) <= largest_scale)) in.error ("offset", "profile/out_of_range", "the offset is too large", "write what a count of 0 means, in SI");
    if (! offset.unit.empty() && offset.unit != unit)
        in.error ("offset", "profile/unit", "the offset is in " + offset.unit + ", the scale in " + unit, "write both in one unit");
    return offset.value;
}

double readScale (ProfileFields& in, std::string& unit)
{
    const auto scale = in.scale ("scale", 1.0);
    if (! (std::abs (scale.value) >= 1.0 / largest_scale && std::abs (scale.value) <= largest_scale))
        in.error ("scale", "profile/out_of_range", "no count is as much as that", "write what one count is, in SI");
    unit = readUnit (in, scale.unit);
    return scale.value;
}

InputField readInputField (ProfileFields& in)
{
    InputField field;
    in.ignore ("about");
    field.bits = readBits (in);
    field.buttons = in.texts ("buttons");
    field.is_hat = in.has ("hat");
    if (field.is_hat) field.buttons = in.texts ("hat");
    if (! field.buttons.empty() && ! in.has ("name"))
        field.name.clear();
    else
        field.name = in.name ("name");
    if (in.has ("expect")) field.expect = in.id ("expect", 0x7fffffff);

    field.unwrap = in.flag ("unwrap");
    field.scale = readScale (in, field.unit);
    field.offset = readOffset (in, field.unit);

    if (field.unwrap && field.bits.is_float) in.error ("unwrap", "profile/type", "a floating-point number does not begin again", "leave \"unwrap\" out");
    if (field.is_hat && field.buttons.size() != 4) in.error ("hat", "profile/kind", "a hat has four buttons", "name up, right, down and left");
    if (field.buttons.size() > field.bits.size) in.error (field.is_hat ? "hat" : "buttons", "profile/beyond", "there are more buttons than bits", "take a larger type");
    for (const auto& button : field.buttons)
        if (! button.empty() && ! graph::isId (button))
            in.error (field.is_hat ? "hat" : "buttons", "profile/name", inQuotes (button) + " is not a name", "write lower case letters, digits and _, a letter first, or \"\" for a bit without a button");
    return field;
}

/// A report says whether it was seen, and if not, why it is believed.
void readVerified (ProfileFields& in, bool& verified, std::string& why_not)
{
    in.require ("verified", "write \"verified\": true if a report of a real device was decoded with it, else false");
    verified = in.flag ("verified");
    why_not = in.has ("why_not") ? in.text ("why_not") : std::string();
    if (! verified && why_not.empty()) in.error ("why_not", "profile/missing", "a report that is not verified has to say why", "write \"why_not\": \"…\"");
}

InputReport readInput (ProfileFields& in)
{
    InputReport report;
    in.ignore ("about");
    if (const auto id = in.id ("id", 255)) report.id = static_cast<std::uint8_t> (*id);
    in.require ("length", "write \"length\": the bytes of the report, its id included");
    report.length = static_cast<std::size_t> (in.whole ("length", 1, most_bytes, 1));
    report.longest = static_cast<std::size_t> (in.whole ("longest", static_cast<int> (report.length), most_bytes, static_cast<int> (report.length)));
    in.each ("fields", [&] (ProfileFields& f)
             {
        report.fields.push_back (readInputField (f));
        if (report.fields.back().bits.end() > 8 * report.length)
            f.error ("at", "profile/beyond", "the field ends at byte " + std::to_string ((report.fields.back().bits.end() + 7) / 8) + " of a report of " + std::to_string (report.length), "make the report longer, or begin earlier"); });
    if (in.has ("timestamp")) report.timestamp = in.name ("timestamp");
    if (in.has ("sequence")) report.sequence = in.name ("sequence");
    readVerified (in, report.verified, report.why_not);

    std::vector<std::string> names;
    for (std::size_t i = 0; i < report.fields.size(); ++i)
    {
        const auto& name = report.fields[i].name;
        if (name.empty()) continue;
        if (std::ranges::find (names, name) != names.end()) in.error ("fields", "profile/duplicate", "there are two fields " + inQuotes (name), "name one otherwise");
        names.push_back (name);
    }

    const auto named = [&] (std::string_view key, const std::string& name) -> InputField*
    {
        const auto it = std::ranges::find (report.fields, name, &InputField::name);
        if (it != report.fields.end() && it->isAxis() && ! it->bits.is_float) return &*it;
        if (! name.empty()) in.error (key, "profile/unknown_name", "there is no whole number called " + inQuotes (name) + " in this report", suggestion (name, names));
        return nullptr;
    };
    if (! report.sequence.empty()) named ("sequence", report.sequence);
    if (auto* time = report.timestamp.empty() ? nullptr : named ("timestamp", report.timestamp))
    {
        time->unwrap = true;
        if (time->unit != "s") in.error ("timestamp", "profile/unit", "a time stamp is in s, this is in " + time->unit, "give the field a scale such as \"1 us\"");
    }
    return report;
}

Encoding readEncoding (ProfileFields& in, const Tables& tables, std::string& unit)
{
    Encoding e;
    e.scale = readScale (in, unit);
    e.offset = readOffset (in, unit);

    if (in.has ("log2") && in.has ("table")) in.error ("table", "profile/kind", "a field has one law", "leave log2 or table out");
    in.within ("log2", [&] (ProfileFields& law)
               {
        e.law = Encoding::Law::log2;
        e.steps = law.number ("steps", unit::count, {}, 1.0);
        e.reference = law.number ("reference", unit::count, Bounds::positive(), 1.0);
        if (e.steps == 0.0) law.error ("steps", "profile/out_of_range", "steps is 0", "write how many numbers an octave has"); });
    if (in.has ("table"))
    {
        const auto name = in.name ("table");
        if (const auto it = tables.find (name); it != tables.end())
        {
            e.law = Encoding::Law::table;
            std::tie (e.x, e.y) = it->second;
        }
        else if (! name.empty())
            in.error ("table", "profile/unknown_name", "there is no table " + inQuotes (name), "add it under \"tables\"");
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
        in.error ("source", "profile/kind", inQuotes (source) + " is not a source", "write effort, enable or echo");

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
    if (s.channels.empty() || s.channels.size() > most_channels) in.error ("channels", "profile/too_many", "there are " + std::to_string (s.channels.size()) + " channels", "name 1 to " + std::to_string (most_channels));
    for (const auto& channel : s.channels)
        if (! graph::isId (channel)) in.error ("channels", "profile/name", inQuotes (channel) + " is not a name", "write lower case letters, digits and _, a letter first");

    const auto type = in.has ("type") ? in.text ("type") : std::string ("s8");
    s.is_signed = type != "u8";
    s.bits = type == "s16le" ? 16 : 8;
    if (type != "u8" && type != "s8" && type != "s16le") in.error ("type", "profile/type", inQuotes (type) + " is not a type of samples", "write s8, u8 or s16le");
    return s;
}

/// Marks bits of an output report as written by one thing, and complains where another writes them, too.
class Plan
{
public:
    Plan (ProfileFields& r, std::size_t bytes) : report (r), taken (8 * bytes) {}

    void take (std::size_t at, std::size_t size, const std::string& by)
    {
        if (at + size > taken.size())
        {
            report.error ("fields", "profile/beyond", by + " ends at byte " + std::to_string ((at + size + 7) / 8) + " of a report of " + std::to_string (taken.size() / 8), "make the report longer, or begin earlier");
            return;
        }
        const auto from = taken.begin() + static_cast<std::ptrdiff_t> (at), to = from + static_cast<std::ptrdiff_t> (size);
        if (std::any_of (from, to, std::identity()))
            report.error ("fields", "profile/overlap", by + " lies over something else", "move one of them");
        std::fill (from, to, true);
    }

private:
    ProfileFields& report;
    std::vector<bool> taken;
};

OutputReport readOutput (ProfileFields& in, const Tables& tables)
{
    OutputReport report;
    in.ignore ("about");
    report.name = in.name ("name");
    if (const auto id = in.id ("id", 255)) report.id = static_cast<std::uint8_t> (*id);

    const auto kind = in.has ("kind") ? in.text ("kind") : std::string ("output");
    report.is_feature = kind == "feature";
    if (kind != "output" && kind != "feature") in.error ("kind", "profile/kind", inQuotes (kind) + " is not a kind of report", "write output or feature");

    if (! in.has ("neutral")) in.error ("neutral", "profile/no_neutral", "there is no report that makes the device do nothing", "write \"neutral\": the bytes of the whole report");
    report.neutral = in.has ("neutral") ? in.hex ("neutral") : Bytes {};
    report.body = in.has ("body") ? in.hex ("body") : report.neutral;
    if (report.body.size() != report.neutral.size())
        in.error ("body", "profile/beyond", "body has " + std::to_string (report.body.size()) + " bytes, neutral " + std::to_string (report.neutral.size()), "write reports of one length");
    if (report.id && ! report.neutral.empty() && (report.neutral.front() != *report.id || report.body.empty() || report.body.front() != *report.id))
        in.error ("neutral", "profile/format", "the report does not begin with its id", "the first byte is the id");

    const auto bytes = std::min (report.body.size(), report.neutral.size());
    Plan plan (in, bytes);
    if (report.id) plan.take (0, std::min<std::size_t> (8, 8 * bytes), "the id");
    in.each ("fields", [&] (ProfileFields& f)
             {
        report.fields.push_back (readOutputField (f, tables));
        const auto& field = report.fields.back();
        plan.take (field.bits.at, field.bits.size, field.name.empty() ? "a field" : inQuotes (field.name)); });
    in.each ("sequences", [&] (ProfileFields& s)
             {
        SequenceNibble n;
        s.require ("byte", "write \"byte\": the byte it stands in");
        n.byte = static_cast<std::size_t> (s.whole ("byte", 0, most_bytes - 1, 0));
        n.shift = s.whole ("shift", 0, 7, 0);
        n.modulo = s.whole ("modulo", 2, 256, 16);
        std::size_t bits = 1;
        while (1 << bits < n.modulo)
            ++bits;
        if (1 << bits != n.modulo) s.error ("modulo", "profile/out_of_range", "modulo is not a power of two", "write 2, 4, 8, 16 … 256");
        if (static_cast<std::size_t> (n.shift) + bits > 8) s.error ("shift", "profile/beyond", "the counter goes beyond its byte", "take a smaller shift or modulo");
        plan.take (8 * n.byte + static_cast<std::size_t> (n.shift), bits, "the sequence number");
        report.sequences.push_back (n); });
    in.within ("stream", [&] (ProfileFields& s)
               {
        report.stream = readStream (s);
        plan.take (8 * report.stream->at, report.stream->frames * report.stream->channels.size() * static_cast<std::size_t> (report.stream->bits), "the stream"); });
    in.within ("crc32", [&] (ProfileFields& c)
               {
        report.checksum = Checksum { .prefix = c.has ("prefix") ? c.hex ("prefix") : Bytes {}, .at = static_cast<std::size_t> (c.whole ("at", 0, most_bytes - 1, 0)) };
        c.require ("at", "write \"at\": the byte it begins in");
        plan.take (8 * report.checksum->at, 32, "the checksum"); });

    report.max_rate = in.number ("max_rate", unit::hertz, Bounds::positive(), report.max_rate);
    report.keepalive = in.number ("keepalive", unit::second, Bounds::notNegative(), 0.0);
    readVerified (in, report.verified, report.why_not);
    return report;
}
}   // namespace

Tables readTables (ProfileFields& profile)
{
    Tables tables;
    profile.within ("tables", [&] (ProfileFields& all)
                    {
        const Json& json = all.json();
        if (! json.is_object()) return;
        for (const auto& [name, value] : json.items())
            all.within (name, [&, n = name] (ProfileFields& table)
                        {
                const auto x = table.numbers ("x"), y = table.numbers ("y");
                const bool rising = std::ranges::adjacent_find (x, std::greater_equal()) == x.end();
                if (x.empty() || x.size() != y.size() || ! rising)
                    table.error ("x", "profile/kind", "a table has as many x as y, and its x rise", "write {\"x\": [0, 1], \"y\": [0, 100]}");
                else
                    tables[n] = { x, y }; }); });
    return tables;
}

std::vector<InputReport> readInputs (ProfileFields& profile)
{
    std::vector<InputReport> reports;
    profile.each ("inputs", [&] (ProfileFields& in)
                  {
        reports.push_back (readInput (in));
        const auto& id = reports.back().id;
        for (std::size_t i = 0; i + 1 < reports.size(); ++i)
            if (! id || ! reports[i].id || *id == *reports[i].id)
                return in.error ("id", "profile/duplicate", "this report cannot be told from another", "a device with several input reports gives each an id of its own"); });
    return reports;
}

std::vector<OutputReport> readOutputs (ProfileFields& profile, const Tables& tables)
{
    std::vector<OutputReport> reports;
    profile.each ("outputs", [&] (ProfileFields& in)
                  {
        reports.push_back (readOutput (in, tables));
        for (std::size_t i = 0; i + 1 < reports.size(); ++i)
            if (reports[i].name == reports.back().name)
                in.error ("name", "profile/duplicate", "there are two output reports of this name", "name one otherwise"); });
    return reports;
}

}   // namespace tactus::host::hid
