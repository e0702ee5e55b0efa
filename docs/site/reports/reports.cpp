// SPDX-License-Identifier: MIT
// The module reports.wasm of the playground: the program's own reader of profiles, reader and judge of reports, and limits of motors and rumble.
// docs/site/playground/reports.js calls it. A module holds one device.
#include <host/devices/hid/match.hpp>
#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/hid/reading_judge.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/run/log/run_head.hpp>
#include <tactus/text/json.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

// The functions that the libraries call when they cannot go on. Those of the C library print, for which the module would have to import a system.
// An exception ends the module, too: the page then gets an error from the call, and no report.
extern "C" void __abort_message (const char*, ...) { __builtin_trap(); }
extern "C" void __assert_fail (const char*, const char*, int, const char*) { __builtin_trap(); }
extern "C" void* __cxa_allocate_exception (std::size_t) noexcept { __builtin_trap(); }
extern "C" void __cxa_throw (void*, void*, void* (*)(void*)) { __builtin_trap(); }
void std::__libcpp_verbose_abort (const char*, ...) noexcept { __builtin_trap(); }

namespace tactus::host::hid
{
namespace
{
/// The device, once its profile has been read.
struct Opened
{
    explicit Opened (std::shared_ptr<const Profile> profile) : model (std::move (profile)), judge (model)
    {
        judge.reconnect();
        const auto& given = model.limits();
        rumble_limits.max_signal = given.max_signal;
        rumble_limits.max_signal_slew = given.max_signal_slew;
        rumble_limits.ramp = given.ramp;
        rumble_limits.watchdog = given.watchdog == GuardLimits::none ? GuardLimits::default_watchdog : given.watchdog;
        rest();
    }

    void rest() noexcept
    {
        model.rest();
        rumble_guard.prepare (rumble_limits, model.outputs() > 0 ? 1.0 / model.profile().outputs.front().max_rate : 1e-3);
    }

    HidModel model;
    ReadingJudge judge;
    GuardLimits rumble_limits;
    Guard rumble_guard;   // of all signals: they get the same rumble
};

std::optional<Opened> device;
Bytes input;          // what the page passes: text, or a report
std::string answer;   // what it gets: text, or a report

struct
{
    double position[3], rotation[3], pressure, age, valid, fault, buttons, axes[most_axes];
} reading;
struct
{
    double force[3], torque[3], rumble;
} effort;

std::string_view inputText (int size) { return { reinterpret_cast<const char*> (input.data()), static_cast<std::size_t> (size) }; }

void reply (std::span<const std::uint8_t> bytes) { answer.assign (bytes.begin(), bytes.end()); }

bool hasEffort (const Profile& p)
{
    const auto named = [] (const auto& names) { return std::ranges::any_of (names, [] (const auto& name) { return ! name.empty(); }); };
    return named (p.force) || named (p.torque);
}

/// The reason why a page cannot drive a device with this profile; empty if it can.
std::string whyNot (const Profile& p)
{
    if (p.outputs.size() != 1) return "it has " + std::to_string (p.outputs.size()) + " output reports; a page sends only one";
    const auto& out = p.outputs.front();
    if (out.is_feature) return "its output is a feature report";
    if (out.stream) return "its output carries samples of sound";
    if (! p.init.empty()) return "it has to be set up before it is used (init)";
    if (std::ranges::any_of (p.exit, [] (const Step& step) { return step.kind != Step::Kind::output; })) return "its exit needs a feature report";
    if (hasEffort (p) && sendsOnlyChanges (p)) return "it sends only changes, and a page cannot ask it for its state (only_changes)";
    return {};
}

Json listOf (const std::vector<std::string>& all)
{
    auto list = Json::array();
    for (const auto& one : all)
        list.push_back (one);
    return list;
}

/// The names, units and limits of the device for the page, as JSON, without limits that are not set.
std::string about()
{
    const auto& p = device->model.profile();
    auto limits = Json::object ({}), exit = Json::array(), faults = Json::array();
    auto guard = device->model.limits();
    if (guard.watchdog == GuardLimits::none) guard.watchdog = GuardLimits::default_watchdog;
    for (const auto& [key, value] : guard_fields)
        if (value != &GuardLimits::workspace_scale && std::isfinite (guard.*value)) limits[key] = guard.*value;
    for (const auto& step : p.exit)
    {
        auto bytes = Json::array();
        for (const auto byte : step.bytes)
            bytes.push_back (byte);
        exit.push_back (std::move (bytes));
    }
    for (const auto& fault : reading_faults)
        faults.push_back (std::string (fault.words));
    return Json::object ({ { "id", p.id },
                           { "name", p.name },
                           { "why_not", whyNot (p) },
                           { "has_force", hasEffort (p) },
                           { "axes", listOf (device->model.axisNames()) },
                           { "buttons", listOf (device->model.buttonNames()) },
                           { "limits", std::move (limits) },
                           { "device_watchdog", p.limits.device_watchdog },
                           { "max_rate", p.outputs.empty() ? 0.0 : p.outputs.front().max_rate },
                           { "exit", std::move (exit) },
                           { "faults", std::move (faults) } })
        .dump();
}

void copy (const Vec3& from, double (&to)[3])
{
    for (int i = 0; i < 3; ++i)
        to[i] = from[i];
}

Nanoseconds nanoseconds (double ms) { return static_cast<Nanoseconds> (ms * 1e6) + 1; }   // 0 means never
}   // namespace

//==============================================================================

#define EXPORT(name) extern "C" __attribute__ ((export_name (#name)))

/// Room for so many bytes, which the next call reads.
EXPORT (input)
void* moduleInput (int size)
{
    input.resize (static_cast<std::size_t> (size));
    return input.data();
}
EXPORT (answer)
const void* moduleAnswer() { return answer.data(); }
EXPORT (answer_size)
int moduleAnswerSize() { return static_cast<int> (answer.size()); }
EXPORT (reading)
const void* moduleReading() { return &reading; }
EXPORT (effort)
void* moduleEffort() { return &effort; }

/// Reads a profile. The answer is what the page has to know of it, or if this is false, what is wrong.
EXPORT (open)
bool moduleOpen (int size)
{
    const auto loaded = readProfileText (inputText (size));
    answer.clear();
    if (loaded.profile)
    {
        device.emplace (loaded.profile);
        answer = about();
        return true;
    }
    for (const auto& message : loaded.messages)
        answer += (answer.empty() ? "" : "; ") + describe (message);
    return false;
}

/// The fit of the profile to a device whose product name is the input: higher is better.
EXPORT (fit)
int moduleFit (int vid, int pid, int usage_page, int usage, int size)
{
    return fit (device->model.profile(), { .vid = static_cast<std::uint16_t> (vid),
                                           .pid = static_cast<std::uint16_t> (pid),
                                           .usage_page = static_cast<std::uint16_t> (usage_page),
                                           .usage = static_cast<std::uint16_t> (usage),
                                           .product = std::string (inputText (size)) });
}

/// Takes a report, as HidModel::decode, and fills the reading.
EXPORT (take)
void moduleTake (int size, double at_ms, double driven_s)
{
    const auto now = nanoseconds (at_ms);
    device->judge.begin();
    device->judge.take (std::span (input).first (static_cast<std::size_t> (size)), now);
    const auto r = device->judge.reading ({ .now = now, .driven_s = driven_s });
    copy (r.position, reading.position);
    copy (r.rotation, reading.rotation);
    reading.pressure = r.pressure;
    reading.age = r.age;
    reading.valid = r.valid ? 1.0 : 0.0;
    reading.fault = static_cast<double> (r.fault);
    reading.buttons = static_cast<double> (r.buttons);
    for (std::size_t i = 0; i < device->model.axisNames().size(); ++i)
        reading.axes[i] = r.axes[static_cast<int> (i)];
}

/// The answer is the report that drives the device with the effort, after the limits of its motors, and with the rumble as the guard passes it.
/// `passed_s`: the time since the last drive or rest. `age_s`: the age of the last reading.
EXPORT (drive)
void moduleDrive (double passed_s, double age_s)
{
    auto& model = device->model;
    Effort wanted;
    wanted.signals.set (0, effort.rumble);
    Reading last;
    last.valid = reading.valid != 0.0;
    last.age = age_s;
    const double rumble = device->rumble_guard (wanted, last, passed_s).signals[0];

    HidEffort asked { Vec3 (effort.force[0], effort.force[1], effort.force[2]), Vec3 (effort.torque[0], effort.torque[1], effort.torque[2]),
                      model.restEfforts() };
    for (const auto& signal : model.profile().signals)
        if (const auto& names = model.effortNames(); ! signal.amplitude.empty())
            asked.efforts[static_cast<std::size_t> (std::ranges::find (names, signal.amplitude) - names.begin())] = rumble;
    reply (model.encodeValues (0, model.drive (asked, passed_s)));
}

/// The answer is the report that lets the motors go.
EXPORT (rest)
void moduleRest()
{
    device->rest();
    reply (device->model.neutral (0));
}

}   // namespace tactus::host::hid
