// SPDX-License-Identifier: MIT
#pragma once

/// Readers for the parts of settings. Each function returns the value that the JSON holds, or throws the first Problem it finds,
/// with `key` (the location of the JSON within the setting) extended to the part at fault. Only readSetting catches it.

#include <tactus/plan/values.hpp>

#include <tactus/kit/law.hpp>

namespace tactus::plan
{

struct Problem
{
    std::string what;
    std::string key;   ///< JSON pointer within the setting
};

std::string under (const std::string& key, std::size_t index);
std::string under (const std::string& key, std::string_view name);

double numberFrom (const Json&, const UnitRule&, const std::string& key);
double wholeNumberFrom (const Json&, const UnitRule&, const std::string& key);
double inRange (double, const Interval& hard, const std::string& key);
Vec3 vectorFrom (const Json&, const UnitRule&, const std::string& key);
Curve curveFrom (const Json&, const UnitRule& x, const UnitRule& y, const std::string& key);
Law lawFrom (const Json&, const UnitRule& x, const UnitRule& y, const std::string& key);

/// An array; it must have `size` entries, unless `size` is 0.
const Json& listFrom (const Json&, std::size_t size, const std::string& what, const std::string& key);

/// An object with only members from this list, not necessarily all; `what` names it in messages.
const Json& objectFrom (const Json&, const std::vector<std::string>& members, const std::string& what, const std::string& key);

}   // namespace tactus::plan
