// SPDX-License-Identifier: GPL-3.0-or-later
#include "performance.hpp"

#include <framework/plan/missing_parts.hpp>
#include <framework/refused.hpp>
#include <framework/turn.hpp>
#include <host/app/devices_panel/device_desk.hpp>
#include <host/app/model/device_profiles.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/hid_link/open_device.hpp>
#include <host/sessions/binding.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
/// A pointer begins this far above the origin, so that a run does not begin inside something. m
constexpr double hover = 5e-3;

constexpr int looks_apart = 3;   // at the devices: ten times a second

// Of a hand that the graph says nothing of.
constexpr double usual_stiffness = 400.0, usual_damping = 4.0;   // N/m, N s/m

Message stopped() { return refused ("run/stopped", "nothing runs in the window", "press START there"); }

const Json* descriptionOf (const graph::Graph& g, const std::string& role)
{
    const auto at = std::ranges::find (g.devices, role, &std::pair<std::string, Json>::first);
    return at == g.devices.end() ? nullptr : &at->second;
}
}   // namespace

Performance::Performance (Document& d, const Catalogue& c, Sound* s) : document (d), catalogue (c), sound (s)
{
    document.add (*this);
    probes.onWanted = [this]
    {
        if (engine != nullptr) takeOver();
    };
    documentChanged();
}

Performance::~Performance()
{
    document.remove (*this);
    end();
}

Compiled Performance::compileAt (double rate, const Plan* before, const Plan* withdrawn)
{
    CompileOptions options { .rate_hz = rate, .records = captured_ports, .assets = &assets, .services = { .nearest_triangle = nearestByEmbree, .answers = answers.get() }, .before = before, .withdrawn = withdrawn };
    std::ranges::move (probes.ports(), std::back_inserter (options.records));   // after what is captured, whose numbers have to stay
    if (rig) std::ranges::move (rig->ports(), std::back_inserter (options.records));
    auto compiled = compile (document.graph(), catalogue, options);
    // What somebody wants to see may be gone. That is no reason not to run.
    const auto gone = [&] (const std::string& port)
    { return std::ranges::count (compiled.messages, "record " + port, &Message::where) > 0; };
    if (std::erase_if (options.records, gone) > 0) compiled = compile (document.graph(), catalogue, options);
    if (compiled.plan) needed = needsOf (*compiled.plan);
    return compiled;
}

void Performance::use (const DeviceDesk& d) { desk = &d; }

void Performance::deskChanged()
{
    if (! wanted || ! isRunning() || desk == nullptr) return;
    const auto& now = desk->session().session;
    const auto differs = [&] (const auto& role)
    {
        const auto *before = run_desk.binding (role.name), *after = now.binding (role.name);
        return before == nullptr || after == nullptr ? before != after : *before != *after;
    };
    const auto sounds = [] (const DeviceSession& s)
    { return s.audio() != nullptr ? *s.audio() : Json(); };
    if (now.clock() != run_desk.clock() || sounds (now) != sounds (run_desk) || std::ranges::any_of (engine->newest().roles, differs)) beginAnew (true);
}

/// The first that is no sound card's: whose tool is seen, heard, and moved by the mouse.
std::string Performance::handRoleOf (const Plan& plan) const
{
    for (const auto& role : plan.roles)
    {
        const auto* bound = desk != nullptr ? desk->session().session.binding (role.name) : nullptr;
        const auto* description = bound != nullptr ? bound : descriptionOf (document.graph(), role.name);
        if (description == nullptr || ! audio::isAudio (*description)) return role.name;
    }
    return {};
}

const Performance::Bound* Performance::handDevice() const
{
    const auto at = std::ranges::find (devices, hand_role, &Bound::role);
    return at != devices.end() ? &*at : nullptr;
}

/// By the mouse, or a path that somebody has chosen.
bool Performance::isMovedOtherwise (const std::string& role) const { return role == hand_role && moved_by.kind != Hand::Kind::described; }

/// What a description means, whoever gives it.
MadeDevice Performance::openOther (const std::string& role, const Json& description, const std::filesystem::path& folder)
{
    if (audio::isAudio (description)) return audio::openAudio (audio::withChannels (description, engine ? engine->newest() : *first_plan, role), *rig);
    return hid::openDevice (description, folder, desk != nullptr ? desk->system() : hid::thisComputer(), desk != nullptr ? desk->profiles() : deviceProfiles());
}

/// What the session binds a role to; nothing if it does not, or if the device cannot be had, which is said.
std::optional<Performance::Bound> Performance::openByDesk (const std::string& role)
{
    const auto& session = desk->session();
    const auto openOne = [&] (const Json& description, const std::filesystem::path& folder)
    { return openOther (role, description, folder); };
    const auto binding = bindingOf (session, role);
    auto made = openBound (session, role, *binding, openOne, desk->system(), desk->profiles(), Absence::waits);
    std::ranges::move (made.messages, std::back_inserter (said));
    if (! made.device) return std::nullopt;

    Bound bound { role, std::move (made.device), made.limits, 0.0, made.driver };
    if (const auto real = realDevice (role, *made.driver)) bound.damping = real->profile().limits.device_damping / binding->workspace.scale;
    if (const auto* simulated = dynamic_cast<const SimulatedDevice*> (made.driver))
    {
        bound.damping = simulated->simulation().damping;
        if (auto hand = role == hand_role ? chosenHand (simulated, bound.damping) : nullptr)
        {
            bound.driver = hand.get();
            bound.device = binding->workspace.isPlain() ? std::move (hand) : std::make_unique<WorkspaceDevice> (std::move (hand), binding->workspace);
        }
    }
    return bound;
}

std::optional<Performance::Bound> Performance::open (const std::string& role)
{
    if (desk != nullptr && ! isMovedOtherwise (role) && desk->session().session.binding (role) != nullptr) return openByDesk (role);

    const auto* described = descriptionOf (document.graph(), role);
    auto made = openOther (role, described != nullptr ? *described : Json { { "driver", "sim" } }, document.graph().folder);
    for (auto& m : made.messages)
        m.where = "/devices/" + role + m.where;
    std::ranges::move (made.messages, std::back_inserter (said));
    if (! made.device) return std::nullopt;

    const auto* simulated = dynamic_cast<SimulatedDevice*> (made.device.get());
    Bound bound { role, nullptr, made.limits, simulated != nullptr ? simulated->simulation().damping : 0.0 };
    if (auto hand = role == hand_role ? chosenHand (simulated, bound.damping) : nullptr)
        bound.device = std::move (hand);
    else
        bound.device = std::move (made.device);
    bound.driver = bound.device.get();
    return bound;
}

/// A device that has a clock of its own ticks the run, as on the command line.
ClockChoice Performance::decideClock (const Plan& plan) const
{
    auto& system = desk != nullptr ? desk->system() : hid::thisComputer();
    const auto& profiles = desk != nullptr ? desk->profiles() : deviceProfiles();
    std::vector<Described> described;
    for (const auto& role : plan.roles)
    {
        const bool is_moved = isMovedOtherwise (role.name);
        const auto bound = desk != nullptr ? bindingOf (desk->session(), role.name) : std::nullopt;
        const auto* own = descriptionOf (document.graph(), role.name);
        if (! is_moved && (bound || own != nullptr))
            described.emplace_back (role.name, bound ? bound->description : *own);
        else
            described.emplace_back (role.name, Json { { "driver", "sim" } });
    }
    const auto rateOf = [&] (const Described& d, bool may_wait)
    { return tickRateOf (d.second, system, profiles, may_wait && desk != nullptr && desk->session().session.binding (d.first) != nullptr); };
    return chooseClock ({ {}, desk != nullptr ? desk->session().session.clock() : std::string(), {} }, described, rateOf);
}

std::vector<RealDevice> Performance::realDevices() const
{
    std::vector<RealDevice> all;
    for (const auto& d : devices)
        if (auto real = realDevice (d.role, *d.driver)) all.push_back (std::move (*real));
    return all;
}

std::unique_ptr<TickClock> Performance::makeClock()
{
    for (const auto& real : realDevices())
        if (real.role == clock_role)
        {
            if (real.present != nullptr) return std::make_unique<RunClock> (*real.present, rate_hz);
            return std::make_unique<RunClock> (*real.awaited, rate_hz);
        }
    clock_role.clear();
    return std::make_unique<AbsoluteTimer> (1.0 / rate_hz);
}

/// The simulated tool of the first role, in the hand that was chosen; null if the device is to be as it is described.
std::unique_ptr<Device> Performance::chosenHand (const SimulatedDevice* described, double& damping)
{
    auto what = described != nullptr ? described->simulation() : Simulation {};
    if (what.hand.stiffness == 0.0) what.hand = { usual_stiffness, usual_damping, nullptr };
    switch (moved_by.kind)
    {
    case Hand::Kind::described:
        if (described == nullptr || ! what.hand.path) return nullptr;
        what.hand.path = transported = std::make_shared<TransportPath> (what.hand.path);
        break;
    case Hand::Kind::pointer:
        what.position = Vec3 (0.0, 0.0, hover);
        what.velocity.setZero();
        what.hand_force.setZero();
        what.hand.path = pointer = std::make_shared<PointerPath> (what.position);
        break;
    case Hand::Kind::path:
    {
        auto made = makeDevice ({ { "driver", "sim" }, { "hand", { { "path", moved_by.path } } } }, document.graph().folder);
        std::ranges::move (made.messages, std::back_inserter (said));
        const auto* chosen = dynamic_cast<SimulatedDevice*> (made.device.get());
        if (chosen == nullptr) return nullptr;
        what.hand.path = transported = std::make_shared<TransportPath> (chosen->simulation().hand.path);
        what.position = what.hand.path->at (0.0).position;
        what.velocity.setZero();
        break;
    }
    }
    damping = what.damping;
    return std::make_unique<SimulatedDevice> (std::move (what));
}

void Performance::start (Hand who)
{
    moved_by = std::move (who);
    beginAnew (false);
}

/// For what a run cannot take over. What nobody has rearmed stays stopped, unless a person begins it.
void Performance::beginAnew (bool stays_stopped)
{
    held = stays_stopped && (held || isStoppedForGood());
    stop();
    begins = wanted = true;
    if (! isRunning()) begin();
}

void Performance::stop() noexcept
{
    begins = wanted = false;
    if (runner) runner->stop();
}

void Performance::letGo()
{
    stop();
    end();
}

/// As the session has it.
audio::AudioSettings Performance::audioWanted (Messages& messages) const
{
    const auto* written = desk != nullptr ? run_desk.audio() : nullptr;
    if (written == nullptr) return {};
    auto settings = audio::readAudioSettings (*written, "/audio", messages);
    for (auto& m : messages)
        place (m, desk->session());
    return hasErrors (messages) ? audio::AudioSettings {} : settings;
}

/// A run goes on without the sound that cannot be had.
void Performance::beginSound()
{
    if (! rig->isNeeded()) return rig->seal();
    for (auto& m : rig->begin (engine->plan(), rate_hz, engine.get()))
    {
        m.severity = Message::Severity::warning;
        if (desk != nullptr && m.where.starts_with ("/")) place (m, desk->session());
        said.push_back (std::move (m));
    }
}

void Performance::begin()
{
    end();
    begins = false;
    run_devices = document.graph().devices;
    if (desk != nullptr) run_desk = desk->session().session;
    graph_rate_hz = rate_hz = document.graph().rate_hz;
    answers = std::make_unique<AnsweringThread>();
    Messages of_sound;
    rig = std::make_unique<audio::AudioRig> (audioWanted (of_sound));
    auto compiled = compileAt (rate_hz, nullptr, nullptr);
    hand_role = compiled.plan ? handRoleOf (*compiled.plan) : std::string();
    auto choice = compiled.plan ? decideClock (*compiled.plan) : ClockChoice {};
    clock_role = choice.role;
    if (! choice.role.empty() && choice.rate_hz != rate_hz) compiled = compileAt (rate_hz = choice.rate_hz, nullptr, nullptr);
    said = std::move (compiled.messages);
    std::ranges::move (choice.messages, std::back_inserter (said));
    std::ranges::move (of_sound, std::back_inserter (said));
    if (! compiled.plan) return;

    noteDelay (*compiled.plan);
    if (choice.by_sound_card) rig->tickBy (rate_hz);
    first_plan = compiled.plan.get();
    for (const auto& role : compiled.plan->roles)
        if (auto bound = open (role.name)) devices.push_back (std::move (*bound));
    probes.select (*compiled.plan, rate_hz, true);
    engine = std::make_unique<Engine> (std::move (compiled.plan));
    if (held) engine->emergencyStop();
    for (auto& d : devices)
        engine->attach (d.role, *d.device, d.limits);
    std::ranges::move (missingParts (engine->plan()), std::back_inserter (said));
    for (const auto& real : realDevices())
        if (const auto role = std::ranges::find (needed, real.role, &RoleNeeds::role); role != needed.end()) std::ranges::move (missingTools (*role, partsOf (real.profile())), std::back_inserter (said));
    if (sound != nullptr) sound->setTickRate (rate_hz);
    beginSound();
    clock = rig->clock() == nullptr ? makeClock() : nullptr;
    watch = HealthWatch { clock_role };
    runner = std::make_unique<Runner> (*engine, clock ? *clock : *rig->clock(), rate_hz, Runner::Options { .hooks = this });
    runner->start();
}

void Performance::end()
{
    runner.reset();   // which waits until the forces are zero
    clock.reset();
    if (rig) rig->end();
    engine.reset();
    endCapture();
    answers.reset();
    devices.clear();
    watch = HealthWatch {};
    clock_role.clear();
    rig.reset();
    pointer.reset();
    transported.reset();
    delay_ticks.reset();
}

void Performance::documentChanged()
{
    const auto& graph = document.graph();
    const bool is_same_run = engine != nullptr && graph.rate_hz == graph_rate_hz && graph.devices == run_devices;
    if (is_same_run) return takeOver();
    said = compileAt (graph.rate_hz, nullptr, nullptr).messages;   // a run that ends first may take a moment
    if (wanted) beginAnew (true);                                  // perhaps it compiles now
}

void Performance::takeOver()
{
    auto waiting = engine->withdraw();
    auto compiled = compileAt (rate_hz, &engine->newest(), waiting.get());
    said = std::move (compiled.messages);
    if (! compiled.plan)
    {
        engine->submit (std::move (waiting));
        return;
    }
    if (! captured_taps.empty() && tapsOf (*compiled.plan, captured_ports) != captured_taps) endCapture();
    if (hand_role.empty() && ! handRoleOf (*compiled.plan).empty())   // the run had no hand
    {
        engine->submit (std::move (waiting));
        return beginAnew (true);
    }
    noteDelay (*compiled.plan);
    std::vector<Bound> opened;
    for (const auto& role : compiled.plan->roles)
        if (std::ranges::find (devices, role.name, &Bound::role) == devices.end())
            if (auto bound = open (role.name)) opened.push_back (std::move (*bound));
    std::vector<Engine::Joining> joining;
    for (const auto& d : opened)
        joining.push_back ({ d.role, *d.device, d.limits });
    probes.select (*compiled.plan, rate_hz, false);
    engine->submit (std::move (compiled.plan), joining);
    std::ranges::move (missingParts (engine->newest()), std::back_inserter (said));
    std::ranges::move (opened, std::back_inserter (devices));
}

void Performance::noteDelay (const Plan& plan)
{
    delay_ticks.reset();
    for (const auto& d : plan.delays)
        delay_ticks = std::max (delay_ticks.value_or (0), d.shortest);
}

void Performance::emergencyStop() noexcept
{
    held = true;
    if (begins || ! isRunning()) return stop();   // else one that is about to begin would not know of it
    engine->emergencyStop();
}

void Performance::rearm() noexcept
{
    held = false;
    if (engine) engine->rearm();
}

bool Performance::isStoppedForGood() const
{
    const auto now = status();
    return isRunning() && std::ranges::any_of (now->shown(), [] (const RunStatus::Role& r)
                                               { return Guard::latches (r.stop); });
}

std::optional<RunStatus> Performance::status() const { return runner ? std::optional (runner->status()) : std::nullopt; }

/// Where a sound card ticks, the ticks of a block go by one reading.
std::optional<std::int64_t> Performance::delay() const
{
    if (! delay_ticks || ! rig || rig->clock() == nullptr) return delay_ticks;
    const auto card = rig->status().card;
    return card.rate_hz > 0.0 ? *delay_ticks + static_cast<std::int64_t> (std::ceil (card.block * rate_hz / card.rate_hz)) : *delay_ticks;
}

std::optional<double> Performance::stiffnessLeft() const
{
    const auto* hand = handDevice();
    const auto ticks = delay();
    if (hand == nullptr || hand->damping <= 0.0 || ! ticks) return std::nullopt;
    return 2.0 * hand->damping * rate_hz / (2.0 * static_cast<double> (*ticks) + 1.0);
}

std::optional<double> Performance::mostForce() const
{
    std::optional<double> most;
    for (const auto& d : devices)
        if (std::isfinite (d.limits.max_force)) most = std::max (most.value_or (0.0), d.limits.max_force);
    return most;
}

std::vector<NodeCost> Performance::costs() { return runner ? runner->costs() : std::vector<NodeCost> {}; }

std::optional<Message> Performance::turn (const std::string& param, const Json& value) { return isRunning() ? turnParam (*engine, param, value) : stopped(); }

std::optional<Message> Performance::turnControl (const std::string& id, double value) { return isRunning() ? tactus::turnControl (*engine, document.graph(), id, value) : stopped(); }

std::optional<Message> Performance::strike (const std::string& input, double speed) { return isRunning() ? tactus::strike (*engine, input, speed) : stopped(); }

std::variant<std::vector<std::string>, Message> Performance::capture (const std::string& port, const std::string& watched, const Trigger& trigger)
{
    if (! isRunning()) return stopped();
    endCapture();
    captured_ports = { port, watched };
    takeOver();
    auto armed = arm (engine->newest(), port, watched, trigger);
    if (auto* problem = std::get_if<Message> (&armed))
    {
        endCapture();
        return std::move (*problem);
    }
    captured_taps = tapsOf (engine->newest(), captured_ports);
    auto& [made, names] = std::get<Armed> (armed);
    slot.arm (std::move (made));
    return std::move (names);
}

void Performance::endCapture()
{
    slot.disarm();
    captured_ports.clear();
    captured_taps.clear();
}

void Performance::point (const Vec3& p)
{
    if (pointer) pointer->moveTo (p);
}

std::optional<Performance::Tool> Performance::tool() const
{
    if (! isRunning() || handDevice() == nullptr) return std::nullopt;
    const auto values = seen.load();
    return Tool { Vec3 (values.data()), Vec3 (values.data() + 3) };
}

void Performance::after (std::uint64_t tick, bool halts) noexcept
{
    const auto& plan = engine->plan();
    probes.note (plan, tick);
    slot.note (plan, tick);
    rig->after (plan, halts);
    const auto role = std::ranges::find_if (plan.roles, [this] (const auto& r)
                                            { return r.name == hand_role; });
    if (role == plan.roles.end()) return;
    const auto& device = *role->state;
    const auto &p = device.reading.position, &f = device.applied.force;
    if (sound != nullptr) sound->push (f.sum());
    seen.store ({ p.x(), p.y(), p.z(), f.x(), f.y(), f.z() });
}

std::optional<audio::AudioStatus> Performance::audioStatus() const
{
    if (! rig || ! runner || ! rig->isNeeded()) return std::nullopt;
    return rig->status();
}

void Performance::before (std::uint64_t) noexcept { rig->before(); }

void Performance::attend()
{
    if (begins && ! isRunning()) begin();
    if (runner) runner->attend();
    if (runner && ++attended % looks_apart == 0) watch.look (realDevices());
    if (rig) rig->attend();
    if (sound != nullptr) sound->attend();
    probes.collect();
}

}   // namespace tactus::host
