// SPDX-License-Identifier: GPL-3.0-or-later
#include "gain_text.hpp"
#include "meter_feed.hpp"

#include <host/app/model/quantity_text.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tactus::host
{

namespace
{
/// The text in lower case and without spaces.
std::string squeezed (const std::string& text)
{
    std::string all;
    for (const char c : text)
        if (std::isspace (static_cast<unsigned char> (c)) == 0) all += static_cast<char> (std::tolower (static_cast<unsigned char> (c)));
    return all;
}

constexpr double most_by_level = 4.0;   // 12 dB

Result<double> levelToGain (const std::string& text, const UnityLevel& level)
{
    const auto wanted = parseMeasure (unitWritten (text));
    if (! wanted || ! std::isfinite (wanted->value))
        return Message::error ("gain/syntax", {}, filled (TRANS ("cannot read %1 as a gain"), quote (text)).toStdString(),
                               TRANS ("write -6 dB, x0.5, 50 % or a level such as 0.3 N").toStdString());
    const auto unit = level.unit.empty() ? Result<Measure> (Message::error ("gain/unit", {}, {})) : parseMeasure ("1 " + level.unit);
    if (unit && wanted->dimension != unit->dimension)
        return Message::error ("gain/unit", {},
                               filled (TRANS ("%1 is not a gain, and the level of this layer is in %2"), quote (text), level.unit).toStdString(),
                               filled (TRANS ("write -6 dB or a level in %1"), level.unit).toStdString());
    if (level.unit.empty())
        return Message::error ("gain/no_level", {}, TRANS ("the level of this layer has not been measured").toStdString(),
                               TRANS ("run the graph first, or write a gain such as -6 dB").toStdString());
    if (! unit || ! (level.peak > 0.0))
        return Message::error ("gain/no_level", {}, TRANS ("the layer has been silent, so its level is not known").toStdString(),
                               TRANS ("let it play first, or write a gain such as -6 dB").toStdString());
    // A level that a layer reaches for a moment only, such as while the hand rests, says nothing about how strong it becomes.
    if (const double gain = wanted->value / level.peak; std::abs (gain) <= most_by_level) return decibelsOf (gain);
    return Message::error ("gain/quiet", {},
                           filled (TRANS ("the layer has reached only %1, so that would be a gain of %2 dB"), levelText (level.peak, level.unit),
                                   juce::String (decibelsOf (wanted->value / level.peak), 1))
                               .toStdString(),
                           TRANS ("let it reach its full strength first, or write a gain such as 6 dB").toStdString());
}
}   // namespace

double decibelsOf (double gain)
{
    const double magnitude = std::abs (gain);
    if (! (magnitude > 1e-6)) return silent_db;
    return std::round (200.0 * std::log10 (magnitude)) / 10.0 + 0.0;   // + 0.0: not -0
}

double gainOf (double decibels) { return decibels <= silent_db ? 0.0 : std::pow (10.0, decibels / 20.0); }

const PortSheet& decibelSheet()
{
    static const PortSheet sheet = [] {
        PortSheet s {};
        s.role = Role::param;
        s.id = "gain";
        s.unit = unit::decibel;
        s.about = lasting (TRANS ("gain; 0 dB leaves the layer as it is, -120 dB is off"));
        s.limits = { .hard = { silent_db, 120.0 }, .usual = { -60.0, 6.0 } };
        return s;
    }();
    return sheet;
}

Result<double> readGain (const std::string& text, const UnityLevel& level)
{
    const auto word = squeezed (text);
    if (word == "off" || word == "-inf" || word == "-infdb") return silent_db;
    const bool is_factor = word.starts_with ('x') || word.starts_with ("\xc3\x97");
    const auto digits = is_factor ? word.substr (word[0] == 'x' ? 1 : 2) : word;
    const auto [number, size, is_in_range] = readNumber (digits);
    const auto unit = digits.substr (size);
    if (! is_in_range || ! std::isfinite (number))
        return Message::error ("gain/syntax", {}, filled (TRANS ("cannot read %1 as a gain"), quote (text)).toStdString(),
                               TRANS ("write -6 dB, x0.5, 50 % or a level such as 0.3 N").toStdString());
    if (unit.empty() && is_factor) return decibelsOf (number);
    if (unit == "x" || unit == "\xc3\x97") return decibelsOf (number);
    if (unit == "%") return decibelsOf (0.01 * number);
    if (unit.empty() || unit == "db") return std::max (number, silent_db);
    return levelToGain (text, level);
}

}   // namespace tactus::host
