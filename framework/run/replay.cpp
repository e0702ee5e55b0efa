// SPDX-License-Identifier: MIT
#include "replay.hpp"
#include "log/graph_snapshot.hpp"
#include "turn.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/plan/find_hit.hpp>
#include <tactus/plan/find_param.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace tactus
{

namespace
{
const Message& firstError (const Messages& messages) { return *std::ranges::find (messages, Message::Severity::error, &Message::severity); }
}   // namespace

namespace
{
/// True if the runs of both programs have the same bits: they are the same, or of one version, whose programs and libraries have the same code.
bool isSameBuild (std::string_view one, std::string_view other)
{
    const auto versionOf = [] (std::string_view program) -> std::string_view {
        for (const std::string_view name : { "tactus ", "libtactus ", "libtactus_live " })
            if (program.starts_with (name)) return program.substr (name.size());
        return {};
    };
    return one == other || (! versionOf (one).empty() && versionOf (one) == versionOf (other));
}
}   // namespace

Result<std::unique_ptr<Replay>> Replay::open (const std::string& path, Options options)
{
    auto log = RunLogReader::open (path);
    if (! log) return log.error();
    return open (std::move (*log), std::move (options));
}

Result<std::unique_ptr<Replay>> Replay::open (RunLogReader log, Options options)
{
    std::unique_ptr<Replay> replay { new Replay (std::move (log), std::move (options)) };
    if (auto begun = replay->begin(); ! begun) return begun.error();
    return replay;
}

Replay::Replay (RunLogReader reader, Options o) : log (std::move (reader)), options (std::move (o)) {}

Result<> Replay::begin()
{
    const auto& head = log.head();
    if (! isSameBuild (head.program, options.program))
        warnings.push_back (Message::warning ("log/other_program", log.name(),
                                              "the run was recorded by " + quote (head.program) + ", but this is " + options.program
                                                  + "; only the same program is certain to reproduce the run bit for bit"));
    else if (head.functions != math::revision)
        warnings.push_back (Message::warning ("log/other_functions", log.name(),
                                              "the run was recorded by a version whose sin, exp and the like give different bits (revision "
                                                  + std::to_string (head.functions) + ", here " + std::to_string (math::revision)
                                                  + "), so the replay may differ in the last digits"));
    if (options.duration_s > 0.0) most = static_cast<std::uint64_t> (std::ceil (options.duration_s * rate() - 1e-6));

    if (auto fetched = fetch(); ! fetched) return fetched;
    if (! next || next->last != RunTick::Last::no) return Message::error ("log/empty", log.name(), "the run ended before its first tick", "log a longer run");

    CompileOptions compile { .rate_hz = rate(), .feeds = head.feeds, .records = options.records, .assets = options.assets, .services = options.services };
    compile.services.answers = &queries;
    for (const auto& set : head.sets)
    {
        auto read = readOverride (set);
        if (! read) return here (read.error());
        compile.overrides.push_back (std::move (*read));
    }
    std::ranges::copy (options.overrides, std::back_inserter (compile.overrides));

    running = std::make_unique<Run> (catalogue(), std::move (compile),
                                     [this] (const std::string& role, const graph::Graph&, const Plan&, Messages&) { return openHand (role); });
    running->add (feed);
    auto logged = options.graph == nullptr ? loggedGraph() : Result<graph::Graph> { graph::Graph {} };
    if (! logged) return here (logged.error());
    const auto& graph = options.graph != nullptr ? *options.graph : *logged;
    auto messages = running->load (graph);
    if (! running->hasEngine()) return here (firstError (messages));
    played = graph;
    running->keepRecords();
    running->openDevices (graph, messages);
    has_begun = true;
    return {};
}

Result<graph::Graph> Replay::loggedGraph() const
{
    const auto folder = std::filesystem::path (log.name()).parent_path();
    if (const auto changed = checkAssets (*next->graph, folder); ! changed.empty()) return changed.front();
    return readSnapshot (*next->graph, folder);
}

Run::RoleDevice Replay::openHand (const std::string& role)
{
    const auto& head = log.head();
    auto hand = std::make_unique<Hand>();
    GuardLimits limits;
    const auto takeFrom = [&] (const auto& guards, const auto& devices) {
        const auto guard = guards.find (role);
        if (guard == guards.end()) return false;
        limits = guard->second;
        if (const auto device = devices.find (role); device != devices.end()) hand->has = device->second;
        return true;
    };
    const bool known = has_begun ? takeFrom (next->guards, next->devices) : takeFrom (head.guards, head.devices);
    if (! known && has_begun) return {};
    if (! known)
        warnings.push_back (Message::warning ("log/no_role", log.name(),
                                              "the logged run had no role '" + role + "', so in the replay this role reads a hand at rest"));
    hands[role] = hand.get();
    return { .device = std::move (hand), .limits = limits, .is_logged = known && options.graph == nullptr };
}

Result<> Replay::fetch()
{
    auto fetched = log.next();
    if (! fetched) return fetched.error();
    next = std::move (*fetched);
    if (next && ! most && next->tick > most_ticks_unasked)
        return here (Message::error ("log/too_long", {},
                                     "the log asks for " + std::to_string (next->tick) + " ticks; without a duration, a replay is limited to "
                                         + std::to_string (most_ticks_unasked) + " ticks",
                                     "give a --duration in s"));
    return {};
}

Result<bool> Replay::tick()
{
    if (! next || (most && now >= *most)) return false;
    while (next && next->tick == now)
    {
        if (next->last == RunTick::Last::broken) broken_at = now;
        if (next->last != RunTick::Last::no || next->halt == true) return false;
        if (auto done = carryOut(); ! done) return here (done.error());
        if (auto fetched = fetch(); ! fetched) return fetched.error();
    }
    running->tick();
    ++now;
    return true;
}

void Replay::FeedValues::before (Plan& plan, std::uint64_t) noexcept
{
    if (! values.empty()) plan.setFeeds (values);
}

Result<> Replay::swapPlan()
{
    auto graph = loggedGraph();
    if (! graph) return graph.error();
    auto edit = running->edit (*graph, next->kept);
    if (edit.plan() == nullptr) return firstError (edit.messages());
    edit.openDevices();
    edit.tightenOnly (next->tightened);   // the log has what took effect, also of edits that were undone before they ran
    edit.commit();
    running->engine().takeSubmitted();
    played = *graph;
    return {};
}

Result<> Replay::carryOut()
{
    if (next->graph && (std::exchange (has_first, true) || ! next->tightened.empty()) && options.graph == nullptr)
        if (auto swapped = swapPlan(); ! swapped) return swapped;
    for (const auto& [param, target] : next->turns)
        if (auto done = turn (param, target); ! done) return done;
    for (const auto& [input, speed] : next->hits)
        if (auto done = strike (input, speed); ! done) return done;
    for (const auto& [role, reading] : next->readings)
        if (const auto hand = hands.find (role); hand != hands.end()) hand->second->reading = reading;
    if (next->rearm) running->engine().rearm();
    if (next->emergency) running->engine().emergencyStop();
    if (next->passed_s) running->engine().passTime (*next->passed_s);
    if (next->feed) feed.values = *next->feed;
    queries.repeat (next->late);
    return {};
}

Result<> Replay::turn (const std::string& param, double target)
{
    const auto found = running->engine().param (param);
    if (found)
        running->engine().set (*found, target);
    else if (options.graph == nullptr)
        return found.error();
    else if (not_there.insert (param).second)
        warnings.push_back (Message::warning ("log/not_turned", {}, "the logged run turned " + param + ", which this graph does not have"));
    return {};
}

Result<> Replay::strike (const std::string& input, double speed)
{
    const auto found = running->engine().hits (input);
    if (found)
        running->engine().strike (found->front(), speed);
    else if (options.graph == nullptr)
        return found.error();
    else if (not_there.insert (input).second)
        warnings.push_back (Message::warning ("log/not_struck", {}, "the logged run triggered hits on " + input + ", which this graph does not have"));
    return {};
}

/// The message as an error in the current line of the log.
Message Replay::here (const Message& m) const { return Message::error (m.id, log.placeOf (next ? next->line : 1), m.text, m.remedy); }

std::optional<Message> Replay::end() const
{
    if (broken_at)
        return Message::warning ("log/broken", log.name(),
                                 "writing the log could not keep up with the run, so the log ends at tick " + std::to_string (*broken_at)
                                     + "; before that tick it is complete");
    if (! next && log.isCutOff())
        return Message::warning ("log/cut_off", log.name(),
                                 "the log breaks off after tick " + std::to_string (now - 1)
                                     + ", because the program that wrote it was killed or crashed; up to that tick it is complete");
    return std::nullopt;
}

}   // namespace tactus
