// SPDX-License-Identifier: MIT
#pragma once

#include "messages.hpp"

namespace tactus::python
{

/// Logs and replays as arrays.
void bindLogs (py::module_&);

}   // namespace tactus::python
