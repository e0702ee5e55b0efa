// SPDX-License-Identifier: MIT
#include "settings.hpp"
#include <tactus/plan/settings/files.hpp>
#include <tactus/plan/settings/surface_setting.hpp>

namespace tactus::plan
{

namespace
{
SettingValue valueFrom (const Json&, const SettingSheet&, const Files&, const std::string& key);

/// A missing field keeps its default.
Values recordFrom (const Json& json, const SettingSheet& sheet, const Files& files, const std::string& what, const std::string& key)
{
    std::vector<std::string> ids;
    for (const auto& f : sheet.fields)
        ids.emplace_back (f.id);
    objectFrom (json, ids, what, key);

    Values values;
    for (const auto& f : sheet.fields)
    {
        const auto found = json.find (f.id);
        values.push_back (found == json.end() ? f.initial : valueFrom (*found, f, files, under (key, f.id)));
    }
    return values;
}

Records recordsFrom (const Json& json, const SettingSheet& sheet, const Files& files, const std::string& key)
{
    listFrom (json, 0, "a list of records", key);
    Records rows;
    for (std::size_t i = 0; i < json.size(); ++i)
        rows.push_back (recordFrom (json[i], sheet, files, "record " + std::to_string (i), under (key, i)));
    return rows;
}

std::vector<double> numbersFrom (const Json& json, const SettingSheet& sheet, const std::string& key)
{
    listFrom (json, 0, "a list of numbers", key);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < json.size(); ++i)
        numbers.push_back (inRange (numberFrom (json[i], sheet.unit, under (key, i)), sheet.limits.hard, under (key, i)));
    return numbers;
}

SettingValue valueFrom (const Json& json, const SettingSheet& sheet, const Files& files, const std::string& key)
{
    using Kind = SettingSheet::Kind;
    switch (sheet.kind)
    {
    case Kind::number:
        return inRange (numberFrom (json, sheet.unit, key), sheet.limits.hard, key);
    case Kind::integer:
        inRange (numberFrom (json, sheet.unit, key), sheet.limits.hard, key);
        return wholeNumberFrom (json, sheet.unit, key);
    case Kind::text:
        if (! json.is_string()) throw Problem { "it must be a string", key };
        return json.get<std::string>();
    case Kind::vector:
        return vectorFrom (json, sheet.unit, key);
    case Kind::numbers:
        return numbersFrom (json, sheet, key);
    case Kind::curve:
        return curveFrom (json, sheet.x_unit, sheet.unit, key);
    case Kind::law:
        return lawFrom (json, sheet.x_unit, sheet.unit, key);
    case Kind::record:
        return recordFrom (json, sheet, files, "it", key);
    case Kind::records:
        return recordsFrom (json, sheet, files, key);
    case Kind::signal:
        return load (&Assets::signal, json, files, key);
    case Kind::image:
        return Image { load (&Assets::image, json, files, key) };
    case Kind::table:
        return Sheet { load (&Assets::table, json, files, key) };
    case Kind::surface:
        break;
    }
    return surfaceFrom (json, files, key);
}
}   // namespace

Result<SettingValue> readSetting (const Json& json, const SettingSheet& sheet, const Files& files, std::string& where)
{
    try
    {
        return valueFrom (json, sheet, files, "");
    }
    catch (const Problem& p)
    {
        where += p.key;
        return Message::error ("setting/value", {}, p.what);
    }
}

}   // namespace tactus::plan
