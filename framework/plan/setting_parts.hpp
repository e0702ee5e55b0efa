// SPDX-License-Identifier: MIT
#pragma once

/// What settings are made of. Each function returns what the JSON says or throws the first Problem, with `key`, the
/// place of the JSON within the setting, extended to the culprit. Only readSetting catches it.

#include "values.hpp"

#include <framework/law.hpp>

namespace tactus::plan
{

struct Problem
{
    std::string what;
    std::string key;   ///< JSON pointer from the setting on
};

std::string under (const std::string& key, std::size_t index);
std::string under (const std::string& key, std::string_view name);

double numberFrom (const Json&, const UnitRule&, const std::string& key);
double wholeNumberFrom (const Json&, const UnitRule&, const std::string& key);
double inRange (double, const Interval& hard, const std::string& key);
Vec3 vectorFrom (const Json&, const UnitRule&, const std::string& key);
Curve curveFrom (const Json&, const UnitRule& x, const UnitRule& y, const std::string& key);
Law lawFrom (const Json&, const UnitRule& x, const UnitRule& y, const std::string& key);

/// An array, of `size` entries if that is not 0.
const Json& listFrom (const Json&, std::size_t size, const std::string& what, const std::string& key);

/// An object with some of these members and no others; `what` names it.
const Json& objectFrom (const Json&, const std::vector<std::string>& members, const std::string& what, const std::string& key);

}   // namespace tactus::plan
