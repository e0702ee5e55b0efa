// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::host
{

/// True if a person reads what is written to stderr.
bool stderrIsTerminal() noexcept;

}   // namespace tactus::host
