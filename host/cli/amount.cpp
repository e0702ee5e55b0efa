// SPDX-License-Identifier: GPL-3.0-or-later
#include "amount.hpp"

#include <host/base/command_line/command.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
double readNumber (const std::string& option, const std::string& text, const char* si_unit, const char* example, bool is_signed)
{
    const auto amount = parseMeasure (text), unit = parseMeasure (std::string ("1 ") + si_unit);
    const bool fits = amount && (amount->dimension == unit->dimension || amount->dimension == Dimension {});
    if (! fits || ! (is_signed || amount->value > 0.0) || ! std::isfinite (amount->value))
        throw UsageError (option, quote (text) + " does not fit; write a number " + (is_signed ? "" : "above 0 ") + "with its unit, such as "
                                      + quote (example));
    return amount->value;
}
}   // namespace

double readAmount (const std::string& option, const std::string& text, const char* si_unit, const char* example)
{
    return readNumber (option, text, si_unit, example, false);
}

double readSignedAmount (const std::string& option, const std::string& text, const char* si_unit, const char* example)
{
    return readNumber (option, text, si_unit, example, true);
}

}   // namespace tactus::host
