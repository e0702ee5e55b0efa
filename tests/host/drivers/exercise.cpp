// SPDX-License-Identifier: MIT
// Drives the drivers of lab devices against their fakes as Tactus does, by the functions of tactus_device.h on two threads, while a fake fails in turn in
// each of its ways. It needs no tests and no nodes, so it is soon built with each sanitizer: ./test.sh --drivers. Exit status 1 if a call, or a count of a
// fake, is wrong; each helper process writes what its sanitizer finds into a file, which counts as well.

#include "exercise.hpp"
#include "support/waiting.hpp"

#include <tactus/text/json.hpp>

#include <atomic>
#include <cmath>
#include <iostream>
#include <thread>
#include <vector>

namespace tactus::test
{

namespace
{
using namespace std::chrono_literals;

int failures = 0;

void put (void* context, const char* text, std::size_t length) noexcept { static_cast<std::string*> (context)->assign (text, length); }
}   // namespace

void expect (bool is_so, const std::string& what)
{
    if (is_so) return;
    ++failures;
    std::cout << "wrong: " << what << std::endl;
}

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

namespace
{
std::vector<void (*) (const TemporaryFolder&)>& exercises()
{
    static std::vector<void (*) (const TemporaryFolder&)> all;
    return all;
}
}   // namespace

Exercise::Exercise (void (*of) (const TemporaryFolder&)) { exercises().push_back (of); }

}   // namespace tactus::test

int main()
{
    using namespace tactus;
    using namespace tactus::test;
    const TemporaryFolder folder;
    for (const auto* variable : { "ASAN_OPTIONS", "TSAN_OPTIONS", "UBSAN_OPTIONS" })   // of the helpers, which this program starts
        ::setenv (variable, ("log_path=" + (folder / "sanitizer").string()).c_str(), 1);
    ::setenv ("HOME", folder.path().c_str(), 1);
    for (auto* const exercise : exercises())
        exercise (folder);
    for (const auto& entry : std::filesystem::directory_iterator (folder.path()))
        if (const auto name = entry.path().filename().string(); name.starts_with ("sanitizer")) expect (false, "a helper: " + folder.textOf (name));
    std::cout << (failures == 0 ? "nothing is wrong" : std::to_string (failures) + " things are wrong") << std::endl;
    return failures == 0 ? 0 : 1;
}
