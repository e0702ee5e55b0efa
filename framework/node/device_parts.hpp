// SPDX-License-Identifier: MIT
#pragma once

#include "device.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// The index of the part with this name, or -1. An empty name matches nothing, not even a part without a name.
inline int partNamed (std::string_view name, const std::vector<std::string>& there) noexcept
{
    return name.empty() ? -1 : indexOf (there, name);
}

/// For NodeType::missing: "no axis 'grip' (did you mean 'trigger'?); its axes: 'trigger', 'wheel'". Empty if the part exists.
std::string lacking (std::string_view kind, std::string_view plural, std::string_view name, const std::vector<std::string>& there);

/// The same for channels, which are numbered from 1: "no signal output 3; it has 2".
std::string lackingChannel (std::string_view kind, int channel, int there);

}   // namespace tactus
