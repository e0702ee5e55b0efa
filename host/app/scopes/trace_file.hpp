// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trace_window.hpp"

#include <tactus/file/csv.hpp>

namespace tactus::host
{

/// Writes all stored ticks of some traces, in the format of `tactus render --out`: column t, then a column per component, with nan where
/// a trace has no value at a tick. Ids: scope/nothing, and those of TableWriter.
Result<> writeTraces (const std::filesystem::path&, const TraceList&);

}   // namespace tactus::host
