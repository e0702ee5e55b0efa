// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/storage/recovery.hpp>
#include <tactus/file/text_file.hpp>

#include "support/temporary_folder.hpp"

#include <tactus/file/graph_file.hpp>

#include <atomic>
#include <thread>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
const std::string wood_file = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

AutosavedDocument changedWood()
{
    auto graph = loadGraph (wood_file).graph;
    graph.root.nodes[1].params["stiffness"] = "3 N/mm";
    return { wood_file, {}, true, 1000.0, writeGraph (graph) };
}

/// What a killed run leaves behind: a folder whose lock is not held.
fs::path killed (const fs::path& home, const std::string& text, bool in_trial = false, const std::string& name = "killed")
{
    const auto folder = home / "sessions" / name;
    REQUIRE (writeTextFile (folder / "kept.json", text));
    REQUIRE (writeTextFile (folder / "lock", ""));
    if (in_trial) REQUIRE (writeTextFile (folder / "trial", "\n"));
    return folder;
}
}   // namespace

TEST_CASE ("an autosaved document survives a round trip")
{
    const auto document = changedWood();
    const auto read = readAutosave (writeAutosave (document));
    REQUIRE (read);
    CHECK (read->file == document.file);
    CHECK (read->preset == document.preset);
    CHECK (read->changed);
    CHECK (read->at_s == document.at_s);
    CHECK (read->graph == document.graph);
    const auto restored = restore (*read);
    CHECK (restored.problem.empty());
    CHECK (writeGraph (restored.graph) == document.graph);
    CHECK (restored.graph.folder == fs::path (wood_file).parent_path().string());
}

TEST_CASE ("a recovered graph finds its included graphs next to the file it came from")
{
    TemporaryFolder home;
    const auto* inner = R"({"format": "tactus-graph", "version": 1, "nodes": {"k": {"type": "signal.constant"}}, "wires": []})";
    REQUIRE (writeTextFile (home.path() / "inner.json", inner));
    const auto outer = readGraph (R"({"format": "tactus-graph", "version": 1, "nodes": {"in": {"type": "file:inner.json"}}, "wires": []})").graph;
    const auto restored = restore ({ home.path() / "outer.json", {}, true, 0.0, writeGraph (outer) });
    REQUIRE (restored.graph.files.contains ("inner.json"));
    CHECK (restored.graph.files.at ("inner.json")->root.find ("k") != nullptr);
}

TEST_CASE ("a session that ends normally leaves nothing behind")
{
    TemporaryFolder home;
    RecoverySession session (home.path());
    CHECK (session.problem().empty());
    CHECK (session.autosave (changedWood()));
    session.end();
    CHECK (findCrashedSessions (home.path()).empty());
    CHECK (fs::is_empty (home.path() / "sessions"));
}

TEST_CASE ("a running session is not taken for a crashed one, and a crashed one is found only once")
{
    TemporaryFolder home;
    {
        RecoverySession session (home.path());
        REQUIRE (session.autosave (changedWood()));
        CHECK (findCrashedSessions (home.path()).empty());
    }
    const auto found = findCrashedSessions (home.path());
    REQUIRE (found.size() == 1);
    CHECK (found[0].document().graph == changedWood().graph);
    CHECK_FALSE (found[0].endedInTrial());
    CHECK (findCrashedSessions (home.path()).empty());   // as seen by another instance that starts meanwhile
}

TEST_CASE ("a graph that was killed within seconds of its start is recovered without running first")
{
    TemporaryFolder home;
    killed (home.path(), writeAutosave (changedWood()), true);
    const auto found = findCrashedSessions (home.path());
    REQUIRE (found.size() == 1);
    CHECK (found[0].endedInTrial());
    const auto q = questionAbout (found[0], 1012.0);
    CHECK (q.safe_first);
    CHECK (q.can_recover);
    CHECK (q.text.find ("'Dry wood'") != std::string::npos);
    CHECK (q.text.find ("12 s ago") != std::string::npos);
}

TEST_CASE ("the trial marker exists only right after a start")
{
    TemporaryFolder home;
    {
        RecoverySession session (home.path());
        REQUIRE (session.autosave (changedWood()));
        session.beginTrial();
        CHECK (session.inTrial());
        session.endTrial();
        CHECK_FALSE (session.inTrial());
    }
    const auto found = findCrashedSessions (home.path());
    REQUIRE (found.size() == 1);
    CHECK_FALSE (questionAbout (found[0], 1000.0).safe_first);
}

TEST_CASE ("the user is not asked about a crash in which nothing was lost")
{
    TemporaryFolder home;
    auto same = changedWood();
    same.changed = false;
    const auto folder = killed (home.path(), writeAutosave (same));
    CHECK (findCrashedSessions (home.path()).empty());
    CHECK_FALSE (fs::exists (folder));
    killed (home.path(), writeAutosave (same), true);   // but the graph it was running may have caused the crash
    CHECK (findCrashedSessions (home.path()).size() == 1);
}

TEST_CASE ("with several crashed sessions, the latest comes first")
{
    TemporaryFolder home;
    for (const auto& [name, at] : { std::pair { "a", 5.0 }, std::pair { "b", 9.0 }, std::pair { "c", 7.0 } })
    {
        auto document = changedWood();
        document.at_s = at;
        killed (home.path(), writeAutosave (document), false, name);
    }
    const auto found = findCrashedSessions (home.path());
    REQUIRE (found.size() == 3);
    CHECK (found[0].document().at_s == 9.0);
    CHECK (found[1].document().at_s == 7.0);
    CHECK (found[2].document().at_s == 5.0);
}

TEST_CASE ("a truncated autosave is reported, and is not deleted")
{
    TemporaryFolder home;
    const auto whole = writeAutosave (changedWood());
    for (std::size_t n = 0; n + 2 < whole.size(); n += 7)
    {
        const auto folder = killed (home.path(), whole.substr (0, n));
        auto found = findCrashedSessions (home.path());
        REQUIRE (found.size() == 1);
        REQUIRE_FALSE (found[0].problem().empty());
        const auto q = questionAbout (found[0], 0.0);
        REQUIRE_FALSE (q.can_recover);
        REQUIRE (q.text.find (folder.string()) != std::string::npos);
        REQUIRE (fs::exists (folder / "kept.json"));
        found[0].discard();
        REQUIRE_FALSE (fs::exists (folder));
    }
}

TEST_CASE ("an autosave with any byte changed never crashes the program")
{
    TemporaryFolder home;
    const auto whole = writeAutosave (changedWood());
    for (std::size_t n = 0; n < whole.size(); n += 5)
    {
        auto text = whole;
        text[n] = static_cast<char> (text[n] ^ 0x15);
        killed (home.path(), text);
        for (auto& s : findCrashedSessions (home.path()))
        {
            REQUIRE_FALSE (questionAbout (s, 0.0).text.empty());
            s.discard();
        }
    }
}

TEST_CASE ("without a writable folder, the problem is reported once")
{
    TemporaryFolder home;
    REQUIRE (writeTextFile (home.path() / "sessions", "a file where the folder should be"));
    RecoverySession session (home.path());
    CHECK (session.problem().find ("TACTUS_HOME") != std::string::npos);
    CHECK_FALSE (session.autosave (changedWood()));
    session.beginTrial();
    CHECK_FALSE (session.inTrial());
    CHECK (findCrashedSessions (home.path()).empty());
}

TEST_CASE ("a session is not damaged by another instance that looks for crashed sessions while it starts")
{
    TemporaryFolder home;
    std::atomic<bool> stops { false };
    std::thread looking ([&] {
        while (! stops)
            findCrashedSessions (home.path());
    });
    for (int i = 0; i < 300; ++i)
    {
        RecoverySession session (home.path());
        const bool is_saved = session.problem().empty() && session.autosave (changedWood()) && fs::exists (session.folder() / "kept.json");
        session.end();
        if (! is_saved)
        {
            stops = true;
            looking.join();
        }
        REQUIRE (is_saved);
    }
    stops = true;
    looking.join();
}

TEST_CASE ("a link or a folder that another user can change is not a crashed session, and nothing is written or removed there")
{
    const TemporaryFolder home, outside;
    AutosavedDocument document;
    document.changed = true;
    for (const auto* session : { "linked", "open" })
        REQUIRE (writeTextFile (outside / session / "kept.json", writeAutosave (document)));
    fs::create_directory (home / "sessions");
    fs::create_directory_symlink (outside / "linked", home / "sessions/linked");
    fs::rename (outside / "open", home / "sessions/open");
    fs::permissions (home / "sessions/open", fs::perms::all);
    CHECK (findCrashedSessions (home.path()).empty());
    CHECK (fs::exists (home / "sessions/linked/kept.json"));
    CHECK_FALSE (fs::exists (outside / "linked/lock"));
    CHECK (fs::exists (home / "sessions/open/kept.json"));
}

TEST_CASE ("a recovered graph has the folder that its paths are relative to, which need not be that of its file")
{
    AutosavedDocument document { "/mine/one.json", {}, true, 0.0, writeGraph ({}) };
    CHECK (restore (document).graph.folder == "/mine");
    document.folder = "/presets";
    const auto read = readAutosave (writeAutosave (document));
    REQUIRE (read);
    CHECK (read->folder == "/presets");
    CHECK (restore (*read).graph.folder == "/presets");
}

TEST_CASE ("without a home folder, nothing is autosaved in the current folder")
{
    const TemporaryFolder folder;
    const auto current = fs::current_path();
    fs::current_path (folder.path());
    RecoverySession session { {} };
    const auto found = findCrashedSessions ({});
    fs::current_path (current);
    CHECK_FALSE (session.problem().empty());
    CHECK (found.empty());
    CHECK (folder.isEmpty());
}
