// SPDX-License-Identifier: MIT
#pragma once

#include "apart.hpp"
#include "check_plugin.hpp"

#include <string>

namespace tactus::check_plugin
{

/// Begins the answer of an examination that is skipped; the reason follows.
inline constexpr const char* skip_mark = "\1";

/// The finding of an examination that has run in a separate process: its answer is why it failed, or empty.
Finding finding (std::string id, std::string promise, const ProcessResult&);

}   // namespace tactus::check_plugin
