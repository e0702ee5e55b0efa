// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "values.hpp"

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

/// Between the keyboard and the window: some part of it must have the keyboard. Call it after the message loop has run.
std::string keyboardFault (MainView&);

/// Between the graph now and after an undo and a redo.
std::string stepFault (Document&);

/// Values that the latest step has changed, although it was none that changes values: it is about controls, names, copies or the window.
std::string movedValue (const Document&, const ValuesInEffect& before, const ValuesInEffect& now);

}   // namespace tactus::host::test
