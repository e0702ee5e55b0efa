// SPDX-License-Identifier: MIT
#pragma once

#include "sources.hpp"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// C++ code with float in place of double: its type names, and its numbers, which get an f. Comments, texts and includes stay. A number
/// beyond the range of float is added to `outside`; without it, the number is a bound near the end of the range of double, and is moved as
/// near to the end of the range of float.
std::string inSinglePrecision (std::string_view code, std::vector<std::string>* outside = nullptr);

/// The source files that a folder in single precision has in place of these. Elementary functions and positions have their own files
/// (framework/kit/single/).
std::set<std::string> inSinglePrecision (const std::set<std::string>& paths);

/// The text of one of them, adapted like those of other exports.
std::string adaptedSingle (const std::string& path);
std::string adaptedSingle (const SourceFile&);

}   // namespace tactus::host
