// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/run/runner.hpp>

#include <string>

namespace tactus::host
{

/// Prints the state of a run as one line on stderr; on a terminal, it replaces the previous line, and all lines but the last are shortened to
/// its width. `hardware` is the state of devices and sound card. [main thread]
void printStatus (const Runner&, double rate_hz, bool over_the_last, const std::string& hardware, bool is_last);

/// Prints the shares of the most expensive nodes, one line each. [main thread]
void printCosts (Runner&);

}   // namespace tactus::host
