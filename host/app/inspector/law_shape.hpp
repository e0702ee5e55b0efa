// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/json.hpp>
#include <framework/law.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// The kinds of laws as files name them.
const std::vector<std::string>& lawKinds();

/// Which of them a written law is of; "none" of anything else.
std::string lawKindOf (const Json&);

/// A law of another kind that is about as stiff where a hand presses as the one before; null for "none".
Json lawOfKind (const std::string& kind, const Law& before);

}   // namespace tactus::host
