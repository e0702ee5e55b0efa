// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_run.hpp"
#include "overwriting.hpp"
#include "report.hpp"

#include <host/assets/nearest_by_embree.hpp>
#include <host/platform/home_folder.hpp>
#include <host/sessions/needs.hpp>
#include <host/sessions/numbers_device.hpp>
#include <tactus/graph/reconcile.hpp>
#include <tactus/plan/missing_parts.hpp>
#include <tactus/run/included_guards.hpp>
#include <tactus/run/replay.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <cmath>
#include <iostream>

namespace tactus::host
{

namespace
{
/// Turns errors into warnings: a placeholder for a node of an unknown type does not stop the other nodes from running.
void warnOnly (Messages& messages)
{
    for (auto& m : messages)
        m.severity = Message::Severity::warning;
}
}   // namespace

CommandRun::CommandRun (const RunOptions& o, Pace pace) : options (o), loaded (loadGraph (o.graph)), rig ({}), real (pace == Pace::live, rig)
{
    if (report (loaded.messages, loaded, options.graph) > 0) throw Stop {};
    readFeed();
    if (pace == Pace::live)
    {
        readDeviceSession();
        chooseAudio();
        decideClock();
    }

    CompileOptions compile { .rate_hz = asked_rate_hz,
                             .records = options.records,
                             .overrides = readSets (options.sets),
                             .assets = &assets,
                             .services = { .nearest_triangle = nearestByEmbree } };
    if (feed) compile.feeds = feed->drives();
    const auto opener = [this] (const std::string& role, const graph::Graph& graph, const Plan& plan,
                                Messages& messages) { return open (role, graph, plan, messages); };
    running = std::make_unique<Run> (catalogue(), std::move (compile), opener, pace == Pace::live ? Run::Queries::on_thread : Run::Queries::within_tick);
    load();
    openDevices();
    decideLength (pace);
    auto outputs = options.outputs;
    for (const auto* file : { &options.log, &options.capture })
        if (! file->empty()) outputs.push_back (*file);
    refuseOverwriting (outputs, inputs());
    if (pace == Pace::live) reportUnfinished (outputs);
    if (! options.log.empty()) orFail (running->startLog (options.log, TACTUS_VERSION, options.sets, loaded.graph));
    if (pace == Pace::live) startAudio();
}

void CommandRun::readFeed()
{
    asked_rate_hz = options.rate_hz;
    if (options.feed.empty()) return;
    feed = orFail (Feed::make (orFail (readTable (std::filesystem::path (options.feed))), options.feed, options.rate_hz, loaded.graph.rate_hz));
    asked_rate_hz = feed->rate();
}

/// Loads the device session of the run.
void CommandRun::readDeviceSession()
{
    if (options.session == "off") return;
    device_session = options.session.empty() ? loadDefaultSession (homeFolder()) : loadSession (options.session);
    if (report (device_session.messages, loaded, options.graph) == 0) return;
    std::cerr << "    the run did not start; to run without a session, give --session off\n";
    throw Stop {};
}

/// The sound settings of the session, with changes from options.
void CommandRun::chooseAudio()
{
    Messages messages;
    const auto* written = device_session.session.audio();
    auto settings = written != nullptr ? audio::readAudioSettings (*written, "/audio", messages) : audio::AudioSettings {};
    for (auto& m : messages)
        place (m, device_session);
    for (const auto& text : options.routes)
    {
        auto route = audio::parseRoute (text);
        if (route)
            settings.routes.push_back (std::move (*route));
        else
            messages.push_back (std::move (route).error());
    }
    if (report (messages, loaded, options.graph) > 0) throw Stop {};
    if (! options.card.empty())
    {
        const auto named = audio::parseCard (options.card, audio::soundCards().types());
        settings.card.type = named.type;
        settings.card.output = settings.card.input = named.output;
    }
    rig.choose (std::move (settings));
}

/// The device for each role, described by an option, the session or the graph, in this order of precedence.
std::vector<Described> CommandRun::devicesByRole()
{
    Messages reported_later;
    std::vector<Described> described;
    for (const auto& [role, description] : loaded.graph.devices)
        described.emplace_back (role, describedByGraph (&description, role, reported_later));
    const auto describe = [&] (const std::string& role, const Json& description) {
        const auto at = std::ranges::find (described, role, &Described::first);
        if (at != described.end())
            at->second = description;
        else
            described.emplace_back (role, description);
    };
    for (const auto& role : rolesNamed (loaded.graph))
        if (const auto bound = bindingOf (device_session, role)) describe (role, bound->description);
    for (const auto& text : options.devices)
        if (const auto parsed = optionOf (text, reported_later)) describe (parsed->role, parsed->description);
    return described;
}

Result<DeviceOption> CommandRun::optionOf (const std::string& text, Messages& notes)
{
    return host::parseDeviceOption (
        text, loaded.graph.devices, folder(), [this]() -> const hid::LoadedProfiles& { return real.profiles(); }, notes);
}

/// A device with its own clock ticks the run at its own rate, unless an option or the session says otherwise.
void CommandRun::decideClock()
{
    const auto rateOf = [&] (const Described& d, bool may_wait) {
        const bool is_bound = device_session.session.binding (d.first) != nullptr;
        return real.tickRate (d.second, may_wait && is_bound && ! options.strict);
    };
    ClockWish wish { options.clock, device_session.session.clock(), {} };
    if (options.rate_hz > 0.0 || feed) wish.rate_hz = asked_rate_hz;
    auto choice = host::chooseClock (wish, devicesByRole(), rateOf);
    for (auto& m : choice.messages)
        if (m.id == "session/clock") place (m, device_session);
    if (report (choice.messages, loaded, options.graph) > 0) throw Stop {};
    if (choice.by_sound_card) rig.tickBy (asked_rate_hz > 0.0 ? asked_rate_hz : loaded.graph.rate_hz);
    if (choice.role.empty()) return;
    clock_role = choice.role;
    asked_rate_hz = choice.rate_hz;
}

void CommandRun::load()
{
    if (feed) running->add (*feed);
    // First without the ports that the sound card plays, because the plan taps the inputs of all sinks only if no ports are named.
    auto messages = running->load (loaded.graph);
    if (running->hasEngine() && ! options.outputs.empty()) running->keepRecords();
    running->add (rig);
    running->add (port_probes);
    if (running->hasEngine() && ! rig.settings().routes.empty()) messages = running->load (loaded.graph);
    with_placeholders = hasErrors (messages);
    if (running->hasEngine()) warnOnly (messages);
    report (messages, loaded, options.graph);
    if (! running->hasEngine()) throw Stop {};
}

void CommandRun::checkDeviceOptions()
{
    std::vector<std::string> roles;
    for (const auto& role : engine().newest().roles())
        roles.push_back (role.name);
    for (const auto& text : options.devices)
    {
        Messages notes;
        auto parsed = optionOf (text, notes);
        report (notes, loaded, options.graph);
        if (! parsed) fail (Message::error (parsed.error().id, "--device " + text, parsed.error().text, parsed.error().remedy));
        device_options.push_back (std::move (*parsed));
        const auto& role = device_options.back().role;
        if (std::ranges::count (roles, role) > 0) continue;
        std::string all;
        for (const auto& r : roles)
            all += (all.empty() ? "" : ", ") + r;
        fail (Message::error ("device/unknown_role", "--device " + text, "the graph has no role '" + role + "'" + didYouMean (role, roles),
                              roles.empty() ? "remove the option: the graph has no device nodes" : "name one of its roles: " + all));
    }
}

void CommandRun::openDevices()
{
    checkDeviceOptions();
    Messages messages;
    running->openDevices (loaded.graph, messages);
    device_options.clear();   // a role that is added later has no options
    if (report (messages, loaded, options.graph) > 0) throw Stop {};
    const auto& plan = engine().newest();
    report (missingParts (plan), loaded, options.graph);
    const auto needs = needsOf (plan);
    for (const auto& device : realDevices())
        if (const auto role = std::ranges::find (needs, device.role, &RoleNeeds::role); role != needs.end())
            report (missingTools (*role, partsOf (device.profile())), loaded, options.graph);
}

/// The device named by an option, else by the session, else by the graph, else a simulated tool at rest.
Run::RoleDevice CommandRun::open (const std::string& role, const graph::Graph& graph, const Plan& plan, Messages& messages)
{
    const auto option = std::ranges::find (device_options, role, &DeviceOption::role);
    const bool by_option = option != device_options.end();
    if (! by_option)
        if (auto binding = bindingOf (device_session, role)) return openBySession (role, std::move (*binding), plan, messages);

    const auto* described = graph.device (role);
    if (! by_option && described == nullptr)
        messages.push_back (Message::warning ("device/undescribed", "/devices",
                                              "no device is given for the role '" + role + "', so it gets a simulated tool at rest",
                                              "describe a device for it under `devices`, or give --device " + role + "=gesture:stroke"));

    auto made = by_option ? openByOption (*option, plan) : makeDevice (describedByGraph (described, role, messages), folder());
    for (auto& m : made.messages)
        m.where = (by_option ? "--device " : "/devices/") + role + m.where;
    std::ranges::move (made.messages, std::back_inserter (messages));
    if (made.device && ! by_option) described_by_graph.insert (role);
    return { std::move (made.device), made.limits };
}

MadeDevice CommandRun::openByOption (const DeviceOption& option, const Plan& plan)
{
    const auto& d = option.description;
    return real.open (audio::isAudio (d) ? audio::withChannels (d, plan, option.role) : d, option.folder);
}

Run::RoleDevice CommandRun::openBySession (const std::string& role, RoleBinding binding, const Plan& plan, Messages& messages)
{
    if (audio::isAudio (binding.description)) binding.description = audio::withChannels (binding.description, plan, role);
    const auto openOne = [this] (const Json& description, const std::filesystem::path& from) { return real.open (description, from); };
    auto bound = openBound (device_session, role, binding, openOne, hid::thisComputer(), real.profiles(), options.strict ? Absence::refuses : Absence::waits);
    std::ranges::move (bound.messages, std::back_inserter (messages));
    return { std::move (bound.device), bound.limits, bound.driver };
}

std::vector<RealDevice> CommandRun::realDevices() const
{
    std::vector<RealDevice> all;
    for (const auto& [role, d] : running->devices())
        if (auto device = realDevice (role, d.driver != nullptr ? *d.driver : *d.device)) all.push_back (std::move (*device));
    return all;
}

void CommandRun::decideLength (Pace pace)
{
    double seconds = options.duration_s;
    if (seconds == 0.0)
        for (const auto& [role, d] : running->devices())
            seconds = std::max (seconds, d.device->duration());

    // A small file must not keep the computer busy for hours. A user who gives --duration wants a run of that length.
    constexpr auto most_unasked = static_cast<double> (Replay::most_ticks_unasked);
    const double by_files = feed ? static_cast<double> (feed->ticks()) : seconds * rate();
    if (pace == Pace::offline && options.duration_s == 0.0 && by_files > most_unasked)
    {
        const auto asks = (feed ? "the feed lasts " : "a device's path lasts ") + numberText (std::ceil (by_files)) + " ticks";
        fail ("run/too_long", asks + "; without --duration, a run has at most " + numberText (most_unasked), "give a --duration in s or a lower --rate");
    }

    if (feed) count = feed->ticks();
    if (options.watch && options.duration_s == 0.0) return;
    if (options.duration_s > 0.0 || (! feed && seconds > 0.0))
    {
        const double wanted = std::ceil (seconds * rate() - 1e-6);
        if (wanted > 1e10) fail ("run/too_long", "a run of more than 10^10 ticks would take too long", "give a shorter --duration or a lower --rate");
        count = std::min (count.value_or (static_cast<std::size_t> (-1)), static_cast<std::size_t> (wanted));
    }
}

std::size_t CommandRun::ticksOrFail() const
{
    if (! count)
        fail ("run/no_length", "the length of the run is unknown: there is no feed, trace or gesture",
              "give --duration S, --feed IN.csv, or --device ROLE=gesture:NAME");
    return *count;
}

void CommandRun::startAudio()
{
    if (! rig.isNeeded() && options.capture.empty()) return rig.seal();
    auto messages = rig.begin (engine().plan(), rate(), &engine());
    for (auto& m : messages)
        if (m.where.empty()) m.where = options.card.empty() ? "the sound card" : "--audio " + options.card;
    if (report (messages, loaded, options.graph) > 0) throw Stop {};
    if (options.capture.empty()) return;
    orFail (rig.captureTo (options.capture));
}

void CommandRun::attend()
{
    if (const auto trouble = running->attend())
    {
        const auto ending = trouble->id == "log/broken" ? "; the run continues\n    " + trouble->remedy : ", and the log ends here; the run continues";
        std::cerr << printableName (options.log) << ": warning: " << inOneLine (trouble->text) << printable (ending) << " [" << trouble->id << "]\n";
    }
}

bool CommandRun::reload()
{
    auto next = loadGraph (options.graph);
    if (report (next.messages, next, options.graph) > 0) return false;
    graph::reconcile (next.graph, loaded.graph);

    auto probed = port_probes.clear();   // drops ports of the previous graph
    auto edit = running->edit (next.graph);
    const bool placeholders = edit.plan() != nullptr && hasErrors (edit.messages());
    if (placeholders && with_placeholders) warnOnly (edit.messages());
    if (edit.plan() != nullptr) edit.openDevices();
    if (report (edit.messages(), next, options.graph) > 0)
    {
        port_probes.restore (std::move (probed));
        return false;
    }
    running->endCapture();
    edit.commit();
    report (missingParts (*edit.plan()), next, options.graph);
    report (notTakenOver (next.graph), next, options.graph);
    loaded = std::move (next);
    with_placeholders = placeholders;
    return true;
}

Messages CommandRun::notTakenOver (const graph::Graph& graph) const
{
    Messages messages;
    for (const auto& role : described_by_graph)
    {
        const auto *present = graph.device (role), *before = loaded.graph.device (role);
        if (present != nullptr && (before == nullptr || withoutGuard (*present) != withoutGuard (*before)))
            messages.push_back (Message::warning ("watch/device", "/devices/" + role,
                                                  "the device of the role '" + role + "' has a new description, but the run keeps the old device",
                                                  "restart the run to use the new description"));
    }
    return messages;
}

std::vector<std::filesystem::path> CommandRun::files() const
{
    std::vector<std::filesystem::path> all { options.graph };
    const auto add = [&] (const auto& self, const graph::Graph& graph) -> void {
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

std::vector<std::filesystem::path> CommandRun::inputs() const
{
    auto all = files();
    if (! options.feed.empty()) all.emplace_back (options.feed);
    const auto& assets_read = running->assetPaths();
    all.insert (all.end(), assets_read.begin(), assets_read.end());
    const auto add = [&] (const std::filesystem::path& from, const Json& description) {
        for (const auto* at : { "/path", "/hand/path" })
            if (const JsonPointer path (at); description.is_object() && description.contains (path) && description.at (path).is_string())
                all.push_back (from / description.at (path).get<std::string>());
    };
    for (const auto& [role, description] : loaded.graph.devices)
        add (folder(), description);
    if (! device_session.file.empty()) all.push_back (device_session.file);
    for (const auto& role : device_session.session.roles())
        add (device_session.file.parent_path(), *device_session.session.binding (role));
    for (const auto& text : options.devices)
    {
        all.emplace_back (text.substr (text.find ('=') + 1));
        if (const auto parsed = tactus::parseDeviceOption (text, loaded.graph.devices, folder())) add (parsed->folder, parsed->description);
    }
    return all;
}

void CommandRun::reportRun() const
{
    constexpr Guard::Stop no_limits[] { Guard::Stop::none, Guard::Stop::halted, Guard::Stop::released };
    for (const auto& [role, d] : running->devices())
        if (const auto& event = running->engine().guardOf (role).latest(); std::ranges::count (no_limits, event.why) == 0)
            std::cerr << printableName (role) << ": warning: the guard withheld the force: " << describe (event) << '\n';
    const auto late = running->lateTicks();
    if (late == 0) return;
    std::cerr << "warning: an async query (a search on a large surface) was answered too late " << late << (late == 1 ? " time\n" : " times\n");
    std::cerr << "    allow it more ticks in the settings of the node, such as search_ticks [run/late_answers]\n";
}

}   // namespace tactus::host
