// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/node.hpp>
#include <framework/units.hpp>

#include <CLI/CLI.hpp>

#include <string>
#include <variant>

namespace tactus::host
{

/// An option in SI, or with a unit.
inline void addMeasure (CLI::App& app, const char* option, double& value, const Unit& unit, const std::string& about, bool zero_allowed = false)
{
    app.add_option_function<std::string> (
           option,
           [&value, unit, option, zero_allowed] (const std::string& text)
           {
               const auto read = parseMeasure (text);
               const auto* measure = std::get_if<Measure> (&read);
               if (measure == nullptr) throw CLI::ValidationError (option, std::get<std::string> (read));

               const bool bare = measure->dimension == Dimension {};
               if (! bare && measure->dimension != unit.dimension) throw CLI::ValidationError (option, text + " is in " + symbolOf (measure->dimension) + ", not in " + std::string (unit.symbol));
               if (! isFinite (measure->value) || measure->value < 0.0 || (measure->value == 0.0 && ! zero_allowed))
                   throw CLI::ValidationError (option, text + (zero_allowed ? " is less than 0" : " is not more than 0"));
               value = measure->value;
           },
           about)
        ->type_name (std::string (unit.symbol));
}

}   // namespace tactus::host
