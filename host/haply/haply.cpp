// SPDX-License-Identifier: MIT
// A device driver for Haply's Inverse3 and VerseGrip, through the service of its maker: WebSocket and JSON, one answer for each message. Written from the
// public description of the messages; no device has been tried. See docs/devices.md.
#include <tactus/tactus_device.h>

#include <host/websocket/web_socket.hpp>
#include <tactus/text/json_text.hpp>

#include <boost/asio/steady_timer.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace
{
using tactus::Json;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto until_probe = 5ms;     // after an answer without a new force; longer than a tick, so a probe never comes between two forces
constexpr auto until_late = 20ms;     // without an answer: efforts are refused
constexpr auto until_gone = 100ms;    // the service is not there any more
constexpr auto until_rested = 15ms;   // `rest` may take 20 ms
constexpr auto until_connected = 2s;
constexpr auto until_driven = 50ms;
constexpr std::size_t most_waiting = 64;

using Vector = std::array<double, 3>;

struct State
{
    Vector position {}, rotation {};
    std::uint32_t buttons = 0;
    bool is_idle = false;
};

int32_t fail (const tactus_plugin_report* report, const std::string& why)
{
    report->put (report->context, why.data(), why.size());
    return TACTUS_DEVICE_FAILED;
}

std::string text (const Json& from, const char* key)
{
    if (! from.is_object()) return {};
    const auto at = from.find (key);
    return at != from.end() && at->is_string() ? at->asString() : std::string();
}

const Json* member (const Json* from, const char* key)
{
    if (from == nullptr || ! from->is_object()) return nullptr;
    const auto at = from->find (key);
    return at != from->end() ? &*at : nullptr;
}

/// The finite number there.
std::optional<double> numberAt (const Json* from, const char* key)
{
    const auto* at = member (from, key);
    if (at == nullptr || ! at->is_number()) return std::nullopt;
    const double number = at->get<double>();
    return std::isfinite (number) ? std::optional (number) : std::nullopt;
}

std::optional<Vector> vectorAt (const Json* from)
{
    const auto x = numberAt (from, "x"), y = numberAt (from, "y"), z = numberAt (from, "z");
    if (! x || ! y || ! z) return std::nullopt;
    return Vector { *x, *y, *z };
}

/// The rotation vector of a quaternion, of any length but 0.
std::optional<Vector> rotationAt (const Json* from)
{
    const auto v = vectorAt (from);
    const auto w = numberAt (from, "w");
    if (! v || ! w) return std::nullopt;
    const double sine = std::hypot ((*v)[0], (*v)[1], (*v)[2]);
    if (sine == 0.0 && *w == 0.0) return std::nullopt;
    const double sign = *w < 0.0 ? -1.0 : 1.0;   // the shorter way round
    const double scale = sine > 0.0 ? sign * 2.0 * std::atan2 (sine, sign * *w) / sine : 0.0;
    return Vector { scale * (*v)[0], scale * (*v)[1], scale * (*v)[2] };
}

constexpr const char* button_names[] { "a", "b", "c", "home" };

/// What the person asks for.
struct Wanted
{
    std::string host, port, device_id, grip, spelling;
};

std::optional<std::string> read (const tactus_device_description& given, Wanted& wanted)
{
    const auto json = tactus::readJson (given.json != nullptr && given.json[0] != 0 ? given.json : "{}").root;
    std::string address = given.port[0] != 0 ? given.port : "localhost:10001";
    if (address.find (':') == address.npos) address = "localhost:" + address;
    wanted.host = address.substr (0, address.rfind (':'));
    wanted.port = address.substr (address.rfind (':') + 1);
    wanted.device_id = text (json, "device_id");
    wanted.grip = text (json, "grip");
    wanted.spelling = json.contains ("spelling") ? text (json, "spelling") : "values";
    if (wanted.host.empty() || wanted.port.empty() || wanted.port.find_first_not_of ("0123456789") != wanted.port.npos)
        return "\"port\" is written as 10001 or localhost:10001";
    if (! wanted.grip.empty() && wanted.grip != "wireless" && wanted.grip != "wired") return "\"grip\" is wireless or wired, or left out";
    if (wanted.spelling != "values" && wanted.spelling != "vector") return "\"spelling\" is values (the service up to 3.1) or vector (since 3.5)";
    return std::nullopt;
}

/// The connection to the service.
class Inverse3
{
public:
    explicit Inverse3 (Wanted w) : wanted (std::move (w)) {}
    ~Inverse3() { socket.close(); }

    /// Connects, and finds the arm in the inventory. Returns why it cannot; empty if it can.
    std::string open()
    {
        std::string inventory;
        if (auto why = socket.open (wanted.host, wanted.port, "/", until_connected, &inventory); ! why.empty()) return why;
        if (auto problem = takeInventory (inventory); ! problem.empty()) return problem;
        socket.post ([this] {
            socket.listen ([this] (const std::string& message) { return hear (message); });
            sendNext();
        });
        return {};
    }

    /// Waits for a state. TACTUS_DEVICE_…; `why` if the device is gone.
    int32_t next (Clock::time_point until, State& state, std::string& why)
    {
        for (;;)
        {
            {
                const std::lock_guard lock (mutex);
                if (! states.empty())
                {
                    state = states.front();
                    states.pop_front();
                    return TACTUS_DEVICE_OK;
                }
                if (in_flight && Clock::now() - sent > until_gone) socket.lose ("the service has not answered for 100 ms");
            }
            if (why = socket.trouble(); ! why.empty()) return TACTUS_DEVICE_GONE;
            if (Clock::now() >= until) return TACTUS_DEVICE_NONE;
            socket.run (std::min (until, Clock::now() + 2ms));
        }
    }

    /// Passes on a force as soon as nothing is in flight. Returns why it cannot; empty if it can.
    std::string push (const Vector& newtons)
    {
        if (auto trouble = socket.trouble(); ! trouble.empty()) return trouble;
        {
            const std::lock_guard lock (mutex);
            if (in_flight && Clock::now() - sent > until_late) return "the service has not answered for 20 ms";
            force = newtons;
            is_new = true;
        }
        socket.post ([this] { sendNext(); });
        return {};
    }

    /// Sends a force of 0 and waits until it is answered. If that takes too long, closes the connection: the arm idles when nothing comes.
    void rest()
    {
        static_cast<void> (push ({}));   // if it cannot, the connection is closed below
        const auto end = Clock::now() + until_rested;
        const auto isAtRest = [&] {
            const std::lock_guard lock (mutex);
            return ! socket.trouble().empty() || (! is_new && ! in_flight && force == Vector {});
        };
        while (! isAtRest() && Clock::now() < end)
            socket.run (std::min (end, Clock::now() + 1ms));
        if (isAtRest()) return;
        socket.lose ("the service did not answer in time, so the connection was closed");
        socket.runAll();
    }

    /// True if the arm has stayed idle although it was pushed.
    bool isNotDriven (bool is_idle)
    {
        const std::lock_guard lock (mutex);
        const auto now = Clock::now();
        if (! is_idle || force == Vector {}) idle_since = now;
        return now - idle_since > until_driven;
    }

private:
    const Json* armIn (const Json& message) const
    {
        const auto* arms = member (&message, "inverse3");
        if (arms == nullptr || ! arms->is_array()) return nullptr;
        for (const auto& arm : *arms)
            if (text (arm, "device_id") == id) return &arm;
        return nullptr;
    }

    std::string takeInventory (const std::string& message)
    {
        const auto all = tactus::readJson (message).root;
        const auto* arms = member (&all, "inverse3");
        if (arms == nullptr || ! arms->is_array() || arms->size() == 0) return "the service knows no Inverse3";
        id = wanted.device_id;
        if (id.empty())
        {
            if (arms->size() > 1) return "the service knows several Inverse3: choose one with \"device_id\"";
            id = text ((*arms)[0], "device_id");
        }
        const auto* arm = armIn (all);
        if (arm == nullptr) return "the service knows no Inverse3 with the id " + id;
        for (const char c : id)
            if (! std::isalnum (static_cast<unsigned char> (c)) && c != '-' && c != '_') return "the id of the Inverse3 has characters that no id has";
        const auto* calibrated = member (member (arm, "status"), "calibrated");
        if (calibrated != nullptr && *calibrated == Json (false)) return "the Inverse3 is not calibrated";
        return take (all);
    }

    /// Keeps the state in a message. Returns what is wrong with it; empty: nothing.
    std::string take (const Json& message)
    {
        const auto* arm = armIn (message);
        if (arm == nullptr) return "the service no longer knows the Inverse3 " + id;
        State state;
        const auto* of_arm = member (arm, "state");
        const auto position = vectorAt (member (of_arm, "cursor_position"));
        if (! position) return "the service does not say where the cursor is";
        state.position = *position;
        state.is_idle = of_arm != nullptr && text (*of_arm, "control_mode") == "idle";
        if (! wanted.grip.empty())
        {
            const auto* grips = member (&message, wanted.grip == "wireless" ? "wireless_verse_grip" : "verse_grip");
            const auto* of_grip = grips != nullptr && grips->is_array() && grips->size() > 0 ? member (&(*grips)[0], "state") : nullptr;
            const auto rotation = rotationAt (member (of_grip, "orientation"));
            if (! rotation) return "the service does not say how the grip is held";
            state.rotation = *rotation;
            const auto* buttons = member (of_grip, "buttons");
            for (std::size_t i = 0; i < std::size (button_names); ++i)
                if (const auto* down = member (buttons, button_names[i]); down != nullptr && *down == Json (true)) state.buttons |= 1u << i;
        }
        const std::lock_guard lock (mutex);
        if (states.size() == most_waiting) states.pop_front();
        states.push_back (state);
        return {};
    }

    /// [strand]
    std::string hear (const std::string& message)
    {
        const auto read = tactus::readJson (message);
        auto why = read.messages.empty() ? take (read.root) : std::string ("the service sent something that is not JSON");
        {
            const std::lock_guard lock (mutex);
            in_flight = false;
        }
        if (why.empty()) sendNext();
        return why;
    }

    /// Sends the newest force if nothing is in flight; if there is none, asks where the arm is after a while. [strand]
    void sendNext()
    {
        {
            const std::lock_guard lock (mutex);
            if (in_flight || is_writing || ! socket.trouble().empty()) return;
            if (! is_new) return askLater();
        }
        send (true);
    }

    /// [strand]
    void askLater()
    {
        pause.expires_after (until_probe);
        pause.async_wait ([this] (boost::system::error_code cancelled) {
            if (cancelled) return;
            {
                const std::lock_guard lock (mutex);
                if (in_flight || is_writing || is_new || ! socket.trouble().empty()) return;
            }
            send (false);
        });
    }

    /// [strand]
    void send (bool pushes)
    {
        pause.cancel();
        std::string message;
        {
            const std::lock_guard lock (mutex);
            std::array<char, 200> command {};
            if (pushes)
                std::snprintf (command.data(), command.size(), R"("set_cursor_force":{"%s":{"x":%.15g,"y":%.15g,"z":%.15g}})", wanted.spelling.c_str(),
                               force[0], force[1], force[2]);
            else
                std::snprintf (command.data(), command.size(), R"("probe_position":{})");
            message = R"({"inverse3":[{"device_id":")" + id + R"(","commands":{)" + command.data() + "}}]}";
            in_flight = is_writing = true;
            is_new = false;
            sent = Clock::now();
        }
        socket.say (std::move (message), [this] {
            {
                const std::lock_guard lock (mutex);
                is_writing = false;
            }
            sendNext();   // the answer may have come before
        });
    }

    const Wanted wanted;
    std::string id;   // of the arm

    std::mutex mutex;   // protects what follows; never held while waiting
    std::deque<State> states;
    Vector force {};
    bool is_new = false;                          // `force` has not been sent
    bool in_flight = false, is_writing = false;   // a message waits for its answer; is on its way out
    Clock::time_point sent, idle_since = Clock::now();

    tactus::host::WebSocket socket;   // what it calls uses the other members
    boost::asio::steady_timer pause { socket.executor() };
};

//==============================================================================
// The functions of the driver. No exception may leave them.

template <typename F>
int32_t guarded (const tactus_plugin_report* report, F&& f) noexcept
{
    try
    {
        return f();
    }
    catch (const std::exception& e)
    {
        return fail (report, e.what());
    }
}

int32_t checkHaply (const tactus_device_description* given, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        Wanted wanted;
        const auto wrong = read (*given, wanted);
        return wrong ? fail (report, *wrong) : TACTUS_DEVICE_OK;
    });
}

void* openHaply (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report) noexcept
{
    Inverse3* opened = nullptr;
    guarded (report, [&] {
        Wanted wanted;
        if (const auto wrong = read (*given, wanted)) return fail (report, *wrong);
        const bool has_grip = ! wanted.grip.empty();
        auto arm = std::make_unique<Inverse3> (wanted);
        if (const auto why = arm->open(); ! why.empty()) return fail (report, why);
        about->tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE | (has_grip ? TACTUS_DEVICE_ROTATION : 0);
        about->about = "An Inverse3 of Haply, through its service.";
        if (has_grip)
        {
            about->buttons = button_names;
            about->button_count = std::size (button_names);
        }
        // Guesses, as for the Tactus board: weak, until somebody has measured it.
        about->guard = R"({"max_force": "2 N", "max_slew": "500 N/s", "max_speed": "2 m/s", "max_impulse": "15 N*s", "impulse_window": "10 s",
            "max_energy": "200 mJ", "energy_window": "1 s", "watchdog": "20 ms"})";
        about->device_watchdog_s = 0.05;   // a command lasts for one tick of the service
        opened = arm.release();
        return int32_t { TACTUS_DEVICE_OK };
    });
    return opened;
}

int32_t readHaply (void* device, int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        auto& arm = *static_cast<Inverse3*> (device);
        State state;
        std::string why;
        const auto got = arm.next (Clock::now() + std::chrono::milliseconds (timeout_ms), state, why);
        if (got == TACTUS_DEVICE_GONE) fail (report, why);
        if (got != TACTUS_DEVICE_OK) return got;
        std::ranges::copy (state.position, to->position);
        std::ranges::copy (state.rotation, to->rotation);
        to->buttons = state.buttons;
        to->valid = 1;
        if (arm.isNotDriven (state.is_idle)) stamp->fault = TACTUS_DEVICE_NOT_DRIVEN;
        return got;
    });
}

int32_t writeHaply (void* device, const tactus_effort* effort, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        const auto why = static_cast<Inverse3*> (device)->push ({ effort->force[0], effort->force[1], effort->force[2] });
        return why.empty() ? TACTUS_DEVICE_OK : fail (report, why);
    });
}

int32_t restHaply (void* device, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        static_cast<Inverse3*> (device)->rest();
        return int32_t { TACTUS_DEVICE_OK };
    });
}

void closeHaply (void* device) noexcept { delete static_cast<Inverse3*> (device); }

constexpr const char* keys[] { "port", "device_id", "grip", "spelling" };
}   // namespace

extern "C" const tactus_device_driver tactus_device_entry {
    sizeof (tactus_device_driver), TACTUS_DEVICE_ABI, "haply", "1.0.0", "Haply Inverse3 and VerseGrip, through the service of their maker.",
    keys, std::size (keys), checkHaply, openHaply, readHaply,
    writeHaply, restHaply, closeHaply
};
