// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <filesystem>
#include <string>

namespace tactus::host
{

/// The system's folder for temporary files: TMPDIR, or else /tmp. [any thread]
std::filesystem::path temporaryFolder();

/// Makes a new folder that only this user can enter, from its first moment on, so that no other user can put a file or a link there. Its
/// name begins with `name`. It is in temporaryFolder(), or in /tmp if another user could replace what is there. Empty if it cannot be made.
/// The caller removes it. [any thread]
std::filesystem::path privateFolder (const std::string& name);

/// Makes sure that a folder exists in which only this user and root can put something: settings, caches. What is missing on the way is
/// made so that only this user can enter it. Errors, without a remedy: folder/foreign (another user can change it), folder/unwritable.
/// [any thread]
Result<> needOwnFolder (const std::filesystem::path&);

}   // namespace tactus::host
