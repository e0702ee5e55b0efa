// SPDX-License-Identifier: MIT
#include <host/app/window/files.hpp>
#include <host/io/text_file.hpp>

#include "host/io/temporary_folder.hpp"

#include <framework/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
const fs::path wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json", pad = TACTUS_SOURCE_DIR "/graphs/soft_pad.json";

/// The files of a window without the window.
struct Desk
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
    juce::String said;
    fs::path chosen;   // what a person chooses who is asked; empty: nothing
    std::unique_ptr<Files> files = make();

    std::unique_ptr<Files> make()
    {
        auto made = std::make_unique<Files> (document, question, settings, Files::Ways { [this] (const juce::String& t)
                                                                                         { said = t; },
                                                                                         [this]
                                                                                         { runs = false; },
                                                                                         [this] (bool pointer)
                                                                                         {
                                                                                             files->beforeRun();
                                                                                             runs = true;
                                                                                             by_pointer = pointer;
                                                                                             ++starts; },
                                                                                         [this]
                                                                                         { return runs; },
                                                                                         [] {}, [this] (bool, const fs::path&, std::function<void (const fs::path&)> then)
                                                                                         {
                                                                                             if (! chosen.empty()) then (chosen); } });
        made->clock = [this]
        { return now; };
        return made;
    }

    void edit (double mu) { REQUIRE (document.perform (graph::SetParam { "", "drag", "mu", Json (mu) })); }

    /// Reads what another run would find if this one was killed now.
    std::optional<Kept> keptNow() const
    {
        for (const auto& entry : fs::directory_iterator (folder / "sessions"))
            if (const auto text = readTextFile (entry.path() / "kept.json")) return readKept (*text).kept;
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

TEST_CASE ("what is opened runs, is recent, and is not asked about")
{
    Desk d;
    d.files->open (wood);
    CHECK_FALSE (d.question.isOpen());
    CHECK (d.document.graph().name == "Dry wood");
    CHECK (d.document.file() == wood);
    CHECK (d.runs);
    CHECK (d.settings.recent == std::vector { wood });
}

TEST_CASE ("a preset is opened as a copy: saving it asks where to, and leaves the preset as it is")
{
    Desk d;
    const auto before = readTextFile (wood);
    d.files->openCopy (wood, true);
    CHECK (d.by_pointer);
    CHECK (d.settings.recent.empty());
    d.edit (0.9);
    d.files->save();
    CHECK (d.document.isChanged());   // nobody chose a file
    d.chosen = d.folder / "mine";
    d.files->save();
    CHECK (d.document.file() == d.folder / "mine.json");
    CHECK_FALSE (d.document.isChanged());
    CHECK (loadGraph (d.folder / "mine.json").graph.root.find ("drag")->params["mu"] == 0.9);
    CHECK (readTextFile (wood) == before);
}

TEST_CASE ("a preset that comes with Tactus is not written over by a copy of it")
{
    TemporaryFolder presets;
    fs::copy_file (wood, presets / "dry_wood.json");
    setenv ("TACTUS_PRESETS", presets.path().c_str(), 1);
    Desk d;
    const auto before = presets.textOf ("dry_wood.json");
    d.files->openCopy (presets / "dry_wood.json", false);
    d.edit (0.9);
    d.chosen = presets / "dry_wood.json";
    d.files->save();
    CHECK (d.said.startsWith ("Not saved"));
    CHECK (d.document.isChanged());
    CHECK (presets.textOf ("dry_wood.json") == before);

    d.files->open (presets / "dry_wood.json");   // but who opens it as a file means it
    d.question.answer (1);
    d.edit (0.8);
    d.files->save();
    CHECK (presets.textOf ("dry_wood.json") != before);
    unsetenv ("TACTUS_PRESETS");
}

TEST_CASE ("changes are asked about before another graph comes, and Cancel leaves all as it is")
{
    Desk d;
    d.files->open (wood);
    d.edit (0.9);
    const auto edited = writeGraph (d.document.graph());
    const int starts = d.starts;
    for (const auto& act : std::vector<std::function<void()>> { [&]
                                                                { d.files->open (pad); },
                                                                [&]
                                                                { d.files->create(); },
                                                                [&]
                                                                { d.files->openCopy (pad, false); } })
    {
        act();
        REQUIRE (d.question.isOpen());
        CHECK (d.question.title().contains ("Dry wood"));
        d.question.cancel();
        CHECK (writeGraph (d.document.graph()) == edited);
        CHECK (d.starts == starts);
    }
}

TEST_CASE ("Don't save goes on, and undo brings back what was not saved")
{
    Desk d;
    d.files->open (wood);
    d.edit (0.9);
    d.files->open (pad);
    d.question.answer (1);
    CHECK (d.document.graph().name == "Soft pad");
    d.document.undo();
    CHECK (d.document.graph().root.find ("drag")->params["mu"] == 0.9);
    CHECK (d.document.file() == wood);
}

TEST_CASE ("Save saves and goes on; where it cannot be saved, nothing goes on")
{
    Desk d;
    d.files->openCopy (wood, false);
    d.edit (0.9);
    d.files->open (pad);
    d.chosen = d.folder / "nowhere" / "mine.json";
    d.question.answer (0);
    CHECK (d.said.startsWith ("Not saved"));
    CHECK (d.document.graph().name == "Dry wood");
    CHECK (d.document.isChanged());

    d.chosen = d.folder / "mine.json";
    d.files->open (pad);
    d.question.answer (0);
    CHECK (d.document.graph().name == "Soft pad");
    CHECK (loadGraph (d.folder / "mine.json").graph.root.find ("drag")->params["mu"] == 0.9);
}

TEST_CASE ("a file that cannot be read is said with its place, and what is open stays")
{
    Desk d;
    d.files->open (wood);
    d.folder.write ("torn.json", "{\n  \"format\": \"tactus-graph\",\n  \"version\": 1, oops\n}");
    d.files->open (d.folder / "torn.json");
    CHECK (d.said.startsWith ("torn.json:3:"));
    CHECK (d.document.graph().name == "Dry wood");
    CHECK (d.runs);
}

TEST_CASE ("a second after each edit what is kept is the document")
{
    Desk d;
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
        d.now += 1.1;
        d.files->attend();
        const auto kept = d.keptNow();
        REQUIRE (kept);
        REQUIRE (kept->graph == writeGraph (d.document.graph()));
        REQUIRE (kept->changed == d.document.isChanged());
        REQUIRE (kept->file == d.document.file());
    }
}

TEST_CASE ("a drag is not written to the disk with each of its steps")
{
    Desk d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.runs = false;
    const auto before = d.keptNow()->graph;
    d.edit (0.9);
    d.now += 0.5;
    d.files->attend();
    CHECK (d.keptNow()->graph == before);
}

TEST_CASE ("an edit while it runs is kept before it runs, and is a trial for ten seconds")
{
    Desk d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    CHECK (d.isInTrial());
    d.now += 11.0;
    d.files->attend();
    CHECK_FALSE (d.isInTrial());

    d.edit (0.9);
    CHECK (d.isInTrial());
    CHECK (d.keptNow()->graph == writeGraph (d.document.graph()));
    d.now += 5.0;
    d.files->attend();
    CHECK (d.isInTrial());
    d.runs = false;   // stopped by a person: it did not end the program
    d.files->attend();
    CHECK_FALSE (d.isInTrial());
}

TEST_CASE ("a crash is recovered, unsaved, as a step that can be undone")
{
    TemporaryFolder home;
    auto graph = loadGraph (wood).graph;
    graph.root.nodes[2].params["mu"] = 0.77;
    const auto folder = home / "sessions" / "gone";
    REQUIRE (! writeTextFile (folder / "kept.json", writeKept ({ wood, {}, true, 988.0, writeGraph (graph) })));

    Desk d;
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    REQUIRE (d.question.isOpen());
    d.question.answer (0);
    CHECK (writeGraph (d.document.graph()) == writeGraph (graph));
    CHECK (d.document.file() == wood);
    CHECK (d.document.isChanged());
    CHECK (d.runs);
    CHECK (d.document.history().names().back() == "recover Dry wood");
    CHECK_FALSE (fs::exists (folder));
    d.files->end();
    CHECK (fs::is_empty (home / "sessions"));
}

TEST_CASE ("what was killed as it started does not run until START is pressed")
{
    TemporaryFolder home;
    const auto folder = home / "sessions" / "gone";
    REQUIRE (! writeTextFile (folder / "kept.json", writeKept ({ wood, {}, false, 988.0, writeGraph (loadGraph (wood).graph) })));
    REQUIRE (! writeTextFile (folder / "trial", "\n"));
    Desk d;
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    d.question.answer (0);   // the one that Return takes
    CHECK (d.document.graph().name == "Dry wood");
    CHECK_FALSE (d.runs);
    CHECK (d.said.contains ("START"));
    CHECK_FALSE (d.document.isChanged());
}

TEST_CASE ("in safe mode nothing that is opened or recovered runs")
{
    TemporaryFolder home;
    REQUIRE (! writeTextFile (home / "sessions" / "gone" / "kept.json", writeKept ({ wood, {}, true, 988.0, writeGraph (loadGraph (wood).graph) })));
    Desk d;
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

TEST_CASE ("Later keeps what a crash left for the next start, Discard does not")
{
    TemporaryFolder home;
    const auto folder = home / "sessions" / "gone";
    REQUIRE (! writeTextFile (folder / "kept.json", writeKept ({ wood, {}, true, 988.0, writeGraph (loadGraph (wood).graph) })));
    Desk d;
    d.files->beginSession (home.path());
    REQUIRE (d.files->recover());
    d.question.cancel();
    CHECK (fs::exists (folder));
    REQUIRE (d.files->recover());
    d.question.answer (2);
    CHECK_FALSE (fs::exists (folder));
    CHECK_FALSE (d.files->recover());
}

TEST_CASE ("a program that has to end at once keeps what is not saved, and only that")
{
    Desk d;
    d.files->beginSession (d.folder.path());
    d.files->open (wood);
    d.edit (0.9);
    d.files->endSuddenly();
    const auto left = leftoversIn (d.folder.path());
    REQUIRE (left.size() == 1);
    CHECK (left[0].kept().graph == writeGraph (d.document.graph()));
    CHECK_FALSE (left[0].endedInTrial());

    Desk e;
    e.files->beginSession (e.folder.path());
    e.files->open (wood);
    e.files->endSuddenly();
    CHECK (fs::is_empty (e.folder / "sessions"));
}
