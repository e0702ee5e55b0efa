// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/temporary_folder.hpp"

#include <host/app/window/files.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>

#include <sys/stat.h>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
const fs::path wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json", pad = TACTUS_SOURCE_DIR "/graphs/soft_pad.json";

/// The files of a window, without the window.
struct Rig
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    struct Default
    {
        explicit Default (Look& l) { juce::LookAndFeel::setDefaultLookAndFeel (&l); }
        ~Default() { juce::LookAndFeel::setDefaultLookAndFeel (nullptr); }
    } as_default { look };

    TemporaryFolder folder, own;
    const int own_is_set = setenv ("TACTUS_GRAPHS", own.path().c_str(), 1);
    Document document { graph::Graph {} };
    Question question;
    Settings settings;
    double now = 1000.0;
    bool runs = false, by_pointer = false;
    int starts = 0;
    juce::String notice;
    fs::path chosen;   // the file that the user picks when asked; empty: cancels
    std::unique_ptr<Files> files = make();

    std::unique_ptr<Files> make()
    {
        Files::Callbacks callbacks {
            .notify = [this] (const juce::String& t) { notice = t; },
            .stop = [this] { runs = false; },
            .run = [this] (bool pointer) {
                files->beforeRun();
                runs = true;
                by_pointer = pointer;
                ++starts; },
            .isRunning = [this] { return runs; },
            .isByPointer = [this] { return by_pointer; },
            .usePointer = [this] { by_pointer = true; },
            .openTake = {},
            .onSettings = [] {},
            .choose = [this] (bool, const fs::path&, const std::function<void (const fs::path&)>& then) {
                if (! chosen.empty()) then (chosen); }
        };
        auto made = std::make_unique<Files> (document, question, settings, std::move (callbacks));
        made->clock = [this] { return now; };
        return made;
    }

    void edit (double mu) { REQUIRE (document.perform (graph::SetParam { "", "drag", "mu", Json (mu) })); }

    /// Reads what another instance would find if this one were killed now.
    std::optional<AutosavedDocument> autosaved() const
    {
        for (const auto& entry : fs::directory_iterator (folder / "sessions"))
            if (const auto text = readTextFile (entry.path() / "kept.json")) return *readAutosave (*text);
        return std::nullopt;
    }
    bool isInTrial() const
    {
        for (const auto& entry : fs::directory_iterator (folder / "sessions"))
            if (fs::exists (entry.path() / "trial")) return true;
        return false;
    }
};
}   // namespace

TEST_CASE ("an opened file runs, is listed as recent, and needs no question")
{
    Rig d;
    d.files->open (wood);
    CHECK_FALSE (d.question.isOpen());
    CHECK (d.document.graph().name == "Dry wood");
    CHECK (d.document.file() == wood);
    CHECK (d.runs);
    CHECK (d.settings.recent == std::vector { wood });
}

TEST_CASE ("a preset is opened as a copy: saving asks for a file, and the preset is unchanged")
{
    Rig d;
    const auto before = readTextFile (wood);
    d.files->openCopy (wood, true);
    CHECK (d.by_pointer);
    CHECK (d.settings.recent.empty());
    d.edit (0.9);
    d.files->save();
    CHECK (d.document.isChanged());   // no file was chosen
    d.chosen = d.folder / "mine";
    d.files->save();
    CHECK (d.document.file() == d.folder / "mine.json");
    CHECK_FALSE (d.document.isChanged());
    CHECK (loadGraph (d.folder / "mine.json").graph.root.find ("drag")->params["mu"] == 0.9);
    CHECK (readTextFile (wood) == before);
}

TEST_CASE ("a copy of a shipped preset cannot be saved over the preset")
{
    TemporaryFolder presets;
    fs::copy_file (wood, presets / "dry_wood.json");
    setenv ("TACTUS_PRESETS", presets.path().c_str(), 1);
    Rig d;
    const auto before = presets.textOf ("dry_wood.json");
    d.files->openCopy (presets / "dry_wood.json", false);
    d.edit (0.9);
    d.chosen = presets / "dry_wood.json";
    d.files->save();
    CHECK (d.question.title() == "The graph was not saved");
    CHECK (d.document.isChanged());
    d.question.cancel();
    CHECK (presets.textOf ("dry_wood.json") == before);

    d.files->open (presets / "dry_wood.json");   // opened as a file, it can be saved
    d.question.answer (1);
    d.edit (0.8);
    d.files->save();
    CHECK (presets.textOf ("dry_wood.json") != before);
    unsetenv ("TACTUS_PRESETS");
}

TEST_CASE ("opening another graph asks about unsaved changes, and Cancel changes nothing")
{
    Rig d;
    d.files->open (wood);
    d.edit (0.9);
    const auto edited = writeGraph (d.document.graph());
    const int starts = d.starts;
    const std::vector<std::function<void()>> acts { [&] { d.files->open (pad); }, [&] { d.files->create(); }, [&] { d.files->openCopy (pad, false); } };
    for (const auto& act : acts)
    {
        act();
        REQUIRE (d.question.isOpen());
        CHECK (d.question.title().contains ("Dry wood"));
        d.question.cancel();
        CHECK (writeGraph (d.document.graph()) == edited);
        CHECK (d.starts == starts);
    }
}

TEST_CASE ("Don't save continues, and undo brings back the unsaved changes")
{
    Rig d;
    d.files->open (wood);
    d.edit (0.9);
    d.files->open (pad);
    d.question.answer (1);
    CHECK (d.document.graph().name == "Soft pad");
    d.document.undo();
    CHECK (d.document.graph().root.find ("drag")->params["mu"] == 0.9);
    CHECK (d.document.file() == wood);
}

TEST_CASE ("Save saves and continues, and if saving fails, it does not continue")
{
    Rig d;
    d.files->openCopy (wood, false);
    d.edit (0.9);
    d.files->open (pad);
    d.chosen = d.folder / "nowhere" / "mine.json";
    d.question.answer (0);
    CHECK (d.question.title() == "The graph was not saved");
    CHECK (d.document.graph().name == "Dry wood");
    CHECK (d.document.isChanged());

    d.chosen = d.folder / "mine.json";
    d.question.answer (0);   // "Save as ..." asks for a file, then continues
    CHECK (d.document.graph().name == "Soft pad");
    CHECK (loadGraph (d.folder / "mine.json").graph.root.find ("drag")->params["mu"] == 0.9);
}

TEST_CASE ("a dialog says with line and column why a file cannot be opened, and the open graph stays")
{
    Rig d;
    d.files->open (wood);
    d.folder.write ("torn.json", "{\n  \"format\": \"tactus-graph\",\n  \"version\": 1, oops\n}");
    d.files->open (d.folder / "torn.json");
    REQUIRE (d.question.isOpen());
    CHECK (d.question.title() == "Cannot open torn.json");
    CHECK (d.question.getDescription().startsWith ("Line 3, column 17: "));
    CHECK (d.document.graph().name == "Dry wood");
    CHECK (d.runs);

    d.chosen = pad;
    d.question.answer (0);   // "Open another file ..."
    CHECK_FALSE (d.question.isOpen());
    CHECK (d.document.graph().name == "Soft pad");
}

TEST_CASE ("the dialog about a file with many errors shows the first four and counts the others")
{
    Rig d;
    d.folder.write ("many.json", R"({ "format": "tactus-graph", "version": 2, "nodes": { "a": 1, "b": 1, "c": 1, "d": 1, "e": 1, "f": 1 } })");
    const auto messages = loadGraph (d.folder / "many.json").messages;
    const auto errors = std::ranges::count (messages, Message::Severity::error, &Message::severity);
    REQUIRE (errors > 4);
    d.files->open (d.folder / "many.json");
    CHECK (d.question.getDescription().contains ("There are " + juce::String (static_cast<int> (errors) - 4) + " more errors."));
}

TEST_CASE ("a question that is asked while another one is open comes after it")
{
    Rig d;
    juce::String answers;
    d.question.ask ("first", "", { { "a", [&] { answers << "a"; } }, { "b", {} } });
    d.question.ask ("second", "", { { "c", [&] { answers << "c"; } }, { "d", {} } });
    CHECK (d.question.title() == "first");
    d.question.answer (0);
    REQUIRE (d.question.isOpen());
    CHECK (d.question.title() == "second");
    d.question.answer (0);
    CHECK_FALSE (d.question.isOpen());
    CHECK (answers == "ac");
}

TEST_CASE ("a recent file that no longer exists can be removed from the list where it fails to open")
{
    Rig d;
    fs::copy_file (pad, d.folder / "mine.json");
    d.files->open (d.folder / "mine.json");
    REQUIRE (d.settings.recent.size() == 1);
    fs::remove (d.folder / "mine.json");
    d.files->open (d.folder / "mine.json");
    REQUIRE (d.question.isOpen());
    REQUIRE (d.question.size() == 3);
    d.question.answer (1);
    CHECK (d.settings.recent.empty());
    CHECK_FALSE (d.question.isOpen());
}

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

TEST_CASE ("writing an autosave does not keep the thread of the window")
{
    Rig d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.runs = false;
    d.files->finishAutosave();
    // A pipe in place of the file that is written: whoever writes it waits for a reader.
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

TEST_CASE ("a file that another program has changed is replaced only if the person says so", "[files]")
{
    TemporaryFolder folder;
    const auto file = folder / "mine.json";
    REQUIRE (saveGraph (loadGraph (wood).graph, file));
    Rig d;
    d.files->open (file);
    d.edit (0.5);
    d.files->save();
    CHECK_FALSE (d.question.isOpen());   // only this window has written to it
    const auto written = *readTextFile (file);

    const auto theirs = written + "\n";
    REQUIRE (writeTextFile (file, theirs));
    d.edit (0.6);
    SECTION ("Cancel keeps both")
    {
        d.files->save();
        REQUIRE (d.question.isOpen());
        CHECK (d.question.title().contains ("has been changed"));
        d.question.cancel();
        CHECK (*readTextFile (file) == theirs);
        CHECK (d.document.isChanged());
    }
    SECTION ("Replace saves, and then the file is known")
    {
        bool went_on = false;
        d.files->save ([&] { went_on = true; });
        REQUIRE (d.question.isOpen());
        CHECK_FALSE (went_on);
        d.question.answer (1);
        CHECK (went_on);
        CHECK (*readTextFile (file) != theirs);
        CHECK_FALSE (d.document.isChanged());
        d.edit (0.7);
        d.files->save();
        CHECK_FALSE (d.question.isOpen());
    }
    SECTION ("a file that is gone is written again")
    {
        fs::remove (file);
        d.files->save();
        CHECK_FALSE (d.question.isOpen());
        CHECK (fs::exists (file));
    }
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

TEST_CASE ("an opened clip becomes an unsaved graph that plays the clip, and a damaged clip is refused")
{
    Rig d;
    const fs::path heart = TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic", zip = TACTUS_SOURCE_DIR "/graphs/assets/zip.json";
    d.files->open (heart);
    CHECK (d.runs);
    CHECK (d.document.file().empty());
    CHECK (d.document.graph().root.find ("clip")->settings.at ("clip") == Json ("heartbeat.haptic"));
    d.files->open (zip);   // a .json that is a clip
    CHECK (d.document.graph().root.find ("clip")->settings.at ("clip") == Json ("zip.json"));

    d.chosen = d.folder / "mine.json";
    d.files->save();
    CHECK (fs::exists (d.folder / "zip.json"));   // the clip is copied along
    std::ofstream (d.folder / "broken.haptic") << "{}";
    d.files->open (d.folder / "broken.haptic");
    CHECK (d.question.title() == "Cannot open broken.haptic");
    CHECK (d.document.graph().name == "Mine");   // as its file
    d.question.cancel();
}
