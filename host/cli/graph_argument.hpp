// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// The graph file that an argument names: a path, or the name of a preset, as in graphFile(). A preset in one file (.tactus) is unpacked. Ends the command
/// if that fails, or if it is a bare name, and neither a file nor a preset has this name. The error suggests the preset with the most similar name. Ids:
/// file/unreadable, and those of unpackPreset.
std::string graphArgument (const std::string& given);

}   // namespace tactus::host
