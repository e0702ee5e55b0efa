// SPDX-License-Identifier: MIT
#include "check_driver.hpp"
#include "check_find.hpp"
#include "finding.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <host/devices/device_plugins/stamp_watch.hpp>
#include <tactus/examine/stage.hpp>
#include <tactus/text/caught.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <thread>

#include <csignal>
#include <fcntl.h>
#include <unistd.h>

namespace tactus::check_plugin
{

namespace
{
using namespace std::chrono_literals;
using examine::Stage;
using host::DeviceDriver;
using host::DriverReport;
using host::OpenedDevice;
using Clock = std::chrono::steady_clock;
using Driver = std::shared_ptr<const DeviceDriver>;

constexpr int most_cpu_seconds = 120;          // a driver may spin while it waits
constexpr unsigned longest_examination = 20;   // s; far longer than any examination takes on a busy computer
constexpr auto longest_read = 50ms, late = 50ms, longest_write = 20ms;
constexpr auto far_too_often = 20e3;   // calls per s that return at once

double secondsOf (Clock::duration d) { return std::chrono::duration<double> (d).count(); }
std::string milliseconds (Clock::duration d) { return numberText (std::round (1e4 * secondsOf (d)) / 10.0) + " ms"; }

std::string firstError (const Messages& messages)
{
    for (const auto& m : messages)
        if (m.severity == Message::Severity::error) return printable (m.where + (m.where.empty() ? "" : ": ") + m.text + " [" + m.id + "]");
    return {};
}

/// The duration of a call of the driver.
template <typename Call>
Clock::duration timeOf (const char* stage, Call&& call)
{
    Stage::enter (stage);
    const auto begin = Clock::now();
    call();
    const auto took = Clock::now() - begin;
    Stage::enter ("between two calls");
    return took;
}

//==============================================================================
// Without a device

/// Text that no driver expects.
std::vector<std::string> strangeTexts()
{
    return { "", " ", "/", "..", "%s%n%d", "\xff\xfe", "\x1b[2J", "\1", std::string (100'000, 'x'), std::string ("/nowhere/\xe2\x80") + "\xae",
             "0", "-1", "1e999" };
}

std::vector<std::string> strangeDescriptions (const DeviceDriver& driver)
{
    std::vector<std::string> all { "{}" };
    auto keys = driver.keys();
    for (const auto& key : keys)
    {
        for (const auto* value : { "null", "true", "-1", "1e308", "[]", "{}", "[[[[1]]]]", R"({"a":{"b":[1,2,{"c":null}]}})" })
            all.push_back ("{\"" + key + "\":" + value + "}");
        for (const auto& text : strangeTexts())
            all.push_back (Json { { key, text } }.dump());
    }
    return all;
}

/// `check` must answer to any description, and say why it refuses one.
std::string checkDescriptions (const Driver& driver)
{
    const auto& functions = driver->functions();
    if (functions.check == nullptr) return {};
    const bool has_port = std::ranges::count (driver->keys(), "port") > 0;
    for (const auto& port : strangeTexts())
        for (const auto& json : strangeDescriptions (*driver))
        {
            if (! has_port && ! port.empty()) continue;
            const tactus_device_description given { sizeof given, port.c_str(), json.c_str() };
            DriverReport why;
            int answer = TACTUS_DEVICE_OK;
            timeOf ("check", [&] { answer = functions.check (&given, why.to()); });
            const auto asked = "port " + quote (port) + ", " + quote (json);
            if (answer != TACTUS_DEVICE_OK && answer != TACTUS_DEVICE_FAILED) return "`check` returns " + std::to_string (answer) + " for " + asked;
            if (answer == TACTUS_DEVICE_FAILED && why.text ("").empty()) return "`check` does not say why it refuses " + asked;
        }
    return {};
}

/// A port that cannot exist must not be opened.
std::string checkPort (const Driver& driver)
{
    const auto& functions = driver->functions();
    const tactus_device_description given { sizeof given, "/nowhere/tactus-check-plugin", R"({"port":"/nowhere/tactus-check-plugin"})" };
    tactus_device_about about {};
    about.size = sizeof about;
    DriverReport why;
    void* device = nullptr;
    timeOf ("open", [&] { device = functions.open (&given, &about, why.to()); });
    if (device != nullptr)
    {
        timeOf ("close", [&] { functions.close (device); });
        return "it opens a device at a port that does not exist";
    }
    return why.text ("").empty() ? "`open` does not say why it failed" : "";
}

//==============================================================================
// With a device, which gets no force

struct Device
{
    Driver driver;
    Json description;

    /// Null, and why, if it cannot be opened.
    std::unique_ptr<OpenedDevice> open (std::string& why) const
    {
        Messages messages;
        std::unique_ptr<OpenedDevice> opened;
        timeOf ("open", [&] { opened = driver->open (description, messages); });
        why = firstError (messages);
        return opened;
    }
};

std::string checkOpen (const Device& device)
{
    std::string why;
    const auto opened = device.open (why);
    if (! opened) return why;
    const auto& about = opened->about();
    if (about.rest_reports.empty()) return {};
    const int file = ::open (about.rest_file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0)
        return "the file for its last reports, " + quotePath (about.rest_file) + ", cannot be opened while the device is open: " + std::strerror (errno);
    ::close (file);
    return {};
}

std::size_t entriesOf (const char* folder)
{
    std::error_code unseen;
    const std::filesystem::directory_iterator all (folder, unseen);
    return static_cast<std::size_t> (std::distance (begin (all), end (all)));
}

/// Opens and closes it many times.
std::string checkAgain (const Device& device, int times)
{
    std::string why;
    auto first = device.open (why);
    if (! first) return why;
    const auto about = first->about();
    timeOf ("close", [&] { first.reset(); });
    const auto files = entriesOf ("/proc/self/fd"), threads = entriesOf ("/proc/self/task");
    for (int i = 0; i < times; ++i)
    {
        auto again = device.open (why);
        if (! again) return "it opens once, but not again: " + why;
        if (! again->about().isLike (about)) return "it has other parts or limits when it is opened again";
        timeOf ("close", [&] { again.reset(); });
    }
    if (const auto now = entriesOf ("/proc/self/fd"); now > files) return "each time it is opened and closed, a file stays open";
    std::this_thread::sleep_for (100ms);   // a thread may be on its way out
    if (const auto now = entriesOf ("/proc/self/task"); now > threads) return "a thread of it runs on after `close`";
    return {};
}

/// A struct of the interface, with bytes behind it that belong to others.
template <typename T>
struct GuardedStruct
{
    T value {};
    std::array<unsigned char, 256> wall;

    GuardedStruct() { wall.fill (0xa5); }
    bool isWhole() const
    {
        return std::ranges::all_of (wall, [] (unsigned char c) { return c == 0xa5; });
    }
};

std::string checkBounds (const Device& device)
{
    GuardedStruct<tactus_device_about> about;
    about.value.size = sizeof about.value;
    auto description = device.description;
    for (const auto* key : { "driver", "guard", "about", "ui", "workspace" })   // Tactus reads these itself, and no driver gets them
        description.erase (key);
    const auto given_port = description.value ("port", Json());
    const auto json = description.dump(), port = given_port.is_string() ? given_port.get<std::string>() : std::string();
    const tactus_device_description given { sizeof given, port.c_str(), json.c_str() };
    const auto& functions = device.driver->functions();
    DriverReport why;
    void* handle = nullptr;
    timeOf ("open", [&] { handle = functions.open (&given, &about.value, why.to()); });
    if (handle == nullptr) return "it does not open: " + why.text();
    std::string fault = about.isWhole() ? "" : "`open` writes past the end of tactus_device_about";
    if (functions.rest != nullptr) timeOf ("rest", [&] { functions.rest (handle, why.to()); });
    for (int i = 0; i < 20 && fault.empty(); ++i)
    {
        GuardedStruct<tactus_reading> reading;
        GuardedStruct<tactus_device_stamp> stamp;
        reading.value.size = sizeof reading.value;
        stamp.value.size = sizeof stamp.value;
        timeOf ("read", [&] { functions.read (handle, 50, &reading.value, &stamp.value, why.to()); });
        if (! reading.isWhole()) fault = "`read` writes past the end of tactus_reading";
        if (! stamp.isWhole()) fault = "`read` writes past the end of tactus_device_stamp";
    }
    timeOf ("close", [&] { functions.close (handle); });
    return fault;
}

/// A read must end in time, with a reading or without, and must wait for its time if there is none.
std::string checkTimeout (const Device& device, int times)
{
    std::string why;
    const auto opened = device.open (why);
    if (! opened) return why;
    for (const auto timeout : { 1ms, 10ms, 50ms })
    {
        auto shortest = Clock::duration::max();   // a busy computer makes some calls longer
        int early = 0, none = 0;
        for (int i = 0; i < times; ++i)
        {
            tactus_reading reading;
            tactus_device_stamp stamp;
            DriverReport said;
            int answer = TACTUS_DEVICE_OK;
            const auto took = timeOf ("read", [&] { answer = opened->read (timeout, reading, stamp, said); });
            shortest = std::min (shortest, took);
            if (answer == TACTUS_DEVICE_FAILED && said.text ("").empty()) return "`read` fails and does not say why";
            if (answer == TACTUS_DEVICE_NONE) ++none;
            if (answer == TACTUS_DEVICE_NONE && took < timeout / 2) ++early;
        }
        const auto asked = milliseconds (timeout);
        if (shortest > 2 * timeout + late) return "`read` takes at least " + milliseconds (shortest) + ", although it may wait for " + asked;
        if (2 * early > none && early > 1) return "`read` returns without a reading long before the " + asked + " have passed";
    }
    return {};
}

/// The fault of a reading; empty if there is none.
std::string faultOf (const tactus_reading& r, const host::DriverAbout& about)
{
    if (const auto named = about.layout.axes.size(); r.axis_count < named)
        return "has " + std::to_string (r.axis_count) + " axes, but it names " + std::to_string (named);
    if (static_cast<int> (r.signal_count) < about.layout.signal_inputs) return "has fewer signals than it has signal inputs";
    if (r.axis_count > TACTUS_CHANNELS || r.signal_count > TACTUS_CHANNELS) return "has more axes or signals than there is room for";
    const auto isBad = [] (double v) { return ! std::isfinite (v); };
    if (std::ranges::any_of (r.position, isBad) || std::ranges::any_of (r.rotation, isBad) || isBad (r.pressure)) return "is not a number";
    if (std::any_of (r.axes, r.axes + r.axis_count, isBad) || std::any_of (r.signals, r.signals + r.signal_count, isBad)) return "is not a number";
    if (isBad (r.age_s) || r.age_s < 0.0 || r.age_s > 3600.0) return "has an age of " + numberText (r.age_s) + " s";
    return {};
}

std::string checkReadings (const Device& device, double seconds)
{
    std::string why;
    const auto opened = device.open (why);
    if (! opened) return why;
    const auto& about = opened->about();
    host::StampWatch watch { about.rate_hz, about.stamps };
    std::uint64_t readings = 0, calls = 0, repeated = 0, back = 0, faults = 0, after_lost = 0;
    double oldest = 0.0;
    const auto begin = Clock::now();
    for (; secondsOf (Clock::now() - begin) < seconds; ++calls)
    {
        tactus_reading reading;
        tactus_device_stamp stamp;
        DriverReport said;
        int answer = TACTUS_DEVICE_OK;
        timeOf ("read", [&] { answer = opened->read (longest_read, reading, stamp, said); });
        if (answer == TACTUS_DEVICE_GONE) return "the device is gone: " + said.text();
        if (answer != TACTUS_DEVICE_OK) continue;
        if (auto fault = faultOf (reading, about); ! fault.empty()) return "a reading " + fault;
        const auto verdict = watch (stamp, secondsOf (Clock::now().time_since_epoch()));
        ++readings;
        repeated += verdict.is_new ? 0 : 1;
        if (verdict.fault == ReadingFault::malformed) return "a reading lacks the number or the time that the driver promises for every one";
        back += verdict.has_gone_back ? 1 : 0;
        after_lost += verdict.fault == ReadingFault::lost ? 1 : 0;
        faults += stamp.fault != 0 || reading.valid == 0 ? 1 : 0;
        oldest = std::max (oldest, verdict.lag_s);
    }
    const double passed = secondsOf (Clock::now() - begin), rate = static_cast<double> (readings) / passed;
    const auto perSecond = [] (double r) { return numberText (std::round (r)) + " per s"; };
    if (const double often = static_cast<double> (calls) / passed; often > far_too_often)
        return "`read` returns at once, again and again: " + perSecond (often);
    if (readings == 0) return "no reading came within " + numberText (seconds) + " s";
    if (back > 0) return "the number or the time of a reading went back " + std::to_string (back) + " times";
    if (2 * repeated > readings) return "most readings have the number or the time of the one before";
    if (2 * after_lost > readings)
        return "most readings cannot be used, because others are missing before them: `read` must return each, one per call, the oldest first";
    if (about.rate_hz > 0.0 && (rate > 2.0 * about.rate_hz || rate < 0.5 * about.rate_hz))
        return perSecond (rate) + " readings come, but its rate is " + perSecond (about.rate_hz);
    if (oldest > 0.5) return "readings are " + numberText (std::round (oldest * 10.0) / 10.0) + " s older than they seem, by the clock of the device";
    if (faults == readings) return "no reading is valid: is the device switched on, homed and at rest?";
    return {};
}

/// The fault of an answer of write or rest; empty if there is none.
std::string faultOf (const char* function, int answer, const DriverReport& said)
{
    const auto name = std::string ("`") + function + "` ";
    if (answer == TACTUS_DEVICE_GONE) return name + "says that the device is gone: " + said.text();
    if (answer != TACTUS_DEVICE_OK) return name + "fails" + (said.text ("").empty() ? " and does not say why" : ": " + said.text());
    return {};
}

/// The fault that a function usually takes longer than it may; else empty. Single long calls are no fault, because a busy computer causes them.
std::string slowFault (const char* function, std::vector<Clock::duration>& times)
{
    std::ranges::nth_element (times, times.begin() + static_cast<std::ptrdiff_t> (times.size() / 2));
    const auto usual = times[times.size() / 2];
    return usual > longest_write ? std::string ("`") + function + "` usually takes " + milliseconds (usual) : "";
}

int writeNothing (OpenedDevice& to, DriverReport& said) { return to.write (Effort {}, false, GuardLimits::none, said); }

/// Writes no force, and brings it to rest, again and again. It must come to rest also after a write that has failed.
std::string checkRest (const Device& device, int times)
{
    std::string why;
    const auto opened = device.open (why);
    if (! opened) return why;
    std::vector<Clock::duration> writes, rests;
    const auto judge = [&] (const char* function, std::vector<Clock::duration>& times_of, auto call) {
        DriverReport said;
        int answer = TACTUS_DEVICE_OK;
        times_of.push_back (timeOf (function, [&] { answer = call (said); }));
        return faultOf (function, answer, said);
    };
    const auto write = [&] { return judge ("write", writes, [&] (DriverReport& said) { return writeNothing (*opened, said); }); };
    const auto rest = [&] { return judge ("rest", rests, [&] (DriverReport& said) { return opened->rest (said); }); };
    for (int i = 0; i < times; ++i)
    {
        std::string fault;
        for (int k = 0; k < 5 && fault.empty(); ++k)
            fault = write();
        if (const auto after = rest(); ! after.empty()) fault += (fault.empty() ? "" : "; then ") + after;
        if (! fault.empty()) return fault;
    }
    const auto slow_write = slowFault ("write", writes);
    return slow_write.empty() ? slowFault ("rest", rests) : slow_write;
}

/// Reads and writes at the same time: a read that waits must not hold up a write.
std::string checkThreads (const Device& device, double seconds)
{
    std::string why;
    const auto opened = device.open (why);
    if (! opened) return why;
    std::atomic<bool> has_begun = false, is_over = false;
    std::thread reads ([&] {
        const auto work = [&] {
            tactus_reading reading;
            tactus_device_stamp stamp;
            DriverReport said;
            while (! is_over)
            {
                has_begun = true;
                opened->read (longest_read, reading, stamp, said);
            }
        };
        if (const auto done = caught ("read", work); ! done) is_over = true;
    });
    while (! has_begun)   // a busy computer starts the thread late, and no write would meet a read
        std::this_thread::sleep_for (1ms);
    std::vector<Clock::duration> times;
    std::string fault;
    for (const auto begin = Clock::now(); secondsOf (Clock::now() - begin) < seconds && fault.empty();)
    {
        DriverReport said;
        int answer = TACTUS_DEVICE_OK;
        times.push_back (timeOf ("write", [&] { answer = times.size() % 10 == 9 ? opened->rest (said) : writeNothing (*opened, said); }));
        if (answer != TACTUS_DEVICE_OK) fault = "`write` or `rest` fails while `read` waits: " + said.text();
        std::this_thread::sleep_for (1ms);
    }
    is_over = true;
    Stage::enter ("read");
    reads.join();
    if (! fault.empty()) return fault;
    const auto slow = slowFault ("write", times);
    return slow.empty() ? slow : slow + " while `read` waits";
}

/// Looks for devices alone and while one is open, which must not be touched.
std::string checkList (const Device& device)
{
    if (auto fault = faultOfFind (*device.driver); ! fault.empty()) return fault;
    std::string why;
    const auto opened = device.open (why);
    if (! opened) return why;
    const auto list = device.driver->find();
    tactus_reading reading;
    tactus_device_stamp stamp;
    DriverReport said;
    int answer = TACTUS_DEVICE_NONE;
    for (int i = 0; i < 100 && answer == TACTUS_DEVICE_NONE; ++i)
        timeOf ("read", [&] { answer = opened->read (longest_read, reading, stamp, said); });
    return answer == TACTUS_DEVICE_OK ? "" : "after `find`, no reading comes from the device that is open";
}

//==============================================================================
struct Examination
{
    const char *id, *promise;
    bool needs_device = false;
    std::function<std::string (const Driver&, const Device&)> fault {};
};

/// Each is a promise of tactus_device.h. The level says how often and how long.
std::vector<Examination> examinations (int level)
{
    const int times = 10 * level;
    const double seconds = 0.2 * level;
    const auto alone = [] (auto f) { return [f] (const Driver& driver, const Device&) { return f (driver); }; };
    const auto with = [] (auto f, auto... more) { return [=] (const Driver&, const Device& device) { return f (device, more...); }; };
    return { { "descriptions", "it answers to every description, and says why it refuses one", false, alone (checkDescriptions) },
             { "port", "a port that does not exist is refused, with a reason", false, alone (checkPort) },
             { "open", "its parts, limits and last reports are complete", true, with (checkOpen) },
             { "again", "it can be opened many times, is always the same, and leaves nothing open", true, with (checkAgain, times) },
             { "bounds", "it fills structs only as far as they go", true, with (checkBounds) },
             { "timeout", "a read ends in time, and waits for it", true, with (checkTimeout, std::max (5, times / 2)) },
             { "readings", "readings are whole, new, and come at its rate", true, with (checkReadings, std::max (0.5, seconds)) },
             { "rest", "it takes zero efforts, and comes to rest", true, with (checkRest, times) },
             { "threads", "a read that waits does not hold up a write", true, with (checkThreads, std::max (0.5, seconds)) },
             { "find", "its list of devices is whole, always the same, and touches no device that is open", true, with (checkList) } };
}

std::string skippedFor (const Examination& e, const Options& options, const DeviceDriver& driver)
{
    if (e.needs_device && options.device.empty()) return "no device is given (--open)";
    if (std::string_view (e.id) == "port" && std::ranges::count (driver.keys(), "port") == 0) return "the driver has no key \"port\"";
    if (std::string_view (e.id) == "find" && ! driver.canFind()) return "the driver has no list of its devices";
    if (const std::string_view id = e.id; (id == "rest" || id == "threads") && driver.functions().write == nullptr) return "the driver takes no efforts";
    return {};
}

std::string examine (const Options& options, const Examination& examination)
{
    ::signal (SIGALRM, SIG_DFL);
    ::alarm (longest_examination);
    Stage::enter ("loading");
    const auto driver = DeviceDriver::load (options.file);
    if (! driver) return driver.error().text;
    if (auto reason = skippedFor (examination, options, **driver); ! reason.empty()) return skip_mark + reason;
    Json description = options.device.empty() ? Json::object() : Json::parse (options.device);
    description["driver"] = (*driver)->name();
    return examination.fault (*driver, { *driver, std::move (description) });
}
}   // namespace

std::vector<Finding> checkDriver (const Options& options)
{
    std::vector<Finding> all;
    std::string endless;
    const auto killed = "signal " + std::to_string (SIGALRM);
    for (const auto& e : examinations (options.level))
    {
        Finding f { .id = e.id, .promise = e.promise };
        if (! endless.empty())
        {
            f.verdict = Verdict::skipped;
            f.why = endless;
            all.push_back (std::move (f));
            continue;
        }
        f = finding (f.id, f.promise, runApart ({ most_cpu_seconds, most_cpu_seconds }, [&] { return examine (options, e); }));
        if (f.verdict == Verdict::fail && f.why.find (killed) != std::string::npos)
        {
            f.why = f.why.substr (0, f.why.find (':')) + ": does not return within " + std::to_string (longest_examination) + " s";
            endless = "the driver did not return in `" + f.id + "`";
        }
        all.push_back (std::move (f));
    }
    return all;
}

}   // namespace tactus::check_plugin
