// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_feed.hpp"

#include <host/app/location/problem_location.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <host/tools/figures/axis.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tactus::host
{

namespace
{
/// Without the last bits of a sum, which would show as -0.00.
double cleaned (double v) { return std::abs (v) < 1e-9 ? 0.0 : v; }

/// The values of a port as text. Those of a vector share a row, so they have fewer digits.
std::vector<std::string> valueTexts (const PortFeed::Reading& reading)
{
    std::vector<std::string> texts;
    constexpr int digits_alone = 4, digits_of_three = 3;
    for (const double v : reading.values)
        texts.push_back (withPrefix (cleaned (v), reading.unit, reading.values.size() == 1 ? digits_alone : digits_of_three));
    return texts;
}
}   // namespace

LiveFeed::LiveFeed (Canvas& c, LiveRun& r) : canvas (c), live_run (r), probes (r.traces())
{
    live_run.portFeed().portsNow = [this] { return portsNow(); };
}

LiveFeed::~LiveFeed() { live_run.portFeed().portsNow = {}; }

/// The ports where the wires of the patch begin, and the port that the pointer rests on. They come from the document and not from the
/// canvas, because the run compiles an edit before the canvas shows it.
std::vector<std::string> LiveFeed::portsNow() const
{
    std::vector<std::string> ports;
    const auto* patch = findPatch (canvas.edited().graph(), canvas.patch());
    if (patch == nullptr) return ports;
    const auto inside = canvas.address ({});
    if (asked_for.starts_with (inside) && patch->find (asked_for.substr (inside.size(), asked_for.find ('.') - inside.size())) != nullptr)
        ports.push_back (asked_for);
    std::set<std::string> known (ports.begin(), ports.end());
    for (const auto& w : patch->wires)
    {
        if (ports.size() >= most_sources) break;
        if (auto port = canvas.address (graph::toText (w.from)); known.insert (port).second) ports.push_back (std::move (port));
    }
    for (const auto& param : drivenParams (*patch))
        if (auto port = canvas.address (param); known.insert (port).second) ports.push_back (std::move (port));
    return ports;
}

/// The params that wires set, such as "drag.mu". Found once for each version of the document, because a large patch has thousands of wires.
const std::vector<std::string>& LiveFeed::drivenParams (const graph::Patch& patch) const
{
    const auto version = std::make_pair (canvas.edited().version(), canvas.seen());
    if (driven_of == version) return driven_params;
    driven_of = version;
    driven_params.clear();
    std::map<std::string_view, const graph::Node*> nodes;
    for (const auto& n : patch.nodes)
        nodes.emplace (n.name, &n);
    for (const auto& w : patch.wires)
    {
        if (driven_params.size() == most_driven) break;
        const auto node = nodes.find (w.to.node);
        if (node == nodes.end() || isInput (node->second->type, w.to.port)) continue;
        const auto face = faceOf (canvas.edited().graph(), patch, *node->second, canvas.types());
        const auto* port = face.endOf (w.to);
        if (port == nullptr || port->role != Role::param || ! drives (w, *port)) continue;
        if (auto param = w.to.node + '.' + port->id; std::ranges::count (driven_params, param) == 0) driven_params.push_back (std::move (param));
    }
    for (const auto& [param, output] : drivenFromOutside (canvas.edited().graph(), canvas.seen()))
        if (driven_params.size() < most_driven && nodes.contains (param.substr (0, param.rfind ('.')))) driven_params.push_back (param);
    return driven_params;
}

/// Most wires end at inputs of nodes of the catalogue. That needs no face.
bool LiveFeed::isInput (const std::string& type, const std::string& port) const
{
    const auto* known = canvas.types().find (type);
    return known != nullptr && std::ranges::find (known->inputs, port, &PortSheet::id) != known->inputs.end();
}

std::vector<double> LiveFeed::valuesOf (const std::string& param) const
{
    const auto now = driven_now.find (param);
    return now == driven_now.end() ? std::vector<double> {} : now->second.values;
}

void LiveFeed::refresh()
{
    LiveState live;
    live.runs = live_run.isRunning();
    live_run.portFeed().refresh();
    showStates (live);
    showActivity (live);
    showCard (live);
    showDriven (live);
    if (shows_costs) showCosts (live);
    showProblems (live);
    if (limits != nullptr) showLimits (live);
    canvas.showLive (std::move (live));
}

/// Collected once for each scene, because a large one has thousands of names.
const LiveFeed::Watched& LiveFeed::watched()
{
    if (of_scene.scene == canvas.sceneNumber()) return of_scene;
    of_scene = { .scene = canvas.sceneNumber() };
    std::map<std::string, std::size_t> ports, sources;
    const auto watch = [&] (graph::Id id, const std::string& port, bool is_hit) {
        const auto full_name = canvas.address (port);
        if (of_scene.ports.size() == most_ports && ! ports.contains (full_name)) return;
        const auto [known, is_new] = ports.try_emplace (full_name, of_scene.ports.size());
        if (is_new) of_scene.ports.push_back (full_name);
        of_scene.items.push_back ({ id, known->second, is_hit });
    };
    for (const auto& n : canvas.scene().nodes())
        if (n.face->find (Role::output, "state") != nullptr && ! n.bypass) watch (n.id, n.name + ".state", false);
    for (const auto& w : canvas.scene().wires())
    {
        if (w.quantity == Quantity::hit && w.start >= 0) watch (w.id, canvas.scene().nodes()[static_cast<std::size_t> (w.start)].name + '.' + w.out, true);
        if (! w.enabled || w.source.empty() || (sources.size() == most_sources && ! sources.contains (w.source))) continue;
        const auto [known, is_new] = sources.try_emplace (w.source, sources.size());
        if (is_new) of_scene.sources.push_back (canvas.address (w.source));
        of_scene.wires.push_back ({ w.id, known->second });
    }
    return of_scene;
}

void LiveFeed::showStates (LiveState& live)
{
    const auto& now = watched();
    for (const auto& item : now.items)
    {
        const auto traces = probes.of (now.ports[item.port]);
        if (traces.size() != 1 || traces[0]->begin() >= traces[0]->end()) continue;
        const auto& trace = *traces[0];
        if (! item.is_hit)
        {
            if (const double state = trace.at (trace.end() - 1); live_run.isRunning() && std::isfinite (state)) live.states[item.id] = static_cast<int> (state);
            continue;
        }
        const auto span = static_cast<std::uint64_t> (hit_travels_s * trace.rate());
        for (auto tick = trace.end(); tick-- > trace.begin() && trace.end() - tick < span;)
            if (trace.at (tick) > 0.0)
            {
                live.hits[item.id] = static_cast<double> (trace.end() - tick) / static_cast<double> (span);
                break;
            }
    }
    probes.want (now.ports);
}

/// A level changes once the activity is clearly in another step, so that no wire flickers between two of them.
void LiveFeed::showActivity (LiveState& live)
{
    std::map<graph::Id, int> now;
    if (live_run.isRunning())
    {
        std::vector<double> levels;
        for (const auto& source : watched().sources)
            levels.push_back (LiveState::most_level * live_run.portFeed().level (source));
        // The wires of a port that has very many show only whether they carry something: each step would paint most of the canvas again.
        constexpr std::size_t very_many = 100;
        std::vector<std::size_t> wires (levels.size());
        for (const auto& w : watched().wires)
            if (++wires[w.port] > very_many) levels[w.port] = std::min (levels[w.port], 1.0);
        for (const auto& w : watched().wires)
        {
            const double exact = levels[w.port];
            const auto before = shown_levels.find (w.id);
            const int was = before == shown_levels.end() ? 0 : before->second;
            constexpr double clear = 0.65;
            if (const int level = std::abs (exact - was) > clear ? static_cast<int> (std::lround (exact)) : was; level > 0) now[w.id] = level;
        }
    }
    shown_levels = now;
    live.levels = std::move (now);
}

/// The values of params that wires set. They change no faster than one can read them.
void LiveFeed::showDriven (LiveState& live)
{
    const auto* patch = live_run.isRunning() ? findPatch (canvas.edited().graph(), canvas.patch()) : nullptr;
    if (patch == nullptr) return driven_now.clear();
    if (++since_driven >= numbers_every)
    {
        since_driven = 0;
        driven_now.clear();
        for (const auto& param : drivenParams (*patch))
            if (auto reading = live_run.portFeed().of (canvas.address (param)))
            {
                std::ranges::transform (reading->values, reading->values.begin(), cleaned);
                driven_now.emplace (param, *std::move (reading));
            }
    }
    for (const auto& [param, reading] : driven_now)
    {
        const auto dot = param.rfind ('.');
        const auto* node = patch->find (param.substr (0, dot));
        if (node == nullptr) continue;
        const bool is_vector = reading.values.size() > 1;
        std::string text;
        for (const double v : reading.values)
            addToList (text, shownQuantity (rounded (v), is_vector ? "1" : reading.unit));   // as in the inspector
        live.driven[{ node->id, param.substr (dot + 1) }] = is_vector ? '(' + text + ')' : text;
    }
}

void LiveFeed::showCard (LiveState& live)
{
    auto& feed = live_run.portFeed();
    const auto& now = canvas.pointed();
    if (now.port != pointed.port)
    {
        rested = 0;
        shown_values.clear();
    }
    pointed = now;
    if (pointed.port.empty() || ++rested < rests_for || ! live_run.isRunning()) return feed.follow ({});
    if (const auto watched = portsNow(); std::ranges::count (watched, pointed.port) == 0) asked_for = pointed.port;
    feed.follow (pointed.port);
    const auto reading = feed.of (pointed.port);
    if (! reading) return;
    if (shown_values.size() != reading->values.size() || rested % numbers_every == 0) shown_values = valueTexts (*reading);
    PortCard card { .where = pointed, .title = pointed.port };
    card.values = shown_values;
    card.quantity = reading->quantity;
    card.columns = PortFeed::columns;
    card.course = std::make_shared<const Course> (feed.course());
    card.seconds = withPrefix (static_cast<double> (PortFeed::columns) / feed.columnsPerSecond(), "s", 1);
    Extent range { 0.0, 0.0 };   // as the plot
    for (const auto& column : *card.course)
        for (std::size_t i = 0; i < reading->values.size(); ++i)
            for (const double v : { column.low[i], column.high[i] })
                if (isPlottable (v)) range.include (v);
    card.low = withPrefix (cleaned (range.low), reading->unit, 2);
    card.high = withPrefix (cleaned (range.high), reading->unit, 2);
    live.card = std::move (card);
}

/// The node on the canvas that a path of the graph leads to or through; null if there is none.
const SceneNode* LiveFeed::nodeOf (const std::string& path) const
{
    const auto inside = canvas.address ({});
    if (! path.starts_with (inside)) return nullptr;
    const auto name = path.substr (inside.size());
    for (const auto& n : canvas.scene().nodes())
        if (name == n.name || name.starts_with (n.name + '/') || name.starts_with (n.name + '[')) return &n;
    return nullptr;
}

void LiveFeed::showCosts (LiveState& live)
{
    if (++since_costs >= refreshes_per_cost)
    {
        since_costs = 0;
        latest_costs.clear();
        for (const auto& cost : live_run.costs())
            if (const auto* node = nodeOf (cost.node)) latest_costs[node->id] += cost.mean_s * live_run.rate();
    }
    live.costs = latest_costs;
}

void LiveFeed::showProblems (LiveState& live) const
{
    for (const auto& m : live_run.messages())
    {
        if (m.severity != Message::Severity::error) continue;
        const auto location = locationOf (canvas.edited().graph(), m);
        if (location.id != 0 && location.patch == canvas.patch()) live.problems[location.id] = messageText (m);
    }
}

/// Broken limits come first in the list, so they also come first in the text of a light.
void LiveFeed::showLimits (LiveState& live) const
{
    for (const auto& l : limits->list().limits)
        for (const auto& path : l.nodes)
            if (const auto* node = nodeOf (path))
            {
                auto& light = live.limits[node->id];
                light.is_broken = light.is_broken || l.is_broken;
                const auto text = l.text + ".\n" + l.details;
                if (light.text.find (text) == std::string::npos) light.text += (light.text.empty() ? "" : "\n\n") + text;
            }
}

}   // namespace tactus::host
