// SPDX-License-Identifier: GPL-3.0-or-later
#include "control_value.hpp"

#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <cctype>

namespace tactus::host
{

const PortSheet& controlSheet()
{
    static const PortSheet sheet = sheetOfNumber ("value", unit::gain, lasting (TRANS ("the value of the control, from 0 to 1")),
                                                  { .hard = { 0.0, 1.0 }, .usual = { 0.0, 1.0 } }, 0.0);
    return sheet;
}

Result<double> readControl (const std::string& text)
{
    auto digits = text;
    std::erase_if (digits, [] (unsigned char c) { return std::isspace (c) != 0; });
    const bool is_percent = digits.ends_with ('%');
    if (is_percent) digits.pop_back();
    const auto number = wholeNumber (digits);
    if (! number)
        return Message::error ("control/value", {}, filled (TRANS ("%1 is not a number"), quote (text)).toStdString(),
                               TRANS ("write a number from 0 to 1, or 35 %").toStdString());
    const double value = is_percent ? 0.01 * *number : *number;
    if (value >= 0.0 && value <= 1.0) return value;
    return Message::error ("control/value", {}, filled (TRANS ("%1 is not between 0 and 1"), quote (text)).toStdString(),
                           TRANS ("write a number from 0 to 1, or 35 %").toStdString());
}

}   // namespace tactus::host
