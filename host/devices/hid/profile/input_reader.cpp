// SPDX-License-Identifier: MIT
#include "number_reader.hpp"
#include "report_reader.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{
namespace
{
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

    if (field.unwrap && field.bits.is_float) in.error ("unwrap", "profile/type", "a floating-point number does not wrap around", "leave \"unwrap\" out");
    if (field.is_hat && field.buttons.size() != 4) in.error ("hat", "profile/kind", "a hat has four buttons", "name up, right, down and left");
    if (field.buttons.size() > field.bits.size)
        in.error (field.is_hat ? "hat" : "buttons", "profile/beyond", "there are more buttons than bits", "use a larger type");
    for (const auto& button : field.buttons)
        if (! button.empty() && ! graph::isId (button))
            in.error (field.is_hat ? "hat" : "buttons", "profile/name", quote (button) + " is not a name",
                      "write lower case letters, digits and _, a letter first, or \"\" for a bit without a button");
    return field;
}

InputReport readInput (ProfileFields& in)
{
    InputReport report;
    in.ignore ("about");
    if (const auto id = in.id ("id", 255)) report.id = static_cast<std::uint8_t> (*id);
    in.require ("length", "write \"length\": the number of bytes of the report, including its id");
    report.length = static_cast<std::size_t> (in.whole ("length", 1, most_bytes, 1));
    report.longest = static_cast<std::size_t> (in.whole ("longest", static_cast<int> (report.length), most_bytes, static_cast<int> (report.length)));
    in.each ("fields",
             [&] (ProfileFields& f) {
                 report.fields.push_back (readInputField (f));
                 if (report.fields.back().bits.end() > 8 * report.length)
                     f.error ("at", "profile/beyond",
                              "the field ends at byte " + std::to_string ((report.fields.back().bits.end() + 7) / 8) + " of a report of "
                                  + std::to_string (report.length) + (report.length == 1 ? " byte" : " bytes"),
                              "make the report longer, or start the field earlier");
             });
    if (in.has ("timestamp")) report.timestamp = in.name ("timestamp");
    if (in.has ("sequence")) report.sequence = in.name ("sequence");
    readVerified (in, report.verified, report.why_not);

    std::vector<std::string> names;
    for (std::size_t i = 0; i < report.fields.size(); ++i)
    {
        const auto& name = report.fields[i].name;
        if (name.empty()) continue;
        if (std::ranges::find (names, name) != names.end()) in.error ("fields", "profile/duplicate", "there are two fields " + quote (name), "rename one");
        names.push_back (name);
    }

    const auto named = [&] (std::string_view key, const std::string& name) -> InputField* {
        const auto it = std::ranges::find (report.fields, name, &InputField::name);
        if (it != report.fields.end() && it->isAxis() && ! it->bits.is_float) return &*it;
        if (! name.empty())
            in.error (key, "profile/unknown_name", "this report has no whole-number field " + quote (name), suggestion (name, names));
        return nullptr;
    };
    if (! report.sequence.empty()) named ("sequence", report.sequence);
    if (auto* time = report.timestamp.empty() ? nullptr : named ("timestamp", report.timestamp))
    {
        time->unwrap = true;
        if (time->unit != "s")
            in.error ("timestamp", "profile/unit", "a time stamp must be in s; this one is in " + time->unit, "give the field a scale such as \"1 us\"");
    }
    return report;
}
}   // namespace

std::vector<InputReport> readInputs (ProfileFields& profile)
{
    std::vector<InputReport> reports;
    profile.each ("inputs", [&] (ProfileFields& in) {
        reports.push_back (readInput (in));
        const auto& id = reports.back().id;
        for (std::size_t i = 0; i + 1 < reports.size(); ++i)
            if (! id || ! reports[i].id || *id == *reports[i].id)
                return in.error ("id", "profile/duplicate", "this report cannot be distinguished from another", "give each input report its own id");
    });
    return reports;
}

}   // namespace tactus::host::hid
