// SPDX-License-Identifier: MIT
#pragma once

#include <framework/capi/handles.hpp>

#include <pybind11/pybind11.h>

namespace tactus::python
{

namespace py = pybind11;

/// Shows the warnings as Python warnings, and raises tactus.Error if there are errors. [with the GIL]
void report (const Messages&);

/// Raises tactus.Error. [with the GIL]
[[noreturn]] void fail (Message);

/// Reads a value that Python has written as JSON. [with the GIL]
Json jsonOf (const std::string& text);

}   // namespace tactus::python
