// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::host
{

/// The source file of a unit, and its rules for make. Marks such as @S@ are to be filled.
const char* fmuSource();
const char* fmuMake();

}   // namespace tactus::host
