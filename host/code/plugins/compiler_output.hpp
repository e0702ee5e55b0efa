// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>

#include <string>

namespace tactus::host
{

/// The remedy for an error in code that is watched. No earlier version may be loaded, such as when a program starts.
inline constexpr const char* correct_and_save = "correct the C++ code and save it; what is loaded stays as it is";

/// The errors in the output of g++ or clang++, each with its file and line. If the output contains no error, its last lines become one,
/// about `name`, which is what was compiled. Id: live/compile.
Messages errorsOf (const std::string& output, const std::string& name);

}   // namespace tactus::host
