// SPDX-License-Identifier: GPL-3.0-or-later
#include "recovery.hpp"

#include <host/app/text/filled.hpp>

#include <host/base/platform/private_folder.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/ownership.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <juce_core/juce_core.h>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
fs::path sessionsIn (const fs::path& home) { return home / "sessions"; }
fs::path lockIn (const fs::path& session) { return session / "lock"; }
fs::path autosaveIn (const fs::path& session) { return session / "kept.json"; }
fs::path trialIn (const fs::path& session) { return session / "trial"; }

/// The takes of a session that the user has made nothing from yet, each in its own folder.
std::vector<fs::path> takesIn (const fs::path& session)
{
    std::vector<fs::path> all;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (session, failed))
    {
        const auto log = entry.path() / "take.jsonl";
        const bool is_there = fs::is_regular_file (log, failed) && fs::file_size (log, failed) > 0;
        if (is_there && ! fs::exists (entry.path() / "used", failed)) all.push_back (log);
    }
    std::ranges::sort (all, {}, [] (const fs::path& log) { return std::pair (log.native().size(), log); });   // take-10 comes after take-9
    return all;
}

std::string newName()
{
    std::random_device chance;
    return juce::String::toHexString (static_cast<juce::int64> ((std::uint64_t { chance() } << 32u) | chance())).toStdString();
}

std::string textAt (const Json& object, const char* key)
{
    const auto found = object.find (key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

juce::String howLongAgo (double seconds)
{
    const auto count = [] (double n, const juce::String& text) { return filled (text, static_cast<long long> (std::max (0.0, std::floor (n)))); };
    if (seconds < 120.0) return count (seconds, TRANS ("%1 s ago"));
    if (seconds < 7200.0) return count (seconds / 60.0, TRANS ("%1 min ago"));
    if (seconds < 172800.0) return count (seconds / 3600.0, TRANS ("%1 hours ago"));
    return count (seconds / 86400.0, TRANS ("%1 days ago"));
}

std::string nameOf (const AutosavedDocument& d)
{
    const auto graph = readGraph (d.graph).graph;
    if (! graph.name.empty()) return graph.name;
    return d.file.empty() ? TRANS ("Untitled graph").toStdString() : d.file.stem().string();
}
}   // namespace

std::string writeAutosave (const AutosavedDocument& d)
{
    const Json json {
        { "format", "tactus-kept" },
        { "version", 1 },
        { "file", d.file.string() },
        { "preset", d.preset.string() },
        { "changed", d.changed },
        { "at", d.at_s },
        { "graph", d.graph },
        { "folder", d.folder.string() },
        { "by_pointer", d.by_pointer },
        { "file_hash", d.file_hash },
        { "stopped", d.stopped }
    };
    return json.dump (2) + '\n';
}

Result<AutosavedDocument> readAutosave (const std::string& text)
{
    const auto json = Json::tryParse (text).value_or (Json());
    const bool is_whole = json.is_object() && textAt (json, "format") == "tactus-kept" && json.contains ("graph") && json["graph"].is_string();
    if (! is_whole) return Message::error ("recovery/damaged", {}, TRANS ("the file is damaged").toStdString());
    AutosavedDocument d { textAt (json, "file"), textAt (json, "preset"), json.value ("changed", Json (true)) == true, 0.0, json["graph"].get<std::string>() };
    d.folder = textAt (json, "folder");
    d.file_hash = textAt (json, "file_hash");
    d.by_pointer = json.value ("by_pointer", Json (false)) == true;
    d.stopped = json.value ("stopped", Json (false)) == true;
    if (const auto at = json.find ("at"); at != json.end() && at->is_number()) d.at_s = at->get<double>();
    return d;
}

RestoredGraph restore (const AutosavedDocument& d)
{
    RestoredGraph restored;
    auto read = readGraph (d.graph);
    const auto error = std::ranges::find (read.messages, Message::Severity::error, &Message::severity);
    if (error != read.messages.end()) restored.problem = error->text;
    auto& graph = restored.graph = std::move (read.graph);
    graph.folder = (d.folder.empty() ? (d.file.empty() ? d.preset : d.file).parent_path() : d.folder).string();
    const auto include = [&] (const graph::Patch& patch) {
        for (const auto& node : patch.nodes)
        {
            if (! node.type.starts_with ("file:")) continue;
            const auto written = node.type.substr (5);
            auto inner = loadGraph (fs::path (graph.folder) / written);
            if (! hasErrors (inner.messages)) graph.files.emplace (written, std::make_shared<const graph::Graph> (std::move (inner.graph)));
        }
    };
    include (graph.root);
    for (const auto& [name, patch] : graph.graphs)
        include (patch);
    return restored;
}

RecoverySession::RecoverySession (const fs::path& home)
{
    // The folder gets its real name only once it is locked: another instance that looks for crashed sessions right now would
    // otherwise pick it up.
    own = sessionsIn (home) / newName();
    const auto hidden = sessionsIn (home) / ('.' + own.filename().string());
    if (! home.empty() && needOwnFolder (hidden)) lock = FileLock::take (lockIn (hidden));
    std::error_code failed;
    if (lock) fs::rename (hidden, own, failed);
    if (failed) lock.reset();
    if (lock) return;
    const auto text = TRANS ("Autosave is off: cannot write to %1. Save often, or set TACTUS_HOME to a writable folder.");
    wrong = filled (text, home.empty() ? "~/.config/Tactus" : own.string()).toStdString();
}

Result<> RecoverySession::autosave (const AutosavedDocument& d)
{
    if (! lock) return Message::error ("recovery/no_folder", own.string(), wrong);
    return writeTextFile (autosaveIn (own), writeAutosave (d));
}

void RecoverySession::beginTrial()
{
    if (trial || ! lock) return;
    trial = writeTextFile (trialIn (own), "\n").has_value();
}

void RecoverySession::endTrial()
{
    if (! trial) return;
    trial = false;
    std::error_code failed;
    fs::remove (trialIn (own), failed);
}

void RecoverySession::end()
{
    if (! lock) return;
    std::error_code failed;
    fs::remove_all (own, failed);
    lock.reset();
}

void CrashedSession::discard()
{
    std::error_code failed;
    fs::remove_all (own, failed);
    lock.reset();
}

std::vector<CrashedSession> findCrashedSessions (const fs::path& home)
{
    std::vector<CrashedSession> all;
    if (home.empty()) return all;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (sessionsIn (home), failed))
    {
        if (! fs::is_directory (entry.symlink_status (failed)) || entry.path().filename().string().starts_with ('.')) continue;   // still being created
        if (! whoElseCanChange (entry.path()).empty()) continue;
        CrashedSession s;
        s.own = entry.path();
        s.lock = FileLock::take (lockIn (s.own));
        if (! s.lock) continue;   // belongs to an instance that is still running
        s.in_trial = fs::exists (trialIn (s.own), failed);
        const auto text = readTextFile (autosaveIn (s.own));
        if (! text)
        {
            s.discard();
            continue;
        }
        if (auto read = readAutosave (*text))
        {
            s.saved = std::move (*read);
            s.wrong = restore (s.saved).problem;
        }
        else
            s.wrong = read.error().text;
        s.recorded = takesIn (s.own);
        if (s.wrong.empty() && ! s.saved.changed && ! s.in_trial && s.recorded.empty())
            s.discard();
        else
            all.push_back (std::move (s));
    }
    std::ranges::sort (all, std::greater {}, [] (const CrashedSession& s) { return s.document().at_s; });
    return all;
}

RecoveryQuestion questionAbout (const CrashedSession& s, double now_s)
{
    RecoveryQuestion q;
    q.title = TRANS ("Tactus closed unexpectedly").toStdString();
    if (! s.problem().empty())
    {
        q.can_recover = false;
        const auto text = TRANS ("The autosaved graph cannot be read: %1. Copy %2 if you want to inspect it.");
        q.text = filled (text, s.problem(), autosaveIn (s.folder()).string()).toStdString();
        return q;
    }
    const auto& file = s.document().file;
    const auto name = "'" + nameOf (s.document()) + "'" + (file.empty() ? "" : " (" + file.filename().string() + ")");
    const auto text = s.document().changed ? TRANS ("%1 has unsaved changes, last autosaved %2.") : TRANS ("%1 was open %2.");
    q.text = filled (text, name, howLongAgo (now_s - s.document().at_s)).toStdString();
    if (const auto count = s.takes().size(); count > 0)
        q.text += " " + (count == 1 ? TRANS ("A take was not saved.") : filled (TRANS ("%1 takes were not saved."), count)).toStdString();
    q.safe_first = s.endedInTrial();
    q.can_run = q.safe_first || ! s.document().stopped;
    if (q.safe_first)
        q.text += " "
                  + TRANS ("Tactus closed soon after the graph was started or changed, so running the graph may crash Tactus again. "
                           "Look at the graph first; START runs it.")
                        .toStdString();
    return q;
}

}   // namespace tactus::host
