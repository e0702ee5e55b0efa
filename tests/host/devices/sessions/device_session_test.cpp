// SPDX-License-Identifier: MIT
// The session file: reading, writing, damage.

#include "support/temporary_folder.hpp"

#include <fuzz/session_target.hpp>
#include <host/devices/sessions/session_file.hpp>
#include <support/property.hpp>
#include <tactus/text/json_text.hpp>

#include "support/corpus.hpp"

#include <catch2/catch.hpp>

#include <sys/stat.h>

#include <thread>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr auto example = R"({
  "format": "tactus-session",
  "version": 1,
  "clock": "stylus",
  "roles": {
    "stylus": {
      "driver": "hid",
      "profile": "woodenhaptics_usb",
      "serial": "B7",
      "guard": {
        "max_force": "3 N"
      },
      "workspace": {
        "scale": 2,
        "offset": [
          0,
          0,
          "1 cm"
        ]
      },
      "colour": "red"
    },
    "shaker": {
      "driver": "audio",
      "outputs": [
        {
          "channel": 3,
          "full_scale": "4 N"
        }
      ]
    }
  },
  "audio": {
    "type": "JACK",
    "rate_hz": 48000
  },
  "from_tomorrow": [
    1.25,
    null
  ]
}
)";

std::string idOf (const Messages& messages) { return messages.empty() ? std::string() : messages.front().id; }

/// Any JSON value that is not nested too deeply.
Json anything (int depth)
{
    switch (*rc::gen::inRange (0, depth > 0 ? 7 : 5))
    {
    case 0:
        return nullptr;
    case 1:
        return *rc::gen::arbitrary<bool>();
    case 2:
        return *rc::gen::arbitrary<int>();
    case 3:
        return *rc::gen::map (rc::gen::arbitrary<double>(), [] (double v) { return std::isfinite (v) ? v : 0.5; });
    case 4:
        return *rc::gen::container<std::string> (rc::gen::inRange<char> (32, 126));
    case 5:
    {
        auto list = Json::array();
        for (int n = *rc::gen::inRange (0, 3); n > 0; --n)
            list.push_back (anything (depth - 1));
        return list;
    }
    default:
    {
        auto object = Json::object();
        for (int n = *rc::gen::inRange (0, 3); n > 0; --n)
            object[*rc::gen::container<std::string> (rc::gen::inRange<char> ('a', 'z'))] = anything (depth - 1);
        return object;
    }
    }
}

DeviceSession anySession()
{
    DeviceSession s;
    const auto name = [] { return *rc::gen::element<std::string> ("stylus", "thumb", "shaker_2", "a"); };
    for (int n = *rc::gen::inRange (0, 5); n > 0; --n)
        switch (*rc::gen::inRange (0, 4))
        {
        case 0:
            s.setClock (*rc::gen::element<std::string> ("", "timer", "audio", "stylus"));
            break;
        case 1:
            s.unbind (name());
            break;
        case 2:
            s.setAudio (*rc::gen::arbitrary<bool>() ? Json() : Json { { "type", anything (1) } });
            break;
        default:
            s.bind (name(), { { "driver", anything (0) }, { "more", anything (2) } });
            break;
        }
    return s;
}
}   // namespace

TEST_CASE ("a session is read, changed and written, and unknown entries are kept", "[sessions]")
{
    auto read = readSession (example);
    CHECK (read.messages.empty());
    auto& s = read.session;
    CHECK (writeSession (s) == example);
    CHECK (s.clock() == "stylus");
    CHECK (s.roles() == std::vector<std::string> { "stylus", "shaker" });
    REQUIRE (s.binding ("stylus"));
    CHECK ((*s.binding ("stylus"))["serial"] == "B7");
    CHECK (s.binding ("thumb") == nullptr);
    REQUIRE (s.audio());
    CHECK ((*s.audio())["type"] == "JACK");

    s.unbind ("stylus");
    s.unbind ("unbound");
    s.setClock ("");
    s.bind ("thumb", { { "driver", "sim" } });
    const auto again = readSession (writeSession (s));
    CHECK (again.messages.empty());
    CHECK (again.session == s);
    CHECK (again.session.clock().empty());
    CHECK (again.session.roles() == std::vector<std::string> { "shaker", "thumb" });
    CHECK (writeSession (s).find ("from_tomorrow") != std::string::npos);
}

TEST_CASE ("any session reads back byte for byte", "[sessions]")
{
    test::property ("round trip", [] {
        const auto s = anySession();
        const auto text = writeSession (s);
        const auto read = readSession (text);
        RC_ASSERT (read.messages.empty());
        RC_ASSERT (read.session == s);
        RC_ASSERT (writeSession (read.session) == text);
    });
}

TEST_CASE ("a damaged session is either read, or refused with a position, and it is never used in part", "[sessions]")
{
    test::property ("damage", [] {
        std::string text = example;
        for (int n = *rc::gen::inRange (1, 4); n > 0; --n)
        {
            const auto at = *rc::gen::inRange<std::size_t> (0, text.size());
            switch (*rc::gen::inRange (0, 3))
            {
            case 0:
                text.resize (at);
                break;
            case 1:
                text[at] = *rc::gen::arbitrary<char>();
                break;
            default:
                text.erase (at, *rc::gen::inRange<std::size_t> (1, 20));
                break;
            }
            if (text.empty()) text = " ";
        }
        fuzz::trySession (text);
    });
}

TEST_CASE ("every text of the session corpus is read or refused", "[sessions]") { CHECK (test::replay ("session", fuzz::trySession) > 10); }

TEST_CASE ("errors in a session have a position", "[sessions]")
{
    const auto [text, id, line, damaged] = GENERATE (table<std::string, std::string, int, bool> ({
        { "", "file/syntax", 1, true },
        { "[]", "session/format", 1, true },
        { "{\"format\": \"tactus-graph\", \"version\": 1}", "session/format", 1, true },
        { "{\"format\": \"tactus-session\",\n\"version\": 2}", "session/version", 2, false },
        { "{\"format\": \"tactus-session\",\n\"version\": 0}", "session/version", 2, false },
        { "{\"format\": \"tactus-session\"}", "session/version", 1, false },
        { "{\"format\": \"tactus-session\", \"version\": 1,\n\"clock\": 3}", "session/kind", 2, false },
        { "{\"format\": \"tactus-session\", \"version\": 1,\n\"clock\": \"A clock\"}", "session/kind", 2, false },
        { "{\"format\": \"tactus-session\", \"version\": 1,\n\"roles\": []}", "session/kind", 2, false },
        { "{\"format\": \"tactus-session\", \"version\": 1,\n\"roles\": {\n\"Stylus\": {}}}", "session/name", 3, false },
        { "{\"format\": \"tactus-session\", \"version\": 1,\n\"roles\": {\n\"stylus\": \"hid\"}}", "session/kind", 3, false },
        { "{\"format\": \"tactus-session\", \"version\": 1,\n\"audio\": 1}", "session/kind", 2, false },
    }));
    const auto read = readSession (text);
    INFO (text);
    REQUIRE (hasErrors (read.messages));
    CHECK (idOf (read.messages) == id);
    CHECK (read.messages.front().line == line);
    CHECK_FALSE (read.messages.front().remedy.empty());
    CHECK (read.damaged == damaged);
    CHECK (read.session == DeviceSession {});
}

TEST_CASE ("a damaged session file is set aside every time and never lost, but one that the user can fix stays", "[sessions]")
{
    TemporaryFolder home;
    CHECK (loadDefaultSession (home.path()).messages.empty());   // there is no file
    for (const auto* aside : { "session.json.broken", "session.json.broken-2", "session.json.broken-3" })
    {
        const auto text = std::string ("{ half of ") + aside;
        home.write ("session.json", text);
        const auto loaded = loadDefaultSession (home.path());
        CHECK (idOf (loaded.messages) == "session/set_aside");
        CHECK (loaded.isGood());   // the run can start
        CHECK (loaded.session == DeviceSession {});
        CHECK (loaded.messages.front().remedy.find (aside) != std::string::npos);
        CHECK (home.textOf (aside) == text);
        CHECK_FALSE (std::filesystem::exists (home / "session.json"));
    }

    const std::string newer = R"({"format": "tactus-session", "version": 7, "roles": {"x": {"driver": "tomorrow"}}})";
    home.write ("session.json", newer);
    auto loaded = loadDefaultSession (home.path());
    CHECK (idOf (loaded.messages) == "session/version");
    CHECK_FALSE (loaded.isGood());
    const auto edited = editSession (loaded, [] (DeviceSession& s) { s.setClock ("timer"); });
    CHECK_FALSE (edited.isGood());   // and the file is not overwritten
    CHECK (home.textOf ("session.json") == newer);
}

TEST_CASE ("a session that another user can change binds nothing, unless it is named", "[sessions]")
{
    const TemporaryFolder home;
    const LoadedSession session { {}, defaultSessionFile (home.path()) };
    const auto mask = ::umask (0);
    REQUIRE (saveSession (session));
    ::umask (mask);
    CHECK (loadDefaultSession (home.path()).isGood());
    for (const auto& open : { session.file, home.path() })
    {
        INFO (open.string());
        using std::filesystem::perms, std::filesystem::perm_options;
        permissions (open, perms::others_write, perm_options::add);
        const auto loaded = loadDefaultSession (home.path());
        CHECK_FALSE (loaded.isGood());
        CHECK (idOf (loaded.messages) == "session/foreign");
        CHECK (idOf (editSession (loaded, [] (DeviceSession& s) { s.setClock ("timer"); }).messages) == "session/foreign");
        CHECK (loadSession (session.file).isGood());
        permissions (open, perms::others_write, perm_options::remove);
    }
}

TEST_CASE ("a named session file must exist, is only read, and can be created by an edit", "[sessions]")
{
    TemporaryFolder folder;
    CHECK (idOf (loadSession (folder / "lab.json").messages) == "session/unreadable");
    folder.write ("lab.json", "{");
    CHECK_FALSE (loadSession (folder / "lab.json").isGood());
    CHECK (folder.textOf ("lab.json") == "{");

    const auto made = editSession ({ {}, folder / "new/of/it.json" }, [] (DeviceSession& s) { s.bind ("stylus", { { "driver", "sim" } }); });
    CHECK (made.isGood());
    const auto read = loadSession (folder / "new/of/it.json");
    CHECK (read.isGood());
    CHECK (read.session == made.session);

    folder.write ("file", "");
    const auto nowhere = editSession ({ {}, folder / "file/session.json" }, [] (DeviceSession&) {});
    CHECK (idOf (nowhere.messages) == "session/unwritable");
    CHECK_FALSE (nowhere.isGood());
}

TEST_CASE ("an edit keeps changes that another program made since the session was read", "[sessions]")
{
    TemporaryFolder folder;
    const auto bind = [] (const char* role) { return [role] (DeviceSession& s) { s.bind (role, { { "driver", "sim" } }); }; };
    const LoadedSession mine { {}, folder / "session.json" };
    editSession (mine, bind ("thumb"));
    CHECK (editSession (mine, bind ("index")).session.roles() == std::vector<std::string> { "thumb", "index" });
}
