// SPDX-License-Identifier: MIT
#pragma once

#include "device.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// The number of the part of this name; -1 if there is none. One without a name is not found by that.
inline int partNamed (const std::string& name, const std::vector<std::string>& there) noexcept { return name.empty() ? -1 : indexOf (there, name); }

/// For NodeType::missing: "no axis 'grip' (did you mean 'trigger'?); its axes: 'trigger', 'wheel'"; empty if it is there.
std::string lacking (std::string_view kind, std::string_view plural, const std::string& name, const std::vector<std::string>& there);

/// The same for channels, counted from 1: "no signal output 3; it has 2".
std::string lackingChannel (std::string_view kind, int channel, int there);

}   // namespace tactus
