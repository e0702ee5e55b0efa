// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "graph_argument.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/platform/home_folder.hpp>
#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/devices/sessions/choose_clock.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <host/devices/sessions/role_fits.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

struct SessionOptions
{
    std::string graph, file, clock;
    std::vector<std::string> bind, unbind;
    bool clock_given = false, json = false;
};

/// Makes file names absolute, because in a session they are relative to the folder of the session, not to `folder`. What a key of the driver of a
/// plugin means, only that driver knows.
void makeAbsolute (Json& description, const fs::path& folder)
{
    if (namesPlugin (description)) return;
    for (const auto* at : { "/path", "/hand/path" })
        if (const JsonPointer where (at); description.contains (where) && description.at (where).is_string())
        {
            auto& path = description.at (where);
            if (const auto text = path.get<std::string>(); text.find_first_of ("./\\") != text.npos)
                path = fs::absolute (folder / text).lexically_normal().string();
        }
    const auto port = description.is_object() && description.value ("driver", Json()) == "serial" ? description.find ("port") : description.end();
    if (port == description.end() || ! port->is_string()) return;
    const auto text = port->get<std::string>();
    if (! text.empty() && ! text.starts_with ("COM")) *port = fs::absolute (folder / text).string();   // a link, such as that of `tactus fake-device --link`
}

/// Replaces "auto" by the profile of the connected device, so that the role can wait for this device later.
void nameProfile (Json& description, const hid::LoadedProfiles& profiles)
{
    if (! hid::isHid (description) || description.value ("profile", Json ("auto")) != "auto") return;
    if (const auto found = hid::findDevice (description, hid::thisComputer(), profiles); found.profile) description["profile"] = found.profile->id;
}

Json read (const std::string& option, std::string& role, const std::optional<LoadedGraph>& graph, const hid::LoadedProfiles& profiles)
{
    const auto folder = graph ? fs::path (graph->graph.folder) : fs::path();
    Messages notes;
    auto parsed = host::parseDeviceOption (
        option, graph ? graph->graph.devices : std::vector<Described> {}, folder, [&]() -> const hid::LoadedProfiles& { return profiles; }, notes);
    report (notes, LoadedGraph {}, "--bind " + option);
    if (! parsed) fail (Message::error (parsed.error().id, "--bind " + option, parsed.error().text, parsed.error().remedy));
    auto& [name, description, from] = *parsed;
    role = name;
    makeAbsolute (description, from);
    nameProfile (description, profiles);
    for (const auto& m : checkBinding (description, {}, profiles))
        if (m.severity == Message::Severity::error)
            fail (Message::error (m.id, "--bind " + option + (m.where.empty() ? "" : ", " + m.where), m.text, m.remedy));
    return description;
}

void stopIfWrong (const LoadedSession& s)
{
    const LoadedGraph none;
    if (report (s.messages, none, s.file.string()) > 0) throw Stop {};
}

std::string spacesTo (std::size_t width, const std::string& text) { return std::string (width > text.size() ? width - text.size() : 0, ' '); }

void printTable (std::vector<std::vector<std::string>> rows)
{
    for (auto& row : rows)
        for (auto& cell : row)
        {
            std::ranges::replace (cell, '\n', ' ');
            cell = &cell == &row.back() ? printable (cell) : printableName (cell);   // the last column may hold sentences
        }
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
        {
            widths.resize (std::max (widths.size(), i + 1));
            widths[i] = std::max (widths[i], row[i].size());
        }
    for (const auto& row : rows)
    {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += row[i] + (i + 1 < row.size() ? spacesTo (widths[i] + 2, row[i]) : "");
        line.erase (line.find_last_not_of (' ') + 1);
        std::cout << line << '\n';
    }
}

std::string describe (const Workspace& w)
{
    if (w.isPlain()) return {};
    const auto offset = numberText (w.offset.x()) + ", " + numberText (w.offset.y()) + ", " + numberText (w.offset.z());
    auto text = "workspace x" + numberText (w.scale) + " + (" + offset + ") m";
    if (w.isTurned()) text += w.isMirrored() ? ", mirrored" : ", turned";
    if (! w.clutch.empty()) text += ", clutch " + quote (w.clutch);
    return text;
}

constexpr std::string_view stateOf (std::optional<bool> connected)
{
    if (! connected) return "not checked until a run opens it";
    return *connected ? "connected" : "not connected";
}

void printSession (const LoadedSession& s, std::span<const hid::ConnectedDevice> connected, const hid::LoadedProfiles& profiles)
{
    std::error_code unseen;
    std::cout << printableName (s.file.string()) << (fs::exists (s.file, unseen) ? "\n" : " (does not exist yet)\n");
    const auto clock = s.session.clock();
    std::cout << "clock: " << (clock.empty() ? "the first device that can tick the run" : printableName (clock)) << '\n';
    const auto roles = s.session.roles();
    if (roles.empty()) std::cout << "no role is bound: each graph uses the devices that it describes; --bind ROLE=hid:auto binds a role\n";
    std::vector<std::vector<std::string>> rows;
    for (const auto& role : roles)
    {
        const auto b = bindingOf (s, role);
        std::string state;
        if (hid::isHid (b->description)) state = stateOf (isConnected (b->description, connected, profiles));
        rows.push_back ({ role, nameOf (b->description), state, describe (b->workspace) });
    }
    printTable (rows);
    if (const auto* audio = s.session.audio()) std::cout << "audio: " << printable (audio->dump()) << '\n';
}

std::string verdict (const RoleFit& fit)
{
    std::string text;
    for (const auto& m : fit.messages)
        text += (text.empty() ? "" : "; ") + m.where + (m.where.empty() ? "" : ": ") + m.text;
    for (const auto& l : fit.lacking)
        text += (text.empty() ? "" : "; ") + l;
    if (! text.empty()) return "no: " + text;
    if (! fit.there) return "unknown until it is connected";
    text = fit.connected == false ? "yes, once it is connected" : "yes";
    if (! fit.along.empty()) text += "; it moves only along " + fit.along;
    return fit.pushes.empty() || fit.pushes == fit.along ? text : text + "; it pushes only along " + fit.pushes;
}

constexpr std::string_view whose (RoleFit::From from)
{
    if (from == RoleFit::From::session) return " (session)";
    return from == RoleFit::From::graph ? " (graph)" : " (default)";
}

Json jsonOf (const RoleFit& fit)
{
    Json lacking = Json::array();
    for (const auto& l : fit.lacking)
        lacking.push_back (l);
    for (const auto& m : fit.messages)
        lacking.push_back (m.where + ": " + m.text);
    Json json { { "role", fit.role }, { "needs", describe (fit.needs) }, { "bound_to", nameOf (fit.description) }, { "by", "none" } };
    if (fit.from == RoleFit::From::session) json["by"] = "session";
    if (fit.from == RoleFit::From::graph) json["by"] = "graph";
    json["fits"] = fit.fits();
    json["lacking"] = std::move (lacking);
    if (fit.connected) json["connected"] = *fit.connected;
    return json;
}

std::vector<RoleFit> fitsOf (const LoadedGraph& graph, const std::string& file, const LoadedSession& s,
                             std::span<const hid::ConnectedDevice> connected, const hid::LoadedProfiles& profiles)
{
    FileAssets assets;
    const auto compiled = compile (graph.graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
    if (report (compiled.messages, graph, file) > 0 || ! compiled.plan) throw Stop {};
    auto fits = host::fitsOf (needsOf (*compiled.plan), graph.graph, s, profiles, connected);
    for (auto& fit : fits)
        if (fit.from == RoleFit::From::session && isPluginDevice (fit.description))
            std::ranges::move (checkPluginDevice (fit.description), std::back_inserter (fit.messages));
    return fits;
}

bool edits (const SessionOptions& options) { return ! options.bind.empty() || ! options.unbind.empty() || options.clock_given; }

/// Loads the session that the options name. If they edit a file that does not exist yet, starts with an empty session.
LoadedSession openSession (const SessionOptions& options)
{
    if (options.file.empty()) return loadDefaultSession (homeFolder());
    std::error_code unseen;
    if (! edits (options) || fs::exists (options.file, unseen)) return loadSession (options.file);
    LoadedSession fresh;
    fresh.file = options.file;
    return fresh;
}

LoadedSession edited (LoadedSession session, const SessionOptions& options, const std::optional<LoadedGraph>& graph, const hid::LoadedProfiles& profiles)
{
    std::vector<Described> bound;
    for (const auto& option : options.bind)
    {
        std::string role;
        auto description = read (option, role, graph, profiles);
        bound.emplace_back (std::move (role), std::move (description));
    }
    for (const auto& role : options.unbind)
        if (session.session.binding (role) == nullptr)
            fail (Message::error ("session/not_bound", "--unbind " + role, "the session does not bind this role",
                                  "`tactus session` lists the roles that it binds"));
    return editSession (std::move (session), [&] (DeviceSession& s) {
        for (const auto& role : options.unbind)
            s.unbind (role);
        for (auto& [role, description] : bound)
            s.bind (role, rebound (s.binding (role), std::move (description)));
        if (options.clock_given) s.setClock (options.clock == "first" ? "" : options.clock);
    });
}

void run (const SessionOptions& options)
{
    std::optional<LoadedGraph> graph;
    if (! options.graph.empty())
    {
        graph = loadGraph (options.graph);
        if (report (graph->messages, *graph, options.graph) > 0) throw Stop {};
    }
    const auto profiles = hid::loadProfileLibrary();
    auto session = openSession (options);
    stopIfWrong (session);
    if (edits (options))
    {
        session = edited (std::move (session), options, graph, profiles);
        stopIfWrong (session);
    }

    const auto connected = hid::eachOnce (hid::thisComputer().connected(), profiles);
    const auto fits = graph ? fitsOf (*graph, options.graph, session, connected, profiles) : std::vector<RoleFit> {};
    if (options.json)
    {
        Json json { { "file", session.file.string() }, { "session", Json::parse (writeSession (session.session)) } };
        if (graph)
        {
            json["roles"] = Json::array();
            for (const auto& fit : fits)
                json["roles"].push_back (jsonOf (fit));
        }
        std::cout << json.dump (2) << '\n';
        return;
    }
    printSession (session, connected, profiles);
    if (! graph) return;
    std::cout << '\n'
              << printableName (graph->graph.name.empty() ? options.graph : graph->graph.name) << '\n';
    std::vector<std::vector<std::string>> rows { { "role", "needs", "bound to", "fits?" } };
    for (const auto& fit : fits)
        rows.push_back ({ fit.role, describe (fit.needs), nameOf (fit.description) + std::string (whose (fit.from)), verdict (fit) });
    printTable (rows);
}

Check clockCheck()
{
    return { [] (const std::string& text) { return graph::isId (text)
                                                       ? std::string()
                                                       : "'" + text + "' is not a role name: use lower-case letters, digits and _, starting with a letter"; },
             "ROLE|timer|audio|first" };
}
}   // namespace

void addSession (const Command& app)
{
    const auto options = std::make_shared<SessionOptions>();
    const auto command = app.add ("session", "Show or change which devices the roles of graphs are bound to, and show whether they fit a graph");
    command.addOption (
        "graph", [options] (const std::string& given) { options->graph = graphArgument (given); },
        "A graph file or the name of a preset: check whether the devices of the session fit its roles");
    const auto bind = command.addOption ("--bind", options->bind,
                                         "Bind a role to a device: ROLE=hid:PROFILE (hid:auto), ROLE=FILE.json, ROLE=sim, "
                                         "ROLE=serial:PROFILE@PORT, ROLE=udp:PROFILE@ADDRESS, ROLE=trace:FILE.csv, ROLE=gesture:NAME or ROLE=DRIVER:PORT; "
                                         "may be given more than once");
    bind.oneValueEach();
    command.addOption ("--unbind", options->unbind, "A role to unbind; it then gets the device that each graph describes; may be given more than once")
        .oneValueEach();
    const auto clock = command.addOption ("--clock", options->clock,
                                          "The clock of runs: a role, timer, audio, or first (the first device that can tick the run)");
    clock.check (clockCheck());
    command.addOption ("--file", options->file, "Use this session file instead of the user's");
    command.addFlag ("--json", options->json, "Print JSON");
    addPlugins (command);
    command.footer ("`tactus play` and tactus-host use the session; `tactus render` never does. See docs/sessions.md.\n\n"
                    "Examples:\n"
                    "  tactus session\n"
                    "  tactus session graphs/dry_wood.json\n"
                    "  tactus session --bind stylus=hid:auto --clock stylus\n"
                    "  tactus session --unbind stylus --clock first");
    command.callback ([options, clock] {
        options->clock_given = clock.isGiven();
        run (*options);
    });
}

}   // namespace tactus::host
