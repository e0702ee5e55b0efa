// SPDX-License-Identifier: MIT
// A device driver for the arms of Force Dimension, through their maker's library. Written from a public description of its functions; no arm has been
// tried. See docs/known_devices.md.
#include "arm.hpp"
#include "dhd_library.hpp"

#include <host/drivers/driver_table.hpp>
#include <host/drivers/guessed_limits.hpp>
#include <host/drivers/read_keys.hpp>
#include <host/drivers/rotation_of.hpp>
#include <tactus/run/realtime.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <climits>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace tactus::host::forcedimension
{

namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
constexpr auto between_looks = 20ms;   // at the status
constexpr int most_unseen = 2;
constexpr auto until_gone = 50ms;      // of failures only
constexpr auto until_closed = 100ms;   // after the stop
constexpr double watchdog_unit_s = 125e-6, first_firmware_with_watchdog = 3.0;

// Places of the status, and how many numbers it can have: more than any version of the library writes.
constexpr int powered = 0, connected = 1, in_reset = 3, with_force = 5, in_error = 9, force_off_cause = 14, most_status = 32;
constexpr int by_button = 1, by_watchdog = 3, by_unplugging = 5, by_dead_man = 6;   // why forces are off

/// A kind of arm, as the library numbers them: right-handed, left-handed, and numbers that CHAI3D meets although no header names them.
struct Model
{
    std::string_view name;
    double max_force;   // in N; what CHAI3D allows, as nothing else is known
    std::vector<int> types;
};
constexpr int falcon = 60, most_buttons = 8;
const Model models[] {
    { "falcon", 8.0, { falcon } },
    { "delta.3", 20.0, { 63, 111 } },
    { "omega.3", 12.0, { 33, 110 } },
    { "omega.6", 12.0, { 34, 36 } },
    { "omega.7", 12.0, { 35, 37 } },
    { "sigma.3", 12.0, { 206, 133 } },
    { "sigma.6", 12.0, { 115, 116 } },
    { "sigma.7", 12.0, { 104, 105, 102, 103, 209 } },
    { "lambda.3", 12.0, { 203 } },
    { "lambda.6", 12.0, { 131, 132 } },
    { "lambda.7", 12.0, { 108, 109, 112, 113, 114, 117, 118, 119, 120, 121, 122, 123, 124, 125, 126, 127, 128, 129, 130, 210, 211 } },
};

/// The device that a person asks for.
struct WantedArm
{
    std::string port;
    int index = -1, serial = -1;   // -1: not given
    const Model* model = nullptr;
    bool calibrate = false;
};

/// The number of arms that this program has open. Nothing says that the library would open such an arm only once.
std::atomic<int> open_arms = 0;

/// The ports whose arms went away while they were open. Such an arm is not calibrated by its motors when it comes back: the person did not ask for
/// that motion.
std::set<std::string>& gonePorts()
{
    static std::set<std::string> ports;   // [opening thread]
    return ports;
}

// The library's x points towards the person, its y to the right.
void turn (const double* from, double* to)
{
    to[0] = from[1];
    to[1] = -from[0];
    to[2] = from[2];
}

/// An arm. `period_us`: of readings, and of zeros while nothing is asked for: the library compensates the weight only while forces are set.
template <int period_us>
class Arm
{
    static constexpr std::chrono::microseconds period { period_us };

public:
    using Wanted = WantedArm;

    static std::string parse (const tactus_device_description& given, Wanted& wanted)
    {
        if (auto wrong = readKeys (given, wanted.port, [&] (ObjectReader& in) { wanted.calibrate = in.flag ("calibrate"); }); ! wrong.empty()) return wrong;
        const std::string_view port = wanted.port;
        if (port.empty() || readNumber (port, 127, wanted.index)) return {};
        wanted.index = -1;
        if (port.starts_with ("sn=") && readNumber (port.substr (3), 0xffff, wanted.serial)) return {};
        const auto named = std::ranges::find (models, port, &Model::name);
        if (named == std::end (models)) return "\"port\" is a number that counts the arms from 0, sn= and a serial number, or a model such as omega.3";
        wanted.model = &*named;
        return {};
    }

    static std::unique_ptr<Arm> open (const Wanted& wanted, tactus_device_about& about, std::string& said)
    {
        const auto library = DhdLibrary::load (said);
        if (library == nullptr) return nullptr;
        auto arm = std::make_unique<Arm> (library, wanted.port);
        if (! arm->connect (wanted, said)) return nullptr;
        arm->home (wanted, said);
        arm->describe (about, said);
        return arm;
    }

    /// The library tells the model and the serial number of an arm only while it is open, so each free one is opened for a moment.
    static std::string find (const Found& found)
    {
        std::string why;
        const auto library = DhdLibrary::load (why);
        if (library == nullptr) return why;
        const int count = library->dhdGetDeviceCount != nullptr ? library->dhdGetDeviceCount() : -1;
        if (count < 0) return "the library, of version " + library->version() + ", does not count its arms: " + library->lastError();
        for (int i = 0; i < count; ++i)
        {
            const auto number = std::to_string (i);
            Arm arm (library, number);
            if (const bool may_open = open_arms == 0; may_open && arm.connect ({ .port = number, .index = i }, why))
                found (arm.serial() > 0 ? "sn=" + std::to_string (arm.serial()) : number, arm.model() + ", number " + number, 0);
            else
                found (number, "An arm of Force Dimension, number " + number, may_open ? TACTUS_DEVICE_IN_USE : TACTUS_DEVICE_UNSEEN);
        }
        return {};
    }

    Arm (std::shared_ptr<const DhdLibrary> l, std::string p) : dhd (std::move (l)), port (std::move (p)) {}
    Arm (const Arm&) = delete;
    Arm& operator= (const Arm&) = delete;

    /// Ends by stop, wait, close: what closing alone does to the motors is not known.
    ~Arm()
    {
        if (! is_open) return;
        if (is_gone) gonePorts().insert (port);   // NOLINT(bugprone-exception-escape): a program without memory for this ends
        for (int tries = 0; tries < 5 && dhd->dhdStop (id) < 0; ++tries)
            std::this_thread::sleep_for (5ms);
        if (! is_gone) std::this_thread::sleep_for (until_closed);
        (is_of_drd ? dhd->drdClose : dhd->dhdClose) (id);
        --open_arms;
    }

    std::int32_t read (std::int32_t timeout_ms, tactus_reading& to, tactus_device_stamp& stamp, std::string& why)
    {
        const auto until = Clock::now() + std::chrono::milliseconds (timeout_ms);
        for (auto now = Clock::now();; now = Clock::now())
        {
            sleepUntil (due);   // the library answers at once while it has nothing new
            now = std::max (now, due);
            due = std::max (due + period, now);
            feed();
            if (now >= look_at)
            {
                look_at = now + between_looks;
                look();
                if (was_unplugged) return leave (why, "it was unplugged");
            }
            double position[3] {};
            const int got = dhd->dhdGetPosition (&position[0], &position[1], &position[2], id);
            const bool is_new = got >= 0 && got != DhdFunctions::nothing_new, is_whole = is_new && fill (to);
            if (is_whole)
            {
                failing_since.reset();
                turn (position, to.position);
                stamp.fault = fault;
                return TACTUS_DEVICE_OK;
            }
            if (got < 0 || is_new)   // a part of a reading may fail, too
            {
                if (! failing_since) failing_since = now;
                if (now - *failing_since > until_gone) return leave (why, "it does not answer: " + dhd->lastError());
            }
            if (Clock::now() >= until) return TACTUS_DEVICE_NONE;
        }
    }

    std::int32_t write (const tactus_effort& effort, std::string& why)
    {
        const auto &f = effort.force, &turning = effort.torque;
        const Push push { -f[1], f[0], f[2], -turning[1], turning[0], turning[2], grips && effort.axis_count > 0 ? hand * effort.axes[0] : 0.0 };
        const bool is_zero = push == Push {};
        if (is_zero && ! is_enabled) return TACTUS_DEVICE_OK;   // nothing is pushed, and zeros are fed anyway
        const std::lock_guard lock (sending);
        is_resting = is_zero || ! is_enabled;
        if (is_enabled && put (push) >= 0) return TACTUS_DEVICE_OK;
        return because (why, is_enabled ? dhd->lastError() : "its forces are not enabled", TACTUS_DEVICE_FAILED);
    }

    std::int32_t rest (std::string& why)
    {
        // No call has reached an arm that is gone for longer than its watchdog takes to release the motors.
        if (! drives || is_gone) return TACTUS_DEVICE_OK;
        const std::lock_guard lock (sending);
        is_resting = true;
        if (put ({}) >= 0 || ! is_enabled) return TACTUS_DEVICE_OK;   // nothing pushes before the forces are enabled
        return because (why, dhd->lastError(), TACTUS_DEVICE_FAILED);
    }

private:
    using Push = std::array<double, 7>;   // the force, the torque, and the force of the gripper, in the axes of the library

    bool isHomed (const int (&status)[most_status]) const { return dhd->drdIsInitialized != nullptr ? dhd->drdIsInitialized (id) : status[in_reset] == 0; }

    bool connect (const Wanted& wanted, std::string& why)
    {
        const auto take = [&] (int answer, bool of_drd) {
            is_open = answer >= 0;
            is_of_drd = of_drd;
            id = static_cast<char> (answer);
        };
        const bool has_drd = dhd->drdOpenID != nullptr && dhd->drdClose != nullptr;
        const auto open_index = [&] (int index) {
            const auto at = static_cast<char> (index);
            take (has_drd ? dhd->drdOpenID (at) : dhd->dhdOpenID (at), has_drd);
        };
        std::string what = "no arm";
        const int count = dhd->dhdGetDeviceCount != nullptr ? dhd->dhdGetDeviceCount() : -1;
        if (wanted.serial >= 0)
        {
            what = "no arm with the serial number " + std::to_string (wanted.serial);
            if (dhd->dhdOpenSerial == nullptr)
                what = "the library, of version " + dhd->version() + ", does not find arms by serial number, so none";
            else
                take (dhd->dhdOpenSerial (wanted.serial), false);
        }
        else if (wanted.model != nullptr)
        {
            what = "no " + std::string (wanted.model->name);
            for (std::size_t i = 0; dhd->dhdOpenType != nullptr && ! is_open && i < wanted.model->types.size(); ++i)
                take (dhd->dhdOpenType (wanted.model->types[i]), false);
        }
        else
        {
            if (wanted.index >= 0) what = "no arm " + std::to_string (wanted.index) + ", counted from 0,";
            const int end = wanted.index >= 0 ? wanted.index + 1 : std::max (count, 1);
            for (int i = std::max (wanted.index, 0); ! is_open && i < end; ++i)   // the first free one
                open_index (i);
        }
        if (is_open)
            ++open_arms;
        else
            why = what + " can be opened: " + dhd->lastError() + (count >= 0 ? ". Connected arms: " + std::to_string (count) : std::string());
        return is_open;
    }

    /// Looks whether the arm knows its position, and lets it find out by motor only if a person has asked for that just now.
    void home (const Wanted& wanted, std::string& remark)
    {
        const bool has_come_back = gonePorts().erase (port) > 0;
        int status[most_status] {};
        dhd->dhdGetStatus (status, id);
        if (isHomed (status)) return;
        const bool can = dhd->drdAutoInit != nullptr && dhd->drdStop != nullptr && (dhd->drdIsSupported == nullptr || dhd->drdIsSupported (id));
        if (wanted.calibrate && can && ! has_come_back)
        {
            if (dhd->drdAutoInit (id) < 0 || dhd->drdStop (true, id) < 0) remark += "the arm is not calibrated: " + dhd->lastError();
            return;
        }
        remark += "the arm is not calibrated, so it has no force. ";
        remark += ! can || (wanted.calibrate && ! has_come_back) ? "Move each axis to both of its ends by hand"
                  : has_come_back                                ? "It was gone, and no motor moves it without a person: start again"
                                                                 : "With \"calibrate\": true, its motors move it; keep your hands away then";
    }

    int type() const { return dhd->dhdGetSystemType != nullptr ? dhd->dhdGetSystemType (id) : -1; }

    /// 0: unknown. All Falcons have the same number.
    unsigned serial() const
    {
        unsigned short number = 0;
        const bool tells = dhd->dhdOpenSerial != nullptr && type() != falcon && dhd->dhdGetSerialNumber != nullptr;
        return tells && dhd->dhdGetSerialNumber (&number, id) >= 0 ? number : 0;
    }

    std::string model() const
    {
        const char* name = dhd->dhdGetSystemName != nullptr ? dhd->dhdGetSystemName (id) : nullptr;
        return std::string (name != nullptr && name[0] != 0 ? name : "An arm") + " of Force Dimension";
    }

    void describe (tactus_device_about& about, std::string& remark)
    {
        const auto has = [&] (bool (*what) (char)) { return what != nullptr && what (id); };
        const auto kind = std::ranges::find_if (models, [type = type()] (const Model& m) { return std::ranges::count (m.types, type) > 0; });
        has_wrist = has (dhd->dhdHasWrist) && dhd->dhdGetOrientationFrame != nullptr;
        turns = has (dhd->dhdHasActiveWrist) && dhd->dhdSetForceAndTorque != nullptr;
        has_gripper = has (dhd->dhdHasGripper) && dhd->dhdGetGripperAngleRad != nullptr;
        double gap = 0.0;
        has_gap = has_gripper && dhd->dhdGetGripperGap != nullptr && dhd->dhdGetGripperGap (&gap, id) >= 0;   // not every gripper has one
        grips = has (dhd->dhdHasActiveGripper) && (turns ? dhd->dhdSetForceAndTorqueAndGripperForce != nullptr : dhd->dhdSetForceAndGripperForce != nullptr);
        hand = has (dhd->dhdIsLeftHanded) ? -1.0 : 1.0;

        double firmware = 0.0;
        const bool tells = dhd->dhdGetVersion != nullptr && dhd->dhdGetVersion (&firmware, id) >= 0;
        unsigned char watchdog = 0;
        if (dhd->dhdEnableExpertMode != nullptr) dhd->dhdEnableExpertMode();
        drives = dhd->dhdGetWatchdog != nullptr && dhd->dhdGetWatchdog (&watchdog, id) >= 0 && watchdog > 0
                 && (! tells || firmware >= first_firmware_with_watchdog);   // whatever the library says for an older one
        if (dhd->dhdDisableExpertMode != nullptr) dhd->dhdDisableExpertMode();
        about.device_watchdog_s = drives ? watchdog * watchdog_unit_s : 0.0;
        if (! drives)
            remark += std::string (remark.empty() ? "" : "; ")
                      + "the arm has no force: it has no watchdog, or one that is off, so it would keep its last force if this program died";

        about.tool = TACTUS_DEVICE_POSITION | (has_wrist ? TACTUS_DEVICE_ROTATION : 0) | (drives ? TACTUS_DEVICE_FORCE : 0)
                     | (drives && turns ? TACTUS_DEVICE_TORQUE : 0);
        axes = { "saturated" };
        if (has_gripper) axes.push_back ("gripper_angle");
        if (has_gap) axes.push_back ("gripper");
        about.axes = axes.data();
        about.axis_count = axes.size();
        static constexpr const char* efforts[] { "gripper" };
        about.efforts = efforts;
        about.effort_count = drives && grips ? 1 : 0;
        static constexpr const char* falcon_buttons[] { "center", "left", "up", "right" };
        static constexpr const char* buttons[most_buttons] { "button0", "button1", "button2", "button3", "button4", "button5", "button6", "button7" };
        about.buttons = type() == falcon ? falcon_buttons : buttons;
        about.button_count = type() == falcon ? std::size (falcon_buttons) : std::size (buttons);

        sentence = model() + (serial() > 0 ? ", serial number " + std::to_string (serial()) : std::string())
                   + (tells ? ", firmware " + roundedText (firmware, 3) : std::string()) + ", library " + dhd->version() + ".";
        about.about = sentence.c_str();

        double most = kind != std::end (models) ? kind->max_force : 8.0;   // the least, for one that is not known
        const double own = dhd->dhdGetMaxForce != nullptr ? dhd->dhdGetMaxForce (id) : -1.0;
        if (own > 0.0) most = std::min (most, own);
        auto guard = guessedLimits (most, 5.0 * most);
        if (turns) addTorque (guard, 0.2);
        if (grips)
            for (const auto& [limit, value] : { std::pair { "max_axis_effort", 8.0 }, { "max_axis_slew", 2000.0 }, { "max_axis_impulse", 40.0 } })
                guard[limit] = value;
        limits = guard.dump();
        if (drives) about.guard = limits.c_str();
    }

    /// Gives the library an effort. Below 0: it has refused it. [with `sending` held]
    int put (const Push& p)
    {
        int answer = 0;
        if (turns && grips)
            answer = dhd->dhdSetForceAndTorqueAndGripperForce (p[0], p[1], p[2], p[3], p[4], p[5], p[6], id);
        else if (turns)
            answer = dhd->dhdSetForceAndTorque (p[0], p[1], p[2], p[3], p[4], p[5], id);
        else if (grips)
            answer = dhd->dhdSetForceAndGripperForce (p[0], p[1], p[2], p[6], id);
        else
            answer = dhd->dhdSetForce (p[0], p[1], p[2], id);
        if (answer >= 0) is_saturated = answer == DhdFunctions::saturated;
        return answer;
    }

    /// While nothing is asked for, the arm gets zeros at the full rate: otherwise it sags, and its watchdog switches the forces off. [reading thread]
    void feed()
    {
        if (! drives || ! is_resting) return;
        const std::unique_lock lock (sending, std::try_to_lock);
        if (lock.owns_lock() && is_resting) put ({});
    }

    /// Once in the life of this object: what switches the forces off later keeps them off. [reading thread]
    void enable()
    {
        const std::unique_lock lock (sending, std::try_to_lock);
        if (! lock.owns_lock()) return;   // at the next look
        if (dhd->dhdSetBrakes != nullptr) dhd->dhdSetBrakes (0, id);
        if (dhd->dhdSetGravityCompensation != nullptr) dhd->dhdSetGravityCompensation (1, id);
        put ({});
        dhd->dhdEnableForce (1, id);
        if (grips && dhd->dhdEnableGripperForce != nullptr) dhd->dhdEnableGripperForce (1, id);
        put ({});
        is_enabled = true;
    }

    /// Looks why the arm cannot be trusted, if it cannot. [reading thread]
    void look()
    {
        constexpr int unknown = INT_MIN;   // this version of the library does not write it
        int status[most_status];
        std::ranges::fill (status, unknown);
        if (dhd->dhdGetStatus (status, id) < 0)
        {
            if (++unseen > most_unseen) fault = TACTUS_DEVICE_BROKEN;   // nothing tells whether its forces are on
            return;
        }
        unseen = 0;
        const int cause = status[force_off_cause];
        was_unplugged = status[connected] == 0 || (status[with_force] == 0 && cause == by_unplugging);
        fault = 0;
        if (! isHomed (status))
            fault = TACTUS_DEVICE_NOT_HOMED;
        else if (status[in_error] > 0)
            fault = TACTUS_DEVICE_BROKEN;
        else if (! drives)
            return;
        else if (status[powered] == 0)
            fault = TACTUS_DEVICE_NOT_DRIVEN;
        else if (! is_enabled)
            enable();
        else if (status[with_force] == 0)
            fault = cause == by_button || cause == by_dead_man ? TACTUS_DEVICE_STOPPED
                    : cause == by_watchdog                     ? TACTUS_DEVICE_TIMED_OUT
                                                               : TACTUS_DEVICE_NOT_DRIVEN;
    }

    std::int32_t leave (std::string& why, std::string reason)
    {
        is_gone = true;
        return because (why, std::move (reason));
    }

    /// The parts of a reading besides the position. False if one cannot be read.
    bool fill (tactus_reading& to)
    {
        to.axis_count = to.buttons = 0;   // an earlier try may have failed half-way
        if (has_wrist)
        {
            double frame[3][3] {};
            if (dhd->dhdGetOrientationFrame (frame, id) < 0) return false;
            turn (rotationOf (Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> (&frame[0][0])).data(), to.rotation);
        }
        to.axes[to.axis_count++] = is_saturated ? 1.0 : 0.0;
        double angle = 0.0, gap = 0.0;
        if (has_gripper && dhd->dhdGetGripperAngleRad (&angle, id) < 0) return false;
        if (has_gripper) to.axes[to.axis_count++] = hand * angle;
        if (has_gap && dhd->dhdGetGripperGap (&gap, id) < 0) return false;
        if (has_gap) to.axes[to.axis_count++] = gap;
        if (dhd->dhdGetButtonMask != nullptr)
            to.buttons = dhd->dhdGetButtonMask (id);
        else
            for (int i = 0; i < most_buttons && dhd->dhdGetButton != nullptr; ++i)
                to.buttons |= dhd->dhdGetButton (i, id) > 0 ? 1u << i : 0;
        to.valid = 1;
        return true;
    }

    const std::shared_ptr<const DhdLibrary> dhd;
    const std::string port;
    char id = -1;
    bool is_open = false, is_of_drd = false;
    bool has_wrist = false, turns = false, has_gripper = false, has_gap = false, grips = false, drives = false;
    double hand = 1.0;   // -1: left-handed, and the angle and the force of the gripper have the other sign
    std::string sentence, limits;
    std::vector<const char*> axes;
    // [reading thread]
    Clock::time_point due, look_at;
    std::optional<Clock::time_point> failing_since;
    std::uint32_t fault = TACTUS_DEVICE_NOT_HOMED;   // until its status says otherwise
    int unseen = 0;                                  // looks in a row without a status
    bool was_unplugged = false;

    std::mutex sending;   // while an effort is on its way into the library. The reading thread only tries to take it
    std::atomic<bool> is_resting = true, is_enabled = false, is_gone = false, is_saturated = false;
};

constexpr const char* keys[] { "port", "calibrate" };

template <int period_us>
constexpr auto table =
    driverTable<Arm<period_us>> ("forcedimension", "The arms of Force Dimension (omega, delta, sigma, lambda), through the library of their maker.", keys);
}   // namespace

const tactus_device_driver driver = table<500>, eager_driver = table<0>;

}   // namespace tactus::host::forcedimension
