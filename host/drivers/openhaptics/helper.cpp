// SPDX-License-Identifier: MIT
// The process that owns OpenHaptics and the arms of a program: if the library crashes or hangs, the program that plays does not. Its arguments are the
// files of the memory that it shares with the driver and of the pipe that ends with the driver. With --library, it only says on its first line why the
// library cannot be opened, or nothing. Written from a public description of the library's functions; no arm has been tried. See docs/known_devices.md.
#include "hd_library.hpp"
#include "shared_arm.hpp"
#include "stored_names.hpp"

#include <host/drivers/helper_side.hpp>
#include <tactus/tactus_device.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace
{
using namespace tactus::host::openhaptics;

constexpr std::uint64_t between_looks = 50;                   // ticks: at the calibration and the temperature
constexpr std::uint64_t fault_lasts = 500;                    // ticks after the last error, so that a force does not come and go
constexpr double return_per_tick = 0.1;                       // of a force that was away, so that it does not come back as a step
constexpr std::int64_t longest_pause_ns = 50'000'000;         // between two pushes of a run, on a busy computer, which must not look like its end
constexpr unsigned wanted_rate = 1000;                        // Hz
constexpr int until_first_ms = 3000, until_zero_ms = 100;     // how long the servo loop has to start, and to send zeros
constexpr unsigned until_killed_s = 2, until_joined_s = 12;   // how long the library has to stop, and to open an arm

bool endsServo (unsigned error)
{
    return error == hd::device_fault || error == hd::communication || error == hd::communication_setup || error == hd::timer
           || error == hd::bad_priority || error == hd::scheduler_full;
}

/// An arm that the library has opened.
class OpenArm
{
public:
    OpenArm (const HdFunctions& h, SharedArm& s) : hd (h), shared (s) {}
    ~OpenArm()
    {
        if (device != hd::no_device) hd.hdDisableDevice (device);
    }
    OpenArm (const OpenArm&) = delete;
    OpenArm& operator= (const OpenArm&) = delete;

    /// The reason if it cannot be opened. The servo loop does not run. [main thread]
    std::string open()
    {
        std::vector<const char*> names { shared.name };
        if (shared.name[0] == 0) names = { nullptr, "Default Device", "Default PHANToM" };   // some versions of the library know one, some another
        std::string why, stored;
        for (const auto* name : names)
        {
            drain();
            last_error = "no reason given";
            device = hd.hdInitDevice (name);
            drain();
            if (device != hd::no_device)
            {
                describe();
                return {};
            }
            why += (why.empty() ? "" : "; ") + std::string (name != nullptr ? name : "the arm without a name") + ": " + last_error;
        }
        for (const auto& name : storedNames())
            stored += (stored.empty() ? "" : ", ") + name;
        return "no arm can be opened (" + (stored.empty() ? "its setup has stored no names" : "names that its setup has stored: " + stored) + "): " + why;
    }

    /// Takes all errors from the library, which has one stack of them for its arms. The text of the first one that the servo loop cannot go on after;
    /// empty: none.
    std::string drain (std::span<const std::unique_ptr<OpenArm>> all = {})
    {
        std::string fatal;
        for (int n = 0; n < 100; ++n)
        {
            const auto error = hd.hdGetError();
            if (error.code == hd::success) break;
            last_error = textOf (error);
            if (fatal.empty() && endsServo (error.code)) fatal = last_error;
            if (error.code < hd::warm_motors || error.code > hd::force_error) continue;
            const auto owner = std::ranges::find_if (all, [&] (const auto& arm) { return arm != nullptr && arm->device == error.device; });
            OpenArm& of = owner != all.end() ? **owner : *this;
            of.fault = error.code == hd::warm_motors ? TACTUS_DEVICE_TOO_HOT : TACTUS_DEVICE_NOT_DRIVEN;
            of.fault_since = of.number;
        }
        return fatal;
    }

    /// One tick of the library, which `sharing` of these arms share: its errors, as drain(). [servo thread]
    std::string tick (bool ends, std::int64_t sharing, std::span<const std::unique_ptr<OpenArm>> all)
    {
        const auto begin = nanosecondsNow();
        hd.hdMakeCurrentDevice (device);
        const bool looks = number++ % between_looks == 0;
        if (looks) calibrate();

        SharedArm::Tick tick { .number = number, .at_ns = nanosecondsNow() };
        hd.hdBeginFrame (device);
        hd.hdGetDoublev (hd::position, tick.position);
        hd.hdGetDoublev (hd::transform, tick.transform);
        int pressed = 0;
        hd.hdGetIntegerv (hd::buttons, &pressed);
        if (looks) temperature = hottest();
        if (shared.state == SharedArm::starting) start();
        tick.buttons = static_cast<std::uint32_t> (pressed);
        tick.temperature = temperature;
        tick.delay_s = delay_s;
        if (fault != 0 && number - fault_since > fault_lasts) fault = 0;
        tick.fault = is_homed ? fault : std::uint32_t { TACTUS_DEVICE_NOT_HOMED };
        shared.ring[number % SharedArm::kept].store (tick);
        shared.ticks = static_cast<std::uint32_t> (number);
        wake (shared.ticks);

        const bool is_left = shared.is_wanted == 0;
        const auto push = ends || is_left || ! is_homed ? SharedArm::Push {} : answer (begin, sharing);
        if (ends || is_left) is_pushed = false;
        hd.hdSetDoublev (hd::force, push.force);
        if (turns) hd.hdSetDoublev (hd::torque, push.torque);
        hd.hdEndFrame (device);
        if (is_left && shared.state == SharedArm::ready) shared.state = SharedArm::resting;
        return drain (all);
    }

    void fail (const std::string& why)
    {
        put (shared.text, sizeof shared.text, why);
        shared.state = SharedArm::failed;
        wake (shared.ticks);
    }

    bool hasStarted() const { return shared.state != SharedArm::starting; }
    bool isPushed() const { return nanosecondsNow() - last_pushed < longest_pause_ns; }   ///< by a run that ticks, perhaps with zeros
    bool isWanted() const { return shared.is_wanted != 0; }
    void release() { shared.state = SharedArm::unused; }

private:
    std::string textOf (const HdError& error) const
    {
        const char* text = hd.hdGetErrorString (error.code);
        char numbers[64];
        std::snprintf (numbers, sizeof numbers, " (error 0x%x, %d inside the library)", error.code, error.internal);
        return (text != nullptr ? text : "an error") + std::string (numbers);
    }

    void describe()
    {
        hd.hdMakeCurrentDevice (device);
        const auto text = [&] (unsigned what) {
            const char* said = hd.hdGetString (what);
            return said != nullptr ? std::string (said) : std::string();
        };
        std::string about = text (hd::model_type).empty() ? "An arm" : text (hd::model_type);
        for (const auto& [before, what] : { std::pair { ", serial number ", hd::serial_number }, std::pair { ", firmware ", hd::firmware_version },
                                            std::pair { ", driver ", hd::driver_version }, std::pair { ", library ", hd::version } })
            if (const auto said = text (what); ! said.empty()) about += before + said;
        put (shared.model, sizeof shared.model, about);
        styles = integer (hd::calibration_styles, 0);
        if (styles == 0) styles = static_cast<int> (hd.hdCheckCalibrationStyle());
        hd.hdEnable (hd::force_output);
        drain();
        if (styles == hd::by_encoder_reset) hd.hdUpdateCalibration (hd::by_encoder_reset);   // before the servo loop, in the pose that the person chose
    }

    int integer (unsigned what, int otherwise) const
    {
        hd.hdGetIntegerv (what, &otherwise);
        return otherwise;
    }

    /// Reads the numbers of the arm, in its first frame: outside of one, the library may refuse to tell them.
    void start()
    {
        shared.max_force = shared.max_continuous_force = 0.0;
        hd.hdGetDoublev (hd::max_force, &shared.max_force);
        hd.hdGetDoublev (hd::max_continuous_force, &shared.max_continuous_force);
        hd.hdGetDoublev (hd::usable_workspace, shared.workspace.data());
        shared.input_dof = integer (hd::input_dof, 6);
        shared.output_dof = integer (hd::output_dof, 3);
        turns = shared.output_dof >= 6;
        const int rate = integer (hd::instantaneous_rate, 0);
        shared.rate_hz = rate > 0 ? rate : wanted_rate;
        shared.state = SharedArm::ready;   // the first tick follows
    }

    void calibrate()
    {
        const auto state = hd.hdCheckCalibration();
        if (state == hd::needs_update && styles != hd::by_encoder_reset)   // which is not possible any more
            hd.hdUpdateCalibration (static_cast<unsigned> (styles & hd::by_itself ? hd::by_itself : hd::by_inkwell));
        is_homed = state == hd::is_calibrated;
    }

    double hottest() const
    {
        std::array<double, 6> all {};
        hd.hdGetDoublev (hd::motor_temperature, all.data());
        return *std::max_element (all.begin(), all.end());
    }

    /// The push for this tick. Waits for its share of half a period for one that answers it; the last one holds until twice the time between the last two
    /// has passed, so for a run at the same rate one tick can go without an answer, and in no case longer than `patience_ns`.
    SharedArm::Push answer (std::int64_t begin, std::int64_t sharing)
    {
        const std::int64_t period = shared.rate_hz > 0.0 ? static_cast<std::int64_t> (1e9 / shared.rate_hz) : 1'000'000;
        const auto before = last_push;
        const auto until = begin + period / (2 * sharing);
        std::int64_t now = begin;
        if (is_pushed)   // a run that has not begun, or is at rest, does not answer
            for (; shared.pushes == before && now < until; now = nanosecondsNow())
                waitWhile (shared.pushes, before, until - now);
        last_push = shared.pushes;
        auto push = shared.push.load();
        now = nanosecondsNow();
        if (last_push != before)
        {
            measure (push, now - begin, period);
            apart_ns = std::clamp (push.at_ns - pushed_at, period, SharedArm::patience_ns);
            pushed_at = push.at_ns;
            if (push.at_ns != 0) last_pushed = now;
        }
        const auto holds = std::min (2 * apart_ns + period, SharedArm::patience_ns);
        is_pushed = push.at_ns != 0 && now - push.at_ns < holds;
        share = is_pushed ? std::min (1.0, share + return_per_tick) : 0.0;
        if (share == 1.0) return push;
        for (auto* part : { &push.force, &push.torque })
            for (double& each : *part)
                each *= share;
        return push;
    }

    /// How long after its place a force reaches the arm. The frame that sends it ends right after this.
    void measure (const SharedArm::Push& push, std::int64_t in_tick_ns, std::int64_t period_ns)
    {
        if (push.answers == 0 || push.answers > number) return;
        const double now_s = 1e-9 * static_cast<double> (in_tick_ns + static_cast<std::int64_t> (number - push.answers) * period_ns);
        delay_s += delay_s == 0.0 ? now_s : 0.01 * (now_s - delay_s);
    }

    const HdFunctions& hd;
    SharedArm& shared;
    unsigned device = hd::no_device;
    int styles = 0;
    bool turns = false;
    std::string last_error;
    std::atomic<std::int64_t> last_pushed = -longest_pause_ns;

    // [servo thread, or while it stands still]
    std::uint64_t number = 0, fault_since = 0;
    std::uint32_t fault = 0, last_push = 0;
    bool is_homed = false, is_pushed = false;
    double temperature = 0.0, delay_s = 0.0;
    double share = 0.0;   // of the push that the arm gets
    std::int64_t apart_ns = 0, pushed_at = 0;
};

/// All arms of a program, in the one servo loop that the library has.
class Helper
{
public:
    Helper (SharedArms& s, int until) : shared (s), pipe (until) {}

    int run()
    {
        const auto why_not = hd.load();
        while (! has_failed && ! hasEnded (20))
            for (std::size_t i = 0; i < shared.arms.size(); ++i)
                attend (i, why_not);
        shared.is_ending = 1;
        if (is_running) halt();
        tactus::host::endProcessAfter (until_killed_s);
        for (auto& arm : arms)
            arm.reset();
        return has_failed ? 1 : 0;
    }

private:
    /// True if the driver is gone, or wants this process to end.
    bool hasEnded (int wait_ms) const { return tactus::host::pipeEnds (pipe, wait_ms); }

    template <typename F>
    bool any (F&& so) const
    {
        return std::any_of (arms.begin(), arms.end(), [&] (const auto& arm) { return arm != nullptr && so (*arm); });
    }

    /// Opens an arm that the driver wants, and closes one that it does not want. The library does both only while its servo loop stands still, so neither
    /// happens while a run ticks another arm.
    void attend (std::size_t i, const std::string& why_not)
    {
        auto& slot = shared.arms[i];
        const bool wants = slot.is_wanted != 0;
        if (! wants && arms[i] == nullptr && slot.state != SharedArm::unused) slot.state = SharedArm::unused;
        const bool joins = wants && arms[i] == nullptr && slot.state == SharedArm::starting, leaves = ! wants && arms[i] != nullptr;
        if (! joins && ! leaves) return;
        const auto is_busy = [this] { return any ([] (const OpenArm& arm) { return arm.isPushed(); }); };
        for (int waited = 0; joins && is_busy() && waited < until_zero_ms && ! hasEnded (1); ++waited)
        {
        }
        auto arm = std::make_unique<OpenArm> (hd, slot);
        if (joins && ! why_not.empty()) return arm->fail (why_not);
        if (is_busy())
        {
            if (joins)
                arm->fail ("another arm of this program is in use, and the library opens arms only while its servo loop stands still: end the run, and "
                           "start it again");
            return;
        }
        shared.is_joining = 1;
        if (is_running) halt();
        tactus::host::endProcessAfter (until_joined_s);
        for (std::size_t k = 0; k < arms.size(); ++k)
            if (arms[k] != nullptr && ! arms[k]->isWanted())
            {
                arms[k]->release();
                arms[k].reset();
            }
        if (joins)
        {
            if (const auto why = arm->open(); why.empty())
                arms[i] = std::move (arm);
            else
                arm->fail (why);
        }
        if (any ([] (const OpenArm&) { return true; })) start();
        tactus::host::endProcessAfter (0);
        shared.is_joining = 0;
    }

    void start()
    {
        hd.hdSetSchedulerRate (wanted_rate);
        for (auto& arm : arms)
            if (arm != nullptr) arm->drain();   // an arm that does not know this rate keeps its own
        ending = is_zero = false;
        is_running = true;
        scheduled = hd.hdScheduleAsynchronous ([] (void* self) { return static_cast<Helper*> (self)->servo(); }, this, hd::usual_priority);
        hd.hdStartScheduler();
        const auto is_waiting = [this] { return any ([] (const OpenArm& arm) { return ! arm.hasStarted(); }); };
        for (int waited = 0; is_waiting() && waited < until_first_ms && ! hasEnded (1); ++waited)
        {
        }
        for (auto& arm : arms)
            if (arm != nullptr && ! arm->hasStarted()) arm->fail ("the library does not start: " + arm->drain());
    }

    /// Sends zeros, and ends the servo loop. The library may hang: then this process is killed.
    void halt()
    {
        ending = true;
        for (int waited = 0; ! is_zero && waited < until_zero_ms; ++waited)
            std::this_thread::sleep_for (std::chrono::milliseconds (1));
        tactus::host::endProcessAfter (until_killed_s);
        hd.hdStopScheduler();
        hd.hdUnschedule (scheduled);
        is_running = false;
    }

    /// One tick of the library. [servo thread]
    unsigned servo()
    {
        const bool ends = ending || has_failed;
        const auto open = std::count_if (arms.begin(), arms.end(), [] (const auto& arm) { return arm != nullptr; });
        std::string fatal;
        for (auto& arm : arms)
            if (arm != nullptr)
                if (auto why = arm->tick (ends, open, arms); fatal.empty()) fatal = std::move (why);
        is_zero = is_zero || ends;
        if (! fatal.empty() && ! has_failed)
        {
            has_failed = true;
            shared.is_ending = 1;
            for (auto& arm : arms)
                if (arm != nullptr) arm->fail (fatal);
        }
        return 1;   // the main thread takes it off the schedule
    }

    SharedArms& shared;
    const int pipe;
    HdFunctions hd;
    std::array<std::unique_ptr<OpenArm>, std::tuple_size_v<decltype (SharedArms::arms)>> arms;   // changed while the servo loop stands still
    unsigned long scheduled = 0;
    bool is_running = false;   // [main thread]
    std::atomic<bool> ending = false, is_zero = false, has_failed = false;
};
}   // namespace

int main (int count, char** arguments)
{
    if (count < 3) return 2;
    if (arguments[1] == std::string_view ("--library"))
        return tactus::host::writePipe (std::atoi (arguments[count - 1]), HdFunctions {}.load() + "\n") ? 0 : 1;
    const int memory = std::atoi (arguments[1]), pipe = std::atoi (arguments[2]);
    void* at = tactus::host::mapShared (memory, sizeof (SharedArms));
    if (at == nullptr) return 2;
    return Helper (*static_cast<SharedArms*> (at), pipe).run();
}
