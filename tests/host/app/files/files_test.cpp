// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/files_rig.hpp"

#include <fstream>
#include <set>

using namespace tactus;
using namespace tactus::host;
using host::test::pad;
using host::test::wood;
using Rig = host::test::FilesRig;
namespace fs = std::filesystem;

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
    CHECK_FALSE (d.question.getDescription().trimStart().startsWithChar (':'));   // where the message names no file
    CHECK (d.question.getDescription().contains ("there is no folder"));
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
    SECTION ("the file can be reloaded: it runs by the same hand if the graph ran, and undo brings back what was not saved")
    {
        const bool ran = GENERATE (false, true), by_pointer = GENERATE (false, true);
        d.runs = ran;
        d.by_pointer = by_pointer;
        const int starts = d.starts;
        d.files->save();
        REQUIRE (d.question.isOpen());
        d.question.answer (2);
        CHECK (d.starts == starts + (ran ? 1 : 0));
        CHECK (d.by_pointer == by_pointer);
        CHECK (*readTextFile (file) == theirs);
        CHECK_FALSE (d.document.isChanged());
        CHECK (d.document.file() == file);
        CHECK (d.document.graph().root.find ("drag")->params["mu"] == 0.5);
        d.document.undo();
        CHECK (d.document.graph().root.find ("drag")->params["mu"] == 0.6);
    }
    SECTION ("a file that is gone is written again")
    {
        fs::remove (file);
        d.files->save();
        CHECK_FALSE (d.question.isOpen());
        CHECK (fs::exists (file));
    }
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
    d.question.answer (0);
    CHECK (fs::exists (d.folder / "zip.json"));   // the clip is copied along
    std::ofstream (d.folder / "broken.haptic") << "{}";
    d.files->open (d.folder / "broken.haptic");
    CHECK (d.question.title() == "Cannot open broken.haptic");
    CHECK (d.document.graph().name == "Mine");   // as its file
    d.question.cancel();
}

namespace
{
/// The files in a folder and below it.
std::set<std::string> filesIn (const fs::path& folder)
{
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator (folder))
        if (! entry.is_directory()) names.insert (entry.path().lexically_relative (folder).generic_string());
    return names;
}

/// An environment variable for the length of a test.
class SetVariable
{
public:
    SetVariable (const char* n, const fs::path& value) : name (n) { setenv (name, value.c_str(), 1); }
    ~SetVariable() { unsetenv (name); }
    SetVariable (const SetVariable&) = delete;
    SetVariable& operator= (const SetVariable&) = delete;

private:
    const char* name;
};

constexpr auto clip_text = R"({"format": "tactus-clip", "version": 1, "tracks": [{"continuous": [{"from": 0, "to": 0.1}]}]})";
}   // namespace

TEST_CASE ("a graph of a stranger brings its own recordings, pictures and tables into the home folder, and no other files")
{
    TemporaryFolder theirs, home;
    const SetVariable settings ("TACTUS_HOME", home / "Tactus"), profiles ("TACTUS_PROFILES", home / "boards"), plugins ("TACTUS_PLUGINS", home / "lab");
    Json strings = Json::array(), nodes = Json::object();
    const auto bring = [&] (const std::string& name, const std::string& text) {
        fs::create_directories ((theirs / name).parent_path());
        theirs.write (name, text);
        strings.push_back (name);
        const auto add = [&] (const std::string& type, Json written) {
            nodes["n" + std::to_string (nodes.size())] = Json { { "type", type }, { "settings", std::move (written) } };
        };
        add ("signal.clip", { { "clip", name } });
        add ("texture.height_map", { { "map", { { "image", name }, { "csv", name } } } });
        add ("vibration.wavetable", { { "table", { { "wav", name } } } });
        add ("deform.surface", { { "surface", { { "mesh", name } } } });
        add ("maker.unknown", { { "whatever", name } });
        add ("file:" + name, Json::object());
    };
    for (const auto* name : { ".bash_login", ".config/autostart/evil.desktop", "bin/ls", "Tactus/plugins/evil.tactus", "lab/evil.tactus", "boards/board.json",
                              "Tactus/session.json", "Tactus/known.csv", ".hidden.wav", ".hidden/tap.wav", "notes.json" })
        bring (name, "{}");
    bring ("boards/clip.json", clip_text);
    const auto graph = [&] (const Json& all) {
        return Json { { "format", "tactus-graph" }, { "version", 2 }, { "nodes", all }, { "wires", Json::array() }, { "devices", { { "pen", { { "driver", "sim" }, { "mass", "50 g" }, { "about", ".bash_login" }, { "files", strings } } } } } }
            .dump();
    };
    bring ("assets/tap.wav", "RIFF");
    bring ("assets/bark.png", "PNG");
    const auto all = nodes;
    nodes = Json::object();
    for (const auto& [name, node] : all.items())
        if (! node["type"].asString().starts_with ("file:")) nodes[name] = node;   // a file that is no graph refuses the whole graph
    theirs.write ("g.json", graph (nodes));

    Rig d;
    d.files->open (theirs / "g.json");
    REQUIRE (d.document.file() == theirs / "g.json");
    d.chosen = home / "mine.json";
    d.files->saveAs();
    CHECK (filesIn (home.path()).empty());   // the question is open
    d.question.answer (0);
    CHECK (filesIn (home.path()) == std::set<std::string> { "assets/bark.png", "assets/tap.wav", "mine.json" });
}

TEST_CASE ("before files of a graph go along, a question names them: they are copied, or left where they are, or nothing is saved")
{
    TemporaryFolder theirs, mine;
    fs::create_directories (theirs / "assets");
    theirs.write ("assets/beat.json", clip_text);
    theirs.write ("g.json", R"({"format": "tactus-graph", "version": 2, "wires": [],
        "nodes": {"clip": {"type": "signal.clip", "settings": {"clip": "assets/beat.json"}}}})");
    Rig d;
    d.files->open (theirs / "g.json");
    d.chosen = mine / "mine.json";
    const auto clip = [&] { return loadGraph (mine / "mine.json").graph.root.find ("clip")->settings["clip"].asString(); };

    d.files->saveAs();
    CHECK (d.question.title().startsWith ("Copy these files to "));
    CHECK (d.question.getDescription().contains ("assets/beat.json"));
    d.question.cancel();
    CHECK (mine.isEmpty());

    d.files->saveAs();
    d.question.answer (1);
    CHECK (filesIn (mine.path()) == std::set<std::string> { "mine.json" });
    CHECK (fs::equivalent (mine / clip(), theirs / "assets/beat.json"));

    d.files->open (theirs / "g.json");
    d.files->saveAs();
    d.question.answer (0);
    CHECK (filesIn (mine.path()) == std::set<std::string> { "assets/beat.json", "mine.json" });
    CHECK (clip() == "assets/beat.json");

    d.files->open (theirs / "g.json");   // now nothing has to be copied
    d.files->saveAs();
    CHECK_FALSE (d.question.isOpen());
}
