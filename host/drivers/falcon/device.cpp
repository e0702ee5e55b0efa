// SPDX-License-Identifier: MIT
// A device driver for the Novint Falcon on a serial port or by libftdi, without any software of its maker. Written from a public description of the
// protocol; no Falcon has been tried. See docs/known_devices.md.
#include "device.hpp"
#include "kinematics.hpp"
#include "serial_port.hpp"

#include <host/devices/hid/slow_adapter.hpp>
#include <host/drivers/driver_table.hpp>
#include <host/drivers/guessed_limits.hpp>
#include <host/drivers/read_keys.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <string>
#include <utility>

namespace tactus::host::falcon
{

namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto until_asked = 2ms;   // after an answer without a new force
constexpr auto until_late = 20ms;   // without an answer: a packet was lost
constexpr auto longest_patience = 160ms, prompt = 5ms;
constexpr double motor_per_torque = -10'000.0, most_motor = 4096.0;
constexpr double middle = 0.150;   // in front of the base, in m

/// A Falcon. It answers each packet with a packet, and sends none by itself. At most one packet is on its way, besides those that bring it
/// to rest.
/// `times`: the factor of all times until a Falcon that does not answer counts as gone, for tests on busy computers.
template <int times>
class Falcon
{
    static constexpr auto until_gone = times * 500ms;            // without an answer
    static constexpr auto longest_wait = times * 160ms;          // of a force until it is sent
    static constexpr auto longest_kept = times * 100ms;          // of a force without a newer one: the program was frozen, or its writing thread is
    static constexpr int most_questions = times > 1 ? 40 : 10;   // at opening

public:
    struct Wanted
    {
        std::string port, firmware;
        std::optional<unsigned> usb {};   // the number of a Falcon without a serial port
    };

    static std::string parse (const tactus_device_description& given, Wanted& wanted)
    {
        if (auto wrong = readKeys (given, wanted.port, [&] (ObjectReader& in) { wanted.firmware = in.text ("firmware"); }); ! wrong.empty()) return wrong;
        unsigned number = 0;
        const auto* end = wanted.port.data() + wanted.port.size();
        const bool has_number = wanted.port.starts_with ("usb:") && wanted.port.size() > 4 && std::from_chars (wanted.port.data() + 4, end, number).ptr == end;
        if (has_number || wanted.port == "usb") wanted.usb = number;
        if (wanted.usb || wanted.port.empty() || wanted.port.starts_with ('/')) return {};
        return "name the port: falcon:/dev/ttyUSB0, or falcon:usb or falcon:usb:1 for one without a serial port";
    }

    static std::unique_ptr<Falcon> open (const Wanted& wanted, tactus_device_about& about, std::string& said)
    {
        auto device = std::make_unique<Falcon>();
        const auto port = wanted.port.empty() ? SerialPort::ofFalcon() : wanted.port;
        const bool is_usb = wanted.usb || port.empty();
        said = is_usb ? device->line.openUsb (wanted.usb.value_or (0)) : device->line.open (port);
        if (said.empty()) said = device->start (wanted.firmware);
        if (! said.empty()) return nullptr;
        if (auto slow = is_usb ? std::string() : hid::slowAdapter (port); ! slow.empty()) said = "forces are slow, and stiff walls buzz: " + slow;
        device->describe (about);
        return device;
    }

    std::int32_t read (std::int32_t timeout_ms, tactus_reading& to, tactus_device_stamp& stamp, std::string& why)
    {
        const auto until = Clock::now() + std::chrono::milliseconds (timeout_ms);
        for (;;)
        {
            if (const auto report = line.next())
            {
                take (*report, to, stamp);
                return TACTUS_DEVICE_OK;
            }
            const auto now = Clock::now();
            Clock::time_point wake;
            {
                std::unique_lock lock (mutex);
                if (line.isGone() || (silent_since && now - *silent_since > until_gone))
                {
                    why = line.isGone() ? "it was unplugged" : "it does not answer";
                    return TACTUS_DEVICE_GONE;
                }
                if (in_flight && now >= sent + patience)   // bytes were lost, or it is slow: then packets must not queue up
                {
                    in_flight = was_prompt = false;
                    is_doubtful = true;
                    patience = std::min<Clock::duration> (2 * patience, longest_patience);
                }
                if (now >= until) return TACTUS_DEVICE_NONE;
                if (is_doubtful && now >= answered + prompt && was_prompt) is_doubtful = false;
                if (in_flight)
                    wake = std::min (until, sent + patience);
                else if (is_doubtful && now < answered + prompt)
                    wake = std::min (until, answered + prompt);
                else
                {
                    changed.wait_until (lock, std::min (until, std::max (answered, sent) + until_asked), [this] { return is_new; });
                    if (! in_flight) send();   // rest() has not sent one meanwhile
                    wake = in_flight ? std::min (until, sent + patience) : now + 1ms;
                }
            }
            line.await (wake - Clock::now());
        }
    }

    std::int32_t write (const tactus_effort& effort, std::string& why)
    {
        const std::lock_guard lock (mutex);
        force = Vec3 (effort.force[0], effort.force[2], -effort.force[1]);   // x right, y up and z towards the person are the axes of the Falcon
        given = Clock::now();
        if (pushes && force.isZero (0.0) && in_flight && given - sent > prompt) return putRest (why);   // a stop waits for no answer
        if (! std::exchange (is_new, true)) waits_since = given;
        changed.notify_one();
        if (given - waits_since <= longest_wait) return TACTUS_DEVICE_OK;
        why = "the last force has not been sent for 160 ms, because the Falcon has not answered";
        return TACTUS_DEVICE_FAILED;
    }

    std::int32_t rest (std::string& why)
    {
        const std::lock_guard lock (mutex);
        return putRest (why);
    }

private:
    bool answers()   // to packets without a force
    {
        bool does = false;
        for (int tries = 0; tries < most_questions && ! does; ++tries)
        {
            line.send (at_rest);
            for (const auto end = Clock::now() + 50ms; Clock::now() < end && ! does; does = line.next().has_value())
                line.await (5ms);
        }
        bool is_late = does;   // an answer to an earlier packet
        for (int answers = 0; answers < most_questions && is_late; ++answers, is_late = line.next().has_value())
            line.await (prompt);
        return does;
    }

    /// Makes sure that the firmware runs, which the Falcon forgets without power.
    std::string start (const std::string& firmware)
    {
        line.goNormal();
        if (answers()) return {};
        if (firmware.empty())
            return "it does not answer: its firmware does not run, or this is not a Falcon. Give the file that has its firmware with the key \"firmware\"";
        std::string why;
        for (int tries = 0; tries < 3; ++tries)   // users report that the first try often fails
        {
            why = line.load (firmware);
            line.goNormal();
            if (why.empty() && answers()) break;
            if (why.empty()) why = "the firmware is loaded, but does not answer";
        }
        return why;
    }

    void describe (tactus_device_about& about)
    {
        about.tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE;
        about.about = "A Novint Falcon.";
        static constexpr const char* buttons[] { "plus", "forward", "center", "minus" };
        static constexpr const char* axes[] { "saturated" };
        about.axes = axes;
        about.axis_count = std::size (axes);
        about.buttons = buttons;
        about.button_count = std::size (buttons);
        static const auto limits = guessedLimits (8.0, 40.0).dump();   // 8 N is what CHAI3D allows
        about.guard = limits.c_str();
        about.rest_file = line.path().c_str();
        static const tactus_device_bytes last { sizeof last, at_rest.data(), at_rest.size() };
        static const tactus_device_bytes* const lasts[] { &last, &last };   // the first one may meet half a packet
        about.rest_reports = lasts;
        about.rest_report_count = std::size (lasts);
    }

    void take (const Report& report, tactus_reading& to, tactus_device_stamp& stamp)
    {
        const bool knows = (report.bits & homed) == homed;
        const auto place = knows ? legs.placeOf (Kinematics::anglesOf (report.counts)) : std::nullopt;
        if (place) Vec3::Map (to.position) = Vec3 (place->x(), middle - place->z(), place->y());
        to.axes[0] = is_saturated ? 1.0 : 0.0;
        to.axis_count = 1;
        to.buttons = report.bits & 0xfu;
        to.valid = 1;
        stamp.fault = ! knows ? TACTUS_DEVICE_NOT_HOMED : ! place ? TACTUS_DEVICE_BROKEN
                                                                  : 0;
        has_place = place.has_value();

        const std::lock_guard lock (mutex);
        answered = Clock::now();
        was_prompt = answered - sent < prompt;
        if (was_prompt) patience = until_late;
        in_flight = false;
        silent_since.reset();
    }

    /// [with the mutex held]
    std::int32_t putRest (std::string& why)
    {
        force.setZero();
        is_new = false;
        why = put (at_rest);
        if (! why.empty()) return TACTUS_DEVICE_FAILED;
        pushes = false;
        return TACTUS_DEVICE_OK;
    }

    /// Sends the newest force, turned into torques at the newest place. A force without a place, or too old a force, is given up, because it would come back
    /// as a step. [reading thread, with the mutex held]
    void send()
    {
        if (! line.isFree()) return;   // the last packet is not out yet; the next call tries again
        if (! has_place || Clock::now() - given > longest_kept) force.setZero();
        const Vec3 values = motor_per_torque * legs.torquesOf (force);
        const double largest = values.cwiseAbs().maxCoeff();
        is_saturated = largest > most_motor;
        std::array<int, 3> motors {};
        for (int i = 0; i < 3; ++i)   // together, so that the direction stays
            motors[static_cast<std::size_t> (i)] = static_cast<int> (std::lround (values[i] * (is_saturated ? most_motor / largest : 1.0)));
        const bool is_push = motors != std::array<int, 3> {};
        pushes = pushes || is_push;   // a packet that could not be sent may have gone out in part
        if (! put (packetOf (motors, homing | (has_place ? green : red))).empty()) return;
        is_new = false;
        pushes = is_push;
    }

    /// [with the mutex held]
    std::string put (const Packet& packet)
    {
        auto why = line.send (packet);
        if (! why.empty()) return why;
        is_doubtful = is_doubtful || in_flight;
        in_flight = true;
        sent = Clock::now();
        if (! silent_since) silent_since = sent;
        return {};
    }

    SerialPort line;

    // [reading thread]
    Kinematics legs;
    bool has_place = false, is_saturated = false;

    std::mutex mutex;   // of what follows; never held while waiting
    std::condition_variable changed;
    Vec3 force = Vec3::Zero();
    bool is_new = false;
    bool pushes = false;                    // the last packet had a force
    Clock::time_point given, waits_since;   // times of the newest force, and of the first one that was not sent
    Clock::time_point sent, answered;       // times of the last packet in each direction
    bool in_flight = false;                 // the last packet has not been answered
    bool is_doubtful = false;               // more packets may be on the way: nothing is sent until answers are prompt and no further one comes
    bool was_prompt = false;                // the last answer
    Clock::duration patience = until_late;
    std::optional<Clock::time_point> silent_since;   // since then, no packet has been answered
};

constexpr const char* keys[] { "port", "firmware" };

template <int times>
constexpr auto table = driverTable<Falcon<times>> ("falcon", "The Novint Falcon on a serial port, or by libftdi.", keys);
}   // namespace

const tactus_device_driver driver = table<1>, patient_driver = table<300>;

}   // namespace tactus::host::falcon
