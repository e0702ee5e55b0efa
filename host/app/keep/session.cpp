// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.hpp"

#include <framework/file/graph_file.hpp>
#include <host/io/text_file.hpp>

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
fs::path keptIn (const fs::path& session) { return session / "kept.json"; }
fs::path trialIn (const fs::path& session) { return session / "trial"; }

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

std::string howLongAgo (double seconds)
{
    const auto count = [] (double n, const char* unit)
    { return std::to_string (static_cast<long long> (std::max (0.0, std::floor (n)))) + ' ' + unit; };
    if (seconds < 120.0) return count (seconds, "s");
    if (seconds < 7200.0) return count (seconds / 60.0, "min");
    if (seconds < 172800.0) return count (seconds / 3600.0, "hours");
    return count (seconds / 86400.0, "days");
}

std::string nameOf (const Kept& kept)
{
    const auto graph = readGraph (kept.graph).graph;
    if (! graph.name.empty()) return graph.name;
    return kept.file.empty() ? "a graph without a name" : kept.file.stem().string();
}
}   // namespace

std::string writeKept (const Kept& k)
{
    const Json json { { "format", "tactus-kept" }, { "version", 1 }, { "file", k.file.string() }, { "preset", k.preset.string() }, { "changed", k.changed }, { "at", k.at_s }, { "graph", k.graph } };
    return json.dump (2, ' ', false, Json::error_handler_t::replace) + '\n';
}

ReadKept readKept (const std::string& text)
{
    ReadKept read;
    const auto json = Json::parse (text, nullptr, false);
    if (! json.is_object() || textAt (json, "format") != "tactus-kept" || ! json.contains ("graph") || ! json["graph"].is_string())
    {
        read.problem = "it is damaged";
        return read;
    }
    read.kept = { textAt (json, "file"), textAt (json, "preset"), json.value ("changed", Json (true)) == true, 0.0, json["graph"].get<std::string>() };
    if (const auto at = json.find ("at"); at != json.end() && at->is_number()) read.kept.at_s = at->get<double>();
    return read;
}

RestoredGraph restore (const Kept& kept)
{
    RestoredGraph restored;
    auto read = readGraph (kept.graph);
    const auto error = std::ranges::find (read.messages, Message::Severity::error, &Message::severity);
    if (error != read.messages.end()) restored.problem = error->text;
    auto& graph = restored.graph = std::move (read.graph);
    graph.folder = (kept.file.empty() ? kept.preset : kept.file).parent_path().string();
    const auto include = [&] (const graph::Patch& patch)
    {
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

Session::Session (const fs::path& home)
{
    // It gets its name only once it is locked: whoever looks for leftovers just now would take a folder that is not for one.
    own = sessionsIn (home) / newName();
    const auto hidden = sessionsIn (home) / ('.' + own.filename().string());
    std::error_code failed;
    fs::create_directories (hidden, failed);
    lock = FileLock::take (lockIn (hidden));
    fs::rename (hidden, own, failed);
    if (failed) lock.reset();
    if (! lock) wrong = "Nothing can be kept for the case of a crash: " + own.string() + " cannot be written. Save often, or set TACTUS_HOME to a folder that can be.";
}

std::optional<std::string> Session::keep (const Kept& kept)
{
    if (! lock) return wrong;
    return writeTextFile (keptIn (own), writeKept (kept));
}

void Session::noteTrial()
{
    if (trial || ! lock) return;
    trial = ! writeTextFile (trialIn (own), "\n").has_value();
}

void Session::noteTrialIsOver()
{
    if (! trial) return;
    trial = false;
    std::error_code failed;
    fs::remove (trialIn (own), failed);
}

void Session::end()
{
    if (! lock) return;
    std::error_code failed;
    fs::remove_all (own, failed);
    lock.reset();
}

void Leftover::discard()
{
    std::error_code failed;
    fs::remove_all (own, failed);
    lock.reset();
}

std::vector<Leftover> leftoversIn (const fs::path& home)
{
    std::vector<Leftover> all;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (sessionsIn (home), failed))
    {
        if (! entry.is_directory (failed) || entry.path().filename().string().starts_with ('.')) continue;   // one that is being made
        Leftover l;
        l.own = entry.path();
        l.lock = FileLock::take (lockIn (l.own));
        if (! l.lock) continue;   // somebody's, who lives
        l.in_trial = fs::exists (trialIn (l.own), failed);
        if (const auto text = readTextFile (keptIn (l.own)))
        {
            auto read = readKept (*text);
            l.what = std::move (read.kept);
            l.wrong = std::move (read.problem);
            if (l.wrong.empty()) l.wrong = restore (l.what).problem;
        }
        else
        {
            l.discard();
            continue;
        }
        if (l.wrong.empty() && ! l.what.changed && ! l.in_trial)
            l.discard();
        else
            all.push_back (std::move (l));
    }
    std::ranges::sort (all, std::greater {}, [] (const Leftover& l)
                       { return l.kept().at_s; });
    return all;
}

RecoveryQuestion questionAbout (const Leftover& l, double now_s)
{
    RecoveryQuestion q;
    q.title = "Tactus did not end well";
    if (! l.problem().empty())
    {
        q.can_recover = false;
        q.text = "What was kept of the graph that was open cannot be read: " + l.problem() + ". It is in " + (l.folder() / "kept.json").string() + "; copy it if you want to look into it.";
        return q;
    }
    const auto name = "'" + nameOf (l.kept()) + "'";
    const auto ago = howLongAgo (now_s - l.kept().at_s) + " ago";
    q.text = l.kept().changed ? name + " has changes that are not saved, the last " + ago + "." : name + " was open, " + ago + ".";
    q.safe_first = l.endedInTrial();
    if (q.safe_first) q.text += " It ended soon after the graph was started or changed, so running it may end it again: better look at it first. START then runs it.";
    return q;
}

}   // namespace tactus::host
