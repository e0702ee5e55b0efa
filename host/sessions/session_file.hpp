// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "device_session.hpp"

#include <filesystem>
#include <functional>
#include <optional>

namespace tactus::host
{

/// A session and the file it is kept in.
struct LoadedSession
{
    DeviceSession session;
    std::filesystem::path file;
    Messages messages {};   ///< with errors the session is empty, and the file is not to be written over
    TextPositions positions {};

    bool isGood() const { return ! hasErrors (messages); }
};

/// Says of a message whose `where` is a JSON pointer into a session where that stands in its file.
void place (Message&, const LoadedSession&);

/// The one that is used where nobody names another.
std::filesystem::path usualSessionFile (const std::filesystem::path& home);

/// A file that somebody names: it has to be there. Ids: session/unreadable, and those of readSession. [main thread]
LoadedSession loadSession (const std::filesystem::path& file);

/// The usual one, which need not be there. One that is damaged is set aside as session.json.broken (or .broken-2 …), which
/// is a warning, and the session is empty; one that a person can mend stays where it is. Ids as well: session/set_aside.
LoadedSession loadUsualSession (const std::filesystem::path& home);

/// Whole or not at all. Id: session/unwritable. [main thread]
std::optional<Message> saveSession (const LoadedSession&);

/// Reads the file anew, changes it, writes it: what others have changed in the meantime stays. Returns the session as it is
/// then; with errors nothing was written. [main thread]
LoadedSession editSession (LoadedSession, const std::function<void (DeviceSession&)>&);

}   // namespace tactus::host
