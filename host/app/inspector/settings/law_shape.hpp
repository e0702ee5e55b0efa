// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/law.hpp>
#include <tactus/text/json.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// The kinds of laws, as named in files.
const std::vector<std::string>& lawKinds();

/// The kind of a stored law; "none" if it is not a law.
std::string lawKindOf (const Json&);

/// Converts a law to a different kind with about the same stiffness at 1 N. Null for "none".
Json lawOfKind (const std::string& kind, const Law& before);

}   // namespace tactus::host
