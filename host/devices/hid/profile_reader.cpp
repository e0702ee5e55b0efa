// SPDX-License-Identifier: MIT
#include "profile_reader.hpp"
#include "hex.hpp"
#include "physics.hpp"
#include <host/devices/hid/profile/kinematics_reader.hpp>
#include <host/devices/hid/profile/profile_check.hpp>
#include <host/devices/hid/profile/report_reader.hpp>

#include <tactus/run/device/guard_limits.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::host::hid
{
namespace
{

std::vector<MatchRule> readMatch (ProfileFields& profile)
{
    std::vector<MatchRule> rules;
    const bool is_numbers_only = profile.has ("physics") && ! profile.has ("inputs") && ! profile.has ("outputs");
    if (! is_numbers_only && ! profile.has ("wires"))
        profile.require ("match", "write \"match\": [{\"vid\": \"0x1209\", \"pid\": \"0x0001\"}] with the numbers of the device, "
                                  "or for a serial line \"wires\": {\"serial\": {}}");
    profile.each ("match", [&] (ProfileFields& in) {
        MatchRule rule;
        rule.vid = in.ids ("vid");
        rule.pid = in.ids ("pid");
        if (const auto page = in.id ("usage_page", 0xffff)) rule.usage_page = static_cast<std::uint16_t> (*page);
        if (const auto usage = in.id ("usage", 0xffff)) rule.usage = static_cast<std::uint16_t> (*usage);
        rule.interface_number = in.id ("interface", 255);
        rule.product = in.text ("product");

        const auto bus = in.text ("bus");
        if (bus == "usb") rule.bus = Bus::usb;
        if (bus == "bluetooth") rule.bus = Bus::bluetooth;
        if (! bus.empty() && ! rule.bus) in.error ("bus", "profile/kind", quote (bus) + " is not a bus", "write usb or bluetooth");
        if (rule.vid.empty() && rule.product.empty() && ! rule.usage_page)
            in.error ("vid", "profile/missing", "this rule would fit almost any device", "add a vid, a product or a usage page");
        rules.push_back (std::move (rule));
    });
    return rules;
}

SerialWire readSerial (ProfileFields& in)
{
    SerialWire serial;
    serial.baud = in.whole ("baud", 300, 20'000'000, serial.baud);
    const auto framing = in.text ("framing");
    constexpr std::pair<std::string_view, Framing> all[] {
        { "none", Framing::none }, { "cobs", Framing::cobs }, { "length", Framing::length }, { "dualpanto", Framing::dualpanto }, { "answer", Framing::answer }
    };
    const auto* it = std::ranges::find (all, framing, [] (const auto& f) { return f.first; });
    if (! in.has ("framing"))
        in.require ("framing", "write none, cobs, length, dualpanto or answer");
    else if (it == std::end (all))
        in.error ("framing", "profile/kind", quote (framing) + " is not a framing", "write none, cobs, length, dualpanto or answer");
    else
        serial.framing = it->second;
    if (const auto filler = in.id ("filler", 255)) serial.filler = static_cast<std::uint8_t> (*filler);
    if (serial.filler && serial.framing != Framing::answer)
        in.error ("filler", "profile/wire", "only a device that answers needs a filler", "leave it out, or choose the framing answer");
    return serial;
}

Wires readWires (ProfileFields& profile)
{
    Wires wires;
    profile.within ("wires", [&] (ProfileFields& in) {
        in.within ("serial", [&] (ProfileFields& serial) { wires.serial = readSerial (serial); });
        in.within ("udp", [&] (ProfileFields&) { wires.udp = true; });
        if (! wires.any()) in.error ("", "profile/missing", "no wire is named", "write \"serial\" or \"udp\", or leave \"wires\" out");
    });
    return wires;
}

std::vector<Step> readSteps (ProfileFields& profile, std::string_view key)
{
    std::vector<Step> steps;
    profile.each (key, [&] (ProfileFields& in) {
        Step step;
        in.ignore ("about");
        const auto kind = in.has ("kind") ? in.text ("kind") : std::string ("output");
        if (kind == "feature")
            step.kind = Step::Kind::feature;
        else if (kind == "get_feature")
            step.kind = Step::Kind::get_feature;
        else if (kind != "output")
            in.error ("kind", "profile/kind", quote (kind) + " is not a kind of report", "write output, feature or get_feature");
        step.bytes = in.has ("bytes") ? in.hex ("bytes") : Bytes {};
        step.delay = in.number ("delay", unit::second, { .min = 0.0, .max = 10.0 }, 0.0);
        steps.push_back (std::move (step));
    });
    return steps;
}

/// The unit of the efforts that render the force; empty if there are none.
std::string motorUnit (const Profile& p)
{
    for (const auto& report : p.outputs)
        for (const auto& field : report.fields)
            if (! field.name.empty() && std::ranges::count (p.force, field.name) > 0) return field.unit;
    return {};
}

/// True if both texts name the same unit, as "N/s" and "kg*m/s3" do. A unit that Tactus does not know, such as A, equals only itself.
bool isSameUnit (const std::string& a, const std::string& b)
{
    if (a == b) return true;
    const auto x = parseMeasure ("1 " + a), y = parseMeasure ("1 " + b);
    return x && y && x->value == y->value && x->dimension == y->dimension && x->angular == y->angular;
}

/// Reads a limit of the motors, which may be a bare number, since Tactus does not know all units of motors.
double motorLimit (ProfileFields& in, const char* key, const std::string& unit)
{
    const auto [value, given] = in.scale (key, GuardLimits::none);
    if (! (value > 0.0)) in.error (key, "profile/out_of_range", std::string (key) + " must be greater than 0", "write a number greater than 0");
    if (! given.empty() && ! isSameUnit (given, unit))
        in.error (key, "profile/unit", std::string (key) + " is in " + given + ", but the motors of this profile need " + unit,
                  "write a number in " + unit);
    return value;
}

std::vector<Alarm> readAlarms (ProfileFields& profile)
{
    std::vector<Alarm> alarms;
    profile.each ("alarms", [&] (ProfileFields& in) {
        Alarm alarm;
        in.ignore ("about");
        alarm.field = in.name ("field");
        if (const auto raw = in.id ("is", 0x7fffffff)) alarm.is = static_cast<std::uint32_t> (*raw);
        alarm.while_driven = in.number ("while_driven", unit::second, { .min = 0.0, .max = 10.0 }, 0.0);
        const auto means = in.text ("means");
        std::string known;
        bool is_known = false;
        for (std::size_t i = 0; i < reading_faults.size(); ++i)
        {
            const auto fault = static_cast<ReadingFault> (i);
            if (! isAlarm (fault)) continue;
            addToList (known, reading_faults[i].id);
            if (means != reading_faults[i].id) continue;
            alarm.means = fault;
            is_known = true;
        }
        if (! in.has ("means"))
            in.require ("means", "write one of " + known);
        else if (! is_known)
            in.error ("means", "profile/kind", quote (means) + " is not an alarm", "write one of " + known);
        alarms.push_back (std::move (alarm));
    });
    return alarms;
}

Limits readLimits (ProfileFields& profile, const std::string& motor_unit)
{
    constexpr auto any = Bounds::notNegative();
    constexpr auto some = Bounds::positive();
    Limits l;
    profile.within ("limits", [&] (ProfileFields& in) {
        readEffortLimits (in, l.guard);
        checkStops (l.guard, in.where(), in.messages());
        l.guard.ramp = in.number ("ramp", unit::second, any, l.guard.ramp);
        l.guard.watchdog = in.number ("stale_input", unit::second, some, l.guard.watchdog);
        l.max_motor = motorLimit (in, "max_motor", motor_unit);
        l.max_motor_slew = motorLimit (in, "max_motor_slew", motor_unit + "/s");
        l.still_travel = in.number ("still_travel", unit::metre, some, l.still_travel);
        l.max_stiffness = in.number ("max_stiffness", unit::stiffness, any, l.max_stiffness);
        l.max_damping = in.number ("max_damping", unit::damping, any, l.max_damping);
        l.device_damping = in.number ("device_damping", unit::damping, any, 0.0);
        l.first_mode = in.number ("first_mode", unit::hertz, any, 0.0);
        l.position_quantum = in.number ("position_quantum", unit::metre, any, 0.0);
        l.force_quantum = in.number ("force_quantum", unit::newton, any, 0.0);
        l.device_watchdog = in.number ("device_watchdog", unit::second, any, 0.0);
    });
    return l;
}

/// Reads {"x": 1.5, …}. Units are allowed, as everywhere.
std::vector<std::pair<std::string, double>> readValues (ProfileFields& in, std::string_view key)
{
    std::vector<std::pair<std::string, double>> values;
    in.within (key, [&] (ProfileFields& all) {
        if (! all.json().is_object()) return;
        for (const auto& [name, value] : all.json().items())
            values.emplace_back (name, all.scale (name, 0.0).value);
    });
    return values;
}

std::vector<GoldenSample> readSamples (ProfileFields& profile)
{
    std::vector<GoldenSample> samples;
    profile.each ("samples", [&] (ProfileFields& in) {
        GoldenSample s;
        s.about = in.text ("about");
        s.source = in.text ("source");
        s.captured = in.flag ("captured");
        for (const auto& text : in.texts ("input"))
            if (const auto bytes = bytesOf (text))
                s.input.push_back (*bytes);
            else
                in.error ("input", "profile/hex", quote (text) + " is not a list of bytes", "write two hexadecimal digits per byte");
        if (in.has ("output"))
        {
            s.output = in.text ("output");
            s.values = readValues (in, "asked");
            for (const double sample : in.numbers ("stream"))
                s.samples.push_back (static_cast<float> (sample));
            s.expected = in.has ("report") ? in.hex ("report") : Bytes {};
            if (s.expected.empty())
                in.error ("report", "profile/missing", "the sample has no expected report", "write \"report\": the bytes that must be sent");
        }
        else
        {
            s.values = readValues (in, "gives");
            s.pressed = in.texts ("pressed");
            if (s.input.empty())
                in.error ("input", "profile/missing", "the sample has no report", "write \"input\": [\"01 00 ff\"], or \"output\": the name of a report");
        }
        samples.push_back (std::move (s));
    });
    return samples;
}

Profile read (ProfileFields& in)
{
    Profile p;
    in.ignore ("$schema");
    in.ignore ("ui");
    if (in.text ("format") != "tactus-profile") in.error ("format", "profile/format", "this is not a device profile", "write \"format\": \"tactus-profile\"");
    if (in.whole ("version", 1, 1000, 1) != 1)
        in.error ("version", "profile/format", "the version of the profile's format is newer than 1", "update Tactus, or write \"version\": 1");
    p.id = in.name ("id");
    if (p.id == "auto" || p.id == "pid")
        in.error ("id", "profile/name", quote (p.id) + " does not name a profile: hid:" + p.id + " means any device that fits", "give the profile another id");
    in.require ("name", "write \"name\": the usual name of the device");
    p.name = in.text ("name");
    p.about = in.text ("about");

    p.match = readMatch (in);
    p.wires = readWires (in);
    p.init = readSteps (in, "init");
    p.exit = readSteps (in, "exit");
    if (in.has ("replaces")) p.replaces = in.name ("replaces");
    p.inputs = readInputs (in);
    p.outputs = readOutputs (in, readTables (in));

    p.position = in.threeNames ("position");
    p.rotation = in.threeNames ("rotation");
    p.force = in.threeNames ("force");
    p.torque = in.threeNames ("torque");
    if (in.has ("pressure")) p.pressure = in.name ("pressure");
    if (in.has ("valid")) p.valid = in.name ("valid");
    p.alarms = readAlarms (in);
    in.each ("signals", [&] (ProfileFields& s) {
        s.require ("amplitude", "name the effort that sets the amplitude");
        auto& signal = p.signals.emplace_back();
        if (s.has ("amplitude")) signal.amplitude = s.name ("amplitude");
        if (s.has ("frequency")) signal.frequency = s.name ("frequency");
    });
    p.axes = readAxes (in);
    p.kinematics = readKinematics (in);
    p.limits = readLimits (in, motorUnit (p));
    p.physics = readPhysics (in);
    p.rate = in.number ("rate", unit::hertz, Bounds::positive(), 0.0);
    p.quirks = in.texts ("quirks");
    p.sources = in.texts ("sources");
    if (p.sources.empty())
        in.error ("sources", "profile/missing", "the profile names no sources", "write \"sources\": [\"…\"]: a document, a repository, or your own firmware");
    p.samples = readSamples (in);
    checkProfile (p, in);
    in.finish();
    return p;
}

}   // namespace

LoadedProfile readProfile (const Json& json)
{
    LoadedProfile loaded;
    ProfileFields in (json, "", loaded.messages);
    auto profile = read (in);
    if (! hasErrors (loaded.messages)) loaded.profile = std::make_shared<const Profile> (std::move (profile));
    return loaded;
}

LoadedProfile readProfileText (std::string_view text)
{
    const auto json = readJson (text);
    if (hasErrors (json.messages)) return { .profile = {}, .messages = json.messages };
    auto loaded = readProfile (json.root);
    for (auto& m : loaded.messages)
    {
        const auto at = positionOf (json.positions, m.where);
        m.line = at.line;
        m.column = at.column;
    }
    return loaded;
}

}   // namespace tactus::host::hid
