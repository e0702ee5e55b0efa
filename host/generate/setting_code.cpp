// SPDX-License-Identifier: GPL-3.0-or-later
#include "setting_code.hpp"

#include <tactus/kit/at.hpp>

namespace tactus::host
{

namespace
{
using SettingKind = SettingSheet::Kind;

std::string braced (const std::vector<std::string>& parts) { return parts.empty() ? "{}" : "{ " + listed (parts) + " }"; }

std::string kindOf (const Law& law)
{
    constexpr const char* names[] { "none", "power", "exponential", "table", "dissipation" };
    return std::string ("tactus::Law::Kind::") + names[static_cast<int> (law.kind)];
}
}   // namespace

std::string SettingCode::of (const SettingSheet& sheet, const SettingValue& value, const std::string& name)
{
    switch (sheet.kind)
    {
    case SettingKind::number:
        return literal (std::get<double> (value));
    case SettingKind::integer:
        return std::to_string (static_cast<long long> (std::get<double> (value)));
    case SettingKind::text:
        return textLiteral (std::get<std::string> (value));
    case SettingKind::vector:
    {
        const auto& v = std::get<Vec3> (value);
        return "tactus::Vec3 { " + listed ({ literal (v.x()), literal (v.y()), literal (v.z()) }) + " }";
    }
    case SettingKind::numbers:
        return numbers (std::get<std::vector<double>> (value), name);
    case SettingKind::curve:
        return curve (std::get<Curve> (value), name);
    case SettingKind::law:
        return law (std::get<Law> (value), name);
    case SettingKind::record:
        return record (sheet, std::get<Values> (value), name);
    case SettingKind::records:
        return records (sheet, std::get<Records> (value), name);
    case SettingKind::signal:
        return signal (std::get<std::shared_ptr<const Signal>> (value).get(), name);
    case SettingKind::image:
        return "{ " + grid (std::get<Image> (value).grid.get(), name) + " }";
    case SettingKind::table:
        return "{ " + grid (std::get<Sheet> (value).grid.get(), name) + " }";
    case SettingKind::surface:
        return surface (std::get<std::shared_ptr<const Surface>> (value).get(), name);
    }
    return {};
}

/// Defines a constant array and returns its name. The lines hold as many values as fit.
std::string SettingCode::array (const std::string& type, const std::string& name, const std::vector<std::string>& values)
{
    constexpr std::size_t most_columns = 120;
    const auto own = names.make (name);
    arrays += "inline constexpr " + type + " " + own + "[] {";
    std::string line;
    for (const auto& value : values)
    {
        if (! line.empty() && line.size() + value.size() > most_columns)
        {
            arrays += "\n   " + line;
            line.clear();
        }
        line += " " + value + ",";
    }
    arrays += "\n   " + line + "\n};\n\n";
    return space + "::" + own;
}

std::string SettingCode::numberArray (std::span<const double> numbers, const std::string& name)
{
    std::vector<std::string> all;
    for (const double v : numbers)
        all.push_back (literal (v));
    return array ("double", name, all);
}

std::string SettingCode::numbers (std::span<const double> all, const std::string& name)
{
    constexpr std::size_t most_in_place = 12;
    if (all.size() > most_in_place) return "tactus::exported::listOf (" + numberArray (all, name) + ")";
    std::vector<std::string> parts;
    for (const double v : all)
        parts.push_back (literal (v));
    return braced (parts);
}

std::string SettingCode::curve (const Curve& c, const std::string& name)
{
    if (c.empty()) return "tactus::Curve {}";
    return "tactus::Curve { .x = " + numbers (c.x, name + "_x") + ", .y = " + numbers (c.y, name + "_y") + " }";
}

std::string SettingCode::law (const Law& l, const std::string& name)
{
    return "tactus::Law { .kind = " + kindOf (l) + ", .a = " + literal (l.a) + ", .b = " + literal (l.b) + ", .table = " + curve (l.table, name) + " }";
}

std::string SettingCode::record (const SettingSheet& sheet, const Values& values, const std::string& name)
{
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < sheet.fields.size(); ++i)
        parts.push_back ("." + std::string (sheet.fields[i].id) + " = " + of (sheet.fields[i], values[i], name + "_" + std::string (sheet.fields[i].id)));
    return braced (parts);
}

std::string SettingCode::records (const SettingSheet& sheet, const Records& all, const std::string& name)
{
    if (all.empty()) return "{}";
    std::string text = "{\n";
    for (std::size_t i = 0; i < all.size(); ++i)
        text += "        " + record (sheet, all[i], name + "_" + std::to_string (i)) + ",\n";
    return text + "    }";
}

std::string SettingCode::signal (const Signal* s, const std::string& name)
{
    if (s == nullptr) return "nullptr";
    std::vector<std::string> channels;
    for (const auto& channel : s->channels)
        channels.push_back ("tactus::exported::listOf (" + numberArray (channel, name) + ")");
    return "std::make_shared<const tactus::Signal> (tactus::Signal { .rate_hz = " + literal (s->rate_hz) + ", .channels = " + braced (channels) + " })";
}

std::string SettingCode::grid (const Grid* g, const std::string& name)
{
    if (g == nullptr) return "nullptr";
    return "std::make_shared<const tactus::Grid> (tactus::Grid { .rows = " + std::to_string (g->rows) + ", .columns = " + std::to_string (g->columns)
           + ", .values = " + (g->values.empty() ? "{}" : "tactus::exported::listOf (" + numberArray (g->values, name) + ")") + " })";
}

std::string SettingCode::lawData (const Law& l, const std::string& name)
{
    std::vector<std::string> parts { kindOf (l), literal (l.a), literal (l.b) };
    if (! l.table.empty())
        for (const auto& [numbers, suffix] : { std::pair { &l.table.x, "_x" }, { &l.table.y, "_y" } })
            parts.push_back (numberArray (*numbers, name + suffix));
    return braced (parts);
}

std::string SettingCode::curves (const Surface& s, const std::string& name)
{
    std::vector<std::string> shapes;
    for (const auto& shape : s.curves)
    {
        std::vector<std::string> laws;
        for (const auto& axes : shape)
            for (const auto& axis : axes)
                laws.push_back (lawData (axis, name + "_curve"));
        shapes.push_back (laws.empty() ? "{}" : "tactus::exported::curvesOf (" + array ("tactus::exported::LawData", name + "_curves", laws) + ")");
    }
    return braced (shapes);
}

std::string SettingCode::ratios (const Surface& s, const std::string& name)
{
    if (s.mu.empty()) return "{}";
    std::vector<std::string> all;
    for (const auto& mu : s.mu)
    {
        std::vector<std::string> parts { literal (mu.number), lawData (mu.law, name + "_mu_law") };
        if (! mu.curve.empty())
            for (const auto& [numbers, suffix] : { std::pair { &mu.curve.x, "_mu_x" }, { &mu.curve.y, "_mu_y" } })
                parts.push_back (numberArray (*numbers, name + suffix));
        all.push_back (braced (parts));
    }
    return "tactus::exported::ratiosOf (" + array ("tactus::exported::RatioData", name + "_mu", all) + ")";
}

std::string SettingCode::surface (const Surface* s, const std::string& name)
{
    if (s == nullptr) return "nullptr";
    std::vector<double> points, frames;
    std::vector<std::string> triangles, weights;
    for (const auto& p : s->mesh->points)
        points.insert (points.end(), p.begin(), p.end());
    for (const auto& t : s->mesh->triangles)
        for (const int corner : t)
            triangles.push_back (std::to_string (corner));
    for (const auto& frame : s->frames)
        for (int k = 0; k < 9; ++k)
            frames.push_back (frame (k / 3, k % 3));
    for (const auto& tool : s->weights)
    {
        std::vector<std::string> nodes;
        for (const auto& shares : tool)
            nodes.push_back (numbers (shares, name + "_weights"));
        weights.push_back (braced (nodes));
    }
    const auto mesh = "tactus::exported::meshOf (" + numberArray (points, name + "_points") + ", " + array ("int", name + "_triangles", triangles) + ")";
    return "std::make_shared<const tactus::Surface> (tactus::Surface {\n        .mesh = " + mesh
           + ",\n        .frames = " + (frames.empty() ? "{}" : "tactus::exported::framesOf (" + numberArray (frames, name + "_frames") + ")")
           + ",\n        .curves = " + curves (*s, name) + ",\n        .mu = " + ratios (*s, name) + ",\n        .weights = " + braced (weights) + " })";
}

}   // namespace tactus::host
