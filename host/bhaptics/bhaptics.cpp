// SPDX-License-Identifier: MIT
// A device driver for vests that are driven through bHaptics Player (version 2): WebSocket and JSON. Written from the public description of the messages; no
// vest and no Player has been tried. See docs/devices.md.
#include "dots.hpp"
#include "vest_map.hpp"

#include <tactus/tactus_device.h>

#include <host/websocket/web_socket.hpp>
#include <tactus/text/json_text.hpp>

#include <boost/asio/steady_timer.hpp>

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace
{
using tactus::Json;
using tactus::Vec3;
using tactus::host::Dots;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto between_asks = 20ms;   // while no message is due
constexpr auto until_late = 100ms;    // without an answer: efforts are refused
constexpr auto until_gone = 500ms;    // the Player is not there any more
constexpr auto until_rested = 15ms;   // `rest` may take 20 ms
constexpr auto until_connected = 2s;
constexpr auto path = "/v2/feedbacks?app_id=tactus&app_name=Tactus";
constexpr double lowest_rate = 10.0, usual_rate = 50.0, highest_rate = 1000.0;   // messages per second; each lasts for 100 ms

int32_t fail (const tactus_plugin_report* report, const std::string& why)
{
    report->put (report->context, why.data(), why.size());
    return TACTUS_DEVICE_FAILED;
}

/// What the person asks for.
struct Wanted
{
    std::string host, port;
    std::optional<Dots> dots;
    Clock::duration period {};   // of messages
};

std::optional<std::string> read (const tactus_device_description& given, Wanted& wanted)
{
    const auto json = tactus::readJson (given.json != nullptr && given.json[0] != 0 ? given.json : "{}").root;
    std::string address = given.port[0] != 0 ? given.port : "localhost:15881";
    if (address.find (':') == address.npos) address = "localhost:" + address;
    wanted.host = address.substr (0, address.rfind (':'));
    wanted.port = address.substr (address.rfind (':') + 1);
    if (wanted.host.empty() || wanted.port.empty() || wanted.port.find_first_not_of ("0123456789") != wanted.port.npos)
        return "\"port\" is written as 15881 or localhost:15881";
    auto dots = Dots::read (tactus::readJson (vest_map).root, json);
    if (! dots) return dots.error().text;
    wanted.dots = std::move (*dots);
    double rate = usual_rate;
    if (json.is_object() && json.contains ("rate"))
    {
        const auto& asked = *json.find ("rate");
        if (! asked.is_number() || ! (asked.get<double>() >= lowest_rate && asked.get<double>() <= highest_rate))
            return "\"rate\" is the most messages per second, 10 to 1000";
        rate = asked.get<double>();
    }
    wanted.period = std::chrono::duration_cast<Clock::duration> (std::chrono::duration<double> (1.0 / rate));
    return std::nullopt;
}

/// True if a vest is among the devices that the Player says it has, or if it does not say.
bool hasVest (const Json& status)
{
    const auto at = status.is_object() ? status.find ("ConnectedPositions") : status.end();
    if (! status.is_object() || at == status.end() || ! at->is_array()) return true;
    return std::ranges::any_of (*at, [] (const Json& position) { return position.is_string() && position.asString().starts_with ("Vest"); });
}

/// The connection to the Player. A message is followed by a ping, and the next one waits for its answer: so at most one is on its way, and it is the newest.
class Vest
{
public:
    explicit Vest (Wanted w) : wanted (std::move (w)) {}
    ~Vest() { socket.close(); }

    /// Returns why it cannot be opened; empty if it can.
    std::string open()
    {
        if (auto why = socket.open (wanted.host, wanted.port, path, until_connected, nullptr); ! why.empty()) return why;
        socket.post ([this] {
            socket.listen ([this] (const std::string& message) { return hear (message); }, [this] { hearAnswer(); });
            sendNext();
        });
        return {};
    }

    std::size_t channels() const { return wanted.dots->channels(); }

    /// Waits for an answer of the Player. TACTUS_DEVICE_…; `why` if it is gone.
    int32_t next (Clock::time_point until, bool& has_vest, std::string& why)
    {
        for (;;)
        {
            {
                const std::lock_guard lock (mutex);
                has_vest = is_worn;
                if (answers > 0)
                {
                    --answers;
                    return TACTUS_DEVICE_OK;
                }
                if (is_asking && Clock::now() - sent > until_gone) socket.lose ("the Player has not answered for 500 ms");
            }
            if (why = socket.trouble(); ! why.empty()) return TACTUS_DEVICE_GONE;
            if (Clock::now() >= until) return TACTUS_DEVICE_NONE;
            socket.run (std::min (until, Clock::now() + 2ms));
        }
    }

    /// Takes the values of a tick. Returns why they cannot be shown; empty if they can.
    std::string take (std::span<const double> signals, const Vec3& force)
    {
        if (auto trouble = socket.trouble(); ! trouble.empty()) return trouble;
        {
            const std::lock_guard lock (mutex);
            if (is_asking && Clock::now() - sent > until_late) return "the Player has not answered for 100 ms";
            wanted.dots->take (signals, force);
            is_new = true;
        }
        socket.post ([this] { sendNext(); });
        return {};
    }

    /// Silences the vest, and waits until the Player has taken that. If this takes too long, closes the connection: the last message ends by itself.
    void rest()
    {
        {
            const std::lock_guard lock (mutex);
            has_to_rest = true;
        }
        socket.post ([this] { sendNext(); });
        const auto end = Clock::now() + until_rested;
        const auto isAtRest = [&] {
            const std::lock_guard lock (mutex);
            return ! socket.trouble().empty() || (! has_to_rest && ! is_asking);
        };
        while (! isAtRest() && Clock::now() < end)
            socket.run (std::min (end, Clock::now() + 1ms));
        if (isAtRest()) return;
        socket.lose ("the Player did not answer in time, so the connection was closed");
        socket.runAll();
    }

private:
    /// [strand]
    std::string hear (const std::string& message)
    {
        const auto read = tactus::readJson (message);
        if (! read.messages.empty()) return "the Player sent something that is not JSON";
        const std::lock_guard lock (mutex);
        is_worn = hasVest (read.root);
        return {};
    }

    /// Sends the newest values as soon as the last message has been answered and its period is over. Meanwhile, asks whether the Player is there.
    /// [strand]
    void sendNext()
    {
        std::string message;
        {
            const std::lock_guard lock (mutex);
            if (is_asking || ! socket.trouble().empty()) return;
            const auto now = Clock::now();
            const auto due = std::min (sent + between_asks, is_new ? shown + wanted.period : Clock::time_point::max());
            if (! has_to_rest && now < due) return later (due);
            if (has_to_rest || (is_new && now >= shown + wanted.period))
            {
                message = has_to_rest ? wanted.dots->silence() : wanted.dots->message();
                is_new = has_to_rest = false;
                shown = now;
            }
            is_asking = true;
            sent = now;
        }
        if (message.empty()) return ask();
        socket.say (std::move (message), [this] { ask(); });
    }

    /// [strand]
    void ask()
    {
        if (socket.trouble().empty()) socket.ping();
    }

    /// [strand]
    void hearAnswer()
    {
        {
            const std::lock_guard lock (mutex);
            is_asking = false;
            answers = std::min (answers + 1, 64);
        }
        sendNext();
    }

    /// [strand]
    void later (Clock::time_point due)
    {
        pause.expires_at (due);
        pause.async_wait ([this] (boost::system::error_code cancelled) {
            if (! cancelled) sendNext();
        });
    }

    std::mutex mutex;   // protects what follows, but the socket; never held while waiting
    Wanted wanted;
    int answers = 0;   // that nobody has read
    bool is_new = false, has_to_rest = false;
    bool is_asking = false;   // a message or a ping is on its way
    bool is_worn = true;      // as far as the Player says
    Clock::time_point sent, shown;

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

int32_t checkVest (const tactus_device_description* given, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        Wanted wanted;
        const auto wrong = read (*given, wanted);
        return wrong ? fail (report, *wrong) : TACTUS_DEVICE_OK;
    });
}

void* openVest (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report) noexcept
{
    Vest* opened = nullptr;
    guarded (report, [&] {
        Wanted wanted;
        if (const auto wrong = read (*given, wanted)) return fail (report, *wrong);
        auto vest = std::make_unique<Vest> (std::move (wanted));
        if (const auto why = vest->open(); ! why.empty()) return fail (report, why);
        about->tool = TACTUS_DEVICE_FORCE;
        about->signal_outputs = static_cast<int32_t> (vest->channels());
        about->about = "A vest of bHaptics, through bHaptics Player.";
        // Vibrations: 1 is the full intensity, and the force is one only by name.
        about->guard = R"({"max_signal": 1, "max_force": "100 N", "watchdog": "100 ms"})";
        about->device_watchdog_s = 1e-3 * Dots::duration_ms;
        opened = vest.release();
        return int32_t { TACTUS_DEVICE_OK };
    });
    return opened;
}

int32_t readVest (void* device, int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        bool has_vest = true;
        std::string why;
        const auto got = static_cast<Vest*> (device)->next (Clock::now() + std::chrono::milliseconds (timeout_ms), has_vest, why);
        if (got == TACTUS_DEVICE_GONE) fail (report, why);
        if (got != TACTUS_DEVICE_OK) return got;
        to->valid = 1;
        if (! has_vest) stamp->fault = TACTUS_DEVICE_NOT_DRIVEN;
        return got;
    });
}

int32_t writeVest (void* device, const tactus_effort* effort, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        const auto signals = std::span (effort->signals).first (std::min<std::size_t> (effort->signal_count, std::size (effort->signals)));
        const auto why = static_cast<Vest*> (device)->take (signals, Vec3 { effort->force[0], effort->force[1], effort->force[2] });
        return why.empty() ? TACTUS_DEVICE_OK : fail (report, why);
    });
}

int32_t restVest (void* device, const tactus_plugin_report* report) noexcept
{
    return guarded (report, [&] {
        static_cast<Vest*> (device)->rest();
        return int32_t { TACTUS_DEVICE_OK };
    });
}

void closeVest (void* device) noexcept { delete static_cast<Vest*> (device); }

constexpr const char* keys[] { "port", "channels", "full_force", "rate" };
}   // namespace

extern "C" const tactus_device_driver tactus_device_entry {
    sizeof (tactus_device_driver), TACTUS_DEVICE_ABI, "bhaptics", "1.0.0", "Vests of bHaptics, through bHaptics Player.",
    keys, std::size (keys), checkVest, openVest, readVest,
    writeVest, restVest, closeVest
};
