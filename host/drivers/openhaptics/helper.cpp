// SPDX-License-Identifier: MIT
// The process that owns OpenHaptics and one arm: if the library crashes or hangs, the program that plays does not. Its arguments are the files of the
// memory that it shares with the driver and of the pipe that ends with the driver, and perhaps the name of the arm. Written from a public description of
// the library's functions; no arm has been tried. See docs/known_devices.md.
#include "hd_library.hpp"
#include "shared_arm.hpp"

#include <tactus/tactus_device.h>

#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace
{
using namespace tactus::host::openhaptics;

constexpr std::uint64_t between_looks = 50;                                     // ticks: at the calibration and the temperature
constexpr std::uint64_t fault_lasts = 500;                                      // ticks after the last error, so that a force does not come and go
constexpr double return_per_tick = 0.1;                                         // of a force that was away, so that it does not come back as a step
constexpr unsigned wanted_rate = 1000;                                          // Hz
constexpr int until_first_ms = 3000, until_zero_ms = 100, until_killed_s = 2;   // how long the servo loop has to send zeros, and the library to end

bool endsServo (unsigned error)
{
    return error == hd::device_fault || error == hd::communication || error == hd::communication_setup || error == hd::timer
           || error == hd::bad_priority || error == hd::scheduler_full;
}

/// The arm, as its servo loop sees it.
class Helper
{
public:
    Helper (SharedArm& s, int until) : shared (s), pipe (until) {}

    int run (const std::vector<const char*>& names)
    {
        if (const auto why = hd.load(); ! why.empty()) return fail (why);
        if (const auto why = open (names); ! why.empty()) return fail (why);
        describe();
        hd.hdEnable (hd::force_output);
        hd.hdSetSchedulerRate (wanted_rate);
        drain();                                                                             // an arm that does not know this rate keeps its own
        if (styles == hd::by_encoder_reset) hd.hdUpdateCalibration (hd::by_encoder_reset);   // before the servo loop, in the pose that the person chose
        const auto scheduled = hd.hdScheduleAsynchronous ([] (void* self) { return static_cast<Helper*> (self)->servo(); }, this, hd::usual_priority);
        hd.hdStartScheduler();
        for (int waited = 0; shared.state == SharedArm::starting && waited < until_first_ms && ! hasEnded (1); ++waited)
        {
        }
        if (shared.state == SharedArm::starting && ! hasEnded (0)) return fail ("the library does not start: " + drain());

        while (! has_failed && ! hasEnded (20))
        {
        }
        ending = true;
        for (int waited = 0; ! is_zero && waited < until_zero_ms; ++waited)
            ::usleep (1000);
        ::alarm (until_killed_s);   // the library may hang
        hd.hdStopScheduler();
        hd.hdUnschedule (scheduled);
        hd.hdDisableDevice (device);
        return has_failed ? 1 : 0;
    }

private:
    int fail (const std::string& why)
    {
        put (shared.text, sizeof shared.text, why);
        shared.state = SharedArm::failed;
        wake (shared.ticks);
        if (device != hd::no_device) hd.hdDisableDevice (device);
        return 1;
    }

    /// True if the driver is gone, or wants this process to end.
    bool hasEnded (int wait_ms) const
    {
        pollfd of_driver { pipe, POLLIN, 0 };
        return ::poll (&of_driver, 1, wait_ms) > 0;
    }

    /// Takes all errors from the library. The text of the first one that the servo loop cannot go on after; empty: none.
    std::string drain()
    {
        std::string fatal;
        for (int n = 0; n < 100; ++n)
        {
            const auto error = hd.hdGetError();
            if (error.code == hd::success) break;
            last_error = textOf (error);
            if (fatal.empty() && endsServo (error.code)) fatal = last_error;
            if (error.code >= hd::warm_motors && error.code <= hd::force_error)
            {
                fault = error.code == hd::warm_motors ? TACTUS_DEVICE_TOO_HOT : TACTUS_DEVICE_NOT_DRIVEN;
                fault_since = number;
            }
        }
        return fatal;
    }

    std::string textOf (const HdError& error) const
    {
        const char* text = hd.hdGetErrorString (error.code);
        char numbers[64];
        std::snprintf (numbers, sizeof numbers, " (error 0x%x, %d inside the library)", error.code, error.internal);
        return (text != nullptr ? text : "an error") + std::string (numbers);
    }

    /// The names that the maker's setup has stored.
    static std::string storedNames()
    {
        namespace fs = std::filesystem;
        std::string all;
        const char *own = std::getenv ("GTDD_HOME"), *set = std::getenv ("HOME"), *home = set != nullptr ? set : "";
        for (const auto& folder : { fs::path (own != nullptr ? own : ""), fs::path ("/usr/share/3DSystems"), fs::path (home) / ".3dsystems",
                                    fs::path ("/opt/geomagic_touch_device_driver") })
        {
            std::error_code failed;
            for (fs::directory_iterator at (folder / "config", failed), end; ! failed && at != end; at.increment (failed))
                if (at->path().extension() == ".config") all += (all.empty() ? "" : ", ") + at->path().stem().string();
        }
        return all.empty() ? "its setup has stored no names" : "names that its setup has stored: " + all;
    }

    std::string open (const std::vector<const char*>& names)
    {
        std::string why;
        for (const auto* name : names)
        {
            drain();
            last_error = "no reason given";
            device = hd.hdInitDevice (name);
            drain();
            if (device != hd::no_device) return {};
            why += (why.empty() ? "" : "; ") + std::string (name != nullptr ? name : "the arm without a name") + ": " + last_error;
        }
        return "no arm can be opened (" + storedNames() + "): " + why;
    }

    void describe()
    {
        hd.hdMakeCurrentDevice (device);
        const auto text = [&] (unsigned what) {
            const char* said = hd.hdGetString (what);
            return said != nullptr ? std::string (said) : std::string();
        };
        const auto number = [&] (unsigned what, int otherwise) {
            int value = otherwise;
            hd.hdGetIntegerv (what, &value);
            return value;
        };
        std::string about = text (hd::model_type).empty() ? "An arm" : text (hd::model_type);
        for (const auto& [before, what] : { std::pair { ", serial number ", hd::serial_number }, std::pair { ", firmware ", hd::firmware_version },
                                            std::pair { ", driver ", hd::driver_version }, std::pair { ", library ", hd::version } })
            if (const auto said = text (what); ! said.empty()) about += before + said;
        put (shared.model, sizeof shared.model, about);
        hd.hdGetDoublev (hd::max_force, &shared.max_force);
        hd.hdGetDoublev (hd::max_continuous_force, &shared.max_continuous_force);
        hd.hdGetDoublev (hd::usable_workspace, shared.workspace.data());
        shared.input_dof = number (hd::input_dof, 6);
        shared.output_dof = number (hd::output_dof, 3);
        styles = number (hd::calibration_styles, 0);
        turns = shared.output_dof >= 6;
        drain();
    }

    /// One tick of the library. [servo thread]
    unsigned servo()
    {
        const auto begin = nanosecondsNow();
        hd.hdMakeCurrentDevice (device);
        const bool looks = number++ % between_looks == 0;
        if (looks) calibrate();

        SharedArm::Tick tick { .number = number };
        hd.hdBeginFrame (device);
        hd.hdGetDoublev (hd::position, tick.position);
        hd.hdGetDoublev (hd::transform, tick.transform);
        int pressed = 0;
        hd.hdGetIntegerv (hd::buttons, &pressed);
        if (looks) temperature = hottest();
        if (number == 1) start();
        tick.buttons = static_cast<std::uint32_t> (pressed);
        tick.temperature = temperature;
        tick.delay_s = delay_s;
        if (fault != 0 && number - fault_since > fault_lasts) fault = 0;
        tick.fault = is_homed ? fault : std::uint32_t { TACTUS_DEVICE_NOT_HOMED };
        shared.ring[number % SharedArm::kept].store (tick);
        shared.ticks = static_cast<std::uint32_t> (number);
        wake (shared.ticks);

        const bool ends = ending || has_failed;
        const auto push = ends || ! is_homed ? SharedArm::Push {} : answer (begin);
        hd.hdSetDoublev (hd::force, push.force);
        if (turns) hd.hdSetDoublev (hd::torque, push.torque);
        hd.hdEndFrame (device);
        is_zero = is_zero || ends;
        if (const auto why = drain(); ! why.empty() && ! has_failed)
        {
            put (shared.text, sizeof shared.text, why);
            has_failed = true;
            shared.state = SharedArm::failed;
            wake (shared.ticks);
        }
        return 1;   // the main thread takes it off the schedule
    }

    void start()
    {
        int rate = 0;
        hd.hdGetIntegerv (hd::instantaneous_rate, &rate);
        shared.rate_hz = rate > 0 ? rate : wanted_rate;
        shared.state = SharedArm::ready;   // the first tick follows
    }

    void calibrate()
    {
        const auto state = hd.hdCheckCalibration();
        if (state == hd::needs_update) hd.hdUpdateCalibration (static_cast<unsigned> (styles & hd::by_itself ? hd::by_itself : hd::by_inkwell));
        is_homed = state == hd::is_calibrated;
    }

    double hottest() const
    {
        std::array<double, 6> all {};
        hd.hdGetDoublev (hd::motor_temperature, all.data());
        return *std::max_element (all.begin(), all.end());
    }

    /// The push for this tick. Waits for at most half a period for one that answers it; the last one holds until twice the time between the last two has
    /// passed, so for a run at the same rate one tick can go without an answer, and in no case longer than `patience_ns`.
    SharedArm::Push answer (std::int64_t begin)
    {
        const std::int64_t period = shared.rate_hz > 0.0 ? static_cast<std::int64_t> (1e9 / shared.rate_hz) : 1'000'000;
        const auto before = last_push;
        std::int64_t now = begin;
        if (is_pushed)   // a run that has not begun, or is at rest, does not answer
            for (; shared.pushes == before && now < begin + period / 2; now = nanosecondsNow())
                waitWhile (shared.pushes, before, begin + period / 2 - now);
        delay_s += 0.01 * (1e-9 * static_cast<double> (nanosecondsNow() - begin) - delay_s);
        last_push = shared.pushes;
        auto push = shared.push.load();
        now = nanosecondsNow();
        if (last_push != before)
        {
            apart_ns = std::clamp (push.at_ns - pushed_at, period, SharedArm::patience_ns);
            pushed_at = push.at_ns;
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

    SharedArm& shared;
    const int pipe;
    HdFunctions hd;
    unsigned device = hd::no_device;
    int styles = 0;
    bool turns = false;
    std::string last_error;
    std::atomic<bool> ending = false, is_zero = false, has_failed = false;

    // [servo thread, or before it]
    std::uint64_t number = 0, fault_since = 0;
    std::uint32_t fault = 0, last_push = 0;
    bool is_homed = false, is_pushed = false;
    double temperature = 0.0, delay_s = 0.0;
    double share = 0.0;   // of the push that the arm gets
    std::int64_t apart_ns = 0, pushed_at = 0;
};
}   // namespace

int main (int count, char** arguments)
{
    if (count < 3) return 2;
    const int memory = std::atoi (arguments[1]), pipe = std::atoi (arguments[2]);
    void* at = ::mmap (nullptr, sizeof (SharedArm), PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    if (at == MAP_FAILED) return 2;
    auto& shared = *static_cast<SharedArm*> (at);
    Helper helper (shared, pipe);
    if (count > 3) return helper.run ({ arguments[3] });
    return helper.run ({ nullptr, "Default Device", "Default PHANToM" });   // some versions of the library know one, some another
}
