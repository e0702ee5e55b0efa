// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace tactus::bench
{

// The texts of presets, which the build embeds.
std::string_view referenceText() noexcept;   ///< graphs/padded_bench.json
std::string_view dryWoodText() noexcept;     ///< graphs/dry_wood.json

}   // namespace tactus::bench
