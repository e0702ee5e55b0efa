// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay.hpp"
#include "report.hpp"

#include <framework/plan/find_hit.hpp>
#include <framework/plan/find_param.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/runlog/graph_snapshot.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <utility>

namespace tactus::host
{

Replay::Replay (const SessionOptions& options, const std::string& path) : told (options), log (orFail (RunLogReader::open (path))), records (options.records)
{
    if (log.head().program != TACTUS_VERSION)
        std::cerr << path << ": warning: the run was of " << log.head().program << ", and this is " << TACTUS_VERSION << "; only the same program is known to give the same bits [log/other_program]\n";
    if (told.duration_s > 0.0) most = static_cast<std::uint64_t> (std::ceil (told.duration_s * rate() - 1e-6));

    fetch();
    if (! next || next->last != RunTick::Last::no) fail ({ "log/empty", path, "the run was over before its first tick", "log a longer one" });
    auto first = told.graph.empty() ? compileLogged (nullptr) : compileOwn();
    records.clear();
    for (const auto& tap : first->taps)
        records.push_back (tap.name);
    running = std::make_unique<Engine> (std::move (first));
    bindHands();
}

std::shared_ptr<Plan> Replay::compileNow (const graph::Graph& graph, const Plan* before)
{
    CompileOptions wanted { .rate_hz = rate(), .feeds = log.head().feeds, .records = records, .assets = &assets, .services = { .nearest_triangle = nearestByEmbree, .answers = &answers }, .before = before };
    for (const auto& sets : { log.head().sets, told.sets })
        for (const auto& set : sets)
            wanted.overrides.push_back (readSet (set));
    auto [plan, messages] = compile (graph, catalogue(), wanted);
    if (! plan) failHere (*std::ranges::find (messages, Message::Severity::error, &Message::severity));
    name_of_graph = graph.name;
    return std::move (plan);
}

std::shared_ptr<Plan> Replay::compileOwn()
{
    const auto loaded = loadGraph (told.graph);
    if (report (loaded.messages, loaded, told.graph) > 0) throw Stop {};
    return compileNow (loaded.graph, nullptr);
}

std::shared_ptr<Plan> Replay::compileLogged (const Plan* before)
{
    const auto folder = std::filesystem::path (log.name()).parent_path();
    for (const auto& message : checkAssets (*next->graph, folder))
        failHere (message);
    const auto graph = readSnapshot (*next->graph, folder);
    if (const auto* message = std::get_if<Message> (&graph)) failHere (*message);
    return compileNow (std::get<graph::Graph> (graph), before);
}

void Replay::bindHands()
{
    for (const auto& role : running->newest().roles)
    {
        const auto guard = log.head().guards.find (role.name);
        if (guard == log.head().guards.end())
            std::cerr << log.name() << ": warning: there was no role '" << role.name << "' in the run; a hand at rest stands in for it [log/no_role]\n";
        if (const auto device = log.head().devices.find (role.name); device != log.head().devices.end()) hands[role.name].has = device->second;
        running->attach (role.name, hands[role.name], guard != log.head().guards.end() ? guard->second : GuardLimits {});
    }
}

void Replay::fetch() { next = orFail (log.next()); }

bool Replay::tick()
{
    if (! next || (most && now >= *most)) return false;
    while (next && next->tick == now)
    {
        if (next->last == RunTick::Last::broken) broken_at = now;
        if (next->last != RunTick::Last::no || next->halt == true) return false;
        carryOut();
        fetch();
    }
    if (! feed.empty()) std::ranges::copy (feed, running->plan().feeds.begin());
    running->tick();
    ++now;
    return true;
}

void Replay::takeOver()
{
    auto plan = compileLogged (&running->newest());
    std::erase_if (plan->takeover.changes, [&] (const auto& change)
                   { return std::ranges::count (next->kept, plan::nameOf (*plan, change.instance, change.knob)) > 0; });
    std::vector<Engine::Joining> joining;
    for (const auto& [role, limits] : next->guards)
        if (! hands.contains (role) && std::ranges::count (plan->roles, role, &Plan::RoleUse::name) > 0)
        {
            auto& hand = hands[role];
            if (const auto device = next->devices.find (role); device != next->devices.end()) hand.has = device->second;
            joining.push_back ({ role, hand, limits });
        }
    running->submit (std::move (plan), joining);
    running->takeSubmitted();
}

void Replay::carryOut()
{
    if (next->graph && std::exchange (has_first, true) && told.graph.empty()) takeOver();
    for (const auto& [param, target] : next->turns)
        turn (param, target);
    for (const auto& [input, speed] : next->hits)
        strike (input, speed);
    for (const auto& [role, reading] : next->readings)
        if (const auto hand = hands.find (role); hand != hands.end()) hand->second.reading = reading;
    if (next->rearm) running->rearm();
    if (next->emergency) running->emergencyStop();
    if (next->feed) feed = *next->feed;
    answers.repeat (next->late);
}

void Replay::turn (const std::string& param, double target)
{
    const auto found = running->param (param);
    if (const auto* ref = std::get_if<plan::ParamRef> (&found)) return running->set (*ref, target);
    if (told.graph.empty()) failHere (std::get<Message> (found));
    if (not_turned.insert (param).second) std::cerr << told.graph << ": warning: " << param << " was turned in the run, and is not there [log/not_turned]\n";
}

void Replay::strike (const std::string& input, double speed)
{
    const auto found = running->hits (input);
    if (const auto* refs = std::get_if<std::vector<plan::HitRef>> (&found)) return running->strike (refs->front(), speed);
    if (told.graph.empty()) failHere (std::get<Message> (found));
    if (not_turned.insert (input).second) std::cerr << told.graph << ": warning: " << input << " was hit in the run, and is not there [log/not_struck]\n";
}

void Replay::failHere (const Message& m) const { fail ({ m.id, log.placeOf (next ? next->line : 1), m.text, m.remedy }); }

void Replay::reportEnd() const
{
    if (broken_at)
        std::cerr << log.name() << ": warning: writing the log could not keep up with the run, and it ends at tick " << *broken_at << "; until then all is as it was [log/broken]\n";
    else if (! next && log.isCutOff())
        std::cerr << log.name() << ": warning: the log breaks off after tick " << now - 1 << ", because the program did not come to its end; until then all is as it was [log/cut_off]\n";
}

}   // namespace tactus::host
