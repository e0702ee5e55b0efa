// SPDX-License-Identifier: MIT
#include "driver_about.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace tactus::host
{

namespace
{
constexpr double default_ramp = 0.2;                              // in s, as for a profile without a ramp (hid::limitsOf)
constexpr double longest_watchdog = 0.5, longest_silence = 1.0;   // in s, of the device and of Tactus
constexpr double highest_rate = 10e3;                             // Hz; a driver may be called twice as often
constexpr std::size_t longest_name = 64, longest_text = 4096, longest_limits = std::size_t { 64 } * 1024;
constexpr const char* ask_author = "ask the author of the driver to correct it";

/// A check of what a driver says about its device. It reports what cannot be.
class Checker
{
public:
    explicit Checker (Messages& m) : messages (m) {}

    void bad (std::string what) { messages.push_back (Message::error ("device/bad_driver", "", "the driver " + std::move (what), ask_author)); }

    std::string text (const char* from, std::size_t longest, const char* what)
    {
        if (from == nullptr) return {};
        const auto* end = static_cast<const char*> (std::memchr (from, 0, longest + 1));
        if (end != nullptr) return { from, end };
        bad ("gives more than " + std::to_string (longest) + " bytes as " + what);
        return {};
    }

    std::vector<std::string> names (const char* const* from, std::size_t count, std::size_t most, const char* what, bool may_lack_name)
    {
        std::vector<std::string> all;
        if (count > most || (count > 0 && from == nullptr))
        {
            bad ("gives " + std::to_string (count) + " " + what + (from == nullptr ? " but no names" : "; at most " + std::to_string (most) + " are possible"));
            return all;
        }
        for (std::size_t i = 0; i < count; ++i)
        {
            auto name = text (from[i], longest_name, "a name");
            const bool lacks_name = name.empty() && may_lack_name;
            if (! lacks_name && ! graph::isId (name)) bad ("names one of its " + std::string (what) + " " + quote (name) + ", not with a to z, digits and _");
            if (! lacks_name && std::ranges::count (all, name) > 0) bad ("names two of its " + std::string (what) + " " + quote (name));
            all.push_back (std::move (name));
        }
        return all;
    }

    int channels (std::int32_t count, const char* what)
    {
        if (count >= 0 && count <= Channels::most) return count;
        bad ("gives " + std::to_string (count) + " " + what + "; 0 to " + std::to_string (Channels::most) + " are possible");
        return 0;
    }

    double number (double value, double most, const char* what)
    {
        if (isFinite (value) && value >= 0.0 && value <= most) return value;
        bad (std::string ("gives ") + what + " that cannot be");
        return 0.0;
    }

private:
    Messages& messages;
};

/// The limits of a device that takes efforts must end them all.
void checkLimits (const DriverAbout& a, Messages& messages)
{
    const auto need = [&] (bool is_needed, double limit, const char* key, const char* what) {
        if (is_needed && ! (limit < GuardLimits::none))
            messages.push_back (Message::error ("device/no_limits", "", std::string ("the driver takes ") + what + ", but gives no " + key,
                                                "ask the author of the driver to add it"));
    };
    need (a.force, a.limits.max_force, "max_force", "a force");
    need (a.torque, a.limits.max_torque, "max_torque", "a torque");
    need (! a.layout.efforts.empty(), a.limits.max_axis_effort, "max_axis_effort", "efforts on axes");
    need (a.layout.signal_outputs > 0, a.limits.max_signal, "max_signal", "signals");
    if (a.stamps == 0)
    {
        // Without a number and a clock, a device that repeats a reading forever looks like one that measures.
        const auto needStill = [&] (bool is_needed, double least, const char* key, const char* what, const char* where) {
            if (is_needed && ! (a.limits.max_still < GuardLimits::none && least < GuardLimits::none))
                messages.push_back (Message::error ("device/no_limits", "",
                                                    std::string ("a frozen reading would not be noticed: the driver takes ") + what + " along the " + where
                                                        + " that it reads, but its readings have neither a number nor a time (`stamps`), and it gives no "
                                                          "max_still with "
                                                        + key,
                                                    std::string ("ask the author of the driver to add a number, a time, or max_still and ") + key));
        };
        needStill (a.force && a.position, a.limits.still_force, "still_force", "a force", "position");
        needStill (a.torque && a.rotation, a.limits.still_torque, "still_torque", "a torque", "rotation");
    }
    checkStops (a.limits, "", messages);
    if (a.takesEfforts() && a.rest_reports.empty() && ! (a.device_watchdog_s > 0.0 && a.device_watchdog_s <= longest_watchdog))
        messages.push_back (Message::error ("device/no_failsafe", "",
                                            "if this program dies, nothing brings the device to rest: the driver names neither a file for the last reports "
                                            "nor a watchdog of the device of at most "
                                                + numberText (longest_watchdog) + " s",
                                            "ask the author of the driver to add one of them"));
}

void readFailsafe (const tactus_device_about& given, DriverAbout& to, Checker& check)
{
    to.rest_file = check.text (given.rest_file, longest_text, "the file for its last reports");
    if (to.rest_file.empty())
    {
        if (given.rest_report_count > 0) check.bad ("gives reports that bring the device to rest, but no file for them");
        return;
    }
    if (to.rest_file.front() != '/') return check.bad ("gives a file for its last reports that does not begin with '/'");
    if (given.rest_report_count == 0 || given.rest_report_count > Failsafe::most_reports || given.rest_reports == nullptr)
        return check.bad ("gives " + std::to_string (given.rest_report_count) + " reports that bring the device to rest; 1 to "
                          + std::to_string (Failsafe::most_reports) + " are possible");
    std::size_t bytes = 0;
    for (std::size_t i = 0; i < given.rest_report_count; ++i)
    {
        const auto* report = given.rest_reports[i];
        const bool is_whole = report != nullptr && report->size >= sizeof *report && report->bytes != nullptr && report->count > 0;
        bytes += is_whole ? report->count : 0;
        if (! is_whole || report->count > Failsafe::most_bytes || bytes > Failsafe::most_bytes)
            return check.bad ("gives a report that brings the device to rest without bytes, or with too many");
        to.rest_reports.push_back ({ { report->bytes, report->bytes + report->count }, false });
    }
}
}   // namespace

bool DriverAbout::isLike (const DriverAbout& other) const
{
    const auto tool = [] (const DriverAbout& a) { return std::array { a.position, a.rotation, a.pressure, a.force, a.torque }; };
    return tool (*this) == tool (other) && layout == other.layout && rate_hz == other.rate_hz && limits == other.limits
           && rest_reports.empty() == other.rest_reports.empty() && device_watchdog_s == other.device_watchdog_s && unrendered == other.unrendered
           && stamps == other.stamps;
}

DriverAbout readAbout (const tactus_device_about& given, bool can_write, Messages& messages)
{
    Checker check (messages);
    DriverAbout a;
    const auto has = [&] (std::uint32_t part) { return (given.tool & part) != 0; };
    a.position = has (TACTUS_DEVICE_POSITION);
    a.rotation = has (TACTUS_DEVICE_ROTATION);
    a.pressure = has (TACTUS_DEVICE_PRESSURE);
    a.force = has (TACTUS_DEVICE_FORCE);
    a.torque = has (TACTUS_DEVICE_TORQUE);
    if (given.tool >= 2 * TACTUS_DEVICE_TORQUE) check.bad ("gives its tool a part that this version of Tactus does not know");
    constexpr std::uint32_t no_force = TACTUS_DEVICE_NO_FORCE_X | TACTUS_DEVICE_NO_FORCE_Y | TACTUS_DEVICE_NO_FORCE_Z,
                            no_torque = TACTUS_DEVICE_NO_TORQUE_X | TACTUS_DEVICE_NO_TORQUE_Y | TACTUS_DEVICE_NO_TORQUE_Z;
    if (given.unrendered > (no_force | no_torque)) check.bad ("names a direction without a motor that this version of Tactus does not know");
    if (given.stamps > (TACTUS_DEVICE_NUMBERS | TACTUS_DEVICE_TIMES)) check.bad ("names a stamp that this version of Tactus does not know");
    a.stamps = given.stamps;
    a.unrendered = given.unrendered | (a.force ? 0u : no_force) | (a.torque ? 0u : no_torque);
    a.about = printableName (check.text (given.about, longest_text, "a sentence"));

    a.layout.axes = check.names (given.axes, given.axis_count, Channels::most, "axes", false);
    a.layout.efforts = check.names (given.efforts, given.effort_count, Channels::most, "efforts", false);
    a.layout.buttons = check.names (given.buttons, given.button_count, Reading::most_buttons, "buttons", true);
    a.layout.signal_inputs = check.channels (given.signal_inputs, "signal inputs");
    a.layout.signal_outputs = check.channels (given.signal_outputs, "signal outputs");
    a.layout.mechanics = { check.number (given.mass, 1e3, "a mass"), check.number (given.damping, 1e6, "a damping") };
    a.rate_hz = check.number (given.rate_hz, highest_rate, "a rate");
    a.device_watchdog_s = check.number (given.device_watchdog_s, 1e9, "a watchdog of the device");
    if (a.takesEfforts() && ! can_write) check.bad ("gives the device something that pushes, but has no `write` and `rest`");
    readFailsafe (given, a, check);

    if (const auto guard = check.text (given.guard, longest_limits, "its limits"); ! guard.empty())
    {
        if (const auto json = Json::tryParse (guard); json && json->is_object())
            a.limits = readGuardLimits (*json, "", messages, a.layout);
        else
            check.bad ("gives limits that are not a JSON object");
    }
    if (a.takesEfforts())
    {
        if (a.limits.ramp == 0.0) a.limits.ramp = default_ramp;
        if (a.limits.watchdog == GuardLimits::none) a.limits.watchdog = GuardLimits::default_watchdog;
        if (a.limits.watchdog > longest_silence) check.bad ("gives a watchdog of more than " + numberText (longest_silence) + " s");
    }
    checkLimits (a, messages);
    return a;
}

Result<std::optional<Failsafe>> armFailsafe (const DriverAbout& a)
{
    if (! a.takesEfforts()) return std::optional<Failsafe> {};
    const bool has_file = ! a.rest_reports.empty();
    auto armed = has_file ? Failsafe::arm (a.rest_file, a.rest_reports) : Failsafe::arm ("/dev/null", { { { 0 }, false } });
    if (armed) return std::optional<Failsafe> (std::move (*armed));
    if (armed.error().id == "device/no_failsafe") return std::optional<Failsafe> {};
    auto why = std::move (armed).error();
    why.text = "if this program dies, nothing brings the device to rest: " + (has_file ? a.rest_file + ": " : std::string()) + why.text;
    return why;
}

}   // namespace tactus::host
