// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/window/main_view.hpp>

#include <string>

namespace tactus::host::test
{

// What is inconsistent; "" if nothing is.

/// Between graph and canvas.
std::string disagreement (MainView&);

/// Between the errors that the live run reports and those of compiling the graph separately.
std::string disagreementWithCompile (MainView&, FileAssets&);

/// Between a graph and the same graph after it was written and read again.
std::string instability (const graph::Graph&);

/// Between the graph now and the same graph after jumps through its history and back.
std::string historyFault (Document&);

}   // namespace tactus::host::test
