// SPDX-License-Identifier: MIT
// A stand-in for what the tests call of POSIX.
#pragma once

#include <cstdlib>

inline int setenv (const char* name, const char* value, int) { return ::_putenv_s (name, value); }
inline int unsetenv (const char* name) { return ::_putenv_s (name, ""); }
