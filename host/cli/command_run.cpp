// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_run.hpp"
#include "overwriting.hpp"
#include "report.hpp"

#include <host/base/platform/home_folder.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <tactus/graph/reconcile.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/replay.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace tactus::host
{

CommandRun::CommandRun (const RunOptions& o, Pace pace, StopSwitch* stops) : options (o), loaded (loadGraph (o.graph)), rig ({})
{
    if (report (loaded.messages, loaded, options.graph) > 0) throw Stop {};
    readFeed();
    if (pace == Pace::live)
    {
        device_session = readDeviceSession();
        chooseAudio (device_session);
    }
    device_options = readDeviceOptions();
    const auto known = [this]() -> const hid::LoadedProfiles& { return profiles(); };
    const auto hardware = pace == Pace::live ? Hardware { hid::thisComputer(), known, &rig } : Hardware {};
    playing = std::make_unique<LiveSession> (catalogue(), hardware, sessionOptions (pace, stops));
    load();
    openDevices();
    decideLength (pace);
    auto outputs = options.outputs;
    for (const auto* file : { &options.log, &options.capture })
        if (! file->empty()) outputs.push_back (*file);
    refuseOverwriting (outputs, inputs());
    if (pace == Pace::live) reportUnfinished (outputs);
    if (! options.log.empty()) orFail (playing->log (options.log, TACTUS_VERSION, options.sets));
    if (pace == Pace::live) startAudio();
}

int CommandRun::reportOn (const Messages& messages) const { return report (messages, loaded, options.graph); }

void CommandRun::readFeed()
{
    if (options.feed.empty()) return;
    feed = orFail (Feed::make (orFail (readTable (std::filesystem::path (options.feed))), options.feed, options.rate_hz, loaded.graph.rate_hz));
}

/// The device session of the run.
LoadedSession CommandRun::readDeviceSession()
{
    if (options.session == "off") return {};
    auto read = options.session.empty() ? loadDefaultSession (homeFolder()) : loadSession (options.session);
    if (reportOn (read.messages) == 0) return read;
    std::cerr << "    the run did not start; to run without a session, give --session off\n";
    throw Stop {};
}

/// The sound settings of the session, with changes from options.
void CommandRun::chooseAudio (const LoadedSession& session)
{
    Messages messages;
    auto settings = audio::readAudioSettings (session, messages);
    for (const auto& text : options.routes)
    {
        auto route = audio::parseRoute (text);
        if (route)
            settings.routes.push_back (std::move (*route));
        else
            messages.push_back (std::move (route).error());
    }
    if (reportOn (messages) > 0) throw Stop {};
    if (! options.card.empty())
    {
        const auto named = audio::parseCard (options.card, audio::soundCards().types());
        settings.card.type = named.type;
        settings.card.output = settings.card.input = named.output;
    }
    rig.choose (std::move (settings));
}

const hid::LoadedProfiles& CommandRun::profiles()
{
    if (! loaded_profiles) loaded_profiles = hid::loadProfileLibrary();
    return *loaded_profiles;
}

std::vector<DeviceOption> CommandRun::readDeviceOptions()
{
    std::vector<DeviceOption> all;
    for (const auto& text : options.devices)
    {
        Messages notes;
        auto parsed = host::parseDeviceOption (
            text, loaded.graph.devices, folder(), [this]() -> const hid::LoadedProfiles& { return profiles(); }, notes);
        reportOn (notes);
        if (! parsed) fail (Message::error (parsed.error().id, "--device " + text, parsed.error().text, parsed.error().remedy));
        if (std::ranges::any_of (all, [&] (const auto& other) { return other.role == parsed->role; }))
            fail (Message::error ("device/option", "--device " + text, "the role " + quote (parsed->role) + " already has a device", "remove one of the two"));
        all.push_back (std::move (*parsed));
    }
    return all;
}

LiveSession::Options CommandRun::sessionOptions (Pace pace, StopSwitch* stops)
{
    LiveSession::Options to;
    to.devices = { .given = device_options,
                   .session = device_session,
                   .absence = options.strict ? Absence::refuses : Absence::waits,
                   .remedy = "describe a device for it under `devices`, or give --device ROLE=gesture:stroke" };
    to.compile = { .rate_hz = feed ? feed->rate() : options.rate_hz,
                   .records = options.records,
                   .overrides = readSets (options.sets),
                   .assets = &assets,
                   .services = { .nearest_triangle = nearestByBoxes } };
    if (feed)
    {
        to.compile.feeds = feed->drives();
        to.listeners.push_back (&*feed);
    }
    to.clock = options.clock;
    to.keeps_records = ! options.outputs.empty();
    to.listeners.push_back (&port_probes);
    to.stops = stops;
    to.may_move = pace == Pace::live;
    to.queries = pace == Pace::live ? Run::Queries::on_thread : Run::Queries::within_tick;
    return to;
}

void CommandRun::load()
{
    const bool is_broken = reportOn (playing->load (loaded.graph)) > 0;   // a node of an unknown type compiles to a placeholder, but it is an error
    if (is_broken || ! playing->isLoaded()) throw Stop {};
}

/// Each --device must name a role of the graph.
void CommandRun::checkRoles() const
{
    std::vector<std::string> roles;
    for (const auto& role : playing->run().engine().newest().roles())
        roles.push_back (role.name);
    for (std::size_t i = 0; i < device_options.size(); ++i)
    {
        const auto& role = device_options[i].role;
        if (std::ranges::count (roles, role) > 0) continue;
        std::string all;
        for (const auto& r : roles)
            addToList (all, r);
        fail (Message::error ("device/unknown_role", "--device " + options.devices[i], "the graph has no role '" + role + "'" + didYouMean (role, roles),
                              roles.empty() ? "remove the option: the graph has no device nodes" : "name one of its roles: " + all));
    }
}

void CommandRun::openDevices()
{
    checkRoles();
    if (reportOn (playing->openDevices()) > 0) throw Stop {};
}

void CommandRun::decideLength (Pace pace)
{
    double seconds = options.duration_s;
    if (seconds == 0.0)
        for (const auto& [role, d] : run().devices())
            seconds = std::max (seconds, d.device->duration());

    // A small file must not keep the computer busy for hours. A user who gives --duration wants a run of that length.
    constexpr auto most_unasked = static_cast<double> (Replay::most_ticks_unasked);
    const double by_files = feed ? static_cast<double> (feed->ticks()) : seconds * rate();
    if (pace == Pace::offline && options.duration_s == 0.0 && options.ticks == 0 && by_files > most_unasked)
    {
        const auto asks = (feed ? "the feed lasts " : "a device's path lasts ") + numberText (std::ceil (by_files)) + " ticks";
        fail ("run/too_long", asks + "; without --duration, a run has at most " + numberText (most_unasked), "give a --duration in s or a lower --rate");
    }

    if (feed) count = feed->ticks();
    if (options.ticks > 0)
    {
        const auto wanted = static_cast<std::size_t> (options.ticks);
        count = std::min (count.value_or (wanted), wanted);
        return;
    }
    if (options.watch && options.duration_s == 0.0) return;
    if (pace == Pace::live && options.duration_s > 0.0)
    {
        wall_s = options.duration_s;   // a feed may end it before
        return;
    }
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
              "give --duration S, --ticks N, --feed IN.csv, or --device ROLE=gesture:NAME");
    return *count;
}

void CommandRun::startAudio()
{
    auto messages = playing->beginSound (! options.capture.empty());
    if (! options.card.empty() && options.capture.empty() && ! rig.isNeeded())
        messages.push_back (Message::warning ("audio/unused", {}, "nothing in this run plays on a sound card, so none is opened",
                                              "say what it plays, with --route PORT=CHANNEL or --device ROLE=audio"));
    for (auto& m : messages)
        if (m.where.empty()) m.where = options.card.empty() ? "the sound card" : "--audio " + options.card;
    if (reportOn (messages) > 0) throw Stop {};
    if (! options.capture.empty()) orFail (rig.captureTo (options.capture));
}

bool CommandRun::reload()
{
    auto next = loadGraph (options.graph);
    if (report (next.messages, next, options.graph) > 0) return false;
    graph::reconcile (next.graph, graph());

    auto probed = port_probes.clear();   // drops ports of the previous graph
    const auto edited = playing->edit (next.graph, LiveSession::EditPolicy::no_errors);
    report (edited.messages, next, options.graph);
    if (! edited.is_taken_over)
    {
        port_probes.restore (std::move (probed));
        return false;
    }
    run().endCapture();
    loaded = std::move (next);
    return true;
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
    add (add, graph());
    return all;
}

std::vector<std::filesystem::path> CommandRun::inputs() const
{
    auto all = files();
    if (! options.feed.empty()) all.emplace_back (options.feed);
    const auto& assets_read = run().assetPaths();
    all.insert (all.end(), assets_read.begin(), assets_read.end());
    const auto add = [&] (const std::filesystem::path& from, const Json& description) {
        for (const auto* at : { "/path", "/hand/path" })
            if (const JsonPointer path (at); description.is_object() && description.contains (path) && description.at (path).is_string())
                all.push_back (from / description.at (path).get<std::string>());
    };
    for (const auto& [role, description] : graph().devices)
        add (folder(), description);
    if (! device_session.file.empty()) all.push_back (device_session.file);
    for (const auto& role : device_session.session.roles())
        add (device_session.file.parent_path(), *device_session.session.binding (role));
    for (const auto& text : options.devices)
    {
        all.emplace_back (text.substr (text.find ('=') + 1));
        if (const auto parsed = tactus::parseDeviceOption (text, graph().devices, folder())) add (parsed->folder, parsed->description);
    }
    return all;
}

/// Each run begins with a stop if its device has not answered yet. That is no news, unless the force never began.
void CommandRun::reportRun() const
{
    constexpr Guard::Stop no_limits[] { Guard::Stop::none, Guard::Stop::halted, Guard::Stop::released };
    for (const auto& [role, d] : run().devices())
    {
        const auto& guard = run().engine().guardOf (role);
        const auto& event = guard.latest();
        if (std::ranges::count (no_limits, event.why) > 0 || (event.at_start && guard.hasBegun())) continue;
        std::cerr << printableName (role) << ": warning: the guard withheld the force: " << describe (event) << '\n';
    }
    const auto late = run().lateTicks();
    if (late == 0) return;
    std::cerr << "warning: an async query (a search on a large surface) was answered too late " << late << (late == 1 ? " time\n" : " times\n");
    std::cerr << "    allow it more ticks in the settings of the node, such as search_ticks [run/late_answers]\n";
}

}   // namespace tactus::host
