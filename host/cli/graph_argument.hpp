// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// The graph file that an argument names: a path, or the name of a preset, as in graphFile(). Ends the command if it is a bare name that
/// neither a file nor a preset has. The error names the preset that was probably meant. Id: file/unreadable.
std::string graphArgument (const std::string& given);

}   // namespace tactus::host
