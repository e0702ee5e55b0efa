// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.hpp"

#include <host/app/keep/carry_files.hpp>
#include <host/app/presets/preset_list.hpp>

#include <framework/file/graph_file.hpp>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
juce::String inWords (const Message& m) { return juce::String (m.text + (m.remedy.empty() ? "" : "; " + m.remedy)); }
}   // namespace

Files::Files (Document& d, Question& q, Settings& s, Ways w)
    : clock ([]
             { return static_cast<double> (juce::Time::currentTimeMillis()) / 1000.0; }),
      document (d), question (q), settings (s), ways (std::move (w))
{
    document.add (*this);
}

Files::~Files() { document.remove (*this); }

void Files::beginSession (const fs::path& h)
{
    home = h;
    session.emplace (home);
    if (! session->problem().empty()) ways.say (session->problem());
}

std::string Files::name() const
{
    if (! document.graph().name.empty()) return document.graph().name;
    return document.file().empty() ? "the graph" : document.file().stem().string();
}

//==============================================================================
void Files::whenSaved (const juce::String& why, std::function<void()> act)
{
    if (question.isOpen()) question.cancel();
    if (! document.isChanged()) return act();
    question.ask ("Save the changes to '" + juce::String (name()) + "' " + why + "?", document.file().empty() ? juce::String ("It has no file of its own yet; you choose where it goes.") : "They go to " + juce::String (document.file().string()) + ".",
                  { { "Save", [this, act]
                      { save (act); } },
                    { "Don't save", act },
                    { "Cancel", {} } });
}

void Files::show (graph::Graph g, Document::Source source, const std::string& step, bool runs, bool by_pointer)
{
    ways.stop();
    document.open (std::move (g), std::move (source), step);
    keepNow();
    if (runs && ! safe) ways.run (by_pointer);
}

void Files::create()
{
    whenSaved ("before a new graph", [this]
               {
        show ({}, {}, "new graph", false, false);
        ways.say ("A new graph. Space, or a double click on the canvas, adds a node."); });
}

void Files::openGraph (graph::Graph g, const std::string& step)
{
    whenSaved ("before another graph is opened", [this, g = std::move (g), step]
               { show (g, {}, step, true, false); });
}

void Files::load (const fs::path& file, Document::Source source, bool by_pointer)
{
    auto loaded = loadGraph (file);
    const auto error = std::ranges::find (loaded.messages, Message::Severity::error, &Message::severity);
    if (error != loaded.messages.end())
    {
        const auto at = error->line > 0 ? ":" + juce::String (error->line) + ":" + juce::String (error->column) : juce::String();
        return ways.say (juce::String (file.filename().string()) + at + ": " + inWords (*error));
    }
    if (! source.file.empty())
    {
        settings.noteRecent (file);
        ways.onSettings();
    }
    const auto called = loaded.graph.name.empty() ? file.stem().string() : loaded.graph.name;
    show (std::move (loaded.graph), std::move (source), "open " + called, true, by_pointer);
    ways.say (safe ? juce::String ("Safe mode: nothing runs until you press START.") : juce::String());
}

void Files::open()
{
    std::error_code failed;
    const auto begin = ! document.file().empty() ? document.file().parent_path() : fs::is_directory (ownFolder(), failed) ? ownFolder()
                                                                                                                          : presetFolder();
    ways.choose (false, begin, [this] (const fs::path& file)
                 { open (file); });
}

void Files::open (const fs::path& file)
{
    std::error_code failed;
    const auto whole = fs::absolute (file, failed);
    whenSaved ("before another graph is opened", [this, whole]
               { load (whole, { .file = whole }, false); });
}

void Files::openCopy (const fs::path& preset, bool by_pointer)
{
    whenSaved ("before another graph is opened", [this, preset, by_pointer]
               { load (preset, { .preset = preset }, by_pointer); });
}

//==============================================================================
void Files::save (std::function<void()> then)
{
    if (document.file().empty()) return saveAs (std::move (then));
    saveTo (document.file(), then);
}

void Files::saveAs (std::function<void()> then)
{
    auto called = juce::File::createLegalFileName (juce::String (document.graph().name)).toLowerCase().replaceCharacter (' ', '_');
    if (called.isEmpty()) called = "untitled";
    const auto folder = ownFolder();
    if (document.file().empty())
    {
        std::error_code failed;
        fs::create_directories (folder, failed);
    }
    const auto begin = document.file().empty() ? folder / (called.toStdString() + ".json") : document.file();
    ways.choose (true, begin, [this, then = std::move (then)] (const fs::path& chosen)
                 {
        auto file = chosen;
        if (file.extension() != ".json") file += ".json";
        saveTo (file, then); });
}

void Files::saveTo (const fs::path& file, const std::function<void()>& then)
{
    std::error_code failed;
    const bool is_shipped = ! presetFolder().empty() && fs::equivalent (file.parent_path(), presetFolder(), failed);
    if (is_shipped && file != document.file() && fs::exists (file, failed)) return ways.say ("Not saved: " + juce::String (file.filename().string()) + " is a preset that comes with Tactus. Choose another name or folder.");
    const auto not_carried = carryFiles (document.graph(), file.parent_path());
    const auto messages = document.save (file);
    if (! messages.empty()) return ways.say ("Not saved: " + inWords (messages.front()));
    keepNow();
    settings.noteRecent (file);
    ways.onSettings();
    ways.say (not_carried.empty() ? "Saved " + juce::String (file.string()) : "Saved, but this file that it names is not beside it: " + juce::String (not_carried.front()) + ". Copy it there.");
    if (then) then();
}

//==============================================================================
bool Files::recover()
{
    leftovers = leftoversIn (home);
    if (leftovers.empty()) return false;
    askAboutNext();
    return true;
}

void Files::askAboutNext()
{
    if (leftovers.empty()) return;
    const auto q = questionAbout (leftovers.front(), clock());
    const auto forget = [this]
    {
        leftovers.front().discard();
        leftovers.erase (leftovers.begin());
        askAboutNext();
    };
    const auto later = [this]
    { leftovers.clear(); };   // the next start asks again
    std::vector<Question::Choice> choices;
    const Question::Choice at_once { "Recover", [this]
                                     { restoreNext (true); } },
        at_rest { "Recover without running", [this]
                  { restoreNext (false); } };
    if (q.can_recover && ! safe && ! q.safe_first) choices.push_back (at_once);
    if (q.can_recover) choices.push_back (at_rest);
    if (q.can_recover && ! safe && q.safe_first) choices.push_back (at_once);
    choices.push_back ({ "Discard", forget });
    choices.push_back ({ "Later", later });
    question.ask (q.title, q.text, std::move (choices));
}

void Files::restoreNext (bool runs)
{
    if (leftovers.empty()) return;
    const auto kept = leftovers.front().kept();
    auto restored = restore (kept);
    const auto called = restored.graph.name.empty() ? std::string ("a graph") : restored.graph.name;
    show (std::move (restored.graph), { kept.file, kept.preset, kept.changed }, "recover " + called, runs, false);
    if (keepNow()) leftovers.front().discard();   // only now that this session keeps it
    const auto more = leftovers.size() - 1;
    leftovers.clear();
    auto said = runs && ! safe ? juce::String ("Recovered. Save it with Ctrl+S.") : juce::String ("Recovered, and nothing runs: look at it, then press START. Save it with Ctrl+S.");
    if (more > 0) said += " " + juce::String (static_cast<int> (more)) + " more will be asked about at the next start.";
    ways.say (said);
}

//==============================================================================
void Files::documentChanged()
{
    if (! session) return;
    if (! unkept_since) unkept_since = clock();
    if (ways.isRunning()) beforeRun();   // the change itself may be what ends the program
}

bool Files::keepNow()
{
    if (! session) return false;
    unkept_since.reset();
    const auto why = session->keep ({ document.file(), document.preset(), document.isChanged(), clock(), writeGraph (document.graph()) });
    if (why) ways.say ("Not kept for the case of a crash: " + juce::String (*why) + ". Save often.");
    return ! why;
}

void Files::beforeRun()
{
    if (! session) return;
    trial_until = clock() + trial_s;
    if (session->isTrial()) return;
    keepNow();
    session->noteTrial();
}

void Files::attend()
{
    if (! session) return;
    const auto now = clock();
    if (unkept_since && now - *unkept_since >= keep_after_s) keepNow();
    if (session->isTrial() && (now >= trial_until || ! ways.isRunning())) session->noteTrialIsOver();
}

void Files::end()
{
    if (session) session->end();
    session.reset();
}

void Files::endSuddenly()
{
    if (! session) return;
    if (! document.isChanged()) return end();
    keepNow();
    session->noteTrialIsOver();
    session.reset();
}

}   // namespace tactus::host
