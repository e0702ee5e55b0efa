// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace tactus::bench
{

/// The text of graphs/padded_bench.json, which the build embeds.
std::string_view referenceText() noexcept;

}   // namespace tactus::bench
