// SPDX-License-Identifier: MIT
#include "node_settings.hpp"
#include <tactus/plan/flat/directory.hpp>
#include <tactus/plan/settings.hpp>

#include <tactus/text/closest_match.hpp>

#include <algorithm>

namespace tactus::plan
{

namespace
{
constexpr double bytes_per_value = 100.0;

/// The number of values in JSON; long texts count as several.
double sizeOf (const Json& json)
{
    constexpr double text_of_a_value = 10.0;   // bytes of a text that count as one value, because a text may be a formula to parse
    double size = 1.0;
    if (json.is_object())
        for (const auto& [key, value] : json.asObject())
            size += sizeOf (value);
    else if (json.is_array())
        for (const auto& value : json.asArray())
            size += sizeOf (value);
    else if (json.is_string())
        size += static_cast<double> (json.asString().size()) / text_of_a_value;
    return size;
}

bool namesFile (const Json& json, const SettingSheet& sheet)
{
    using Kind = SettingSheet::Kind;
    const auto inRecord = [&] (const Json& record) {
        return record.is_object() && std::ranges::any_of (sheet.fields, [&] (const SettingSheet& f) {
                   const auto field = record.find (f.id);
                   return field != record.end() && namesFile (*field, f);
               });
    };
    switch (sheet.kind)
    {
    case Kind::signal:
    case Kind::image:
    case Kind::table:
        return json.is_string();
    case Kind::surface:
        return json.is_object() && json.contains ("mesh");
    case Kind::record:
        return inRecord (json);
    case Kind::records:
        return json.is_array() && std::ranges::any_of (json, inRecord);
    default:
        return false;
    }
}
}   // namespace

void readSettings (const graph::Node& node, Origin here, Assets* assets, const std::string& folder, FlatNode& made, Flat& flat)
{
    for (const auto& sheet : made.type->settings)
        made.settings.push_back (sheet.initial);

    for (const auto& [key, value] : node.settings.items())
    {
        const auto sheet = std::ranges::find (made.type->settings, key, &SettingSheet::id);
        if (sheet == made.type->settings.end())
        {
            std::vector<std::string> ids;
            for (const auto& s : made.type->settings)
                ids.emplace_back (s.id);
            const bool is_param = std::ranges::count (made.type->params, key, &PortSheet::id) > 0;
            flat.error ("node/unknown_setting", flat.at (here, "settings", key),
                        "'" + made.path + "' (" + node.type + ") has no setting '" + key + "'" + didYouMean (key, ids),
                        is_param ? "it is a parameter: move it to params" : "its settings: " + listed (ids));
            continue;
        }
        if (! flat.reads_files && namesFile (value, *sheet))
        {
            made.is_whole = false;
            continue;
        }
        const double size = sizeOf (value);
        if (! flat.spend (work_per_value * size, bytes_per_value * size, flat.at (here, "settings", key))) continue;
        std::string within;
        if (auto read = readSetting (value, *sheet, { assets, folder }, within))
            made.settings[at (sheet - made.type->settings.begin())] = *std::move (read);
        else
        {
            made.is_whole = false;
            flat.error ("setting/value", flat.asIs (flat.at (here, "settings", key), within),
                        "setting '" + key + "' of '" + made.path + "': " + read.error().text,
                        "`tactus nodes " + node.type + "` lists the settings and their ranges");
        }
    }

    for (std::size_t i = 0; i < made.type->settings.size(); ++i)
        if (made.type->settings[i].id == "inputs")
            made.list_size = static_cast<int> (std::get<double> (made.settings[i]));
}

}   // namespace tactus::plan
