// SPDX-License-Identifier: MIT
#include "live_session.hpp"

#include <host/devices/failsafe/failsafe.hpp>
#include <tactus/plan/rules/missing_parts.hpp>
#include <tactus/run/device/gesture_device.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/run/device/trace.hpp>
#include <tactus/text/message.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr auto looks_apart = std::chrono::milliseconds (100);   // between two checks of the devices

bool isSimulatedDevice (const Run::RoleDevice& d)
{
    auto* driver = d.driver != nullptr ? d.driver : d.device.get();
    return dynamic_cast<SimulatedDevice*> (driver) != nullptr || dynamic_cast<GestureDevice*> (driver) != nullptr
           || dynamic_cast<TraceDevice*> (driver) != nullptr;
}

/// True if the graph reads where the tool of the role is.
bool readsPlace (const Plan& plan, const std::string& role)
{
    const auto needs = needsOf (plan);
    const auto of_role = std::ranges::find (needs, role, &RoleNeeds::role);
    return of_role != needs.end() && (of_role->parts.position || of_role->parts.rotation);
}
}   // namespace

LiveSession::LiveSession (const Catalogue& c, Hardware h, Options o)
    : catalogue (c), hardware (std::move (h)), options (std::move (o)), devices (hardware, std::move (options.devices)),
      stops (options.stops != nullptr ? *options.stops : own_stops)
{
}

LiveSession::~LiveSession() { static_cast<void> (end()); }

//==============================================================================
Messages LiveSession::load (const graph::Graph& graph)
{
    playing = graph;
    auto& fixed_rate = options.compile.rate_hz;
    auto choice = devices.chooseClock (playing, options.clock, fixed_rate > 0.0 ? std::optional (fixed_rate) : std::nullopt);
    auto messages = std::move (choice.messages);
    if (hasErrors (messages)) return messages;
    if (choice.by_sound_card && hardware.sound() == nullptr)
        messages.push_back (Message::warning ("audio/none", options.clock.empty() ? "/clock" : "--clock " + options.clock,
                                              "the sound card cannot tick the run, because this program has no sound cards", "a timer ticks the run"));
    else if (choice.by_sound_card)
        hardware.sound()->tickBy (fixed_rate > 0.0 ? fixed_rate : playing.rate_hz);
    clock_role = choice.role;
    if (! clock_role.empty()) options.compile.rate_hz = choice.rate_hz;

    const auto opener = [this] (const std::string& role, const graph::Graph& g, const Plan& plan, Messages& m) {
        auto opened = devices.open (role, g, plan, m);
        opened.limits.ramp = std::max (opened.limits.ramp, options.least_ramp_s);
        if (options.may_move && opened.device && ! isSimulatedDevice (opened) && readsPlace (plan, role)) makeMovable (opened);
        return opened;
    };
    running = std::make_unique<Run> (catalogue, options.compile, opener, options.queries);
    std::optional<Messages> compiled;
    if (options.keeps_records)   // before there are listeners: the plan taps the inputs of all sinks only if no ports are named
    {
        compiled = running->load (graph);
        if (running->hasEngine()) running->keepRecords();
    }
    auto listeners = options.listeners;
    if (hardware.sound() != nullptr) listeners.push_back (hardware.sound());
    listeners.push_back (this);
    for (auto* listener : listeners)
        running->add (*listener);
    const bool names_ports = std::ranges::any_of (listeners, [] (const auto* l) { return ! l->ports().empty(); });
    if (! compiled || (names_ports && running->hasEngine())) compiled = running->load (graph);
    has_placeholders = running->hasEngine() && hasErrors (*compiled);
    std::ranges::move (*compiled, std::back_inserter (messages));
    return messages;
}

Messages LiveSession::openDevices()
{
    Messages messages;
    alarms_told = alarms_stopped = Failsafe::alarms();   // earlier alarms have nothing to do with the devices of this run
    running->keepLimits (options.kept_limits);
    running->openDevices (playing, messages);
    showStops();
    obeyed = stops.noticed();
    if (options.is_stopped) engine().emergencyStop();

    const auto& plan = engine().newest();
    std::ranges::move (missingParts (plan), std::back_inserter (messages));
    const auto needs = needsOf (plan);
    const auto real_devices = realDevices();
    if (std::ranges::count (real_devices, clock_role, &RealDevice::role) == 0) clock_role.clear();
    for (const auto& real : real_devices)
        if (const auto role = std::ranges::find (needs, real.role, &RoleNeeds::role); role != needs.end())
            std::ranges::move (missingTools (*role, partsOf (real.profile())), std::back_inserter (messages));
    for (const auto& plugin : pluginRoles())
        if (const auto role = std::ranges::find (needs, plugin.role, &RoleNeeds::role); role != needs.end())
            std::ranges::move (missingTools (*role, partsOf (plugin.device->about())), std::back_inserter (messages));
    return messages;
}

/// Shows each HID device the guard of its role, so that the device can stop with it.
void LiveSession::showStops()
{
    for (const auto& real : realDevices())
        if (real.present != nullptr) real.present->heed (engine().guardOf (real.role));
}

Messages LiveSession::beginSound (bool anyway)
{
    auto* sound = hardware.sound();
    if (sound == nullptr) return {};
    if (sound->isNeeded() || anyway) return sound->begin (engine().plan(), rate(), &engine());
    sound->seal();
    return {};
}

Result<> LiveSession::log (const std::filesystem::path& file, std::string program, std::vector<std::string> sets)
{
    return running->startLog (file, std::move (program), std::move (sets), playing);
}

/// The clock of the run: the sound card, a device, or a timer. Simulated devices do not notice that a timer is a little late.
TickClock& LiveSession::clock()
{
    if (hardware.sound() != nullptr)
        if (auto* by_card = hardware.sound()->clock()) return *by_card;
    for (const auto& real : realDevices())
        if (real.role == clock_role)
        {
            device_clock = real.present != nullptr ? std::make_unique<RunClock> (*real.present, rate()) : std::make_unique<RunClock> (*real.awaited, rate());
            return *device_clock;
        }
    return timer.emplace (1.0 / rate(), drivesDevice() ? AbsoluteTimer::Wait::punctual : AbsoluteTimer::Wait::idle);
}

std::vector<std::string> LiveSession::start (const Start& how)
{
    auto& ticks = clock();
    watch = HealthWatch { clock_role };
    return running->start (ticks, { .length = how.length, .length_s = how.length_s, .core = how.core, .stop_wanted = how.stop_wanted });
}

//==============================================================================
void LiveSession::before (Plan&, std::uint64_t) noexcept
{
    if (const auto now = Failsafe::alarms(); std::exchange (alarms_stopped, now) != now)
    {
        stops.note (By::program);   // from now on, nothing rearms for a while, however long the main thread is busy
        engine().emergencyStop();
    }
    const auto now = stops.presses();
    const auto earlier = std::exchange (obeyed, now);
    if (now.emergencies != earlier.emergencies) engine().emergencyStop();
    if (now.stops != earlier.stops && running->isLive()) running->live().stop();
}

void LiveSession::stop() noexcept
{
    if (isLive()) running->live().stop();
}

void LiveSession::emergencyStop() noexcept
{
    stops.note (By::program);
    if (isLoaded()) engine().emergencyStop();
}

/// A stop on another thread must not be undone: it may come between the question and the rearm.
Result<> LiveSession::rearm (std::chrono::steady_clock::time_point asked, By who)
{
    const auto seen = stops.latest();
    const auto alarms = Failsafe::alarms();
    if (auto may = stops.mayRearm (asked); ! may) return may;
    if (auto may = stops.mayStart(); ! may && who == By::program) return may;
    stops.rearmed();
    if (! isLoaded()) return {};
    engine().rearm();
    if (stops.latest() != seen || Failsafe::alarms() != alarms) engine().emergencyStop();
    return {};
}

bool LiveSession::holdWorkspaces (bool so)
{
    if (! running) return false;
    bool any = false;
    for (const auto& [role, d] : running->devices())
        if (auto* device = dynamic_cast<WorkspaceDevice*> (d.device.get()))
        {
            device->hold (so);
            any = true;
        }
    return any;
}

bool LiveSession::isLatched() const
{
    if (! isLive()) return false;
    const auto now = running->live().status();
    return std::ranges::any_of (now.shown(), &RunStatus::Role::is_latched);
}

std::optional<Message> LiveSession::noticeAlarm()
{
    const auto now = Failsafe::alarms();
    if (std::exchange (alarms_told, now) == now) return std::nullopt;
    emergencyStop();
    return Failsafe::alarm();
}

std::optional<Message> LiveSession::attendFusion()
{
    if (! fusing || ! isRunning()) return std::nullopt;
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    return fusing->poll (engine().newestShared(), now.count());
}

LiveSession::Events LiveSession::poll()
{
    Events news;
    if (! isLoaded()) return news;
    news.alarm = noticeAlarm();
    news.log = running->poll();
    if (const auto now = std::chrono::steady_clock::now(); isLive() && now - looked_at >= looks_apart)
    {
        watch.poll (realDevices(), pluginRoles());
        looked_at = now;
    }
    news.fusion = attendFusion();
    if (hardware.sound() != nullptr)
        if (auto attended_sound = hardware.sound()->poll(); ! attended_sound) news.sound = attended_sound.error();
    return news;
}

LiveSession::EditResult LiveSession::edit (const graph::Graph& next, EditPolicy accepts, const std::function<bool (const Plan&)>& agrees)
{
    const bool placeholders_run = has_placeholders;
    auto edit = running->edit (next);
    auto& messages = edit.messages();
    const bool placeholders = edit.plan() != nullptr && hasErrors (messages);
    const auto isRefused = [&] { return accepts == EditPolicy::no_errors && hasErrors (messages); };
    if (placeholders && placeholders_run && accepts == EditPolicy::no_errors)
        for (auto& m : messages)
            m.severity = Message::Severity::warning;
    if (edit.plan() == nullptr || isRefused() || (agrees && ! agrees (*edit.plan()))) return { false, std::move (messages) };
    edit.openDevices();
    if (isRefused()) return { false, std::move (messages) };

    edit.commit();
    showStops();
    EditResult edited { true, std::move (messages) };
    std::ranges::move (missingParts (engine().newest()), std::back_inserter (edited.messages));
    std::ranges::move (devices.notTakenOver (playing, next), std::back_inserter (edited.messages));
    playing = next;
    has_placeholders = placeholders;
    return edited;
}

void LiveSession::fuse (std::optional<Fuser::Options> how)
{
    fusing.reset();
    if (isLive()) engine().newestShared()->fuse (nullptr);
    if (how) fusing.emplace (std::move (*how));
}

//==============================================================================
LiveSession::FinalResults LiveSession::end()
{
    FinalResults ended;
    if (running) ended.log = running->finish();   // waits until the forces are zero
    if (hardware.sound() != nullptr) ended.sound = hardware.sound()->end();
    return ended;
}

std::vector<RealDevice> LiveSession::realDevices() const { return running ? host::realDevices (*running) : std::vector<RealDevice> {}; }

std::vector<PluginRole> LiveSession::pluginRoles() const { return running ? host::pluginRoles (*running) : std::vector<PluginRole> {}; }

bool LiveSession::drivesDevice() const
{
    if (! running) return false;
    const bool plays = hardware.sound() != nullptr && hardware.sound()->isNeeded();
    return plays || ! std::ranges::all_of (running->devices(), [] (const auto& d) { return isSimulatedDevice (d.second); });
}

}   // namespace tactus::host
