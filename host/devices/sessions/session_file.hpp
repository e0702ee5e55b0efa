// SPDX-License-Identifier: MIT
#pragma once

#include "device_session.hpp"

#include <tactus/text/result.hpp>

#include <filesystem>
#include <functional>

namespace tactus::host
{

/// A session and its file.
struct LoadedSession
{
    DeviceSession session;
    std::filesystem::path file;
    Messages messages {};   ///< if there are errors, the session is empty and the file must not be overwritten
    TextPositions positions {};

    bool isGood() const { return ! hasErrors (messages); }
};

/// Adds file, line and column to a message whose `where` is a JSON pointer into a session.
void place (Message&, const LoadedSession&);

/// The session file used by default.
std::filesystem::path defaultSessionFile (const std::filesystem::path& home);

/// Loads a named file, which must exist. Ids: session/unreadable, and those of readSession. [main thread]
LoadedSession loadSession (const std::filesystem::path& file);

/// Loads a session file that may be missing, and that another program may be writing, so it is not renamed if it is damaged. A file that another user can
/// change is not read. Ids: those of loadSession, session/foreign. [main thread]
LoadedSession rereadSession (const std::filesystem::path& file);

/// Loads the default session file, which may be missing. A damaged file is renamed to session.json.broken (or .broken-2 …)
/// with a warning, and the session is empty. A file with errors that the user can fix stays in place, and one that another user can
/// change is not read. Ids: those of loadSession, session/set_aside, session/foreign.
LoadedSession loadDefaultSession (const std::filesystem::path& home);

/// Writes the file completely or not at all. Id: session/unwritable. [main thread]
Result<> saveSession (const LoadedSession&);

/// Reads the file again, applies the edit and writes it, so that changes by other programs are kept. Returns the new
/// session; if it has errors, nothing was written. [main thread]
LoadedSession editSession (LoadedSession, const std::function<void (DeviceSession&)>&);

}   // namespace tactus::host
