// SPDX-License-Identifier: MIT
// A device driver for the arms of 3D Systems. The maker's library runs in a helper process (helper.cpp).
#include "touch.hpp"
#include "shared_arm.hpp"
#include "stored_names.hpp"

#include <host/drivers/driver_table.hpp>
#include <host/drivers/guessed_limits.hpp>
#include <host/drivers/helper_program.hpp>
#include <host/drivers/read_keys.hpp>
#include <host/drivers/rotation_of.hpp>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#if ! defined(_WIN32)
extern char** environ;
#endif

namespace tactus::host::openhaptics
{

namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr std::chrono::milliseconds until_open = 10s, until_stuck = 1s, until_zero = 200ms;
constexpr std::int64_t between_looks_ns = 5'000'000;   // at whether the helper lives
constexpr double to_m = 1e-3, most_torque = 0.188;     // N m: that of a Premium with six motors, as the library tells none
constexpr const char* program = "openhaptics-helper";
constexpr const char* may_push = ". The arm may still push: switch it off";

#if defined(_WIN32)
std::vector<char*> plainEnvironment()
{
    return { nullptr };
}   // no locale comes from it
#else
/// The environment of this program, with numbers as in C: with another locale, the maker's setup reads wrong numbers.
std::vector<char*> plainEnvironment()
{
    static char numbers[] = "LC_NUMERIC=C";
    std::vector<char*> all;
    for (char** at = environ; *at != nullptr; ++at)
        if (const std::string_view each = *at; ! each.starts_with ("LC_NUMERIC=") && ! each.starts_with ("LC_ALL=")) all.push_back (*at);
    all.push_back (numbers);
    all.push_back (nullptr);
    return all;
}
#endif

/// The locale that this environment has for numbers; empty if they are as in C.
std::string localeOfNumbers()
{
    for (const auto* variable : { "LC_ALL", "LC_NUMERIC", "LANG" })
        if (const char* set = std::getenv (variable); set != nullptr && set[0] != 0)
        {
            const std::string locale = set;
            return locale == "C" || locale == "POSIX" || locale.starts_with ("C.") ? std::string() : locale;
        }
    return {};
}

/// The process that owns the maker's library, and the memory of the arms of this program, which it shares.
class Owner
{
public:
    /// The one that runs, or a new one. Null, with the reason, if there is none. [opening thread]
    static std::shared_ptr<Owner> get (std::string& why)
    {
        static std::weak_ptr<Owner> running;
        const std::lock_guard lock (opening);
        if (auto owner = running.lock(); owner != nullptr && ! owner->process.hasEnded (0) && owner->shared->is_ending == 0) return owner;
        auto owner = std::make_shared<Owner>();
        why = owner->launch();
        if (! why.empty()) return nullptr;
        running = owner;
        return owner;
    }

    Owner() = default;
    Owner (const Owner&) = delete;
    Owner& operator= (const Owner&) = delete;
    ~Owner()   // the helper, which has the memory as well, sends zeros, ends the library, and then itself
    {
        if (shared != nullptr) unmapShared (shared, sizeof (SharedArms));
    }

    /// A place for an arm, which the helper opens; null: all are taken.
    SharedArm* add (const std::string& name) const
    {
        const std::lock_guard lock (opening);
        const auto at = std::ranges::find_if (shared->arms, [] (const SharedArm& arm) { return arm.is_wanted == 0 && arm.state == SharedArm::unused; });
        if (at == shared->arms.end()) return nullptr;
        put (at->name, sizeof at->name, name);
        at->ticks = 0;
        at->push.store ({});
        at->state = SharedArm::starting;
        at->is_wanted = 1;
        return &*at;
    }

    /// Waits until an arm has got zeros. The helper closes it as soon as no run ticks another one.
    void remove (SharedArm& arm) const
    {
        arm.is_wanted = 0;
        const auto until = Clock::now() + until_zero;
        while (arm.state == SharedArm::ready && ! process.hasEnded (1) && Clock::now() < until)
        {
        }
    }

    bool isJoining() const { return shared->is_joining != 0; }

private:
    std::string launch()
    {
        const int memory = makeShared (sizeof (SharedArms));
        if (memory != -1) shared = static_cast<SharedArms*> (mapShared (memory, sizeof (SharedArms)));
        auto why = shared == nullptr ? "no memory for the helper: " + std::generic_category().message (errno)
                                     : process.start (&driver, program, {}, { memory }, plainEnvironment().data());
        if (memory != -1) closeShared (memory);
        return why;
    }

    static inline std::mutex opening;   // each arm of a program is opened again on a thread of its own
    SharedArms* shared = nullptr;

public:
    HelperProcess process;
};

/// The library's y points up, its z towards the person.
void turn (const Vec3& from, double* to, double scale)
{
    to[0] = scale * from.x();
    to[1] = -scale * from.z();
    to[2] = scale * from.y();
}

void turnBack (const double (&from)[3], double (&to)[3], double scale)
{
    to[0] = scale * from[0];
    to[1] = scale * from[2];
    to[2] = -scale * from[1];
}

class Touch
{
public:
    using Wanted = std::string;   // its name

    static std::string parse (const tactus_device_description& given, Wanted& name)
    {
        return readKeys (given, name, [] (ObjectReader&) {});
    }

    static std::unique_ptr<Touch> open (const Wanted& name, tactus_device_about& about, std::string& said)
    {
        auto touch = std::make_unique<Touch>();
        touch->owner = Owner::get (said);
        if (touch->owner == nullptr) return nullptr;
        touch->arm = touch->owner->add (name);
        if (touch->arm == nullptr) said = "this program has four arms open, and no place for another one";
        if (touch->arm == nullptr || ! touch->wait (said)) return nullptr;
        touch->describe (about, said);
        return touch;
    }

    /// The names that the maker's setup has stored: no arm is opened, because that takes seconds and starts the library. Without names, the library may
    /// still have an arm that needs none.
    static std::string find (const Found& found)
    {
        HelperProcess looks;
        auto why = looks.start (&driver, program, { "--library" }, {}, plainEnvironment().data());
        if (why.empty()) why = looks.firstLine().value_or ("the helper has died while it opened the library of OpenHaptics");
        if (! why.empty()) return why;
        const auto names = storedNames();
        for (const auto& name : names)
            found (name, "An arm of 3D Systems", TACTUS_DEVICE_UNSEEN);
        if (names.empty()) found ({}, "An arm of 3D Systems for which its setup has stored no name", TACTUS_DEVICE_UNSEEN);
        return {};
    }

    Touch() = default;
    Touch (const Touch&) = delete;
    Touch& operator= (const Touch&) = delete;
    ~Touch()
    {
        if (arm != nullptr) owner->remove (*arm);
    }

    std::int32_t read (std::int32_t timeout_ms, tactus_reading& to, tactus_device_stamp& stamp, std::string& why)
    {
        const auto until = Clock::now() + std::chrono::milliseconds (timeout_ms);
        for (;;)
        {
            const auto newest = arm->ticks.load();
            if (newest != static_cast<std::uint32_t> (last))
            {
                heard = Clock::now();
                const auto behind = newest - static_cast<std::uint32_t> (last);
                const auto next = last + (behind < SharedArm::kept - 2 ? 1 : behind);   // what has been overwritten is lost
                const auto tick = arm->ring[next % SharedArm::kept].load();
                last = tick.number;
                read_last = last;
                fill (tick, to, stamp);
                return TACTUS_DEVICE_OK;
            }
            if (arm->state == SharedArm::failed) return because (why, arm->text);
            if (owner->process.hasEnded (0)) return because (why, std::string ("the process that owns its library has died") + may_push);
            if (owner->isJoining()) heard = Clock::now();   // its servo loop stands still, and the helper watches the time
            if (Clock::now() - heard > until_stuck)
            {
                owner->process.kill();
                return because (why, std::string ("its library has not moved for a second, so its process was killed") + may_push);
            }
            if (Clock::now() >= until) return TACTUS_DEVICE_NONE;
            waitWhile (arm->ticks, newest, between_looks_ns);
        }
    }

    std::int32_t write (const tactus_effort& effort, std::string& why)
    {
        SharedArm::Push push;
        turnBack (effort.force, push.force, 1.0);
        if (turns) turnBack (effort.torque, push.torque, 1e3);
        return give (push, why);
    }

    /// After the death of the helper nothing can be sent any more, and read() has said what that means.
    std::int32_t rest (std::string& why) { return owner->process.hasEnded (0) ? std::int32_t { TACTUS_DEVICE_OK } : give ({}, why); }

private:
    std::int32_t give (SharedArm::Push push, std::string& why)
    {
        if (owner->process.hasEnded (0)) return because (why, "the process that owns its library has died", TACTUS_DEVICE_FAILED);
        push.at_ns = nanosecondsNow();
        push.answers = read_last;
        arm->push.store (push);
        ++arm->pushes;
        wake (arm->pushes);
        return TACTUS_DEVICE_OK;
    }

    bool wait (std::string& why)
    {
        const auto until = Clock::now() + until_open;
        while (arm->ticks == 0 && arm->state != SharedArm::failed && ! owner->process.hasEnded (1) && Clock::now() < until)
        {
        }
        heard = Clock::now();
        if (arm->ticks != 0) return true;
        why = arm->state == SharedArm::failed ? arm->text : owner->process.hasEnded (0) ? "the process that owns its library has died while it started it"
                                                                                        : "its library does not start";
        return false;
    }

    void describe (tactus_device_about& about, std::string& remark)
    {
        turns = arm->output_dof >= 6;
        const bool drives = arm->max_force > 0.0;
        const auto first = arm->ring[1].load();
        if (first.fault == TACTUS_DEVICE_NOT_HOMED)
            remark = "the arm does not know its position, so it has no force: put its stylus into the inkwell, if it has one, until it does";
        if (! drives) remark += std::string (remark.empty() ? "" : "; ") + "the arm has no force: its library does not tell the largest force";
        about.tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_ROTATION | (drives ? TACTUS_DEVICE_FORCE : 0) | (drives && turns ? TACTUS_DEVICE_TORQUE : 0);
        static constexpr const char* axes[] { "temperature", "delay" };
        static constexpr const char* buttons[] { "button1", "button2", "button3", "button4" };
        nameParts (about, axes, buttons);
        about.rate_hz = arm->rate_hz;
        about.stamps = TACTUS_DEVICE_NUMBERS | TACTUS_DEVICE_TIMES;                     // the ticks of its servo loop
        about.device_watchdog_s = 1e-9 * SharedArm::patience_ns + 2.0 / arm->rate_hz;   // of the helper: it does not help if the helper dies, too
        const auto locale = localeOfNumbers();
        sentence = std::string (arm->model) + (locale.empty() ? "." : ". Its library reads numbers as in C, not as in " + locale + ".");
        about.about = sentence.c_str();
        if (! drives) return;
        const double most = arm->max_force, lasting = arm->max_continuous_force > 0.0 ? std::min (arm->max_continuous_force, most) : 0.25 * most;
        auto guard = guessedLimits (most, 10.0 * lasting);
        if (turns) addTorque (guard, most_torque);
        limits = guard.dump();
        about.guard = limits.c_str();
    }

    void fill (const SharedArm::Tick& tick, tactus_reading& to, tactus_device_stamp& stamp) const
    {
        turn (Vec3 (tick.position), to.position, to_m);
        turn (rotationOf (Eigen::Map<const Eigen::Matrix4d> (tick.transform).topLeftCorner<3, 3>()), to.rotation, 1.0);
        to.axes[to.axis_count++] = tick.temperature;
        to.axes[to.axis_count++] = tick.delay_s;
        to.buttons = tick.buttons;
        to.valid = 1;
        stamp.number = tick.number;
        stamp.time_s = 1e-9 * static_cast<double> (tick.at_ns);
        stamp.fault = tick.fault;
    }

    std::shared_ptr<Owner> owner;
    SharedArm* arm = nullptr;
    bool turns = false;
    std::string sentence, limits;
    std::uint64_t last = 0;   // tick   [reading thread]
    std::atomic<std::uint64_t> read_last = 0;
    Clock::time_point heard {};   // when it came   [reading thread]
};

constexpr const char* keys[] { "port" };
}   // namespace

const tactus_device_driver driver =
    driverTable<Touch> ("openhaptics", "The arms of 3D Systems (Touch, Touch X, Phantom), through OpenHaptics, in a process of its own.", keys);

}   // namespace tactus::host::openhaptics
