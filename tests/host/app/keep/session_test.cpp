// SPDX-License-Identifier: MIT
#include <host/app/keep/session.hpp>
#include <host/io/text_file.hpp>

#include "host/io/temporary_folder.hpp"

#include <framework/file/graph_file.hpp>

#include <atomic>
#include <thread>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
const std::string wood_file = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

Kept changedWood()
{
    auto graph = loadGraph (wood_file).graph;
    graph.root.nodes[1].params["stiffness"] = "3 N/mm";
    return { wood_file, {}, true, 1000.0, writeGraph (graph) };
}

/// What a run leaves that was killed: a folder whose lock nobody holds.
fs::path killed (const fs::path& home, const std::string& text, bool in_trial = false, const std::string& name = "killed")
{
    const auto folder = home / "sessions" / name;
    REQUIRE (! writeTextFile (folder / "kept.json", text));
    REQUIRE (! writeTextFile (folder / "lock", ""));
    if (in_trial) REQUIRE (! writeTextFile (folder / "trial", "\n"));
    return folder;
}
}   // namespace

TEST_CASE ("a document that is kept comes back as it was")
{
    const auto kept = changedWood();
    const auto read = readKept (writeKept (kept));
    CHECK (read.problem.empty());
    CHECK (read.kept.file == kept.file);
    CHECK (read.kept.preset == kept.preset);
    CHECK (read.kept.changed);
    CHECK (read.kept.at_s == kept.at_s);
    CHECK (read.kept.graph == kept.graph);
    const auto restored = restore (read.kept);
    CHECK (restored.problem.empty());
    CHECK (writeGraph (restored.graph) == kept.graph);
    CHECK (restored.graph.folder == fs::path (wood_file).parent_path().string());
}

TEST_CASE ("a recovered graph finds the graphs that it includes, beside the file it came from")
{
    TemporaryFolder home;
    REQUIRE (! writeTextFile (home.path() / "inner.json", R"({"format": "tactus-graph", "version": 1, "nodes": {"k": {"type": "signal.constant"}}, "wires": []})"));
    const auto outer = readGraph (R"({"format": "tactus-graph", "version": 1, "nodes": {"in": {"type": "file:inner.json"}}, "wires": []})").graph;
    const auto restored = restore ({ home.path() / "outer.json", {}, true, 0.0, writeGraph (outer) });
    REQUIRE (restored.graph.files.contains ("inner.json"));
    CHECK (restored.graph.files.at ("inner.json")->root.find ("k") != nullptr);
}

TEST_CASE ("a session that ended as it should leaves nothing behind")
{
    TemporaryFolder home;
    Session session (home.path());
    CHECK (session.problem().empty());
    CHECK (! session.keep (changedWood()));
    session.end();
    CHECK (leftoversIn (home.path()).empty());
    CHECK (fs::is_empty (home.path() / "sessions"));
}

TEST_CASE ("a session that lives is not taken for a leftover, and one that is gone is taken once")
{
    TemporaryFolder home;
    {
        Session session (home.path());
        REQUIRE (! session.keep (changedWood()));
        CHECK (leftoversIn (home.path()).empty());
    }
    const auto found = leftoversIn (home.path());
    REQUIRE (found.size() == 1);
    CHECK (found[0].kept().graph == changedWood().graph);
    CHECK_FALSE (found[0].endedInTrial());
    CHECK (leftoversIn (home.path()).empty());   // another instance that starts meanwhile
}

TEST_CASE ("what was killed within seconds of its start is not run at once when it is recovered")
{
    TemporaryFolder home;
    killed (home.path(), writeKept (changedWood()), true);
    const auto found = leftoversIn (home.path());
    REQUIRE (found.size() == 1);
    CHECK (found[0].endedInTrial());
    const auto q = questionAbout (found[0], 1012.0);
    CHECK (q.safe_first);
    CHECK (q.can_recover);
    CHECK (q.text.find ("'Dry wood'") != std::string::npos);
    CHECK (q.text.find ("12 s ago") != std::string::npos);
}

TEST_CASE ("the marker of a start is there only while the start is fresh")
{
    TemporaryFolder home;
    {
        Session session (home.path());
        REQUIRE (! session.keep (changedWood()));
        session.noteTrial();
        CHECK (session.isTrial());
        session.noteTrialIsOver();
        CHECK_FALSE (session.isTrial());
    }
    const auto found = leftoversIn (home.path());
    REQUIRE (found.size() == 1);
    CHECK_FALSE (questionAbout (found[0], 1000.0).safe_first);
}

TEST_CASE ("nobody is asked about a crash in which nothing was lost")
{
    TemporaryFolder home;
    auto same = changedWood();
    same.changed = false;
    const auto folder = killed (home.path(), writeKept (same));
    CHECK (leftoversIn (home.path()).empty());
    CHECK_FALSE (fs::exists (folder));
    killed (home.path(), writeKept (same), true);   // but what it ran may have done it
    CHECK (leftoversIn (home.path()).size() == 1);
}

TEST_CASE ("of several leftovers the latest comes first")
{
    TemporaryFolder home;
    for (const auto& [name, at] : { std::pair { "a", 5.0 }, std::pair { "b", 9.0 }, std::pair { "c", 7.0 } })
    {
        auto kept = changedWood();
        kept.at_s = at;
        killed (home.path(), writeKept (kept), false, name);
    }
    const auto found = leftoversIn (home.path());
    REQUIRE (found.size() == 3);
    CHECK (found[0].kept().at_s == 9.0);
    CHECK (found[1].kept().at_s == 7.0);
    CHECK (found[2].kept().at_s == 5.0);
}

TEST_CASE ("a kept file that was cut off anywhere is said, and is not thrown away")
{
    TemporaryFolder home;
    const auto whole = writeKept (changedWood());
    for (std::size_t n = 0; n + 2 < whole.size(); n += 7)
    {
        const auto folder = killed (home.path(), whole.substr (0, n));
        auto found = leftoversIn (home.path());
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

TEST_CASE ("a kept file with a byte changed anywhere never ends the program")
{
    TemporaryFolder home;
    const auto whole = writeKept (changedWood());
    for (std::size_t n = 0; n < whole.size(); n += 5)
    {
        auto text = whole;
        text[n] = static_cast<char> (text[n] ^ 0x15);
        killed (home.path(), text);
        for (auto& l : leftoversIn (home.path()))
        {
            REQUIRE_FALSE (questionAbout (l, 0.0).text.empty());
            l.discard();
        }
    }
}

TEST_CASE ("where nothing can be kept, that is said once and for all")
{
    TemporaryFolder home;
    REQUIRE (! writeTextFile (home.path() / "sessions", "a file where the folder should be"));
    Session session (home.path());
    CHECK (session.problem().find ("TACTUS_HOME") != std::string::npos);
    CHECK (session.keep (changedWood()));
    session.noteTrial();
    CHECK_FALSE (session.isTrial());
    CHECK (leftoversIn (home.path()).empty());
}

TEST_CASE ("sessions that begin while others look for leftovers stay whole")
{
    TemporaryFolder home;
    std::atomic<bool> stops { false };
    std::thread looking ([&]
                         {
        while (! stops)
            leftoversIn (home.path()); });
    for (int i = 0; i < 300; ++i)
    {
        Session session (home.path());
        const bool is_kept = session.problem().empty() && ! session.keep (changedWood()) && fs::exists (session.folder() / "kept.json");
        session.end();
        if (! is_kept)
        {
            stops = true;
            looking.join();
        }
        REQUIRE (is_kept);
    }
    stops = true;
    looking.join();
}
