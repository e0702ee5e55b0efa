// SPDX-License-Identifier: MIT
#include "session_file.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/ownership.hpp>

#include <algorithm>
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
    auto m = Message::error ("session/unreadable", "", "there is no readable session file",
                             "name an existing file, or create one: tactus session --file FILE --bind ROLE=hid:PROFILE");
    m.file = file.string();
    return m;
}

Message foreign (const fs::path& file, std::string who)
{
    auto m = Message::error ("session/foreign", "", std::move (who) + ", so it does not choose devices and their limits",
                             "remove the file, or change its owner or its permissions (chown, chmod go-w); --session FILE uses any file");
    m.file = file.string();
    return m;
}

/// The first free name for a damaged file, so that files that were set aside earlier are kept.
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

fs::path defaultSessionFile (const fs::path& home) { return home / "session.json"; }

LoadedSession loadSession (const fs::path& file)
{
    const auto text = readTextFile (file);
    if (! text) return { {}, file, { unreadable (file) } };
    auto read = readAt (file, *text);
    return { std::move (read.session), file, std::move (read.messages), std::move (read.positions) };
}

LoadedSession rereadSession (const fs::path& file)
{
    if (! isThere (file)) return { {}, file, {} };
    if (auto who = whoElseCanChange (file); ! who.empty()) return { {}, file, { foreign (file, std::move (who)) } };
    return loadSession (file);
}

LoadedSession loadDefaultSession (const fs::path& home)
{
    const auto file = defaultSessionFile (home);
    if (home.empty() || ! isThere (file)) return { {}, file, {} };
    if (auto who = whoElseCanChange (file); ! who.empty()) return { {}, file, { foreign (file, std::move (who)) } };
    const auto text = readTextFile (file);
    if (! text) return { {}, file, { unreadable (file) } };
    auto read = readAt (file, *text);
    if (! read.damaged) return { std::move (read.session), file, std::move (read.messages), std::move (read.positions) };

    const auto aside = besides (file);
    std::error_code failed;
    fs::rename (file, aside, failed);
    if (failed) return { {}, file, std::move (read.messages) };
    auto note = read.messages.front();
    note.severity = Message::Severity::warning;
    note.id = "session/set_aside";
    note.text = "the session file is damaged (" + note.text + "), so no role is bound";
    note.remedy = "the file is kept as " + aside.string() + ": repair it and give it its old name again, or bind the roles again";
    return { {}, file, { std::move (note) } };
}

Result<> saveSession (const LoadedSession& s)
{
    const auto done = writeTextFile (fs::absolute (s.file), writeSession (s.session));   // absolute, so that the path has a folder
    std::error_code ignored;
    fs::permissions (s.file, fs::perms::group_write | fs::perms::others_write, fs::perm_options::remove, ignored);
    if (done) return {};
    auto m = Message::error ("session/unwritable", "", "the session " + done.error().text,
                             "make the folder writable, or set TACTUS_HOME to a folder that is writable");
    m.file = s.file.string();
    return m;
}

LoadedSession editSession (LoadedSession before, const std::function<void (DeviceSession&)>& edit)
{
    if (std::ranges::count (before.messages, "session/foreign", &Message::id) > 0) return before;
    auto now = isThere (before.file) ? loadSession (before.file) : LoadedSession { {}, before.file, {} };
    if (! now.isGood()) return now;
    edit (now.session);
    if (auto saved = saveSession (now); ! saved) now.messages.push_back (std::move (saved).error());
    return now;
}

}   // namespace tactus::host
