// SPDX-License-Identifier: MIT
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/fitting/fitting.hpp>
#include <host/osc/osc_port.hpp>
#include <host/sessions/device_session.hpp>

#include <tactus/file/assets/mesh.hpp>
#include <tactus/file/assets/table.hpp>
#include <tactus/file/clips/clip_file.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/units.hpp>

#include "host/app/support/pseudo.hpp"
#include "support/corpus.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <map>
#include <regex>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;

namespace
{
/// While this lives, these are the texts.
struct InTexts
{
    explicit InTexts (const char* file) { useTexts (std::make_unique<juce::LocalisedStrings> (juce::String::fromUTF8 (file), false)); }
    ~InTexts() { useTexts (nullptr); }
};

/// The entries of en.txt that come from code without translations.
std::vector<juce::String> messagePatterns()
{
    juce::StringArray lines;
    juce::File (TACTUS_SOURCE_DIR "/host/app/text/en.txt").readLines (lines);
    std::vector<juce::String> all;
    bool is_message = false;
    for (const auto& line : lines)
    {
        if (line.startsWith ("# ")) is_message = line.startsWith ("# Messages");
        if (is_message && line.startsWithChar ('"')) all.push_back (line.substring (1, line.indexOf ("\" = \"")).replace ("\\\"", "\""));
    }
    return all;
}

/// A text without what is in quotation marks, such as names that a user has given.
juce::String unquoted (const juce::String& text)
{
    static const std::regex quoted (R"rx((^|[\s([,])('[^']*'|"[^"]*"|`[^`]*`))rx");
    return juce::String (std::regex_replace (text.toStdString(), quoted, "$1"));
}

/// The messages that the files of the fuzzing corpora cause, and which words of them a translation does not reach.
struct Untranslated
{
    InPseudo pseudo;
    Data data;
    int messages = 0;
    std::map<std::string, std::string> left {};   // words left, by id of the message

    void add (const Message& m)
    {
        ++messages;
        if ((m.text + m.remedy).find ('\\') != m.text.npos) return;   // a translation file cannot have a backslash
        const auto words = data.wordsLeft (unquoted (messageText (m)));
        if (words.isNotEmpty()) left.emplace (m.id + ": " + words.toStdString(), m.text + "; " + m.remedy);
    }
    void add (const Messages& all)
    {
        for (const auto& m : all)
            add (m);
    }
};

Untranslated* found = nullptr;   // for the functions below, which a corpus calls

void readAsGraph (std::string_view text)
{
    const auto loaded = readGraph (text);
    found->add (loaded.messages);
    if (! hasErrors (loaded.messages)) found->add (compile (loaded.graph, catalogue()).messages);
}

template <typename T>
void addError (const Result<T>& read)
{
    if (! read) found->add (read.error());
}

void readAsSession (std::string_view text) { found->add (readSession (text).messages); }

void readAsTable (std::string_view text)
{
    addError (readTable (text, "file.csv"));
    addError (readers::readGrid (text, "file.csv"));
}

void readAsMesh (std::string_view bytes)
{
    for (const char* name : { "file.obj", "file.off", "file.ply", "file.stl" })
        addError (readers::readMesh (bytes, name));
}

void readAsClip (std::string_view text)
{
    for (const char* name : { "file.json", "file.haptic", "file.ahap", "file.hjif" })
        addError (readers::readClip (text, name));
}

void readAsUnit (std::string_view text)
{
    const auto read = parseMeasure (text);
    if (read) return;
    if (juce::CharPointer_UTF8::isValidString (text.data(), static_cast<int> (text.size()))) found->data.add (valueText (text));   // the message repeats it
    found->add (read.error());
}

void readAsRecording (std::string_view text)
{
    const TemporaryFolder folder;
    const auto file = folder / "rows.csv";
    std::ofstream (file) << text;
    const auto table = readRecording (file);
    if (! table) return found->add (table.error());
    juce::StringArray columns;
    for (const auto& column : table->columns)
        columns.add (juce::String (column));
    found->data.add (columns.joinIntoString (", "));   // as a message lists them
    for (const auto& kind : fitKinds())
        if (const auto fit = fitRecording (kind.kind, *table, "rows.csv", { .mass = 0.05 }); ! fit)
            found->add (fit.error());
        else
            found->add (fit->warnings);
}
}   // namespace

TEST_CASE ("a message is translated by the pattern that has made it, and so are its values", "[app][text]")
{
    const InTexts texts ("language: Deutsch\n"
                         "\"there is no node %1\" = \"es gibt keinen Knoten %1\"\n"
                         "\"there is no %1\" = \"kein %1\"\n"
                         "\"%1 must be %2\" = \"%2 muss %1 sein\"\n"
                         "\"at most %1\" = \"h\xc3\xb6"
                         "chstens %1\"\n"
                         "\", with teeth of %1\" = \", mit Z\xc3\xa4hnen von %1\"\n"
                         "\"a stiffness below %1, or \" = \"eine Steife unter %1 oder \"\n"
                         "\"softer\" = \"weicher\"\n"
                         "\"'%1' is taken\" = \"'%1' ist vergeben\"\n"
                         "\"%1 of %2\" = \"%2 von %1\"\n");
    const auto german = [] (const char* english) { return translated (english).toStdString(); };
    CHECK (german ("there is no node 'a'") == "es gibt keinen Knoten 'a'");   // the longer pattern
    CHECK (german ("there is no wire") == "kein wire");
    CHECK (german ("x must be at most 3") == "h\xc3\xb6"
                                             "chstens 3 muss x sein");
    CHECK (german ("at most 3 um, with teeth of 2 um") == "h\xc3\xb6"
                                                          "chstens 3 um, mit Z\xc3\xa4hnen von 2 um");
    CHECK (german ("a stiffness below 3 N/m, or softer") == "eine Steife unter 3 N/m oder weicher");
    CHECK (german ("'softer' is taken") == "'softer' ist vergeben");
    CHECK (german ("drag.mu: there is no x; softer") == "drag.mu: kein x; weicher");
    CHECK (german ("2 of 3") == "2 of 3");   // too few letters to be sure
    CHECK (german ("something else") == "something else");
    CHECK (german ("") == "");
}

TEST_CASE ("in English, messages are as the framework writes them", "[app][text]")
{
    CHECK (translated ("there is no node '\xc2\xb5'") == juce::String::fromUTF8 ("there is no node '\xc2\xb5'"));
    CHECK (messageText (Message::error ("a/b", {}, "text", "remedy")) == "text; remedy");
}

TEST_CASE ("every pattern of a message is found again, whatever its values", "[app][text]")
{
    const auto patterns = messagePatterns();
    REQUIRE (patterns.size() > 1000);
    const InPseudo pseudo;
    const Data data;
    for (const auto& values : { std::array { "3N/m", "drag.force", "0.2" }, std::array { "2", "grain.out", "1.5mm" } })
        for (const auto& pattern : patterns)
        {
            juce::String text = pattern;
            for (int i = 9; i >= 1; --i)
                text = text.replace ("%" + juce::String (i), values[static_cast<std::size_t> (i % 3)]);
            INFO (pattern);
            CHECK (data.wordsLeft (unquoted (translated (text.toStdString()))) == juce::String());
        }
}

TEST_CASE ("what is wrong with graphs, units, recordings and other files is said in the language of the user", "[app][text]")
{
    Untranslated all;
    found = &all;
    tactus::test::replay ("graph", readAsGraph);
    tactus::test::replay ("units", readAsUnit);
    tactus::test::replay ("recording", readAsRecording);
    tactus::test::replay ("session", readAsSession);
    tactus::test::replay ("csv", readAsTable);
    tactus::test::replay ("table", readAsTable);
    all.data.add ("triangles=10G");
    tactus::test::replay ("mesh", readAsMesh);
    tactus::test::replay ("clip", readAsClip);
    found = nullptr;
    CHECK (all.messages > 600);
    for (const auto& [words, message] : all.left)
    {
        INFO (message);
        CHECK (words == "");
    }
}

TEST_CASE ("a taken OSC port is said in the language of the user", "[app][text]")
{
    const auto first = OscPort::open (0);
    REQUIRE (first);
    const auto second = OscPort::open ((*first)->number());
    REQUIRE_FALSE (second);
    Untranslated all;
    all.add (second.error());
    CHECK (all.left.empty());
}
