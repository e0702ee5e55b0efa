// SPDX-License-Identifier: MIT
#include "run.hpp"

#include "device/guard_limits.hpp"
#include "device/make_device.hpp"
#include "device/sim.hpp"
#include "log/graph_snapshot.hpp"
#include <tactus/run/guard/included_guards.hpp>

#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>

namespace tactus
{

Run::Run (const Catalogue& c, CompileOptions o, OpenDevice opener, Queries when)
    : catalogue (c), options (std::move (o)), assets (options.assets), open (std::move (opener))
{
    if (when == Queries::on_thread)
    {
        queries = std::make_unique<QueryThread>();
        options.services.answers = queries.get();
    }
    if (options.assets != nullptr) options.assets = &assets;
    options.settles = true;
}

Run::~Run() { runner.reset(); }   // waits until the forces are zero, while all members still exist

void Run::add (RunListener& listener) { listeners.push_back (&listener); }

bool Run::isOptional (const std::string& port) const
{
    return std::ranges::any_of (listeners, [&] (const RunListener* l) { return std::ranges::count (l->ports(), port) > 0 && l->isOptional (port); });
}

/// Captured ports come first, so their taps keep their numbers when the ports of listeners change.
Compiled Run::compile (const graph::Graph& graph, const Plan* plan_before, const Plan* withdrawn, std::vector<std::string> kept)
{
    auto wanted = options;
    wanted.before = plan_before;
    wanted.withdrawn = withdrawn;
    wanted.kept = std::move (kept);
    wanted.records.insert (wanted.records.end(), captured_ports.begin(), captured_ports.end());
    for (const auto* listener : listeners)
        std::ranges::move (listener->ports(), std::back_inserter (wanted.records));

    assets.paths = {};
    auto compiled = tactus::compile (graph, catalogue, wanted);
    const auto isMissing = [&] (const std::string& port) {
        const bool has_message = std::ranges::count (compiled.messages, "record " + port, &Message::where) > 0;
        return has_message && isOptional (port);
    };
    return std::erase_if (wanted.records, isMissing) > 0 ? tactus::compile (graph, catalogue, wanted) : compiled;
}

Messages Run::load (const graph::Graph& graph)
{
    auto compiled = compile (graph, nullptr, nullptr, {});
    running.reset();   // an engine of an earlier load may have another rate
    if (compiled.plan) begin (std::move (compiled.plan));
    return std::move (compiled.messages);
}

void Run::begin (std::shared_ptr<Plan> plan)
{
    if (options.rate_hz == 0.0) graph_rate_hz = plan->rateHz();
    options.rate_hz = plan->rateHz();   // later plans keep the rate, because devices and guards depend on it
    running = std::make_unique<Engine> (std::move (plan));
}

void Run::keepRecords()
{
    options.records.clear();
    for (const auto& tap : running->newest().taps())
        options.records.push_back (tap.name);
}

const Run::RoleDevice* Run::deviceOf (const std::string& role) const
{
    const auto at = std::ranges::find (by_role, role, [] (const auto& d) { return std::string_view (d.first); });
    return at != by_role.end() ? &at->second : nullptr;
}

bool Run::hasDevice (const std::string& role) const { return deviceOf (role) != nullptr; }

namespace
{
GuardLimits readGuard (Json guard, const std::string& where, Messages& messages, const DeviceLayout& layout)
{
    for (const auto* key : { "max_signal", "max_signal_slew" })   // may be text with a unit, that of the calibration: keeps only the value
        if (guard.is_object() && guard.contains (key) && guard[key].is_string())
            if (const auto limit = parseMeasure (guard[key].asString())) guard[key] = limit->value;
    return readGuardLimits (guard, where, messages, layout);
}

std::string guardPlace (const std::string& role) { return "/devices/" + role + "/guard"; }

/// The strictest of the guards that the graph and the graphs that it includes describe for a role.
GuardLimits describedLimits (const std::string& role, const graph::Graph& graph, const std::vector<IncludedGuard>& guards, const DeviceLayout& layout,
                             Messages& messages)
{
    GuardLimits limits;
    const auto* description = graph.device (role);
    if (description != nullptr && description->is_object() && description->contains ("guard"))
        limits = tightest (limits, readGuard (description->at ("guard"), guardPlace (role), messages, layout));
    for (const auto& included : guards)
    {
        if (included.role != role) continue;
        Messages of_file;
        limits = tightest (limits, readGuard (included.guard, included.where, of_file, layout));
        for (auto& m : of_file)
        {
            m.file = included.file;
            messages.push_back (std::move (m));
        }
    }
    return limits;
}

/// True for a simulated device in place of a real one that the graph describes. It may lack the buttons and limits of that one.
bool isStandIn (const Run::RoleDevice& opened, const Json* description)
{
    const auto* driver = opened.driver != nullptr ? opened.driver : opened.device.get();
    return description != nullptr && ! isSimulated (*description) && dynamic_cast<const SimulatedDevice*> (driver) != nullptr;
}
}   // namespace

/// The limits that the graph asks of the guard of a role, and those that earlier graphs of this run asked for. A limit that is no longer there waits
/// for the next run.
GuardLimits Run::asksFor (const std::string& role, const graph::Graph& graph, const std::vector<IncludedGuard>& guards, const RoleDevice& of,
                          Messages& messages) const
{
    if (of.is_logged) return {};
    Messages found;
    const auto described = describedLimits (role, graph, guards, of.device->layout(), found);
    const auto earlier = asked.find (role);
    auto limits = earlier != asked.end() ? tightest (described, earlier->second) : described;
    checkStops (tightened (of.limits, limits), guardPlace (role), found);
    const bool does_not_fit = hasErrors (found) && isStandIn (of, graph.device (role));   // the guard fits the device that the graph names
    for (auto& m : found)
    {
        if (does_not_fit) m.severity = Message::Severity::warning;
        messages.push_back (std::move (m));
    }
    if (does_not_fit) return earlier != asked.end() ? earlier->second : GuardLimits {};
    if (limits != described)
        messages.push_back (Message::warning ("watch/guard", guardPlace (role),
                                              "the graph now asks for a looser guard of the role '" + role + "', or for none, but the run keeps the strict one",
                                              "restart the run to use the new ones"));
    return limits;
}

/// Opens the device of a role. If the graph or a graph that it includes has a guard for this role, the guard applies even to a device
/// that an option or a session has chosen.
Run::RoleDevice Run::openOne (const std::string& role, const graph::Graph& graph, const std::vector<IncludedGuard>& guards, const Plan& plan,
                              std::map<std::string, GuardLimits>& asks, Messages& messages)
{
    auto opened = open (role, graph, plan, messages);
    if (! opened.device) return opened;

    Messages found;
    const auto limits = asksFor (role, graph, guards, opened, found);
    if (hasErrors (found))
        opened = {};   // better no device than a device without its limits
    else
        asks[role] = limits;
    opened.limits = tightened (opened.limits, limits);
    if (messages.size() >= most_messages && hasErrors (messages)) return opened;
    for (auto& m : found)
    {
        const auto isKnown = [&m] (const Message& other) { return other.id == m.id && other.where == m.where && other.file == m.file; };
        if (std::ranges::none_of (messages, isKnown)) messages.push_back (std::move (m));
    }
    return opened;
}

void Run::openDevices (const graph::Graph& graph, Messages& messages)
{
    const auto& plan = running->newest();
    // A role of an earlier run that is gone (keepLimits) may be here under another name, on the same device.
    GuardLimits of_gone;
    for (const auto& [name, limits] : asked)
        if (std::ranges::find (plan.roles(), name, &Plan::RoleUse::name) == plan.roles().end()) of_gone = tightest (of_gone, limits);
    const auto guards = includedGuards (graph);
    for (const auto& role : plan.roles())
    {
        if (! open || hasDevice (role.name)) continue;
        if (of_gone != GuardLimits {}) asked.try_emplace (role.name, of_gone);
        auto opened = openOne (role.name, graph, guards, plan, asked, messages);
        if (! opened.device) continue;
        running->attach (role.name, *opened.device, opened.limits);
        by_role.emplace_back (role.name, std::move (opened));
    }
    for (auto* listener : listeners)
        listener->planComes (plan);
}

Result<> Run::startLog (const std::filesystem::path& path, std::string program, std::vector<std::string> sets, const graph::Graph& graph)
{
    RunHead head { .program = std::move (program), .functions = math::revision, .rate_hz = rate(), .sets = std::move (sets), .feeds = options.feeds };
    for (const auto& [role, d] : by_role)
    {
        head.guards.emplace (role, d.limits);
        head.devices.emplace (role, d.device->layout());
    }
    auto created = RunLog::create (path, head);
    if (! created) return created.error();
    log = std::move (*created);
    logNext (running->newestShared(), graph, {});
    running->report (log->journal());
    if (queries) queries->report (log->journal());
    return {};
}

void Run::logNext (const std::shared_ptr<Plan>& plan, const graph::Graph& graph, const std::vector<std::pair<std::string, RoleDevice>>& joining)
{
    if (! log || log_ended) return;
    std::map<std::string, GuardLimits> guards;
    std::map<std::string, DeviceLayout> layouts;
    for (const auto& [role, d] : joining)
    {
        guards.emplace (role, d.limits);
        layouts.emplace (role, d.device->layout());
    }
    log->expect (plan, snapshotOf (graph, assets.paths, log->folder()), guards, layouts);
}

void Run::before (std::uint64_t tick) noexcept
{
    for (auto* listener : listeners)
        listener->before (running->plan(), tick);
}

void Run::after (std::uint64_t tick, bool halts) noexcept
{
    const auto& plan = running->plan();
    for (auto* listener : listeners)
        listener->after (plan, tick, halts);
    slot.note (plan, tick);
}

void Run::tick() noexcept
{
    before (now);
    running->tick();
    after (now, false);
    ++now;
}

std::vector<std::string> Run::start (TickClock& clock, Runner::Options how)
{
    how.hooks = this;
    runner = std::make_unique<Runner> (*running, clock, rate(), how);
    if (log)
        log->beginsAt ([this]() -> std::optional<Json> {
            const auto begun = runner->firstTick();
            if (! begun) return std::nullopt;
            return Json { { "wall", begun->wall_s }, { "monotonic", begun->monotonic_s } };
        });
    return runner->start();
}

std::optional<Message> Run::poll()
{
    if (runner)
        runner->poll();
    else
        running->clear();
    if (! log || log_failure || log_ended) return std::nullopt;
    if (auto drained = log->drain(); ! drained) return log_failure = drained.error();
    if (std::exchange (log_broke, log->brokenAt().has_value()) || ! log_broke) return std::nullopt;
    return Message::warning ("log/broken", {}, "writing the log could not keep up with the run, so the log ends at tick " + std::to_string (*log->brokenAt()),
                             "write the log to a faster disk, or run at a lower --rate");
}

void Run::end()
{
    if (! runner) return;
    runner->stop();
    runner->wait();
}

Result<> Run::finish()
{
    end();
    return endLog();
}

Result<> Run::endLog()
{
    if (log_failure) return *log_failure;
    if (! log || std::exchange (log_ended, true)) return {};
    return log->finish();
}

//==============================================================================

Run::Edit::Edit (Run& r, const graph::Graph& g, std::vector<std::string> kept)
    : run (&r), graph (g), withdrawn (r.running->withdraw()), compiled (r.compile (g, &r.running->newest(), withdrawn.get(), std::move (kept)))
{
    if (r.graph_rate_hz != 0.0 && g.rate_hz != r.graph_rate_hz)
        compiled.messages.push_back (Message::warning ("watch/rate", "/rate_hz",
                                                       "the graph now asks for a different rate, but the run continues at " + numberText (r.rate()) + " Hz",
                                                       "restart the run to use " + numberText (g.rate_hz) + " Hz"));
    if (compiled.plan) readGuards();
}

/// Reads what the guards of the edited graph ask of the roles that have a device.
void Run::Edit::readGuards()
{
    const auto guards = includedGuards (graph);
    Messages found;
    for (const auto& [role, d] : run->by_role)
    {
        if (std::ranges::find (compiled.plan->roles(), role, &Plan::RoleUse::name) == compiled.plan->roles().end()) continue;
        asks[role] = run->asksFor (role, graph, guards, d, found);
    }
    if (hasErrors (found)) compiled.plan.reset();   // better the plan before than one without its limits
    std::ranges::move (found, std::back_inserter (compiled.messages));
}

Run::Edit::Edit (Edit&& other) noexcept
    : run (std::exchange (other.run, nullptr)), graph (other.graph), withdrawn (std::move (other.withdrawn)), compiled (std::move (other.compiled)),
      opened (std::move (other.opened)), asks (std::move (other.asks))
{
}

Run::Edit::~Edit() { drop(); }

void Run::Edit::drop()
{
    if (auto* r = std::exchange (run, nullptr)) r->running->submit (std::move (withdrawn));
}

void Run::Edit::openDevices()
{
    const auto guards = includedGuards (graph);
    for (const auto& role : compiled.plan->roles())
    {
        if (! run->open || run->hasDevice (role.name)) continue;
        auto made = run->openOne (role.name, graph, guards, *compiled.plan, asks, compiled.messages);
        if (made.device) opened.emplace_back (role.name, std::move (made));
    }
}

void Run::Edit::commit (std::span<const Engine::Joining> others)
{
    auto& r = *std::exchange (run, nullptr);
    if (r.isCapturing() && tapsOf (*compiled.plan, r.captured_ports) != r.captured_taps) r.endCapture();
    r.logNext (compiled.plan, graph, opened);
    for (auto* listener : r.listeners)
        listener->planComes (*compiled.plan);
    std::vector<Engine::Joining> joining (others.begin(), others.end());
    for (const auto& [role, d] : opened)
        joining.push_back ({ role, *d.device, d.limits });
    for (const auto& [role, limits] : asks)
        r.running->tighten (role, limits);
    for (auto& [role, d] : r.by_role)
        if (const auto tighter = asks.find (role); tighter != asks.end()) d.limits = tightened (d.limits, tighter->second);
    r.running->submit (compiled.plan, joining);
    std::ranges::move (opened, std::back_inserter (r.by_role));
    for (auto& [role, limits] : asks)
        r.asked.insert_or_assign (role, limits);
}

//==============================================================================

Result<std::vector<std::string>> Run::capture (const graph::Graph& graph, const std::string& port, const std::string& watched, const Trigger& trigger)
{
    endCapture();
    captured_ports = { port, watched };
    auto next = edit (graph);
    const auto refuse = [this] (Message why) {
        captured_ports.clear();
        return why;
    };
    if (next.plan() == nullptr) return refuse (*std::ranges::find (next.messages(), Message::Severity::error, &Message::severity));
    auto armed = arm (*next.plan(), port, watched, trigger);
    if (! armed) return refuse (armed.error());
    captured_taps = tapsOf (*next.plan(), captured_ports);
    slot.arm (std::move (armed->capture));
    next.commit();
    return std::move (armed->components);
}

void Run::endCapture()
{
    slot.disarm();
    captured_ports.clear();
    captured_taps.clear();
}

std::vector<Tap> Run::recorded() const
{
    const auto& taps = running->newest().taps();
    const auto n = options.records.empty() ? taps.size() : std::min (taps.size(), options.records.size());
    return { taps.begin(), taps.begin() + static_cast<std::ptrdiff_t> (n) };
}

}   // namespace tactus
