// SPDX-License-Identifier: MIT
#include "setting_code.hpp"

#include <tactus/kit/at.hpp>

namespace tactus::host
{

namespace
{
using SettingKind = SettingSheet::Kind;

std::string braced (const std::vector<std::string>& parts) { return parts.empty() ? "{}" : "{ " + listText (parts) + " }"; }

const std::string groups = "tactus::exported::groupsOver";
constexpr const char* vector_of_numbers = "tactus::exported::Vector<double>";

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
        return "tactus::Vec3 { " + listText ({ literal (v.x()), literal (v.y()), literal (v.z()) }) + " }";
    }
    case SettingKind::numbers:
        return numbers (std::get<std::vector<double>> (value), name);
    case SettingKind::curve:
        return "tactus::Curve " + curve (std::get<Curve> (value), name);
    case SettingKind::law:
        return "tactus::Law " + law (std::get<Law> (value), name);
    case SettingKind::record:
        return record (sheet, std::get<Values> (value), name);
    case SettingKind::records:
        return records (sheet, std::get<Records> (value), name);
    case SettingKind::signal:
        return signal (std::get<std::shared_ptr<const Signal>> (value).get(), name);
    case SettingKind::image:
        return "tactus::Image { " + grid (std::get<Image> (value).grid.get(), name) + " }";
    case SettingKind::table:
        return "tactus::Sheet { " + grid (std::get<Sheet> (value).grid.get(), name) + " }";
    case SettingKind::surface:
        return surface (std::get<std::shared_ptr<const Surface>> (value).get(), name);
    }
    return {};
}

/// Defines a constant and returns its name.
std::string SettingCode::constant (const std::string& type, const std::string& name, const std::string& value)
{
    const auto own = names.make (name);
    definitions += "inline " + type + " " + own + " " + value + ";\n\n";
    return space + "::" + own;
}

/// Defines a constant array and returns an expression for a vector over it. The lines hold as many values as fit.
std::string SettingCode::array (const std::string& type, const std::string& name, const std::vector<std::string>& values, const std::string& view)
{
    constexpr std::size_t most_columns = 120;
    if (values.empty()) return "{}";
    const auto own = names.make (name);
    definitions += "inline constexpr " + type + " " + own + "[] {";
    std::string line;
    for (const auto& value : values)
    {
        if (! line.empty() && line.size() + value.size() > most_columns)
        {
            definitions += "\n   " + line;
            line.clear();
        }
        line += " " + value + ",";
    }
    definitions += "\n   " + line + "\n};\n\n";
    return view + " (" + space + "::" + own + ")";
}

std::string SettingCode::numbers (std::span<const double> all, const std::string& name, const std::string& view)
{
    std::vector<std::string> texts;
    for (const double v : all)
        texts.push_back (literal (v));
    return array ("double", name, texts, view);
}

std::string SettingCode::curve (const Curve& c, const std::string& name)
{
    if (c.empty()) return "{}";
    return "{ " + numbers (c.x, name + "_x") + ", " + numbers (c.y, name + "_y") + " }";
}

std::string SettingCode::law (const Law& l, const std::string& name)
{
    std::vector<std::string> parts { kindOf (l), literal (l.a), literal (l.b) };
    if (! l.table.empty()) parts.push_back (curve (l.table, name));
    return braced (parts);
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
        channels.push_back (numbers (channel, name));
    return pointer ("constexpr tactus::Signal", name,
                    "{ .rate_hz = " + literal (s->rate_hz) + ", .channels = " + array (vector_of_numbers, name + "_channels", channels) + " }");
}

std::string SettingCode::grid (const Grid* g, const std::string& name)
{
    if (g == nullptr) return "nullptr";
    return pointer ("constexpr tactus::Grid", name + "_grid",
                    "{ .rows = " + std::to_string (g->rows) + ", .columns = " + std::to_string (g->columns)
                        + ", .values = " + numbers (g->values, name) + " }");
}

std::string SettingCode::curves (const Surface& s, const std::string& name)
{
    std::vector<std::string> shapes;
    for (const auto& shape : s.curves)
    {
        std::vector<std::string> nodes;
        for (const auto& axes : shape)
        {
            std::vector<std::string> laws;
            for (const auto& axis : axes)
                laws.push_back (law (axis, name + "_curve"));
            nodes.push_back ("{ " + braced (laws) + " }");
        }
        shapes.push_back (array ("tactus::Surface::Curves", name + "_curves", nodes));
    }
    return array ("tactus::exported::Vector<tactus::Surface::Curves>", name + "_shapes", shapes);
}

std::string SettingCode::ratios (const Surface& s, const std::string& name)
{
    std::vector<std::string> all;
    for (const auto& mu : s.mu)
        all.push_back (braced ({ literal (mu.number), law (mu.law, name + "_mu_law"), curve (mu.curve, name + "_mu") }));
    return array ("tactus::Ratio", name + "_mu", all);
}

std::string SettingCode::weights (const Surface& s, const std::string& name)
{
    std::vector<std::string> tools;
    for (const auto& tool : s.weights)
    {
        std::vector<std::string> nodes;
        for (const auto& shares : tool)
            nodes.push_back (numbers (shares, name + "_shares"));
        tools.push_back (array (vector_of_numbers, name + "_weights", nodes));
    }
    return array ("tactus::exported::Vector<" + std::string (vector_of_numbers) + ">", name + "_tools", tools);
}

std::string SettingCode::mesh (const Mesh& m, const std::string& name)
{
    std::vector<double> points;
    std::vector<std::string> triangles;
    for (const auto& p : m.points)
        points.insert (points.end(), p.begin(), p.end());
    for (const auto& t : m.triangles)
        triangles.push_back ("{ " + std::to_string (t[0]) + ", " + std::to_string (t[1]) + ", " + std::to_string (t[2]) + " }");
    return pointer ("const tactus::Mesh", name + "_mesh",
                    "{ .points = " + numbers (points, name + "_points", groups + "<tactus::Vec3>")
                        + ",\n    .triangles = " + array ("std::array<int, 3>", name + "_triangles", triangles) + " }");
}

std::string SettingCode::surface (const Surface* s, const std::string& name)
{
    if (s == nullptr) return "nullptr";
    std::vector<double> frames;   // column after column, as Eigen stores them
    for (const auto& frame : s->frames)
        frames.insert (frames.end(), frame.data(), frame.data() + frame.size());
    const auto shape = mesh (*s->mesh, name);
    return pointer ("const tactus::Surface", name + "_surface",
                    "{\n    .mesh = " + shape + ",\n    .frames = " + numbers (frames, name + "_frames", groups + "<Eigen::Matrix3d>")
                        + ",\n    .curves = " + curves (*s, name) + ",\n    .mu = " + ratios (*s, name) + ",\n    .weights = " + weights (*s, name) + " }");
}

}   // namespace tactus::host
