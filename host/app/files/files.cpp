// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/clip_graph.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/run/asset_load.hpp>
#include <host/app/storage/carry_files.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/base/files/preset_pack.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/run/log/content_hash.hpp>
#include <tactus/text/quote.hpp>

#include <memory>
#include <utility>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
/// The first errors of a graph file, a paragraph each. Names the file only where it is another one, such as that of a subgraph.
juce::String errorList (const Messages& messages, const fs::path& file)
{
    constexpr int most = 4;
    juce::String list;
    int count = 0;
    for (const auto& m : messages)
    {
        if (m.severity != Message::Severity::error || ++count > most) continue;
        if (! m.file.empty() && m.file != file.string()) list << printableName (m.file) << ": ";
        if (m.line > 0) list << filled (TRANS ("Line %1, column %2"), m.line, m.column) << ": ";
        list << messageText (m) << ".\n\n";
    }
    if (count > most) list << filled (TRANS ("There are %1 more errors."), count - most) << "\n\n";
    return list;
}

constexpr double large_assets = 1e6;   // bytes; more would keep the window busy for longer than a blink

/// The name of a file for a graph with this name: "dry_wood" for "Dry wood".
std::string stemFor (const std::string& name)
{
    return juce::File::createLegalFileName (juce::String (name)).toLowerCase().replaceCharacter (' ', '_').toStdString();
}

/// The name of a graph in a file with this name: "Dry wood" for "dry_wood".
std::string nameFor (const std::string& stem)
{
    const auto words = fromUtf8 (stem).replaceCharacter ('_', ' ').trim();
    return (words.substring (0, 1).toUpperCase() + words.substring (1)).toStdString();
}

juce::String autosaveFailed (const Message& why) { return filled (TRANS ("Autosave failed: %1. Save often."), fromUtf8 (why.text)); }
}   // namespace

Files::Files (Document& d, Question& q, Settings& s, Callbacks c)
    : clock ([] { return static_cast<double> (juce::Time::currentTimeMillis()) / 1000.0; }),
      document (d), question (q), settings (s), callbacks (std::move (c))
{
    document.add (*this);
}

Files::~Files() { document.remove (*this); }

void Files::beginSession (const fs::path& h)
{
    home = h;
    autosaver.reset();
    session.emplace (home);
    autosaver.emplace (*session);
    if (! session->problem().empty()) callbacks.notify (session->problem());
}

fs::path Files::sessionFolder() const { return session && session->problem().empty() ? session->folder() : fs::path(); }

std::string Files::name() const
{
    if (! document.graph().name.empty()) return printableName (document.graph().name);
    return document.file().empty() ? TRANS ("Untitled graph").toStdString() : printableName (document.file().stem().string());
}

//==============================================================================
void Files::whenSaved (const juce::String& asked, std::function<void()> act)
{
    endTyping();
    while (question.isOpen())
        question.cancel();
    if (! document.isChanged()) return act();
    const auto text = document.file().empty() ? TRANS ("The graph has no file yet. You will be asked where to save it.")
                                              : filled (TRANS ("Saving overwrites %1."), document.file().string());
    question.ask (filled (asked, name()), text,
                  { { TRANS ("Save"), [this, act] { save (act); } },
                    { TRANS ("Don't save"), act },
                    { TRANS ("Cancel"), {} } });
}

void Files::show (graph::Graph g, Document::Source source, const std::string& step, bool runs, bool by_pointer)
{
    callbacks.stop();
    document.open (std::move (g), std::move (source), step);
    autosave();
    if (runs && ! safe) callbacks.run (by_pointer);
}

void Files::create()
{
    whenSaved (TRANS ("Save changes to '%1' before creating a new graph?"), [this] {
        show ({}, {}, NEEDS_TRANS ("new graph"), false, false);
        callbacks.notify (TRANS ("New graph. Press Space or double-click the canvas to add a node."));
    });
}

void Files::openGraph (graph::Graph g, const std::string& step, bool is_work, std::function<void()> then)
{
    whenSaved (TRANS ("Save changes to '%1' before opening another graph?"), [this, g = std::move (g), step, is_work, then = std::move (then)] {
        show (g, { .is_changed = is_work }, step, true, false);
        if (then) then();
    });
}

void Files::load (const fs::path& file, const Document::Source& source, bool by_pointer, bool runs)
{
    if (isClipExtension (file)) return loadClipGraph (file, by_pointer);
    if (isPresetPack (file))
    {
        const auto unpacked = unpackPreset (file);
        return unpacked ? load (*unpacked, { .preset = *unpacked }, by_pointer, runs) : refuse (file, { unpacked.error() });
    }
    const auto text = readTextFile (file);   // before it is read as a graph, so that a change in between is noticed
    auto loaded = loadGraph (file);
    if (hasErrors (loaded.messages) && isClipFile (file)) return loadClipGraph (file, by_pointer);
    if (hasErrors (loaded.messages)) return refuse (file, loaded.messages);
    const auto called = loaded.graph.name.empty() ? file.stem().string() : loaded.graph.name;
    const auto hash = contentHash (text.value_or (std::string()));
    const auto is_large = assetBytes (loaded.graph) > large_assets;
    const auto graph = std::make_shared<const graph::Graph> (std::move (loaded.graph));
    const auto opens = [this, file, source, by_pointer, runs, called, hash, graph] {
        if (! source.file.empty())
        {
            settings.noteRecent (file);
            callbacks.onSettings();
        }
        show (*graph, source, filled (TRANS ("open %1"), called).toStdString(), runs, by_pointer);
        if (! document.file().empty()) known_files[document.file()] = hash;
        callbacks.notify (safe ? TRANS ("Safe mode: nothing runs until you press START.") : juce::String());
    };
    if (is_large && callbacks.prepare) return callbacks.prepare (*graph, fromUtf8 (printableName (called)), opens);
    opens();
}

void Files::loadClipGraph (const fs::path& file, bool by_pointer)
{
    const auto clip = loadClip (file);
    if (! clip) return refuse (file, { clip.error() });
    show (graphOfClip (file), {}, filled (TRANS ("open the clip %1"), file.stem().string()).toStdString(), true, by_pointer);
    callbacks.notify (safe ? TRANS ("Safe mode: nothing runs until you press START.") : TRANS ("The clip plays over and over on a simulated device."));
}

/// A dialog, because the reason may be long, and a line at the edge of the window is easily missed by someone who waits for a graph.
void Files::refuse (const fs::path& file, const Messages& messages)
{
    std::vector<Question::Choice> choices { { TRANS ("Open another file ..."), [this] { open(); } } };
    std::error_code failed;
    if (std::ranges::count (settings.recent, file) > 0 && ! fs::exists (file, failed))
        choices.push_back ({ TRANS ("Remove from recent files"), [this, file] {
                                std::erase (settings.recent, file);
                                callbacks.onSettings();
                            } });
    choices.push_back ({ TRANS ("Close"), {} });
    question.ask (filled (TRANS ("Cannot open %1"), printableName (file.filename().string())),
                  errorList (messages, file) + TRANS ("The open graph is unchanged."), std::move (choices));
}

void Files::open()
{
    std::error_code failed;
    auto begin = document.file().parent_path();
    if (begin.empty()) begin = fs::is_directory (ownFolder(), failed) ? ownFolder() : presetFolder();
    callbacks.choose (false, begin, [this] (const fs::path& file) { open (file); });
}

void Files::open (const fs::path& file)
{
    std::error_code failed;
    const auto whole = fs::absolute (file, failed);
    whenSaved (TRANS ("Save changes to '%1' before opening another graph?"), [this, whole] { load (whole, { .file = whole }, false); });
}

void Files::openCopy (const fs::path& preset, bool by_pointer)
{
    whenSaved (TRANS ("Save changes to '%1' before opening another graph?"), [this, preset, by_pointer] { load (preset, { .preset = preset }, by_pointer); });
}

//==============================================================================
void Files::save (std::function<void()> then)
{
    endTyping();
    const auto file = document.file();
    if (file.empty()) return saveAs (std::move (then));
    if (! wasChangedElsewhere (file)) return saveTo (file, then);
    question.ask (filled (TRANS ("%1 has been changed"), printableName (file.filename().string())),
                  TRANS ("Another program has changed the file since it was opened or saved here. Saving overwrites those changes."),
                  { { TRANS ("Save as ..."), [this, then] { saveAs (then); } },
                    { TRANS ("Replace"), [this, file, then] { saveTo (file, then); } },
                    { TRANS ("Reload the file"), [this] { reload(); } },
                    { TRANS ("Cancel"), {} } });
}

void Files::reload()
{
    endTyping();
    const auto file = document.file();
    if (! file.empty()) load (file, { .file = file }, callbacks.isByPointer(), callbacks.isRunning());
}

/// True if a file is there and is no longer what this window has read or written.
bool Files::wasChangedElsewhere (const fs::path& file) const
{
    const auto known = known_files.find (file);
    const auto now = readTextFile (file);
    return known != known_files.end() && now && contentHash (*now) != known->second;
}

void Files::saveAs (std::function<void()> then)
{
    endTyping();
    const auto& now = document.file();
    const auto called = stemFor (document.graph().name);
    const auto folder = now.empty() ? ownFolder() : now.parent_path();
    std::error_code failed;
    if (now.empty()) fs::create_directories (folder, failed);
    const auto usual = now.empty() ? fs::path ("untitled.json") : now.filename();
    const bool has_its_name = ! now.empty() && stemFor (now.stem().string()) == called;   // "my board.json" of My board
    const auto begin = folder / (called.empty() || has_its_name ? usual : fs::path (called + ".json"));
    callbacks.choose (true, begin, [this, then = std::move (then)] (const fs::path& chosen) {
        auto file = chosen;
        if (file.extension() != ".json") file += ".json";
        saveTo (file, then);
    });
}

/// The name for the graph in its new file: that of the file, unless the graph has it already.
std::string Files::nameIn (const fs::path& file) const
{
    const auto& now = document.graph().name;
    const auto stem = file.stem().string();
    return file == document.file() || stemFor (now) == stemFor (stem) ? now : nameFor (stem);
}

void Files::saveElsewhere (const juce::String& why, const std::function<void()>& then)
{
    question.ask (TRANS ("The graph was not saved"), why, { { TRANS ("Save as ..."), [this, then] { saveAs (then); } }, { TRANS ("Cancel"), {} } });
}

void Files::saveTo (const fs::path& file, const std::function<void()>& then, const std::optional<std::vector<fs::path>>& agreed)
{
    std::error_code failed;
    const auto folder = file.parent_path();
    const bool is_shipped = ! presetFolder().empty() && fs::equivalent (folder, presetFolder(), failed);
    if (is_shipped && file != document.file() && fs::exists (file, failed))
        return saveElsewhere (filled (TRANS ("%1 ships with Tactus. Choose another name or folder."), file.filename().string()), then);
    if (auto files = carriedTo (folder, document.graph()).files; ! agreed && ! files.empty())
    {
        std::vector<fs::path> names;
        for (const auto& f : files)
            names.push_back (f.name);
        return question.ask (filled (TRANS ("Copy these files to %1, too?"), printableName (folder.string())),
                             Question::listOf (names) + TRANS ("The graph uses them."),
                             { { TRANS ("Copy"), [this, file, then, names] { saveTo (file, then, names); } },
                               { TRANS ("Leave them where they are"), [this, file, then] { saveTo (file, then, std::vector<fs::path> {}); } },
                               { TRANS ("Cancel"), {} } });
    }
    const auto before = document.graph().name, name = nameIn (file);
    if (name != before) document.call (name);
    auto carried = carriedTo (folder, document.graph(), agreed);
    if (const auto copied = copyInto (folder, carried.files); ! copied)
    {
        if (name != before) document.call (before);
        const auto& where = copied.error().where;
        return saveElsewhere (filled (where.empty() ? "%2." : "%1: %2.", printableName (where), messageText (copied.error())), then);
    }
    if (callbacks.onWrite) callbacks.onWrite (carried.graph);
    const auto messages = document.save (file, carried.graph);
    if (! messages.empty() && name != before) document.call (before);
    if (! messages.empty()) return saveElsewhere (errorList (messages, file).trimEnd(), then);
    known_files[file] = contentHash (readTextFile (file).value_or (std::string()));
    autosave();
    settings.noteRecent (file);
    callbacks.onSettings();
    callbacks.notify (filled (TRANS ("Saved %1"), file.string()));
    if (then) then();
}

//==============================================================================
bool Files::recover()
{
    crashed = findCrashedSessions (home);
    if (crashed.empty()) return false;
    askAboutNext();
    return true;
}

void Files::askAboutNext()
{
    if (crashed.empty()) return;
    const auto q = questionAbout (crashed.front(), clock());
    const auto forget = [this] {
        crashed.front().discard();
        crashed.erase (crashed.begin());
        askAboutNext();
    };
    const auto later = [this] { crashed.clear(); };   // asks again on the next start
    std::vector<Question::Choice> choices;
    if (q.can_recover)
    {
        choices.push_back ({ q.can_run ? TRANS ("Recover without running") : TRANS ("Recover"), [this] { restoreNext (false); } });
        if (! safe && q.can_run)
            choices.insert (q.safe_first ? choices.end() : choices.begin(), { TRANS ("Recover"), [this] { restoreNext (true); } });
    }
    choices.push_back ({ TRANS ("Discard"), forget });
    choices.push_back ({ TRANS ("Later"), later });
    question.ask (q.title, q.text, std::move (choices));
}

void Files::restoreNext (bool runs)
{
    if (crashed.empty()) return;
    const auto saved = crashed.front().document();
    auto restored = restore (saved);
    const auto called = restored.graph.name.empty() ? TRANS ("a graph").toStdString() : restored.graph.name;
    show (std::move (restored.graph), { saved.file, saved.preset, saved.changed }, filled (TRANS ("recover %1"), called).toStdString(), runs, saved.by_pointer);
    if (saved.by_pointer && (! runs || safe)) callbacks.usePointer();
    document.beginHistory();   // undo must not lose what was recovered
    if (! saved.file.empty()) known_files[saved.file] = saved.file_hash;
    bool has_takes = true;
    for (const auto& take : crashed.front().takes())
        has_takes = callbacks.openTake (take) && has_takes;
    if (autosave() && has_takes) crashed.front().discard();   // only now that the document is autosaved in this session
    const auto more = crashed.size() - 1;
    crashed.clear();
    auto text = runs && ! safe ? TRANS ("Recovered. Press Ctrl+S to save.")
                               : TRANS ("Recovered without running: check the graph before you press START. Press Ctrl+S to save.");
    if (more > 0) text << " " << filled (TRANS ("At the next start, Tactus offers to recover %1 more."), more);
    callbacks.notify (text);
}

//==============================================================================
void Files::documentChanged()
{
    if (! session) return;
    autosaveSoon();
    if (callbacks.isRunning()) beforeRun();   // the change itself may crash the program
}

/// The hash of the document's file as this session knows it; empty if it has none.
std::string Files::knownHash() const
{
    const auto known = known_files.find (document.file());
    return known == known_files.end() ? std::string() : known->second;
}

AutosavedDocument Files::autosaved (bool is_changed, std::string text) const
{
    const bool by_pointer = callbacks.isByPointer();
    return { document.file(), document.preset(), is_changed, clock(), std::move (text), document.graph().folder, by_pointer, knownHash(), was_stopped };
}

/// The `ui` of the graph with what the panels keep in a file, such as the scopes.
Json Files::uiToWrite() const
{
    graph::Graph written;
    written.extra = document.graph().extra;
    if (callbacks.onWrite) callbacks.onWrite (written);
    return written.extra.value ("ui", Json());
}

/// Hands a copy of the document to the thread that writes autosaves, or remembers to do so once it is idle.
void Files::autosaveSoon()
{
    constexpr double least_s = 0.5;   // between two autosaves of a step that goes on, such as a drag
    const bool goes_on = document.history().position() == handed_step && clock() - handed_at < least_s;
    is_dirty = goes_on || ! autosaver->isIdle();
    if (! is_dirty) handToAutosaver();
}

void Files::handToAutosaver()
{
    is_dirty = false;
    handed_step = document.history().position();
    handed_at = clock();
    autosaver->write ({ autosaved (true, {}), document.graph(), document.savedText(), uiToWrite() });
}

void Files::finishAutosave()
{
    if (! session) return;
    autosaver->finish();
    if (is_dirty) handToAutosaver();
    autosaver->finish();
}

/// Autosaves before it returns.
bool Files::autosave()
{
    if (! session) return false;
    is_dirty = false;
    autosaver->finish();
    auto document_now = document.graph();
    if (callbacks.onWrite) callbacks.onWrite (document_now);
    const auto saved = session->autosave (autosaved (document.isChanged(), writeGraph (document_now)));
    if (! saved) callbacks.notify (autosaveFailed (saved.error()));
    return saved.has_value();
}

void Files::beforeRun()
{
    if (! session) return;
    trial_until = clock() + trial_s;
    was_stopped = false;
    if (session->inTrial()) return;
    autosave();
    session->beginTrial();
}

void Files::poll()
{
    if (! session) return;
    const auto now = clock();
    const bool by_pointer = callbacks.isByPointer(), is_stopped = callbacks.isStopped();
    const bool is_new = by_pointer != was_by_pointer || is_stopped != was_stopped;
    was_by_pointer = by_pointer;
    was_stopped = is_stopped;
    if (is_dirty || is_new) autosaveSoon();
    if (const auto problem = autosaver->takeProblem()) callbacks.notify (autosaveFailed (*problem));
    if (session->inTrial() && (now >= trial_until || ! callbacks.isRunning())) session->endTrial();
}

void Files::end()
{
    autosaver.reset();
    if (session) session->end();
    session.reset();
}

void Files::endSuddenly (bool has_takes)
{
    if (! session) return;
    endTyping();
    if (! document.isChanged() && ! has_takes) return end();
    autosave();
    autosaver.reset();
    session->endTrial();
    session.reset();
}

}   // namespace tactus::host
