// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host
{

/// The system's folder for temporary files: TMPDIR, or else /tmp. [any thread]
std::filesystem::path temporaryFolder();

/// Makes a new temporary folder that only this user can enter, from its first moment on, so that no other user can put a file or a link
/// there. Its name begins with `name`. Empty if it cannot be made. The caller removes it. [any thread]
std::filesystem::path privateFolder (const std::string& name);

}   // namespace tactus::host
