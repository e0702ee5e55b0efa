// SPDX-License-Identifier: MIT
// The C API of live sessions (tactus_live.h).
#include "decoding_assets.hpp"
#include "live_session.hpp"
#include <tactus/tactus_live.h>

#include <framework/capi/handles.hpp>
#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/preset_folder.hpp>
#include <host/base/platform/signals.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/caught.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

using namespace tactus::host;
using tactus::Message;
using tactus::Messages;
using tactus::capi::add;
using tactus::capi::asResult;
using tactus::capi::failed;
using tactus::capi::give;
using tactus::capi::guarded;
using tactus::capi::isSized;
using tactus::capi::known;
using tactus::capi::list;
using tactus::capi::misuse;
using tactus::capi::text;

namespace tactus::capi
{
template <>
inline constexpr Form form_of<tactus_session_options> { offsetof (tactus_session_options, asset_context) + sizeof (void*), "tactus_session_options",
                                                        "TACTUS_SESSION_OPTIONS" };
template <>
inline constexpr Form form_of<tactus_health> { offsetof (tactus_health, trouble) + sizeof (char*), "tactus_health", "TACTUS_HEALTH" };
}   // namespace tactus::capi

namespace
{
constexpr std::size_t most_events = 1000;
constexpr double most_number = 1e9;
constexpr std::chrono::duration<double> longest_stop { tactus::Runner::longest_halt_s + 5.0 };
constexpr auto longest_exit = std::chrono::seconds (2);   // then the guardian brings the devices to rest when the process ends
constexpr auto look_apart = std::chrono::milliseconds (20);

long thisProcess() noexcept
{
#if defined(__unix__) || defined(__APPLE__)
    return ::getpid();
#else
    return 0;
#endif
}

/// The sessions that a program has started and not closed. `exit` stops them before it does what the program has asked for later, which may take for ever,
/// and before it destroys what their ticks use.
class SessionsOfProcess
{
public:
    /// The sessions of this process. The child of a fork begins with none: it only has copies of its parent's sessions, and perhaps of a locked mutex.
    static SessionsOfProcess& here()
    {
        static std::atomic<SessionsOfProcess*> current { nullptr };   // never deleted, because threads may use it until the process has ended
        for (auto* known = current.load();;)
        {
            if (known != nullptr && known->owner == thisProcess()) return *known;
            auto made = std::make_unique<SessionsOfProcess>();
            if (current.compare_exchange_strong (known, made.get())) return *made.release();
        }
    }

    void add (tactus_session* s)
    {
#if defined(_WIN32)
        static const int registered = std::atexit (stopAll);   // its C library has no at_quick_exit
#else
        static const int registered = std::atexit (stopAll) + ::at_quick_exit (stopAll);   // once, also for the children of forks
#endif
        static_cast<void> (registered);
        const std::lock_guard lock (mutex);
        all.push_back (s);
    }

    void remove (tactus_session* s)
    {
        const std::lock_guard lock (mutex);
        std::erase (all, s);
    }

private:
    static void stopAll() noexcept;

    const long owner = thisProcess();
    std::mutex mutex;
    std::vector<tactus_session*> all;
};

/// The profiles of this computer, read once.
const tactus::host::hid::LoadedProfiles& profiles()
{
    static const auto all = tactus::host::hid::loadProfileLibrary();
    return all;
}
}   // namespace

/// The members are used by one thread of the caller and by the thread that attends to the session, each with `mutex` held, except where a
/// comment says otherwise.
struct tactus_session
{
    explicit tactus_session (tactus::capi::AssetReader r) : assets (r) {}

    ~tactus_session()
    {
        SessionsOfProcess::here().remove (this);
        attending.request_stop();
        wake.notify_all();
        if (attending.joinable()) attending.join();
    }

    bool isOurs() const noexcept { return owner == thisProcess(); }
    bool isTicking() const noexcept { return has_started && live->isRunning(); }

    void attendOnce();
    void tellStops();

    const long owner = thisProcess();   // after fork(), the child has this memory, but neither the threads nor the devices
    DecodingAssets assets;
    StopSwitch stops;   // [any thread]
    tactus::capi::ProbeQueue probes;
    tactus_recorder recorder;
    std::vector<std::string> records, units;   // names of components, and the units of `records`
    std::unique_ptr<LiveSession> live;         // set before the caller has the session
    LiveSession::Start start;
    bool starts = false;                           // tactus_session_start was called
    std::atomic<bool> has_started { false };       // the run is live   [any thread]
    double rate = 0.0;                             // in Hz; fixed when the caller has the session, as is the clock
    std::map<std::string, std::string> troubles;   // of devices, by role, that the caller was told about
    std::map<std::string, std::string> warned;     // ids of warnings, by role, likewise
    Messages events;
    std::map<std::string, tactus::Guard::Stop> told;   // by role: the stop that the caller was told about
    std::map<std::string, bool> clipping;              // by role: the caller was told that its guard clips most ticks
    bool is_over = false;
    bool misses_main = false;                   // the main thread of the program has ended
    std::atomic<bool> has_given_up { false };   // tactus_session_stop has waited long enough   [any thread]
    std::vector<DeviceHealth> health;
    mutable std::mutex mutex;
    std::condition_variable_any wake;
    std::jthread attending;   // declared last: it uses the other members
};

void SessionsOfProcess::stopAll() noexcept
{
    static_cast<void> (tactus::caught ("the end of the program", [] {
        auto& sessions = here();
        const std::lock_guard lock (sessions.mutex);
        for (auto* s : sessions.all)
        {
            s->stops.stop (By::program);
            if (s->has_started) s->live->stop();
        }
        const auto isTicking = [] (const tactus_session* s) { return s->isTicking(); };
        for (const auto began = std::chrono::steady_clock::now();
             std::ranges::any_of (sessions.all, isTicking) && std::chrono::steady_clock::now() - began < longest_exit;)
            std::this_thread::sleep_for (std::chrono::milliseconds (2));
    }));
}

void tactus_session::tellStops()
{
    if (! live->isLive()) return;
    const auto now = live->run().live().status();
    for (const auto& role : now.shown())
    {
        using Stop = tactus::Guard::Stop;
        const auto name = std::string (role.name);
        if (! std::exchange (clipping[name], role.is_clipping) && role.is_clipping)
            events.push_back (Message::warning ("run/clipped", "/devices/" + name,
                                                "the guard clips most ticks: the graph asks for more force than its limits, or for a faster change",
                                                "lower the gains, or look for a part that grows"));
        if (std::exchange (told[name], role.stop) == role.stop || role.stop == Stop::none || role.stop == Stop::halted) continue;
        events.push_back (Message::warning ("run/guard", "/devices/" + name, describe (role.latestEvent()),
                                            role.is_latched ? "find out what stops the run, then rearm" : ""));
    }
    if (now.phase != tactus::RunStatus::Phase::over || std::exchange (is_over, true)) return;
    if (now.end == tactus::RunStatus::End::overrun)
        events.push_back (Message::error ("run/overrun", "", "stopped, because the graph takes longer than a tick period",
                                          "simplify the graph, or use a lower rate"));
}

void tactus_session::attendOnce()
{
    if (! misses_main && (misses_main = mainThreadHasEnded()))
    {
        stops.stop (By::program);
        events.push_back (Message::error ("run/main_thread", "", "stopped, because the main thread of the program has ended",
                                          "let the main thread wait for the other threads"));
    }
    auto news = live->poll();
    for (auto* each : { &news.alarm, &news.log, &news.fusion, &news.sound })
        if (*each) events.push_back (std::move (**each));
    tellStops();
    for (const auto& h : live->health())
        if (auto& told_trouble = troubles[h.role]; std::exchange (told_trouble, h.trouble) != h.trouble && ! h.trouble.empty())
            events.push_back (Message::warning ("device/trouble", "/devices/" + h.role, h.trouble));
    for (const auto& h : live->health())
        if (auto& told_id = warned[h.role]; h.warning && std::exchange (told_id, h.warning->id) != h.warning->id)
            events.push_back (Message::warning (h.warning->id, "/devices/" + h.role, h.warning->text, h.warning->remedy));
    probes.drain();
    if (events.size() > most_events) events.erase (events.begin(), events.end() - most_events);
}

namespace
{
/// The role of each device that the caller gives must be one of the graph.
bool knowsRoles (const std::vector<tactus::DeviceOption>& given, const LiveSession& session, tactus_messages* messages)
{
    const auto& roles = session.run().engine().newest().roles();
    for (const auto& option : given)
    {
        if (std::ranges::any_of (roles, [&] (const auto& r) { return r.name == option.role; })) continue;
        failed (messages, Message::error ("device/unknown_role", "devices", "the graph has no role '" + option.role + "'", "name a role of its device nodes"));
        return false;
    }
    return true;
}

/// True, and the messages are passed on, if there are no errors among them.
bool areFine (Messages found, tactus_messages* messages)
{
    const bool fine = ! tactus::hasErrors (found);
    add (messages, std::move (found));
    return fine;
}

tactus_session* open (const tactus_graph& g, const tactus_session_options& given, tactus_messages* messages)
{
    const auto refuse = [&] (Message why) {
        failed (messages, std::move (why));
        return nullptr;
    };
    const auto& graph = g.history.graph();
    LiveSession::Options options;
    for (const auto& device : list (given.devices, given.device_count))
    {
        Messages notes;
        auto parsed = tactus::host::parseDeviceOption (device, graph.devices, graph.folder, profiles, notes);
        add (messages, std::move (notes));
        if (! parsed) return refuse (std::move (parsed).error());
        options.devices.given.push_back (std::move (*parsed));
    }
    if (const auto file = text (given.session); file != "off")
    {
        options.devices.session = file.empty() ? loadDefaultSession (homeFolder()) : loadSession (file);
        if (! areFine (options.devices.session.messages, messages)) return nullptr;
    }
    options.devices.absence = given.is_strict != 0 ? Absence::refuses : Absence::waits;
    options.devices.remedy = "describe a device for it under `devices`, or give it one: ROLE=gesture:stroke";
    for (const auto& set : list (given.sets, given.set_count))
    {
        auto read = tactus::readOverride (set);
        if (! read) return refuse (std::move (read).error());
        options.compile.overrides.push_back (std::move (*read));
    }
    for (const double number : { given.rate_hz, given.duration_s, given.buffer_s })
        if (! (number >= 0.0 && number < most_number))
            return refuse (Message::error ("api/value", "", "the rate, the duration or the buffer is not a number from 0 to 10^9", "give 0 for the usual one"));

    auto made = std::make_unique<tactus_session> (tactus::capi::AssetReader { given.assets, given.asset_context });
    options.compile.rate_hz = given.rate_hz;
    options.compile.records = list (given.records, given.record_count);
    options.compile.assets = &made->assets;
    options.compile.services.nearest_triangle = tactus::nearestByBoxes;
    options.keeps_records = true;
    options.clock = text (given.clock);
    options.listeners = { &made->recorder, &made->probes.listener() };
    options.stops = &made->stops;
    const auto given_devices = options.devices.given;
    made->live = std::make_unique<LiveSession> (tactus::catalogue(), Hardware { hid::thisComputer(), profiles, nullptr }, std::move (options));
    auto& live = *made->live;
    if (! areFine (live.load (graph), messages) || ! live.isLoaded() || ! knowsRoles (given_devices, live, messages)) return nullptr;
    if (! areFine (live.openDevices(), messages)) return nullptr;
    if (given.log != nullptr)
        if (auto logs = live.log (given.log, "libtactus_live " TACTUS_LIBRARY_VERSION, list (given.sets, given.set_count)); ! logs)
            return refuse (std::move (logs).error());
    made->rate = live.rate();
    for (const auto& tap : live.run().recorded())
    {
        made->records.push_back (tap.name);
        made->units.push_back (tap.unit);
    }
    if (const double ticks = std::ceil (given.buffer_s * live.rate()); ticks > 0.0 && ! made->records.empty())
        made->recorder.ring = std::make_unique<tactus::SpscRing<double>> (static_cast<std::size_t> (ticks), made->records.size());
    if (given.fuses != 0) live.fuse (Fuser::Options { .compiler = { .cache = FusionCompiler::usualCache() } });
    if (given.duration_s > 0.0) made->start.length_s = given.duration_s;
    if (given.core > 0) made->start.core = given.core - 1;
    return made.release();
}

tactus_result notOurs() noexcept { return misuse ("the session is NULL, or belongs to the process that this one was forked from"); }

/// Calls a function with the session locked. For sessions of this process only.
template <typename F>
tactus_result with (tactus_session* s, tactus_messages* messages, F&& f)
{
    if (s == nullptr || ! s->isOurs()) return notOurs();
    return guarded (messages, TACTUS_FAILED, [&]() -> tactus_result {
        const std::lock_guard lock (s->mutex);
        return f (*s->live);
    });
}

bool isOurs (const tactus_session* s) noexcept { return s != nullptr && s->isOurs(); }

const char* nameAt (const std::vector<std::string>& names, size_t i) { return i < names.size() ? names[i].c_str() : nullptr; }
}   // namespace

tactus_session* tactus_session_open (const tactus_graph* g, const tactus_session_options* given, tactus_messages* messages)
{
    if (g == nullptr || ! isSized (given, messages)) return nullptr;
    return guarded<tactus_session*> (messages, nullptr, [&] {
        const HeldSignals held;
        return open (*g, known (given, tactus_session_options TACTUS_SESSION_OPTIONS), messages);
    });
}

tactus_result tactus_session_start (tactus_session* s, tactus_messages* messages)
{
    if (s == nullptr || ! s->isOurs()) return notOurs();
    if (std::exchange (s->starts, true)) return misuse ("the session was started before");
    return guarded (messages, TACTUS_FAILED, [&] {
        const HeldSignals held;   // by the threads that start here: the handlers of the program run on its own threads
        SessionsOfProcess::here().add (s);
        s->attending = std::jthread ([s] (const std::stop_token& stop) {
            static_cast<void> (tactus::caught ("the thread of the session", [&] {
                std::unique_lock lock (s->mutex);
                while (! stop.stop_requested())
                {
                    if (auto done = tactus::caught ("the session", [&] { s->attendOnce(); }); ! done) s->events.push_back (std::move (done).error());
                    s->wake.wait_for (lock, stop, look_apart, [&] { return stop.stop_requested(); });
                }
            }));
        });
        const std::lock_guard lock (s->mutex);
        for (auto& refused : s->live->start (s->start))
            if (messages != nullptr) messages->list.push_back (Message::warning ("run/privilege", "", std::move (refused)));
        s->has_started = true;
        return TACTUS_OK;
    });
}

tactus_result tactus_session_stop (tactus_session* s, tactus_messages* messages)
{
    if (s == nullptr || ! s->isOurs()) return notOurs();
    s->stops.stop (By::program);   // without the lock, which another call may hold for long; also for ticks that start only now
    if (s->has_started) s->live->stop();
    return guarded (messages, TACTUS_FAILED, [&]() -> tactus_result {
        // Without the lock, so that the session is attended to meanwhile.
        for (const auto began = std::chrono::steady_clock::now(); s->isTicking(); std::this_thread::sleep_for (std::chrono::milliseconds (2)))
            if (std::chrono::steady_clock::now() - began > longest_stop)
            {
                s->has_given_up = true;
                return failed (messages, Message::error ("run/stuck", "", "a tick does not end, so the session cannot end either",
                                                         "the graph asks for too much in one tick, or a plugin loops; `tactus check-plugin` examines plugins"));
            }
        return with (s, messages, [&] (LiveSession& live) {
            auto ended = live.end();
            return ended.log ? TACTUS_OK : failed (messages, std::move (ended.log).error());
        });
    });
}

void tactus_session_close (tactus_session* s)
{
    if (s == nullptr || ! s->isOurs()) return;
    if (! s->has_given_up) static_cast<void> (tactus_session_stop (s, nullptr));
    if (! s->isTicking()) delete s;
}

tactus_result tactus_session_emergency_stop (tactus_session* s)
{
    if (s == nullptr || ! s->isOurs()) return notOurs();
    s->stops.emergencyStop (By::program);
    return TACTUS_OK;
}

tactus_result tactus_session_rearm (tactus_session* s, tactus_messages* messages)
{
    if (s == nullptr || ! s->isOurs()) return notOurs();
    return guarded (messages, TACTUS_FAILED, [&] { return asResult (messages, s->live->rearm()); });
}

char* tactus_graph_file (const char* name)
{
    return guarded<char*> (nullptr, nullptr, [&] { return tactus::capi::copied (graphFile (text (name))); });
}

//==============================================================================
tactus_result tactus_session_edit (tactus_session* s, const tactus_graph* g, tactus_messages* messages)
{
    if (g == nullptr) return misuse ("the graph is NULL");
    return with (s, messages, [&] (LiveSession& live) {
        std::optional<tactus::graph::Graph> copy;
        s->probes.drain();   // the samples of the plan before
        auto edited = live.edit (continuing (*g, live.graph(), copy), LiveSession::EditPolicy::no_errors);
        if (edited.is_taken_over) s->probes.follow (live.engine().newest());
        add (messages, std::move (edited.messages));
        return edited.is_taken_over ? TACTUS_OK : TACTUS_FAILED;
    });
}

tactus_result tactus_session_set (tactus_session* s, const char* param, const char* value, tactus_messages* messages)
{
    return with (s, messages, [&] (LiveSession& live) {
        return asResult (messages, tactus::turnParam (live.engine(), text (param), tactus::readValue (text (value))));
    });
}

tactus_result tactus_session_turn (tactus_session* s, const char* control, double value, tactus_messages* messages)
{
    return with (s, messages, [&] (LiveSession& live) {
        return asResult (messages, tactus::turnControl (live.engine(), live.graph(), text (control), value));
    });
}

tactus_result tactus_session_hit (tactus_session* s, const char* input, double speed, tactus_messages* messages)
{
    return with (s, messages,
                 [&] (LiveSession& live) { return asResult (messages, tactus::strike (live.engine(), text (input), speed)); });
}

tactus_result tactus_session_probe (tactus_session* s, const char* const* ports, size_t count, tactus_messages* messages)
{
    return with (s, messages, [&] (LiveSession& live) {
        return asResult (messages, s->probes.probe (live.run(), live.graph(), list (ports, count)));
    });
}

size_t tactus_session_probe_count (const tactus_session* s) { return isOurs (s) ? s->probes.names().size() : 0; }
const char* tactus_session_probe_name (const tactus_session* s, size_t i) { return isOurs (s) ? nameAt (s->probes.names(), i) : nullptr; }

tactus_result tactus_session_probed (tactus_session* s, double* values, size_t count)
{
    if (values == nullptr) return misuse ("the values are NULL");
    return with (s, nullptr, [&] (LiveSession&) {
        const auto& now = s->probes.values();
        if (count < now.size()) return misuse ("there is not enough room for the values of all probes");
        std::ranges::copy (now, values);
        return TACTUS_OK;
    });
}

size_t tactus_session_collect_probes (tactus_session* s, uint64_t* ticks, double* rows, size_t most)
{
    size_t count = 0;
    with (s, nullptr, [&] (LiveSession&) {
        count = s->probes.collect (ticks, rows, most);
        return TACTUS_OK;
    });
    return count;
}

uint64_t tactus_session_lost_probes (tactus_session* s)
{
    std::uint64_t count = 0;
    with (s, nullptr, [&] (LiveSession&) {
        count = s->probes.lost();
        return TACTUS_OK;
    });
    return count;
}

size_t tactus_session_record_count (const tactus_session* s) { return isOurs (s) ? s->records.size() : 0; }
const char* tactus_session_record_name (const tactus_session* s, size_t i) { return isOurs (s) ? nameAt (s->records, i) : nullptr; }
const char* tactus_session_record_unit (const tactus_session* s, size_t i) { return isOurs (s) ? nameAt (s->units, i) : nullptr; }
size_t tactus_session_collect (tactus_session* s, double* rows, size_t most) { return isOurs (s) ? s->recorder.collect (rows, most) : 0; }
uint64_t tactus_session_lost (const tactus_session* s) { return isOurs (s) ? s->recorder.lost() : 0; }

//==============================================================================
tactus_result tactus_session_status (const tactus_session* s, tactus_status* to)
{
    if (s == nullptr || ! s->isOurs()) return notOurs();
    return give (to, s->has_started ? tactus::capi::statusOf (s->live->run(), true) : tactus_status TACTUS_STATUS);
}

double tactus_session_rate (const tactus_session* s) { return isOurs (s) ? s->rate : 0.0; }
const char* tactus_session_clock (const tactus_session* s) { return isOurs (s) ? s->live->clockRole().c_str() : nullptr; }

size_t tactus_session_health_count (tactus_session* s)
{
    size_t count = 0;
    with (s, nullptr, [&] (LiveSession& live) {
        s->health = live.health();
        count = s->health.size();
        return TACTUS_OK;
    });
    return count;
}

tactus_result tactus_session_health (tactus_session* s, size_t i, tactus_health* to)
{
    if (s == nullptr || ! s->isOurs()) return notOurs();
    if (i >= s->health.size()) return misuse ("there is no device of this number: call tactus_session_health_count first");
    const auto& h = s->health[i];
    return give (to, tactus_health { .size = sizeof (tactus_health),
                                     .role = h.role.c_str(),
                                     .profile = h.profile.c_str(),
                                     .is_connected = h.connected,
                                     .age_s = h.age,
                                     .oldest_s = h.oldest,
                                     .rate_hz = h.rate_hz.value_or (0.0),
                                     .reports = h.reports,
                                     .lost = h.lost,
                                     .departures = h.departures,
                                     .trouble = h.trouble.c_str() });
}

size_t tactus_session_events (tactus_session* s, tactus_messages* messages)
{
    size_t count = 0;
    with (s, messages, [&] (LiveSession&) {
        count = s->events.size();
        add (messages, std::exchange (s->events, {}));
        return TACTUS_OK;
    });
    return count;
}
