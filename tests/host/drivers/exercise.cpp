// SPDX-License-Identifier: MIT
// Drives the drivers of lab devices against their fakes as Tactus does, by the functions of tactus_device.h on two threads, while a fake fails in turn in
// each of its ways. It needs no tests and no nodes, so it is soon built with each sanitizer: ./test.sh --drivers. Exit status 1 if a call, or a count of a
// fake, is wrong; each helper process writes what its sanitizer finds into a file, which counts as well.

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/drivers/falcon/device.hpp>
#include <host/drivers/falcon/fake_falcon.hpp>
#include <host/drivers/forcedimension/arm.hpp>
#include <host/drivers/forcedimension/fake_drd.hpp>
#include <host/drivers/openhaptics/fake_hd.hpp>
#include <host/drivers/openhaptics/touch.hpp>
#include <tactus/text/json.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <thread>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;

namespace
{
int failures = 0;

void expect (bool is_so, const std::string& what)
{
    if (is_so) return;
    ++failures;
    std::cout << "wrong: " << what << std::endl;
}

void put (void* context, const char* text, std::size_t length) noexcept { static_cast<std::string*> (context)->assign (text, length); }

/// A use of a device, from `open` to `close`.
struct Use
{
    const char* what;
    int readings = 200;                      // until it ends
    std::function<void()> disturb = [] {};   // when half of them have come
    std::function<bool()> is_seen = {};      // the end of the use, instead of more readings
    int ends_with = TACTUS_DEVICE_OK;        // of the last read
    std::function<void()> then = [] {};      // before `close`
};

void play (const tactus_device_driver& driver, const std::string& port, const Use& use)
{
    const auto json = Json { { "port", port } }.dump();
    const tactus_device_description given { sizeof given, port.c_str(), port.empty() ? "{}" : json.c_str() };
    std::string said, read_said, write_said;
    const auto reportTo = [] (std::string& text) { return tactus_plugin_report { sizeof (tactus_plugin_report), &text, put }; };
    const auto why = reportTo (said), read_why = reportTo (read_said), write_why = reportTo (write_said);
    tactus_device_about about {};
    about.size = sizeof about;
    expect (driver.check (&given, &why) == TACTUS_DEVICE_OK, "check: " + said);
    void* device = driver.open (&given, &about, &why);
    expect (device != nullptr, std::string (use.what) + ": open: " + said);
    if (device == nullptr) return;
    driver.rest (device, &why);

    std::atomic<int> readings = 0, last = TACTUS_DEVICE_NONE;
    std::atomic<bool> is_over = false;
    std::thread reader ([&] {
        while (! is_over && last != TACTUS_DEVICE_GONE)
        {
            tactus_reading reading {};
            tactus_device_stamp stamp {};
            reading.size = sizeof reading;
            stamp.size = sizeof stamp;
            last = driver.read (device, 20, &reading, &stamp, &read_why);
            if (last == TACTUS_DEVICE_OK) ++readings;
        }
    });
    std::thread writer ([&] {
        for (int i = 0; ! is_over; ++i, test::letPass (500us))
        {
            tactus_effort effort {};
            effort.size = sizeof effort;
            effort.axis_count = static_cast<std::uint32_t> (about.effort_count);
            effort.force[i % 3] = 0.3 * std::sin (0.1 * i);
            effort.torque[i % 3] = (about.tool & TACTUS_DEVICE_TORQUE) != 0 ? 0.01 : 0.0;
            if (i % 50 == 49)
                driver.rest (device, &write_why);
            else
                driver.write (device, &effort, &write_why);
        }
        driver.rest (device, &write_why);
    });
    const auto has = [&] (int count) { return eventually ([&] { return readings >= count || last == TACTUS_DEVICE_GONE; }); };
    expect (has (use.readings / 2), "no readings come");
    use.disturb();
    if (use.ends_with == TACTUS_DEVICE_GONE)
        expect (eventually ([&] { return last == TACTUS_DEVICE_GONE; }), std::string (use.what) + ": its end is not noticed");
    else if (use.is_seen)
        expect (eventually (use.is_seen), std::string (use.what) + ": not seen");
    else
        expect (has (use.readings) && last != TACTUS_DEVICE_GONE, std::string (use.what) + ": " + read_said);
    is_over = true;
    use.then();
    reader.join();
    writer.join();
    driver.close (device);
    if (driver.find != nullptr)
    {
        const tactus_device_finder finder { sizeof finder, nullptr, [] (void*, const tactus_device_found*) {} };
        driver.find (&finder, &why);
    }
    std::cout << driver.name << ", " << use.what << ": " << readings << " readings" << std::endl;
}

/// Memory that a fake in a library maps as well.
template <typename T>
T& sharedMemory (const std::filesystem::path& file, const char* variable)
{
    const int opened = ::open (file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (opened < 0 || ::ftruncate (opened, sizeof (T)) != 0) std::abort();
    void* at = ::mmap (nullptr, sizeof (T), PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
    ::close (opened);
    if (at == MAP_FAILED) std::abort();
    ::setenv (variable, file.c_str(), 1);
    return *static_cast<T*> (at);
}

void playFalcon()
{
    using Fault = host::FakeFalcon::Fault;
    const auto& driver = host::falcon::patient_driver;
    host::FakeFalcon falcon;
    for (const auto fault : { Fault::none, Fault::shorter, Fault::shifted, Fault::noisy, Fault::changed, Fault::impossible, Fault::late })
    {
        Use use { .what = "a fault of the line", .disturb = [&] { falcon.fail (fault); }, .then = [&] { falcon.fail (Fault::none); } };
        if (fault == Fault::late) use.readings = 20;
        play (driver, falcon.port(), use);
    }
    expect (falcon.malformed == 0, "bytes outside packets");
    expect (falcon.without_homing == 0, "packets without the bit that keeps the homing");
    play (driver, falcon.port(), { .what = "unplugged", .disturb = [&] { falcon.unplug(); }, .ends_with = TACTUS_DEVICE_GONE });
}

void playForceDimension (const TemporaryFolder& folder)
{
    const auto& driver = host::forcedimension::driver;
    auto& arms = sharedMemory<host::FakeArms> (folder / "drd", "TACTUS_FAKE_DRD");
    utsname machine {};
    ::uname (&machine);
    const auto to = folder / "sdk/lib/release" / ("lin-" + std::string (machine.machine) + "-gcc");
    std::filesystem::create_directories (to);
    std::filesystem::create_symlink (std::filesystem::path (TACTUS_FAKE_LIBRARIES) / "libfake_drd.so", to / "libdrd.so.3.17.5");
    ::setenv ("FDSDK", (folder / "sdk").c_str(), 1);
    auto& arm = arms.arms[0];
    arm.wrist = arm.active_wrist = arm.gripper = arm.active_gripper = arm.ignores_silence = 1;
    for (const int count : { 12, 14, 16, 17 })
    {
        arm.status_count = count;
        play (driver, {}, { .what = "as it should be" });
    }
    for (const int cause : { 1, 2, 3, 4, 6 })
        play (driver, {}, { .what = "forces go off", .disturb = [&] { arm.off_cause = cause; } });
    play (driver, {}, { .what = "a read that takes long", .disturb = [&] { arm.read_stall_ms = 50; } });
    play (driver, {}, { .what = "a write that takes long", .disturb = [&] { arm.write_stall_ms = 50; } });
    play (driver, {}, { .what = "saturated", .disturb = [&] { arm.max_force = 0.1; }, .then = [&] { arm.max_force = 0.0; } });
    play (driver, {}, { .what = "no status", .disturb = [&] { arm.has_no_status = 1; }, .then = [&] { arm.has_no_status = 0; } });
    play (driver, {}, { .what = "unplugged", .disturb = [&] { arm.is_unplugged = 1; }, .ends_with = TACTUS_DEVICE_GONE });
    arm.is_unplugged = 0;
    play (driver, {}, { .what = "silent", .disturb = [&] { arm.is_muted = 1; }, .ends_with = TACTUS_DEVICE_GONE });
    arm.is_muted = 0;
    expect (arm.calls_after_close == 0, "calls after close");
    expect (arm.expert_violations == 0, "a setting of the arm was changed");
    expect (arm.calibrations == 0, "the arm was moved by its motors");
}

void playTouch (const TemporaryFolder& folder)
{
    const auto& driver = host::openhaptics::driver;
    auto& arms = sharedMemory<host::FakeTouches> (folder / "hd", "TACTUS_FAKE_HD");
    ::setenv ("LD_LIBRARY_PATH", (std::string (TACTUS_FAKE_LIBRARIES) + "/hd").c_str(), 1);
    auto& arm = arms.arms[0];
    arms.count = 2;
    for (const int dof : { 3, 6 })
    {
        arm.output_dof = dof;
        play (driver, {}, { .what = "as it should be" });
    }
    for (const int error : { 0x200, 0x201, 0x203, 0x204 })
        play (driver, {}, { .what = "errors", .disturb = [&] { arm.next_error = error; } });
    play (driver, {}, { .what = "a stall", .disturb = [&] { arms.stall_ms = 30; } });
    play (driver, "Second", { .what = "another arm" });
    play (driver, {}, { .what = "unplugged", .disturb = [&] { arm.is_unplugged = 1; }, .ends_with = TACTUS_DEVICE_GONE });
    arm.is_unplugged = arm.is_open = 0;
    play (driver, {}, { .what = "again" });
    expect (arms.frame_errors == 0, "frames out of order");
    expect (arms.calls_after_unschedule == 0, "calls after hdUnschedule");
    expect (arms.gets_outside_frames == 0, "calls outside of frames");
}
}   // namespace

int main()
{
    const TemporaryFolder folder;
    for (const auto* variable : { "ASAN_OPTIONS", "TSAN_OPTIONS", "UBSAN_OPTIONS" })   // of the helpers, which this program starts
        ::setenv (variable, ("log_path=" + (folder / "sanitizer").string()).c_str(), 1);
    ::setenv ("HOME", folder.path().c_str(), 1);
    playFalcon();
    playForceDimension (folder);
    playTouch (folder);
    for (const auto& entry : std::filesystem::directory_iterator (folder.path()))
        if (const auto name = entry.path().filename().string(); name.starts_with ("sanitizer")) expect (false, "a helper: " + folder.textOf (name));
    std::cout << (failures == 0 ? "nothing is wrong" : std::to_string (failures) + " things are wrong") << std::endl;
    return failures == 0 ? 0 : 1;
}
