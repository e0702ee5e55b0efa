// SPDX-License-Identifier: MIT
#include "fitting.hpp"
#include "surface_preset.hpp"

#include <tactus/text/json.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace tactus::host
{

namespace
{
struct Prefix
{
    std::string text;
    double factor = 1.0;
};

/// A prefix for units that have one factor, such as m and N/m.
Prefix prefixFor (double value, const std::string& unit)
{
    const double size = std::abs (value);
    const bool may = unit == "m" || unit == "N" || unit == "J" || unit == "kg";
    if (! may || size == 0.0 || ! std::isfinite (size)) return {};
    if (unit == "kg") return size < 1.0 ? Prefix { "g", 1e3 } : Prefix {};
    if (size < 1e-6) return { "n", 1e9 };
    if (size < 1e-3) return { "u", 1e6 };
    if (size < 1.0) return { "m", 1e3 };
    return {};
}

/// A number with enough decimals to show the width of the interval with two digits.
std::string fixedText (double v, double wide)
{
    if (! std::isfinite (v)) return "unknown";
    if (! (wide > 0.0) || ! std::isfinite (wide) || std::abs (v) >= 1e7) return roundedText (v, 4);
    const auto twoDigitsOf = [] (double number) { return 1 - static_cast<int> (std::floor (std::log10 (number))); };
    const int decimals = std::min (9, twoDigitsOf (wide));
    std::ostringstream out;
    out << std::fixed << std::setprecision (std::max (0, decimals));
    if (const int zeros = std::abs (v) >= 1.0 ? std::min (-decimals, -twoDigitsOf (std::abs (v))) : 0; zeros > 0)   // 40200 instead of 40188
        out << std::pow (10.0, zeros) * std::round (v / std::pow (10.0, zeros));
    else
        out << v;
    const auto text = out.str();
    return text.find_first_not_of ("-0.") == std::string::npos && text.front() == '-' ? text.substr (1) : text;   // no -0.00
}

Json orNull (double v) { return std::isfinite (v) ? Json (v) : Json (nullptr); }
}   // namespace

std::string energyText (double joules, int digits)
{
    constexpr double least = 1e-12;
    const double shown = std::abs (joules) < least ? 0.0 : joules;
    const auto prefix = prefixFor (shown, "J");
    return roundedText (prefix.factor * shown, digits) + " " + prefix.text + "J";
}

std::string textOf (const FitValue& v)
{
    double size = std::abs (v.value);
    for (const double bound : { v.low, v.high })
        if (std::isfinite (bound)) size = std::max (size, std::abs (bound));
    const auto prefix = prefixFor (size, v.unit);
    const double wide = prefix.factor * (v.high - v.low);
    const auto unit = prefix.text == "g" ? prefix.text : prefix.text + v.unit;
    const auto text = [&] (double number) { return fixedText (prefix.factor * number, wide); };
    return text (v.value) + (unit.empty() ? "" : " " + unit) + "  [" + text (v.low) + ", " + text (v.high) + "]";
}

std::string textOf (const FitReport& report)
{
    std::size_t widest = 10;
    for (const auto& v : report.values)
        widest = std::max (widest, v.name.size());
    const auto line = [&] (const std::string& name, const std::string& text) {
        return "  " + name + std::string (widest + 2 - std::min (widest, name.size()), ' ') + text + "\n";
    };
    const auto unit = report.residual_unit.empty() ? "" : " " + report.residual_unit;
    std::string text;
    for (const auto& v : report.values)
        text += line (v.name, textOf (v));
    text += line ("residual", roundedText (report.residual, 3) + unit + " rms, " + percentText (report.residual / report.size) + " of the recording; "
                                  + roundedText (report.left_out_residual, 3) + unit + " on a part that was left out");
    text += line ("verdict", verdictOf (report));
    for (const auto& lack : report.lacking)
        text += "    - " + lack + "\n";
    for (const auto& note : report.notes)
        text += "  note: " + note + "\n";
    return text;
}

Json jsonOf (const FitReport& report)
{
    Json values = Json::array();
    for (const auto& v : report.values)
        values.push_back ({ { "name", v.name },
                            { "unit", v.unit },
                            { "value", orNull (v.value) },
                            { "low", orNull (v.low) },
                            { "high", orNull (v.high) },
                            { "main", v.is_main } });
    return { { "parameters", values },
             { "rows", report.rows },
             { "residual",
               { { "rms", orNull (report.residual) },
                 { "left_out_rms", orNull (report.left_out_residual) },
                 { "recording_rms", orNull (report.size) },
                 { "unit", report.residual_unit } } },
             { "verdict", verdictOf (report) },
             { "lacking", report.lacking },
             { "notes", report.notes } };
}

Json jsonOf (const FittedGraph& made, const std::string& recording, const std::string& preset)
{
    auto json = jsonOf (made.report);
    json["kind"] = infoOf (made.kind).id;
    json["recording"] = recording;
    json["preset"] = preset;
    return json;
}

}   // namespace tactus::host
