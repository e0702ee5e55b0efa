// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_file.hpp"

#include <framework/file/json_text.hpp>
#include <host/devices/problem.hpp>
#include <host/io/text_file.hpp>

#include <system_error>
#include <utility>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
ReadSession readAt (const fs::path& file, const std::string& text)
{
    auto read = readSession (text);
    for (auto& m : read.messages)
        m.file = file.string();
    return read;
}

Message unreadable (const fs::path& file)
{
    auto m = problem ("session/unreadable", "", "there is no session that can be read", "name a file that is there, or make one: tactus session --file FILE --bind ROLE=hid:PROFILE");
    m.file = file.string();
    return m;
}

/// The first name that is free, so that what was set aside before stays too.
fs::path besides (const fs::path& file)
{
    std::error_code failed;
    for (int n = 1;; ++n)
    {
        auto aside = file;
        aside += ".broken" + (n == 1 ? std::string() : "-" + std::to_string (n));
        if (! fs::exists (aside, failed)) return aside;
    }
}

bool isThere (const fs::path& file)
{
    std::error_code failed;
    return fs::exists (fs::symlink_status (file, failed));
}
}   // namespace

void place (Message& m, const LoadedSession& s)
{
    const auto position = positionOf (s.positions, m.where);
    m.file = s.file.string();
    m.line = position.line;
    m.column = position.column;
}

fs::path usualSessionFile (const fs::path& home) { return home / "session.json"; }

LoadedSession loadSession (const fs::path& file)
{
    const auto text = readTextFile (file);
    if (! text) return { {}, file, { unreadable (file) } };
    auto read = readAt (file, *text);
    return { std::move (read.session), file, std::move (read.messages), std::move (read.positions) };
}

LoadedSession loadUsualSession (const fs::path& home)
{
    const auto file = usualSessionFile (home);
    if (home.empty() || ! isThere (file)) return { {}, file, {} };
    const auto text = readTextFile (file);
    if (! text) return { {}, file, { unreadable (file) } };
    auto read = readAt (file, *text);
    if (! read.damaged) return { std::move (read.session), file, std::move (read.messages), std::move (read.positions) };

    const auto aside = besides (file);
    std::error_code failed;
    fs::rename (file, aside, failed);
    if (failed) return { {}, file, std::move (read.messages) };
    auto said = read.messages.front();
    said.severity = Message::Severity::warning;
    said.id = "session/set_aside";
    said.text = "the session is damaged (" + said.text + "), and no role is bound";
    said.remedy = "it is kept as " + aside.string() + ": mend it and put it back, or bind the roles anew";
    return { {}, file, { std::move (said) } };
}

std::optional<Message> saveSession (const LoadedSession& s)
{
    const auto why = writeTextFile (fs::absolute (s.file), writeSession (s.session));   // whose folder has a name
    if (! why) return std::nullopt;
    auto m = problem ("session/unwritable", "", "the session cannot be written: " + *why, "make the folder writable, or set TACTUS_HOME to one that is");
    m.file = s.file.string();
    return m;
}

LoadedSession editSession (LoadedSession before, const std::function<void (DeviceSession&)>& edit)
{
    auto now = isThere (before.file) ? loadSession (before.file) : LoadedSession { {}, before.file, {} };
    if (! now.isGood()) return now;
    edit (now.session);
    if (auto failed = saveSession (now)) now.messages.push_back (std::move (*failed));
    return now;
}

}   // namespace tactus::host
