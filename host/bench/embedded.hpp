// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace tactus::bench
{

/// The text of graphs/padded_bench.json; made by the build.
std::string_view referenceText() noexcept;

}   // namespace tactus::bench
