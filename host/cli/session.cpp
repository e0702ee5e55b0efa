// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.hpp"
#include "overwriting.hpp"
#include "report.hpp"

#include <framework/file/json_text.hpp>
#include <framework/graph/reconcile.hpp>
#include <framework/in_quotes.hpp>
#include <framework/near_miss.hpp>
#include <framework/number_text.hpp>
#include <framework/plan/missing_parts.hpp>
#include <framework/refused.hpp>
#include <framework/turn.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/platform/home_folder.hpp>
#include <host/runlog/graph_snapshot.hpp>
#include <host/runtime/taps.hpp>
#include <host/sessions/needs.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>

namespace tactus::host
{

plan::Override readSet (const std::string& text)
{
    const auto equals = text.find ('=');
    if (equals == std::string::npos || equals == 0)
        throw CLI::ValidationError ("--set", "'" + text + "' is not NODE.PARAM=VALUE, as in drag.mu=0.3 or board.stiffness=\"2 N/mm\"");
    return { text.substr (0, equals), readValue (text.substr (equals + 1)) };
}

namespace
{
/// A placeholder does not keep the rest from running.
void warnOnly (Messages& messages)
{
    for (auto& m : messages)
        m.severity = Message::Severity::warning;
}

Message warning (std::string id, std::string where, std::string text, std::string remedy)
{
    return { .severity = Message::Severity::warning, .id = std::move (id), .where = std::move (where), .text = std::move (text), .remedy = std::move (remedy) };
}

const Message& firstError (const Messages& messages) { return *std::ranges::find (messages, Message::Severity::error, &Message::severity); }

const Json* descriptionOf (const graph::Graph& graph, const std::string& role)
{
    const auto at = std::ranges::find (graph.devices, role, &std::pair<std::string, Json>::first);
    return at != graph.devices.end() ? &at->second : nullptr;
}

/// CLI::Range lets nan pass, which is neither below nor above.
CLI::Validator finiteWithin (double min, double max)
{
    const auto range = "from " + numberText (min) + " to " + numberText (max);
    return CLI::Validator ([=] (std::string& text)
                           {
        double value = 0.0;
        const bool fits = CLI::detail::lexical_cast (text, value) && value >= min && value <= max;
        return fits ? std::string() : "'" + text + "' is not a number " + range; },
                           range);
}
}   // namespace

void SessionOptions::addTo (CLI::App& app)
{
    app.add_option ("graph", graph, "Graph file, as in graphs/dry_wood.json")->required();
    app.add_option ("--feed", feed, "CSV whose columns drive ports: node.port or node.port.x, and t in s");
    app.add_option ("--record", records, "Ports to record, separated by commas; default: the inputs of every sink")->delimiter (',')->allow_extra_args (false);
    app.add_option ("--out", outputs, "Where to: a .csv or a .wav; may be given more than once")->allow_extra_args (false);
    app.add_option ("--rate", rate_hz, "Ticks per second; default: the feed's, else the graph's")->check (finiteWithin (1.0, 1e6));
    app.add_option ("--duration", duration_s, "Length of the run in s")->check (finiteWithin (1e-9, 1e9));
    app.add_option ("--set", sets, "NODE.PARAM=VALUE, or CONTROL=0…1; may be given more than once")->allow_extra_args (false);
    app.add_option ("--device", devices, "ROLE=FILE.json, ROLE=sim, ROLE=trace:FILE.csv, ROLE=gesture:NAME or ROLE=hid:PROFILE (hid:auto), or ROLE=audio:CARD")->allow_extra_args (false);
}

Session::Session (const SessionOptions& options, Pace pace) : told (options), loaded (loadGraph (options.graph)), rig ({}), real (pace == Pace::live, rig), records (options.records)
{
    if (pace == Pace::live) answers = std::make_unique<AnsweringThread>();
    if (report (loaded.messages, loaded, told.graph) > 0) throw Stop {};
    readFeed();
    if (pace == Pace::live)
    {
        readDesk();
        chooseAudio();
        decideClock();
    }
    auto first = compileGraph();
    bindDevices();
    decideLength();
    auto outputs = told.outputs;
    for (const auto* file : { &told.log, &told.capture })
        if (! file->empty()) outputs.push_back (*file);
    refuseOverwriting (outputs, inputs());
    if (! told.log.empty()) startLog (std::move (first));
    if (pace == Pace::live) startAudio();
}

void Session::startAudio()
{
    if (! rig.isNeeded() && told.capture.empty()) return rig.seal();
    auto messages = rig.begin (running->plan(), rate_hz, running.get());
    for (auto& m : messages)
        if (m.where.empty()) m.where = told.card.empty() ? "the sound card" : "--audio " + told.card;
    if (report (messages, loaded, told.graph) > 0) throw Stop {};
    if (told.capture.empty()) return;
    if (auto error = rig.captureTo (told.capture)) fail (*error);
}

void Session::readFeed()
{
    rate_hz = told.rate_hz > 0.0 ? told.rate_hz : loaded.graph.rate_hz;
    if (told.feed.empty()) return;
    feed = orFail (Feed::make (orFail (readTable (std::filesystem::path (told.feed))), told.feed, told.rate_hz, loaded.graph.rate_hz));
    rate_hz = feed->rate();
}

Compiled Session::compileNow (const graph::Graph& graph, const Plan* before, const Plan* withdrawn, const std::vector<std::string>& watched)
{
    CompileOptions wanted { .rate_hz = rate_hz, .records = records, .assets = &noted, .services = { .nearest_triangle = nearestByEmbree, .answers = answers.get() }, .before = before, .withdrawn = withdrawn };
    noted.paths.clear();
    wanted.records.insert (wanted.records.end(), watched.begin(), watched.end());
    if (with_routes) std::ranges::move (rig.ports(), std::back_inserter (wanted.records));
    if (feed) wanted.feeds = feed->ports();
    for (const auto& set : told.sets)
        wanted.overrides.push_back (readSet (set));
    auto compiled = compile (graph, catalogue(), wanted);
    const auto isGone = [&] (const audio::Route& route)
    { return route.if_there && std::ranges::count (compiled.messages, "record " + route.port, &Message::where) > 0; };
    std::size_t gone = 0;
    if (with_routes)
        for (const auto& route : rig.settings().routes)
            if (isGone (route)) gone += std::erase (wanted.records, route.port);
    return gone > 0 ? compile (graph, catalogue(), wanted) : compiled;
}

/// The session of devices that the run is to use.
void Session::readDesk()
{
    if (told.session == "off") return;
    desk = told.session.empty() ? loadUsualSession (homeFolder()) : loadSession (told.session);
    if (report (desk.messages, loaded, told.graph) == 0) return;
    std::cerr << "    the run did not begin; to run without a session: --session off\n";
    throw Stop {};
}

/// What the session says about sound, and what options add to it.
void Session::chooseAudio()
{
    Messages messages;
    const auto* written = desk.session.audio();
    auto settings = written != nullptr ? audio::readAudioSettings (*written, "/audio", messages) : audio::AudioSettings {};
    for (auto& m : messages)
        place (m, desk);
    for (const auto& text : told.routes)
    {
        auto route = audio::parseRoute (text);
        if (auto* m = std::get_if<Message> (&route))
            messages.push_back (std::move (*m));
        else
            settings.routes.push_back (std::move (std::get<audio::Route> (route)));
    }
    if (report (messages, loaded, told.graph) > 0) throw Stop {};
    if (! told.card.empty())
    {
        const auto named = audio::parseCard (told.card, audio::soundCards().types());
        settings.card.type = named.type;
        settings.card.output = settings.card.input = named.output;
    }
    rig.choose (std::move (settings));
}

/// The roles of the graph that somebody describes, as an option, the session or the graph has it, in this order.
std::vector<Described> Session::devicesByRole()
{
    auto described = loaded.graph.devices;
    const auto describe = [&] (const std::string& role, const Json& description)
    {
        const auto at = std::ranges::find (described, role, &Described::first);
        if (at != described.end())
            at->second = description;
        else
            described.emplace_back (role, description);
    };
    for (const auto& role : rolesNamed (loaded.graph))
        if (const auto bound = bindingOf (desk, role)) describe (role, bound->description);
    for (const auto& text : told.devices)
        if (const auto parsed = parseDeviceOption (text, loaded.graph.devices, std::filesystem::path (told.graph).parent_path()); const auto* option = std::get_if<DeviceOption> (&parsed))
            describe (option->role, option->description);
    return described;
}

/// A device that has a clock of its own ticks the run, at its rate, unless somebody says otherwise.
void Session::decideClock()
{
    const auto rateOf = [&] (const Described& d, bool may_wait)
    { return real.tickRate (d.second, may_wait && ! told.strict && desk.session.binding (d.first) != nullptr); };
    ClockWish wish { told.clock, desk.session.clock(), {} };
    if (told.rate_hz > 0.0 || feed) wish.rate_hz = rate_hz;
    auto choice = host::chooseClock (wish, devicesByRole(), rateOf);
    for (auto& m : choice.messages)
        if (m.id == "session/clock") place (m, desk);
    if (report (choice.messages, loaded, told.graph) > 0) throw Stop {};
    if (choice.by_sound_card) rig.tickBy (rate_hz);
    if (choice.role.empty()) return;
    clock_role = choice.role;
    rate_hz = choice.rate_hz;
}

std::shared_ptr<const Plan> Session::compileGraph()
{
    // First without what is played, so that what is recorded is what it would be: where nobody says, the inputs of all sinks.
    auto compiled = compileNow (loaded.graph, nullptr, nullptr);
    if (compiled.plan && ! told.outputs.empty())
    {
        records.clear();
        for (const auto& tap : compiled.plan->taps)
            records.push_back (tap.name);
    }
    with_routes = true;
    if (compiled.plan && ! rig.settings().routes.empty()) compiled = compileNow (loaded.graph, nullptr, nullptr);
    with_placeholders = hasErrors (compiled.messages);
    if (compiled.plan) warnOnly (compiled.messages);
    report (compiled.messages, loaded, told.graph);
    if (! compiled.plan) throw Stop {};
    running = std::make_unique<Engine> (compiled.plan);
    return compiled.plan;
}

void Session::bindDevices()
{
    const auto folder = std::filesystem::path (told.graph).parent_path();
    std::vector<DeviceOption> chosen;
    std::vector<std::string> roles;
    for (const auto& role : running->plan().roles)
        roles.push_back (role.name);

    for (const auto& text : told.devices)
    {
        auto parsed = parseDeviceOption (text, loaded.graph.devices, folder);
        if (auto* message = std::get_if<Message> (&parsed)) fail ({ message->id, "--device " + text, message->text, message->remedy });
        chosen.push_back (std::move (std::get<DeviceOption> (parsed)));
        if (std::ranges::count (roles, chosen.back().role) == 0)
        {
            std::string all;
            for (const auto& r : roles)
                all += (all.empty() ? "" : ", ") + r;
            fail ({ "device/unknown_role", "--device " + text, "the graph has no role '" + chosen.back().role + "'" + didYouMean (chosen.back().role, roles), roles.empty() ? "it has no device nodes at all" : "its roles: " + all });
        }
    }

    Messages messages;
    for (const auto& role : roles)
        if (auto bound = open (role, loaded.graph, chosen, messages)) devices.push_back (std::move (*bound));
    if (report (messages, loaded, told.graph) > 0) throw Stop {};
    for (auto& d : devices)
        running->attach (d.role, *d.device, d.limits);
    report (missingParts (running->plan()), loaded, told.graph);
    const auto needs = needsOf (running->plan());
    for (const auto& real_one : realDevices())
        if (const auto role = std::ranges::find (needs, real_one.role, &RoleNeeds::role); role != needs.end()) report (missingTools (*role, partsOf (real_one.profile())), loaded, told.graph);
}

/// The device that an option names, else the one that the session binds, else the one that the graph describes, else a
/// simulated tool that nobody moves.
std::optional<Session::Bound> Session::open (const std::string& role, const graph::Graph& graph, const std::vector<DeviceOption>& options, Messages& messages)
{
    const auto folder = std::filesystem::path (told.graph).parent_path();
    const auto option = std::ranges::find (options, role, &DeviceOption::role);
    const bool by_option = option != options.end();
    if (auto binding = by_option ? std::nullopt : bindingOf (desk, role))
    {
        if (audio::isAudio (binding->description)) binding->description = audio::withChannels (binding->description, running->plan(), role);
        const auto openOne = [this] (const Json& description, const std::filesystem::path& from)
        { return real.open (description, from); };
        auto bound = openBound (desk, role, *binding, openOne, hid::thisComputer(), real.profiles(), told.strict ? Absence::refuses : Absence::waits);
        std::ranges::move (bound.messages, std::back_inserter (messages));
        if (! bound.device) return std::nullopt;
        return Bound { role, std::move (bound.device), bound.driver, bound.limits, false };
    }

    const auto* described = descriptionOf (graph, role);
    if (! by_option && ! described)
        messages.push_back (warning ("device/undescribed", "/devices", "nobody says which device role '" + role + "' is; a simulated tool at rest stands in for it", "describe it under `devices`, or give --device " + role + "=gesture:stroke"));

    Json description = by_option ? option->description : described ? *described
                                                                   : Json { { "driver", "sim" } };
    if (audio::isAudio (description)) description = audio::withChannels (description, running->plan(), role);
    auto made = real.open (description, by_option ? option->folder : folder);
    for (auto& m : made.messages)
        m.where = by_option ? "--device " + role + m.where : "/devices/" + role + m.where;
    std::ranges::move (made.messages, std::back_inserter (messages));
    if (! made.device) return std::nullopt;
    auto* driver = made.device.get();
    return Bound { role, std::move (made.device), driver, made.limits, ! by_option };
}

std::vector<Tap> Session::recorded() const
{
    const auto& taps = running->plan().taps;
    return { taps.begin(), taps.begin() + static_cast<std::ptrdiff_t> (std::min (taps.size(), records.size())) };
}

std::vector<RealDevice> Session::realDevices() const
{
    std::vector<RealDevice> all;
    for (const auto& d : devices)
        if (auto device = realDevice (d.role, *d.driver)) all.push_back (std::move (*device));
    return all;
}

/// The devices of roles that there were not before.
std::vector<Session::Bound> Session::openNew (const Plan& plan, const graph::Graph& graph, Messages& messages)
{
    std::vector<Bound> opened;
    for (const auto& role : plan.roles)
        if (std::ranges::find (devices, role.name, &Bound::role) == devices.end())
            if (auto bound = open (role.name, graph, {}, messages)) opened.push_back (std::move (*bound));
    return opened;
}

void Session::decideLength()
{
    double seconds = told.duration_s;
    if (seconds == 0.0)
        for (const auto& d : devices)
            seconds = std::max (seconds, d.device->duration());

    if (feed) count = feed->ticks();
    if (told.duration_s > 0.0 || (! feed && seconds > 0.0))
    {
        const double wanted = std::ceil (seconds * rate_hz - 1e-6);
        if (wanted > 1e10) fail ("run/too_long", "a run of more than 10^10 ticks would hardly end", "give a shorter --duration or a lower --rate");
        count = std::min (count.value_or (static_cast<std::size_t> (-1)), static_cast<std::size_t> (wanted));
    }
}

void Session::startLog (std::shared_ptr<const Plan> first)
{
    RunHead head { .program = TACTUS_VERSION, .rate_hz = rate_hz, .sets = told.sets, .feeds = feed ? feed->ports() : std::vector<std::string> {} };
    for (const auto& d : devices)
    {
        head.guards.emplace (d.role, d.limits);
        head.devices.emplace (d.role, d.device->layout());
    }
    log = orFail (RunLog::create (told.log, head));
    log->expect (std::move (first), snapshotOf (loaded.graph, noted.paths, log->folder()));
    running->report (log->journal());
    if (answers) answers->report (log->journal());
}

void Session::submit (std::shared_ptr<Plan> plan, const graph::Graph& graph, std::span<const Engine::Joining> joining)
{
    if (log)
    {
        std::map<std::string, GuardLimits> guards;
        std::map<std::string, DeviceLayout> layouts;
        for (const auto& j : joining)
        {
            guards.emplace (j.role, j.limits);
            layouts.emplace (j.role, j.device.layout());
        }
        log->expect (plan, snapshotOf (graph, noted.paths, log->folder()), guards, layouts);
    }
    running->submit (std::move (plan), joining);
}

void Session::drainLog()
{
    if (! log || log_failure) return;
    if (auto drained = log->drain(); ! drained)
    {
        log_failure = std::move (drained.error());
        std::cerr << told.log << ": warning: " << log_failure->what << ", and the log ends here; the run goes on [" << log_failure->id << "]\n";
        return;
    }
    if (std::exchange (log_broke, log->brokenAt().has_value()) || ! log_broke) return;
    std::cerr << told.log << ": warning: writing the log could not keep up, and it ends at tick " << *log->brokenAt() << "; the run goes on\n    write it to a faster disk, or log at a lower --rate [log/broken]\n";
}

std::optional<Error> Session::finishLog()
{
    drainLog();
    if (log && ! log_failure)
        if (auto finished = log->finish(); ! finished) log_failure = std::move (finished.error());
    return log_failure;
}

bool Session::reload()
{
    auto next = loadGraph (told.graph);
    if (report (next.messages, next, told.graph) > 0) return false;
    graph::reconcile (next.graph, loaded.graph);

    forgetProbes();
    auto waiting = running->withdraw();
    auto [plan, messages] = compileNow (next.graph, &running->newest(), waiting.get());
    const bool placeholders = plan && hasErrors (messages);
    if (placeholders && with_placeholders) warnOnly (messages);
    auto opened = plan ? openNew (*plan, next.graph, messages) : std::vector<Bound> {};
    if (report (messages, next, told.graph) > 0)
    {
        running->submit (std::move (waiting));
        return false;
    }
    ring.select ({}, 1);
    probed.clear();
    endCapture();
    std::vector<Engine::Joining> joining;
    for (const auto& d : opened)
        joining.push_back ({ d.role, *d.device, d.limits });
    submit (plan, next.graph, joining);
    report (missingParts (*plan), next, told.graph);
    report (notTakenOver (next.graph), next, told.graph);
    std::ranges::move (opened, std::back_inserter (devices));

    loaded = std::move (next);
    with_placeholders = placeholders;
    return true;
}

/// What is captured comes first, so that it has the same numbers in all plans as long as it is, whatever is probed.
Compiled Session::compileWatched (const Plan* withdrawn)
{
    auto ports = captured_ports;
    ports.insert (ports.end(), probed.begin(), probed.end());
    return compileNow (loaded.graph, &running->newest(), withdrawn, ports);
}

void Session::selectProbes (const Plan& plan)
{
    constexpr double highest_rate_hz = 1000.0;
    ring.select (tapsOf (plan, probed), static_cast<std::uint32_t> (std::max (1.0, std::round (rate_hz / highest_rate_hz))));
}

std::variant<std::vector<std::string>, Message> Session::probe (const std::vector<std::string>& ports)
{
    forgetProbes();
    auto waiting = running->withdraw();
    auto before = std::exchange (probed, ports);
    auto [plan, messages] = compileWatched (waiting.get());
    const auto taps = plan ? tapsOf (*plan, ports) : std::vector<std::size_t> {};
    const auto unseen = std::ranges::find_if (ports, [&] (const std::string& port)
                                              { return plan && tapsOf (*plan, { port }).empty(); });
    if (! plan || taps.size() > ProbeRing::most || unseen != ports.end())
    {
        probed = std::move (before);
        running->submit (std::move (waiting));
        if (! plan) return firstError (messages);
        if (unseen != ports.end()) return refused ("probe/several", inQuotes (*unseen) + " stands for ports of several instances inside", "name them inside, as in hand/finger[*]/drag.force");
        return refused ("probe/too_many", "all probes together would have " + std::to_string (taps.size()) + " components, and there is room for " + std::to_string (ProbeRing::most), "wait until others are over");
    }
    auto names = namesOf (*plan, taps);
    selectProbes (*plan);
    submit (std::move (plan), loaded.graph);
    return names;
}

std::variant<std::vector<std::string>, Message> Session::capture (const std::string& port, const std::string& watched, const Trigger& trigger)
{
    endCapture();
    forgetProbes();
    auto waiting = running->withdraw();
    captured_ports = { port, watched };
    auto [plan, messages] = compileWatched (waiting.get());
    const auto refuse = [&] (Message m)
    {
        captured_ports.clear();
        running->submit (std::move (waiting));
        return m;
    };
    if (! plan) return refuse (firstError (messages));
    auto armed = arm (*plan, port, watched, trigger);
    if (auto* problem = std::get_if<Message> (&armed)) return refuse (std::move (*problem));

    selectProbes (*plan);
    auto& [capture, names] = std::get<Armed> (armed);
    slot.arm (std::move (capture));
    submit (std::move (plan), loaded.graph);
    return names;
}

void Session::endCapture()
{
    slot.disarm();
    captured_ports.clear();
}

/// A plan may come to stand where one stood that was freed: what is still there of that one is not to be taken for its.
void Session::forgetProbes()
{
    ring.drain ([] (const auto&) {});
}

Messages Session::notTakenOver (const graph::Graph& graph) const
{
    Messages messages;
    if (graph.rate_hz != loaded.graph.rate_hz && told.rate_hz == 0.0 && ! feed)
        messages.push_back (warning ("watch/rate", "/rate_hz", "the run goes on at " + numberText (rate_hz) + " Hz", "start it anew for " + numberText (graph.rate_hz) + " Hz"));
    for (const auto& device : devices)
    {
        const auto *present = descriptionOf (graph, device.role), *before = descriptionOf (loaded.graph, device.role);
        const bool differs = present != nullptr && (before == nullptr || *present != *before);
        if (differs && device.by_graph)
            messages.push_back (warning ("watch/device", "/devices/" + device.role, "the device of '" + device.role + "' goes on as it was opened, with the guard it had", "start the run anew for the one described now"));
    }
    return messages;
}

std::vector<std::filesystem::path> Session::files() const
{
    std::vector<std::filesystem::path> all { told.graph };
    const auto add = [&] (const auto& self, const graph::Graph& graph) -> void
    {
        for (const auto& [written, file] : graph.files)
        {
            auto path = std::filesystem::path (graph.folder) / written;
            if (std::ranges::find (all, path) != all.end()) continue;
            all.push_back (std::move (path));
            self (self, *file);
        }
    };
    add (add, loaded.graph);
    return all;
}

std::vector<std::filesystem::path> Session::inputs() const
{
    auto all = files();
    if (! told.feed.empty()) all.emplace_back (told.feed);
    all.insert (all.end(), noted.paths.begin(), noted.paths.end());
    const auto add = [&] (const std::filesystem::path& folder, const Json& description)
    {
        for (const auto* at : { "/path", "/hand/path" })
            if (const Json::json_pointer path (at); description.is_object() && description.contains (path) && description.at (path).is_string()) all.push_back (folder / description.at (path).get<std::string>());
    };
    const auto folder = std::filesystem::path (told.graph).parent_path();
    for (const auto& [role, description] : loaded.graph.devices)
        add (folder, description);
    if (! desk.file.empty()) all.push_back (desk.file);
    for (const auto& role : desk.session.roles())
        add (desk.file.parent_path(), *desk.session.binding (role));
    for (const auto& text : told.devices)
    {
        all.emplace_back (text.substr (text.find ('=') + 1));
        const auto parsed = parseDeviceOption (text, loaded.graph.devices, folder);
        if (const auto* option = std::get_if<DeviceOption> (&parsed)) add (option->folder, option->description);
    }
    return all;
}

void Session::reportRun() const
{
    for (const auto& d : devices)
        if (const auto& event = running->guardOf (d.role).latest(); event.why != Guard::Stop::none && event.why != Guard::Stop::halted && event.why != Guard::Stop::released)
            std::cerr << d.role << ": warning: the guard withheld the force: " << describe (event) << '\n';
    if (const auto late = answers ? answers->lateTicks() : 0; late > 0)
        std::cerr << "warning: " << late << (late == 1 ? " time" : " times") << " a slow answer (the search of a large surface) was not there when it was due\n    give it more ticks in the settings of the node, as in search_ticks [run/late_answers]\n";
}

void Session::before (std::uint64_t tick) noexcept
{
    if (feed) (*feed) (tick, running->plan().feeds);
    rig.before();
}

void Session::after (std::uint64_t tick, bool halts) noexcept
{
    rig.after (running->plan(), halts);
    ring.note (running->plan(), tick);
    slot.note (running->plan(), tick);
}

void Session::tick() noexcept
{
    before (now);
    running->tick();
    after (now, false);
    ++now;
}

}   // namespace tactus::host
