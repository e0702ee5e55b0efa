// SPDX-License-Identifier: GPL-3.0-or-later
// Autosaves, and what is recovered after a crash.
#include "host/app/support/files_rig.hpp"
#include "support/waiting.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/plan/compile.hpp>

#include <fstream>
#include <iterator>
#include <random>

#include <sys/stat.h>

using namespace tactus;
using namespace tactus::host;
using host::test::pad;
using host::test::wood;
using Rig = host::test::FilesRig;
namespace fs = std::filesystem;

TEST_CASE ("after each edit, the autosave matches the document, without waiting for more edits")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.runs = false;
    std::mt19937 chance (5);
    for (int i = 0; i < 30; ++i)
    {
        switch (chance() % 4)
        {
        case 0:
            d.document.undo();
            break;
        case 1:
            d.document.redo();
            break;
        default:
            if (d.document.graph().root.find ("drag") != nullptr) d.edit (0.01 * i);
        }
        d.files->finishAutosave();
        const auto saved = d.autosaved();
        REQUIRE (saved);
        REQUIRE (saved->graph == writeGraph (d.document.graph()));
        REQUIRE (saved->changed == d.document.isChanged());
        REQUIRE (saved->file == d.document.file());
    }
}

TEST_CASE ("an autosave holds what panels keep in a file, such as the scopes, which alone are no change")
{
    Rig d;
    d.keep = [] (graph::Graph& g) { g.extra["ui"]["scopes"] = Json::array ({ Json { { "kind", "spectrum" } } }); };
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.runs = false;
    const auto isKept = [&] {
        const auto saved = d.autosaved();
        REQUIRE (saved);
        const auto restored = restore (*saved);
        CHECK (restored.problem.empty());
        CHECK (saved->changed == d.document.isChanged());
        return restored.graph.extra.value ("ui", Json::object()).contains ("scopes");
    };
    d.edit (0.25);
    d.files->finishAutosave();
    CHECK (isKept());
    d.document.undo();
    d.files->finishAutosave();
    CHECK (isKept());
    d.files->beforeRun();   // this one is written at once
    CHECK (isKept());
}

TEST_CASE ("a drag is autosaved while it goes on: a step that comes while another one is being written is written next")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.runs = false;
    for (int i = 0; i < 300; ++i)
    {
        d.edit (1e-3 * i);
        if (i % 10 == 0) d.files->poll();
    }
    d.files->finishAutosave();
    CHECK (d.autosaved()->graph == writeGraph (d.document.graph()));
}

TEST_CASE ("a step that goes on is autosaved twice a second, and all of it at the end")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.runs = false;
    d.edit (0.5);
    int autosaves = 0;
    std::string last;
    for (int i = 0; i < 200; ++i)   // for two seconds
    {
        d.now += 0.01;
        REQUIRE (d.document.perform (graph::SetParam { "", "drag", "mu", Json (0.5 + 1e-3 * i) }, graph::Step::joined));
        d.files->poll();
        REQUIRE (tactus::test::eventually ([&] { return ! d.files->isWriting(); }));
        if (const auto now = d.autosaved()->graph; now != last)
        {
            ++autosaves;
            last = now;
        }
    }
    CHECK (autosaves >= 4);
    CHECK (autosaves <= 6);
    d.now += 0.5;
    d.files->poll();
    REQUIRE (tactus::test::eventually ([&] { return ! d.files->isWriting(); }));
    CHECK (d.autosaved()->graph == writeGraph (d.document.graph()));
}

TEST_CASE ("writing an autosave does not keep the thread of the window")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.runs = false;
    d.files->finishAutosave();
    // A pipe takes the place of the file: the thread that writes it waits until somebody reads.
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (d.folder / "sessions", failed))
    {
        fs::remove (entry.path() / "kept.json", failed);
        REQUIRE (mkfifo ((entry.path() / "kept.json").c_str(), 0600) == 0);
    }
    d.edit (0.9);
    d.edit (0.8);
    d.files->poll();   // returns, as do the edits
    for (const auto& entry : fs::directory_iterator (d.folder / "sessions", failed))
    {
        std::ifstream reader (entry.path() / "kept.json");
        const std::string text { std::istreambuf_iterator<char> (reader), {} };
        CHECK (readAutosave (text));
        fs::remove (entry.path() / "kept.json", failed);
    }
    d.files->finishAutosave();
    CHECK (d.autosaved()->graph == writeGraph (d.document.graph()));
}

TEST_CASE ("an edit during a run is autosaved before it runs, and counts as a trial for ten seconds")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    CHECK (d.isInTrial());
    d.now += 11.0;
    d.files->poll();
    CHECK_FALSE (d.isInTrial());

    d.edit (0.9);
    CHECK (d.isInTrial());
    CHECK (d.autosaved()->graph == writeGraph (d.document.graph()));
    d.now += 5.0;
    d.files->poll();
    CHECK (d.isInTrial());
    d.runs = false;   // stopped by the user: it did not crash the program
    d.files->poll();
    CHECK_FALSE (d.isInTrial());
}

TEST_CASE ("a recovered document is unsaved, and no undo takes it away")
{
    TemporaryFolder home;
    auto graph = loadGraph (wood).graph;
    graph.root.nodes[2].params["mu"] = 0.77;
    const auto folder = home / "sessions" / "gone";
    REQUIRE (writeTextFile (folder / "kept.json", writeAutosave ({ wood, {}, true, 988.0, writeGraph (graph) })));

    Rig d;
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    REQUIRE (d.question.isOpen());
    d.question.answer (0);
    CHECK (writeGraph (d.document.graph()) == writeGraph (graph));
    CHECK (d.document.file() == wood);
    CHECK (d.document.isChanged());
    CHECK (d.runs);
    CHECK (d.document.history().size() == 0);
    d.document.undo();
    CHECK (writeGraph (d.document.graph()) == writeGraph (graph));
    CHECK (d.document.isChanged());
    CHECK_FALSE (fs::exists (folder));
    d.files->end();
    CHECK (fs::is_empty (home / "sessions"));
}

TEST_CASE ("after a crash, what another program has written into the file meanwhile is not replaced without a question")
{
    for (const bool is_changed : { true, false })
    {
        CAPTURE (is_changed);
        TemporaryFolder home, mine;
        const auto file = mine / "mine.json";
        fs::copy_file (wood, file);
        {
            Rig d;
            d.files->beginSession (home.path());
            d.files->open (file);
            REQUIRE (d.document.perform (graph::SetParam { "", "drag", "mu", Json (0.77) }));
            d.files->finishAutosave();
            d.files->endSuddenly();
        }
        auto other = loadGraph (wood).graph;
        other.name = "by another program";
        if (is_changed) REQUIRE (writeTextFile (file, writeGraph (other)));
        Rig d;
        d.files->beginSession (home.path());
        REQUIRE (d.files->recover());
        d.question.answer (1);
        REQUIRE_FALSE (d.question.isOpen());
        d.files->save();
        CHECK (d.question.isOpen() == is_changed);
        CHECK ((loadGraph (file).graph.name == "by another program") == is_changed);
    }
}

TEST_CASE ("after a crash, nothing but the mouse moves the tool if the mouse moved it before")
{
    for (const bool by_pointer : { true, false })
        for (const std::size_t answer : { 0U, 1U })   // Recover, Recover without running
        {
            CAPTURE (by_pointer, answer);
            TemporaryFolder home;
            {
                Rig d;
                d.files->beginSession (home.path());
                d.files->openCopy (wood, false);
                REQUIRE (d.document.perform (graph::SetParam { "", "drag", "mu", Json (0.77) }));
                d.by_pointer = by_pointer;   // chosen in the window, which is no edit
                d.files->poll();
                d.files->finishAutosave();
                d.files->endSuddenly (true);
            }
            Rig d;
            d.files->beginSession (home.path());
            REQUIRE (d.files->recover());
            d.question.answer (answer);
            CHECK (d.runs == (answer == 0));
            CHECK (d.by_pointer == by_pointer);
        }
}

TEST_CASE ("a graph that was stopped before a crash does not run after it")
{
    TemporaryFolder home;
    {
        Rig d;
        d.files->beginSession (home.path());
        d.files->openCopy (wood, false);
        d.runs = false;   // STOP, or a stop that holds the forces at zero
        d.now += 60.0;
        d.files->poll();
        REQUIRE (d.document.perform (graph::SetParam { "", "drag", "mu", Json (0.77) }));
        d.files->finishAutosave();
        d.files->endSuddenly (true);
    }
    Rig d;
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    d.question.answer (0);
    CHECK (d.document.graph().root.find ("drag")->params["mu"] == 0.77);
    CHECK (d.starts == 0);
}

TEST_CASE ("a graph that was killed as it started does not run until START is pressed")
{
    TemporaryFolder home;
    const auto folder = home / "sessions" / "gone";
    REQUIRE (writeTextFile (folder / "kept.json", writeAutosave ({ wood, {}, false, 988.0, writeGraph (loadGraph (wood).graph) })));
    REQUIRE (writeTextFile (folder / "trial", "\n"));
    Rig d;
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    d.question.answer (0);   // the choice that Return picks
    CHECK (d.document.graph().name == "Dry wood");
    CHECK_FALSE (d.runs);
    CHECK (d.notice.contains ("START"));
    CHECK_FALSE (d.document.isChanged());
}

TEST_CASE ("in safe mode, opened and recovered graphs do not run")
{
    TemporaryFolder home;
    REQUIRE (writeTextFile (home / "sessions" / "gone" / "kept.json", writeAutosave ({ wood, {}, true, 988.0, writeGraph (loadGraph (wood).graph) })));
    Rig d;
    d.files->setSafe (true);
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    CHECK (d.question.size() == 3);
    d.question.answer (0);
    CHECK_FALSE (d.runs);
    d.files->openCopy (pad, true);
    d.question.answer (1);
    CHECK (d.document.graph().name == "Soft pad");
    CHECK_FALSE (d.runs);
}

TEST_CASE ("Later keeps a crashed session for the next start, Discard deletes it")
{
    TemporaryFolder home;
    const auto folder = home / "sessions" / "gone";
    REQUIRE (writeTextFile (folder / "kept.json", writeAutosave ({ wood, {}, true, 988.0, writeGraph (loadGraph (wood).graph) })));
    Rig d;
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    d.question.cancel();
    CHECK (fs::exists (folder));
    REQUIRE (d.files->recover());
    d.question.answer (2);
    CHECK_FALSE (fs::exists (folder));
    CHECK_FALSE (d.files->recover());
}

TEST_CASE ("a program that must close suddenly autosaves unsaved changes, and nothing else")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.edit (0.9);
    d.files->endSuddenly();
    const auto left = findCrashedSessions (d.folder.path());
    REQUIRE (left.size() == 1);
    CHECK (left[0].document().graph == writeGraph (d.document.graph()));
    CHECK_FALSE (left[0].endedInTrial());

    Rig e;
    e.files->beginSession (e.folder.path());
    e.files->open (wood);
    e.files->endSuddenly();
    CHECK (fs::is_empty (e.folder / "sessions"));
}

TEST_CASE ("an unsaved graph that is recovered finds its clip again", "[app][files][recovery]")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic");   // a graph that plays it, without a file
    REQUIRE (d.document.perform (graph::SetHeader { .name = "Mine" }));
    d.files->finishAutosave();
    d.files->endSuddenly();
    auto crashed = findCrashedSessions (d.folder.path());
    REQUIRE (crashed.size() == 1);
    const auto restored = restore (crashed.front().document()).graph;
    FileAssets assets;
    CHECK (compile (restored, catalogue(), { .assets = &assets }).plan != nullptr);
}
