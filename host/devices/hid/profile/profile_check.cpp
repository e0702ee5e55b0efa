// SPDX-License-Identifier: MIT
#include "profile_check.hpp"
#include <host/devices/hid/bits.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/hid/report/report_encoder.hpp>

#include <tactus/node/device.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace tactus::host::hid
{
namespace
{
/// Names with their units; the first occurrence of a name sets its unit.
class Names
{
public:
    void add (const std::string& name, const std::string& unit)
    {
        if (name.empty()) return;
        const auto [it, is_new] = units.try_emplace (name, unit);
        if (is_new) list.push_back (name);
        if (it->second != unit) conflict = name;
    }

    bool has (const std::string& name) const { return units.contains (name); }
    const std::string& unitOf (const std::string& name) const { return units.at (name); }

    std::vector<std::string> list;
    std::string conflict;   // a name with two units

private:
    std::map<std::string, std::string> units;
};

class Check
{
public:
    Check (const Profile& profile, ProfileFields& fields) : p (profile), in (fields)
    {
        for (const auto& report : p.inputs)
            for (const auto& field : report.fields)
            {
                if (field.isAxis()) axes.add (field.name, field.unit);
                for (const auto& button : field.buttons)
                    buttons.add (button, "1");
            }
        for (const auto& report : p.outputs)
        {
            for (const auto& field : report.fields)
                if (field.source == OutputField::Source::effort) efforts.add (field.name, field.unit);
            outputs.add (report.name, "1");
        }
    }

    void all()
    {
        if (p.inputs.empty() && p.outputs.empty() && ! isNumbersOnly (p))
            in.error ("inputs", "profile/missing", "the profile has no reports",
                      "add \"inputs\" or \"outputs\"; for a device that Tactus cannot open, add \"physics\" and remove \"match\"");
        count ("inputs", "axes", axes, most_axes);
        count ("inputs", "buttons", buttons, 32);
        count ("outputs", "efforts", efforts, most_efforts);

        const bool direct = std::holds_alternative<DirectKinematics> (p.kinematics);
        three ("position", p.position, axes, direct ? "m" : "");
        three ("rotation", p.rotation, axes, "rad");
        three ("force", p.force, efforts, direct ? "N" : "");
        noCurrents();
        three ("torque", p.torque, efforts, "N*m");
        twice();
        known ("pressure", p.pressure, axes, "N");
        known ("valid", p.valid, axes, "");
        for (const auto& alarm : p.alarms)
            known ("alarms", alarm.field, axes, "");
        signals();
        joints();
        neutrals();
        limits();
        echoes();
        steps();
        wires();
        for (const auto& sample : p.samples)
            golden (sample);
    }

private:
    void count (std::string_view key, const std::string& what, const Names& names, std::size_t most)
    {
        if (names.list.size() > most)
            in.error (key, "profile/too_many", "there are " + std::to_string (names.list.size()) + " " + what, "keep at most " + std::to_string (most));
        if (! names.conflict.empty()) in.error (key, "profile/unit", quote (names.conflict) + " has two units", "give it the same unit in all reports");
    }

    void known (std::string_view key, const std::string& name, const Names& names, const std::string& unit)
    {
        if (name.empty()) return;
        if (! names.has (name)) return in.error (key, "profile/unknown_name", "there is no field " + quote (name), suggestion (name, names.list));
        if (! unit.empty() && names.unitOf (name) != unit)
            in.error (key, "profile/unit", quote (name) + " is in " + names.unitOf (name) + ", but must be in " + unit,
                      "give the field a scale such as \"1e-6 " + unit + "\"");
    }

    void three (std::string_view key, const std::array<std::string, 3>& names, const Names& among, const std::string& unit)
    {
        for (const auto& name : names)
            known (key, name, among, unit);
    }

    /// A linear map gives a force or a torque. Without the constant of a motor, neither can be a current.
    void noCurrents()
    {
        if (! std::holds_alternative<LinearMap> (p.kinematics)) return;
        for (const auto& name : p.force)
            if (! name.empty() && efforts.has (name) && efforts.unitOf (name) != "N" && efforts.unitOf (name) != "N*m")
                in.error ("force", "profile/unit",
                          quote (name) + " is in " + efforts.unitOf (name) + ", but linear kinematics give N, or N*m for an axis in rad",
                          "give the field a scale in N*m that includes the torque constant of the motor: for 1 mA and 0.05 N*m/A, \"5e-5 N*m\"");
    }

    /// Checks that no field renders two components: their sum would exceed the limit of each.
    void twice()
    {
        std::vector<std::string> seen;
        const auto look = [&] (std::string_view key, const std::array<std::string, 3>& names) {
            for (const auto& name : names)
            {
                if (! name.empty() && std::ranges::count (seen, name) > 0)
                    in.error (key, "profile/twice", quote (name) + " is named more than once in \"force\" and \"torque\"",
                              "name each field once, and write null for a component without its own field");
                seen.push_back (name);
            }
        };
        look ("force", p.force);
        look ("torque", p.torque);
    }

    void signals()
    {
        auto channels = p.signals.size();
        for (const auto& report : p.outputs)
            if (report.stream) channels += report.stream->channels.size();
        if (channels > static_cast<std::size_t> (Channels::most))
            in.error ("signals", "profile/too_many", "there are " + std::to_string (channels) + " signal outputs",
                      "keep at most " + std::to_string (Channels::most));
        for (const auto& signal : p.signals)
        {
            known ("signals", signal.amplitude, efforts, "");
            known ("signals", signal.frequency, efforts, "Hz");
            if (! signal.amplitude.empty() && (std::ranges::count (p.force, signal.amplitude) > 0 || std::ranges::count (p.torque, signal.amplitude) > 0))
                in.error ("signals", "profile/signal_on_force", "the amplitude of a signal drives " + quote (signal.amplitude) + ", which renders the force",
                          "give the signal its own effort, because the guard limits forces and signals separately");
        }
    }

    /// Each drive needs a counter, and a motor if the device has force output.
    void joints()
    {
        std::size_t drives = 0;
        if (std::holds_alternative<SerialArm> (p.kinematics)) drives = 3;
        if (std::holds_alternative<FiveBar> (p.kinematics)) drives = 2;
        const bool pushes = std::ranges::any_of (p.force, [] (const auto& name) { return ! name.empty(); });
        for (std::size_t i = 0; i < drives; ++i)
        {
            if (p.position[i].empty())
                in.error ("position", "profile/kinematics", "a drive has no counter",
                          "name " + std::to_string (drives) + " input fields, one for the encoder of each drive");
            if (pushes && p.force[i].empty())
                in.error ("force", "profile/kinematics", "a drive has no motor",
                          "name " + std::to_string (drives) + " efforts, one for the motor of each drive, or leave \"force\" out");
        }
    }

    /// Checks that neutral reports request no force and that their enable bits are 0.
    void neutrals()
    {
        for (const auto& report : p.outputs)
        {
            rests (report, report.neutral, "outputs", "the neutral report of " + quote (report.name));
            noneEnabled (report, report.neutral, "outputs", "the neutral report of " + quote (report.name));
        }
    }

    /// Checks that the steps of `init` and `exit` request no force, because they are sent as they are, and that those of `exit`, the last reports that the
    /// device gets, leave its enable bits at 0.
    void stepsAtRest (const std::vector<Step>& steps, const std::string& key)
    {
        for (const auto& step : steps)
            for (const auto& report : p.outputs)
                for (const auto& bytes : readings (step, report))
                {
                    const auto what = "the report " + quote (report.name) + " of a step of " + quote (key);
                    rests (report, bytes, key, what);
                    if (key == "exit") noneEnabled (report, bytes, key, what);
                }
    }

    /// The ways in which a device may read a step as this report: if it begins with its id, or without ids, with its first byte, unless that varies.
    /// Systems leave out a leading 0, and fill up a report that is too short.
    static std::vector<Bytes> readings (const Step& step, const OutputReport& report)
    {
        std::vector<Bytes> all;
        if (step.bytes.empty() || report.body.empty() || report.neutral.empty() || step.kind == Step::Kind::get_feature) return all;
        if ((step.kind == Step::Kind::feature) != report.is_feature) return all;
        const auto isAtStart = [] (const auto& field) { return field.bits.at < 8; };
        const bool varies = std::ranges::any_of (report.fields, isAtStart) || std::ranges::count (report.sequences, 0u, &SequenceNibble::byte) > 0
                            || (report.stream && report.stream->at == 0) || (report.checksum && report.checksum->at == 0);
        const auto add = [&] (std::span<const std::uint8_t> bytes) {
            if (! varies && bytes.front() != report.body.front() && bytes.front() != report.neutral.front()) return;
            auto& read = all.emplace_back (bytes.begin(), bytes.end());
            read.resize (std::max (read.size(), report.body.size()));
        };
        add (step.bytes);
        const bool may_be_left_out = step.bytes.front() == 0 && step.bytes.size() > 1;
        if (may_be_left_out && (report.id || step.bytes.size() == report.body.size() + 1)) add (std::span (step.bytes).subspan (1));
        return all;
    }

    void noneEnabled (const OutputReport& report, const Bytes& bytes, std::string_view key, const std::string& what)
    {
        for (const auto& field : report.fields)
            if (field.source == OutputField::Source::enable && field.bits.end() <= 8 * bytes.size() && bitsAt (field.bits, bytes) != 0)
                in.error (key, "profile/neutral", what + " enables the motors at byte " + std::to_string (field.bits.at / 8), "set the enable bits to 0 there");
    }

    void rests (const OutputReport& report, const Bytes& bytes, std::string_view key, const std::string& what)
    {
        for (const auto& field : report.fields)
        {
            if (bytes.empty() || field.bits.end() > 8 * bytes.size()) continue;   // reported elsewhere
            const bool pushes = std::ranges::count (p.force, field.name) > 0 || std::ranges::count (p.torque, field.name) > 0 || isMechanical (field.unit);
            if (field.source == OutputField::Source::effort && pushes) rests (field, numberOf (field.bits, bitsAt (field.bits, bytes)), key, what);
        }
    }

    /// Checks the number that such a report has in the field of a motor.
    void rests (const OutputField& field, double number, std::string_view key, const std::string& what)
    {
        const auto& e = field.encoding;
        constexpr double half_a_count = 0.5000001;   // where zero lies between two counts
        std::string asked;                           // what the number asks for; empty if it is not a force
        if (const double value = number * e.scale + e.offset; e.law == Encoding::Law::linear && ! (std::abs (value) <= half_a_count * std::abs (e.scale)))
            asked = numberText (value) + " " + field.unit;
        if (const double zero = encoded (e, 0.0); e.law == Encoding::Law::table && std::isfinite (zero))   // else the scale is refused elsewhere
            if (const double none = numberOf (field.bits, rawOf (field.bits, zero)); number != none)
                asked = "the raw value " + numberText (number) + ", but no force is " + numberText (none) + ",";
        if (! asked.empty())
            in.error (key, "profile/neutral", what + " asks for " + asked + " in " + quote (field.name),
                      "write the raw value there that means no force");
    }

    /// Checks that each effort has a limit. For an effort that is neither force nor torque, min and max of its field are enough.
    void limits()
    {
        const auto names = [] (const auto& all) { return std::ranges::any_of (all, [] (const auto& name) { return ! name.empty(); }); };
        const auto need = [&] (const char* key, const std::string& what) {
            in.error ("limits", "profile/no_limit", "the profile drives " + what + " but sets no limit for it",
                      "add " + std::string (key) + " to the limits: the most that the device may apply to a hand");
        };
        const auto& guard = p.limits.guard;
        if (names (p.force) && guard.max_force == GuardLimits::none) need ("max_force", "a force");
        if (names (p.torque) && guard.max_torque == GuardLimits::none) need ("max_torque", "a torque");
        motorLimits();
        const bool has_signals = ! p.signals.empty() || std::ranges::any_of (p.outputs, [] (const auto& report) { return report.stream.has_value(); });
        if (has_signals && guard.max_signal == GuardLimits::none) need ("max_signal", "signals");
        if (guard.max_axis_effort != GuardLimits::none) return;
        for (const auto& report : p.outputs)
            for (const auto& field : report.fields)
            {
                const bool is_bounded = (std::isfinite (field.min) && std::isfinite (field.max)) || field.encoding.law == Encoding::Law::table;
                if (field.source != OutputField::Source::effort || is_bounded) continue;
                const auto drives = [&] (const auto& all) { return std::ranges::count (all, field.name) > 0; };
                const auto isSignal = [&] (const auto& s) { return s.amplitude == field.name || s.frequency == field.name; };
                if (! drives (p.force) && ! drives (p.torque) && std::ranges::none_of (p.signals, isSignal))
                    return need ("max_axis_effort", "the effort " + quote (field.name));
            }
    }

    /// Checks that the motor limits have motors to act on, and that a stop from max_motor takes at most longest_stop_s.
    void motorLimits()
    {
        const double most = p.limits.max_motor, slew = p.limits.max_motor_slew;
        const bool pushes = std::ranges::any_of (p.force, [] (const auto& name) { return ! name.empty(); });
        if (! pushes && (most != GuardLimits::none || slew != GuardLimits::none))
            in.error ("limits", "profile/no_motor", "max_motor and max_motor_slew limit the motors that render the force, but the profile has none",
                      "name them in \"force\", or remove the limits");
        if (slew != GuardLimits::none && ! (most / slew <= longest_stop_s))
            in.error ("limits", "device/slow_stop",
                      most == GuardLimits::none ? "without max_motor, max_motor_slew could prolong a stop indefinitely"
                                                : "with max_motor_slew, a stop from max_motor takes " + numberText (most / slew) + " s; at most "
                                                      + numberText (longest_stop_s) + " s are allowed",
                      most == GuardLimits::none ? "add max_motor, at most " + numberText (slew * longest_stop_s) : "raise max_motor_slew, or lower max_motor");
    }

    void echoes()
    {
        for (const auto& report : p.outputs)
            for (const auto& field : report.fields)
                if (field.source == OutputField::Source::echo) known ("outputs", field.name, axes, "");
    }

    void steps()
    {
        for (const auto* list : { &p.init, &p.exit })
            for (const auto& step : *list)
                if (step.bytes.empty())
                    in.error (list == &p.init ? "init" : "exit", "profile/missing", "the step has no bytes",
                              "write \"bytes\": the whole report, starting with its id if it has one");
        stepsAtRest (p.init, "init");
        stepsAtRest (p.exit, "exit");
    }

    /// Checks that everything that the device needs can pass over its wires.
    void wires()
    {
        if (! p.wires.any()) return;
        const auto isFeature = [] (const auto& list) { return std::ranges::any_of (list, [] (const auto& s) { return s.kind != Step::Kind::output; }); };
        if (isFeature (p.init) || isFeature (p.exit) || std::ranges::any_of (p.outputs, &OutputReport::is_feature))
            in.error ("wires", "profile/wire", "feature reports exist only in HID", "make them output reports, or leave \"wires\" out");
        const auto framing = p.wires.serial ? p.wires.serial->framing : Framing::cobs;
        if (framing == Framing::answer) answers();
        if (framing != Framing::none && framing != Framing::answer) return;
        for (const auto& report : p.inputs)
            if (report.length != report.longest || (! report.id && std::ranges::none_of (report.fields, [] (const auto& f) { return f.expect.has_value(); })))
                in.error ("wires", "profile/wire",
                          "without framing, nothing tells where a report begins, unless it has a fixed length, and an id or a field with \"expect\"",
                          "choose the framing cobs or length, or give each input report such a field and no \"longest\"");
    }

    /// Checks that a device that only answers is asked often enough, and by one report.
    void answers()
    {
        if (p.inputs.size() != 1 || p.outputs.size() != 1)
            in.error ("wires", "profile/wire", "a device that only answers needs one input report and one output report, which it answers",
                      "choose another framing, or keep one of each");
        if (std::ranges::any_of (p.outputs, [] (const auto& r) { return r.keepalive > 0.0 || r.stream || ! r.sequences.empty(); }))
            in.error ("outputs", "profile/wire",
                      "a device that only answers is asked by its output report in each tick, so this can have no keepalive, no stream and no sequence number",
                      "leave them out");
        if (p.rate > 0.0)
            in.error ("rate", "profile/wire", "a device that only answers cannot tick a run, because it waits for the run", "leave \"rate\" out");
    }

    void golden (const GoldenSample& sample)
    {
        const auto vector = [] (const std::string& name, std::string_view of) {
            return name.size() == of.size() + 2 && name.starts_with (of) && name[of.size()] == '.'
                   && std::string_view ("xyz").find (name.back()) != std::string_view::npos;
        };

        known ("samples", sample.output, outputs, "");
        for (const auto& [name, value] : sample.values)
            if (sample.output.empty())
            {
                if (name != "pressure" && name != "time" && name != "lost" && ! vector (name, "position") && ! vector (name, "rotation"))
                    known ("samples", name, axes, "");
            }
            else if (! vector (name, "force") && ! vector (name, "torque"))
                known ("samples", name, efforts, "");
        for (const auto& button : sample.pressed)
            known ("samples", button, buttons, "");
    }

    const Profile& p;
    ProfileFields& in;
    Names axes, buttons, efforts, outputs;
};
}   // namespace

void checkProfile (const Profile& profile, ProfileFields& fields) { Check (profile, fields).all(); }

}   // namespace tactus::host::hid
