// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.hpp"
#include "report.hpp"

#include <framework/file/json_text.hpp>
#include <framework/near_miss.hpp>
#include <framework/number_text.hpp>
#include <framework/plan/compile.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/devices/make_device.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>

namespace tactus::host
{

namespace
{
/// The value of --set: a number, a list of numbers, or text with a unit or the name of a choice.
Json readValue (const std::string& text)
{
    const auto json = readJson (text).root;   // which does not recurse, whatever somebody types
    return json.is_number() || json.is_array() ? json : Json (text);
}

plan::Override readSet (const std::string& text)
{
    const auto equals = text.find ('=');
    if (equals == std::string::npos || equals == 0)
        throw CLI::ValidationError ("--set", "'" + text + "' is not NODE.PARAM=VALUE, as in drag.mu=0.3 or board.stiffness=\"2 N/mm\"");
    return { text.substr (0, equals), readValue (text.substr (equals + 1)) };
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
    app.add_option ("--record", records, "Ports to record, separated by commas; default: the inputs of every sink")->delimiter (',');
    app.add_option ("--out", outputs, "Where to: a .csv or a .wav; may be given more than once");
    app.add_option ("--rate", rate_hz, "Ticks per second; default: the feed's, else the graph's")->check (finiteWithin (1.0, 1e6));
    app.add_option ("--duration", duration_s, "Length of the run in s")->check (finiteWithin (1e-9, 1e9));
    app.add_option ("--set", sets, "NODE.PARAM=VALUE, or CONTROL=0…1; may be given more than once");
    app.add_option ("--device", devices, "ROLE=FILE.json, ROLE=sim, ROLE=trace:FILE.csv or ROLE=gesture:NAME");
}

Session::Session (const SessionOptions& options, Pace pace) : loaded (loadGraph (options.graph))
{
    if (pace == Pace::live) answers = std::make_unique<SlowAnswers>();
    if (report (loaded.messages, loaded, options.graph) > 0) throw Stop {};
    readFeed (options);
    compileGraph (options);
    bindDevices (options);
    decideLength (options);
}

void Session::readFeed (const SessionOptions& options)
{
    rate_hz = options.rate_hz > 0.0 ? options.rate_hz : loaded.graph.rate_hz;
    if (options.feed.empty()) return;
    feed = orFail (Feed::make (orFail (readTable (std::filesystem::path (options.feed))), options.feed, options.rate_hz, loaded.graph.rate_hz));
    rate_hz = feed->rate();
}

void Session::compileGraph (const SessionOptions& options)
{
    CompileOptions wanted { .rate_hz = rate_hz, .records = options.records, .assets = &assets, .services = { .nearest_triangle = nearestByEmbree, .answers = answers.get() } };
    if (feed) wanted.feeds = feed->ports();
    for (const auto& set : options.sets)
        wanted.overrides.push_back (readSet (set));

    auto compiled = compile (loaded.graph, catalogue(), wanted);
    if (compiled.plan)   // a placeholder does not keep the rest from running
        for (auto& m : compiled.messages)
            m.severity = Message::Severity::warning;
    report (compiled.messages, loaded, options.graph);
    if (! compiled.plan) throw Stop {};
    running = std::make_unique<Engine> (std::move (compiled.plan));
}

void Session::bindDevices (const SessionOptions& options)
{
    const auto folder = std::filesystem::path (options.graph).parent_path();
    std::vector<DeviceOption> chosen;
    std::vector<std::string> roles;
    for (const auto& role : running->plan().roles)
        roles.push_back (role.name);

    for (const auto& text : options.devices)
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

    int errors = 0;
    for (const auto& role : roles)
    {
        const auto option = std::ranges::find (chosen, role, &DeviceOption::role);
        const auto described = std::ranges::find (loaded.graph.devices, role, &std::pair<std::string, Json>::first);
        const bool in_graph = option == chosen.end() && described != loaded.graph.devices.end();
        const Json description = option != chosen.end() ? option->description : in_graph ? described->second
                                                                                         : Json { { "driver", "sim" } };

        if (option == chosen.end() && ! in_graph)
            std::cerr << "warning: nobody says which device role '" << role << "' is; a simulated tool at rest stands in for it\n    describe it under `devices`, or give --device " << role << "=gesture:stroke [device/undescribed]\n";

        auto made = makeDevice (description, option != chosen.end() ? option->folder : folder);
        for (auto& m : made.messages)
            m.where = in_graph ? "/devices/" + role + m.where : "--device " + role + m.where;
        errors += report (made.messages, loaded, options.graph);
        devices.push_back ({ role, std::move (made.device), made.limits });
    }
    if (errors > 0) throw Stop {};
    for (auto& d : devices)
        running->attach (d.role, *d.device, d.limits);
}

void Session::decideLength (const SessionOptions& options)
{
    double seconds = options.duration_s;
    if (seconds == 0.0)
        for (const auto& d : devices)
            seconds = std::max (seconds, d.device->duration());

    if (feed) count = feed->ticks();
    if (options.duration_s > 0.0 || (! feed && seconds > 0.0))
    {
        const double wanted = std::ceil (seconds * rate_hz - 1e-6);
        if (wanted > 1e10) fail ("run/too_long", "a run of more than 10^10 ticks would hardly end", "give a shorter --duration or a lower --rate");
        count = std::min (count.value_or (static_cast<std::size_t> (-1)), static_cast<std::size_t> (wanted));
    }
}

void Session::reportRun() const
{
    for (const auto& d : devices)
        if (const auto& event = running->guardOf (d.role).latest(); event.why != Guard::Stop::none && event.why != Guard::Stop::halted)
            std::cerr << d.role << ": warning: the guard withheld the force: " << describe (event) << '\n';
    if (const auto late = answers ? answers->lateTicks() : 0; late > 0)
        std::cerr << "warning: " << late << (late == 1 ? " time" : " times") << " a slow answer (the search of a large surface) was not there when it was due\n    give it more ticks in the settings of the node, as in search_ticks [run/late_answers]\n";
}

void Session::tick() noexcept
{
    if (feed) (*feed) (now, running->plan().feeds);
    ++now;
    running->tick();
}

}   // namespace tactus::host
