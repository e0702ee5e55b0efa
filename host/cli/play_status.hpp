// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/runtime/runner.hpp>

namespace tactus::host
{

/// How a run stands, on one line of stderr; on a terminal over the line before. [main thread]
void printStatus (const Runner&, double rate_hz, bool over_the_last, const char* end);

/// What the costliest nodes take of a tick, a line each. [main thread]
void printCosts (Runner&);

}   // namespace tactus::host
