// SPDX-License-Identifier: MIT
// A device driver for the Novint Falcon on a serial port or by libftdi, without any software of its maker. Written from a public description of the
// protocol; no Falcon has been tried. See docs/known_devices.md.
#include "device.hpp"
#include "kinematics.hpp"
#include "serial_port.hpp"

#include <host/devices/hid/usb_adapter.hpp>
#include <host/drivers/driver_table.hpp>
#include <host/drivers/guessed_limits.hpp>
#include <host/drivers/read_keys.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

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

/// A Falcon. It answers each packet with a packet, and sends none by itself. At most one is on its way, besides those that bring it to rest.
/// `times`: the factor of all times until a Falcon that does not answer counts as gone, for tests on busy computers.
template <int times>
class Falcon
{
    static constexpr auto until_gone = times * 500ms;            // without an answer
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
        if (wanted.port == "usb" || (wanted.port.starts_with ("usb:") && readNumber (wanted.port.substr (4), 127U, number))) wanted.usb = number;
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
        for (auto wake = Clock::now();;)
        {
            if (const auto report = line.next (wake)) return take (*report, to, stamp);
            const auto now = Clock::now();
            std::unique_lock lock (mutex);
            if (line.isGone()) return because (why, "it was unplugged");
            if (silent_since && now - *silent_since > until_gone) return because (why, "it does not answer");
            if (in_flight && now >= sent + patience)   // bytes were lost, or it is slow: then packets must not queue up
            {
                in_flight = was_prompt = false;
                is_doubtful = true;
                patience = std::min<Clock::duration> (2 * patience, longest_patience);
            }
            if (now >= until) return TACTUS_DEVICE_NONE;
            const bool is_quiet = now >= answered + prompt, may_send = ! in_flight && (is_quiet || ! is_doubtful);
            if (is_quiet && was_prompt) is_doubtful = false;
            if (may_send) changed.wait_until (lock, std::min (until, std::max (answered, sent) + until_asked), [this] { return is_new; });
            if (may_send && ! in_flight) send();   // rest() has not sent one meanwhile
            wake = std::min (until, in_flight ? sent + patience : may_send ? now + 1ms
                                                                           : answered + prompt);
        }
    }

    std::int32_t write (const tactus_effort& effort, std::string& why)
    {
        std::unique_lock lock (mutex);
        force = Vec3 (effort.force[0], effort.force[2], -effort.force[1]);   // x right, y up and z towards the person are the axes of the Falcon
        given = Clock::now();
        is_new = true;
        changed.notify_one();
        if (! pushes || ! in_flight || given - sent <= prompt || ! force.isZero (0.0)) return TACTUS_DEVICE_OK;
        lock.unlock();
        return rest (why);   // a stop waits for no answer
    }

    std::int32_t rest (std::string& why)
    {
        const std::lock_guard lock (mutex);
        force.setZero();
        is_new = false;
        why = put (at_rest);
        pushes = pushes && ! why.empty();
        return why.empty() ? TACTUS_DEVICE_OK : TACTUS_DEVICE_FAILED;
    }

private:
    bool answers()   // to packets without a force
    {
        bool does = false;
        for (int tries = 0; tries < most_questions && ! does; ++tries)
        {
            line.send (at_rest);
            does = line.next (Clock::now() + 50ms).has_value();
        }
        for (int late = 0; does && late < most_questions && line.next (Clock::now() + prompt); ++late)   // answers to earlier packets
        {
        }
        return does;
    }

    /// Makes sure that the firmware runs, which the Falcon forgets without power.
    std::string start (const std::string& firmware)
    {
        line.goNormal();
        std::string why;
        if (! answers())
            why = "it does not answer: its firmware does not run, or this is not a Falcon. Give the file that has its firmware with the key \"firmware\"";
        for (int tries = 0; ! why.empty() && ! firmware.empty() && tries < 3; ++tries)   // users report that the first try often fails
        {
            why = line.load (firmware);
            line.goNormal();
            if (why.empty() && ! answers()) why = "the firmware is loaded, but does not answer";
        }
        return why;
    }

    void describe (tactus_device_about& about)
    {
        about.tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE;
        about.about = "A Novint Falcon.";
        static constexpr const char* buttons[] { "plus", "forward", "center", "minus" };
        static constexpr const char* axes[] { "saturated" };
        nameParts (about, axes, buttons);
        static const auto limits = guessedLimits (8.0, 40.0).dump();   // 8 N is what CHAI3D allows
        about.guard = limits.c_str();
        about.rest_file = line.path().c_str();
        static const tactus_device_bytes last { sizeof last, at_rest.data(), at_rest.size() };
        static const tactus_device_bytes* const lasts[] { &last, &last };   // the first one may meet half a packet
        about.rest_reports = lasts;
        about.rest_report_count = std::size (lasts);
    }

    std::int32_t take (const Report& report, tactus_reading& to, tactus_device_stamp& stamp)
    {
        const bool knows = (report.bits & homed) == homed;
        const auto place = knows ? legs.placeOf (Kinematics::anglesOf (report.counts)) : std::nullopt;
        if (place) Vec3::Map (to.position) = Vec3 (place->x(), middle - place->z(), place->y());
        to.axes[to.axis_count++] = is_saturated ? 1.0 : 0.0;
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
        return TACTUS_DEVICE_OK;
    }

    /// Sends the newest force, turned into torques at the newest place. A force without a place, or too old a force, is given up, because it would come back
    /// as a step. [reading thread, with the mutex held]
    void send()
    {
        if (! line.isFree()) return;   // the last packet is not out yet; the next call tries again
        if (! has_place || Clock::now() - given > longest_kept) force.setZero();
        const Vec3 values = motor_per_torque * legs.torquesOf (force);
        const double share = std::min (1.0, most_motor / values.cwiseAbs().maxCoeff());   // of all, so that the direction stays
        is_saturated = share < 1.0;
        std::array<int, 3> motors {};
        Eigen::Vector3i::Map (motors.data()) = (share * values).array().round().cast<int>();
        const bool is_push = motors != std::array<int, 3> {};
        pushes = pushes || is_push;   // a packet that could not be sent may have gone out in part
        if (! put (packetOf (motors, homing | (has_place ? green : red))).empty()) return;
        is_new = false;
        pushes = is_push;
    }

    /// [with the mutex held]
    std::string put (const Packet& packet)
    {
        if (auto why = line.send (packet); ! why.empty()) return why;
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
    bool is_new = false, pushes = false;       // it has not been sent; the last packet had one
    Clock::time_point given, sent, answered;   // times of the newest force, and of the last packet in each direction
    bool in_flight = false;                    // the last packet has not been answered
    bool is_doubtful = false;                  // more packets may be on the way: nothing is sent until answers are prompt and no further one comes
    bool was_prompt = false;                   // the last answer
    Clock::duration patience = until_late;
    std::optional<Clock::time_point> silent_since;   // since then, no packet has been answered
};

constexpr const char* keys[] { "port", "firmware" };

template <int times>
constexpr auto table = driverTable<Falcon<times>> ("falcon", "The Novint Falcon on a serial port, or by libftdi.", keys);
}   // namespace

const tactus_device_driver driver = table<1>, patient_driver = table<300>;

}   // namespace tactus::host::falcon
