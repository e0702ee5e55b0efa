// SPDX-License-Identifier: MIT
#pragma once

#include "messages.hpp"

namespace tactus::python
{

/// Renders of one graph with many sets of values: a call of Python for many of them, and none in a tick. The bits are those of PythonRun.
void bindPoints (py::module_&);

}   // namespace tactus::python
