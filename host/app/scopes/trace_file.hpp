// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "look_at.hpp"

#include <host/io/csv.hpp>

namespace tactus::host
{

/// Writes all that is held of some traces, in the columns of `tactus render --out`: t, then a component each. Where one has
/// nothing on a tick that another has, stands nan. [errors as of TableWriter; scope/nothing if there is nothing to write]
[[nodiscard]] tl::expected<void, Error> writeTraces (const std::filesystem::path&, const TraceList&);

}   // namespace tactus::host
