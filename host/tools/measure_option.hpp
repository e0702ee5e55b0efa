// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>
#include <tactus/text/units.hpp>

#include <host/command_line/command.hpp>

#include <string>
#include <variant>

namespace tactus::host
{

/// Adds an option whose value is in the SI unit or has its own unit.
inline void addMeasure (const Command& app, const char* option, double& value, const Unit& unit, const std::string& about, bool zero_allowed = false)
{
    app.addOption (
           option,
           [&value, unit, option, zero_allowed] (const std::string& text) {
               const auto read = parseMeasure (text);
               if (! read) throw UsageError (option, read.error().text);
               const auto& measure = *read;

               const bool bare = measure.dimension == Dimension {};
               if (! bare && measure.dimension != unit.dimension)
                   throw UsageError (option, text + " is in " + symbolOf (measure.dimension) + ", not in " + std::string (unit.symbol));
               if (! isFinite (measure.value) || measure.value < 0.0 || (measure.value == 0.0 && ! zero_allowed))
                   throw UsageError (option, text + (zero_allowed ? " must not be less than 0" : " must be more than 0"));
               value = measure.value;
           },
           about)
        .type (std::string (unit.symbol));
}

}   // namespace tactus::host
