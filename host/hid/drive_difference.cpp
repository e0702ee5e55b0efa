// SPDX-License-Identifier: GPL-3.0-or-later
#include "drive_difference.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>

namespace tactus::host::hid
{
namespace
{
/// What an effort does. An effort that renders neither a force nor a signal keeps its name, because the guard finds the axis that it
/// pushes by the name.
std::string partOf (const Profile& profile, const std::string& effort)
{
    std::string part;
    const auto add = [&] (bool is_so, const std::string& what) {
        if (is_so) part += (part.empty() ? "" : " and ") + what;
    };
    for (std::size_t i = 0; i < 3; ++i)
    {
        const std::string axis (1, "xyz"[i]);
        add (profile.force[i] == effort, "force " + axis);
        add (profile.torque[i] == effort, "torque " + axis);
    }
    add (std::ranges::count (profile.signals, effort, &SignalEffort::amplitude) > 0, "the amplitude of a signal");
    add (std::ranges::count (profile.signals, effort, &SignalEffort::frequency) > 0, "the frequency of a signal");
    return part.empty() ? "the effort " + quote (effort) : part;
}

/// The bytes around the fields. Constants in them can push too, so they must be the same.
bool haveSameFrame (const OutputReport& a, const OutputReport& b)
{
    return a.id == b.id && a.is_feature == b.is_feature && a.body == b.body && a.neutral == b.neutral && a.sequences == b.sequences
           && a.checksum == b.checksum && a.given == b.given;
}

bool haveSameSamples (const Stream& a, const Stream& b)
{
    return a.at == b.at && a.frames == b.frames && a.rate == b.rate && a.channels.size() == b.channels.size() && a.is_signed == b.is_signed && a.bits == b.bits;
}

class Difference
{
public:
    Difference (const Profile& a, const Profile& b) : own (a), other (b) {}

    std::string all() const
    {
        for (const auto steps : { &Profile::init, &Profile::exit })
        {
            const auto mine = sentBy (own.*steps), theirs = sentBy (other.*steps);
            const auto isSent = [&] (const Step& s) { return std::ranges::any_of (theirs, [&] (const Step& t) { return sendsTheSame (s, t); }); };
            if (! std::ranges::all_of (mine, isSent)) return "its \"init\" or \"exit\" sends a report that the shipped profile does not send";
            // A device that was not told its mode, or not told to rest, can respond to the same reports in a different way.
            if (! own.outputs.empty() && ! std::ranges::equal (mine, theirs, sendsTheSame))
                return "its \"init\" or \"exit\" leaves out a report of the shipped profile, or sends the reports in a different order";
        }
        if (own.outputs.empty()) return {};
        if (auto difference = inReadings(); ! difference.empty()) return difference;
        if (own.kinematics != other.kinematics) return "its kinematics differ";
        if (own.axes != other.axes) return "its axes differ";
        for (const auto& report : own.outputs)
            if (auto difference = in (report); ! difference.empty()) return difference;
        return {};
    }

private:
    static bool sendsTheSame (const Step& a, const Step& b) { return a.kind == b.kind && a.bytes == b.bytes && a.given == b.given; }

    /// The steps that send something.
    static std::vector<Step> sentBy (std::vector<Step> steps)
    {
        std::erase_if (steps, [] (const Step& s) { return s.kind == Step::Kind::get_feature; });
        return steps;
    }

    /// The field of an input report, and the id of that report; null if there is none.
    static std::pair<const InputField*, std::optional<std::uint8_t>> fieldOf (const Profile& profile, const std::string& name)
    {
        for (const auto& report : profile.inputs)
            for (const auto& field : report.fields)
                if (field.name == name) return { &field, report.id };
        return { nullptr, {} };
    }

    bool readTheSame (const std::string& mine, const std::string& theirs) const
    {
        if (theirs.empty()) return true;   // the limits of the other profile do not depend on this field
        const auto [a, a_id] = fieldOf (own, mine);
        const auto [b, b_id] = fieldOf (other, theirs);
        if (a == nullptr || b == nullptr) return a == b;
        return a_id == b_id && a->bits == b->bits && a->scale == b->scale && a->offset == b->offset && a->unit == b->unit && a->unwrap == b->unwrap;
    }

    /// The axis of the other profile that an effort pushes. The guard finds it by the same rule: the axis of the same name, or axisN for
    /// effortN. "" if there is none.
    std::string axisOf (const std::string& effort) const
    {
        constexpr std::string_view prefix = "effort";
        if (fieldOf (other, effort).first != nullptr) return effort;
        const auto axis = effort.starts_with (prefix) ? "axis" + effort.substr (prefix.size()) : std::string();
        return fieldOf (other, axis).first != nullptr ? axis : std::string();
    }

    /// The limits of speed, energy and age, and the force of a device with kinematics, depend on the readings.
    std::string inReadings() const
    {
        for (std::size_t i = 0; i < 3; ++i)
        {
            if (! readTheSame (own.position[i], other.position[i])) return std::string ("its position ") + "xyz"[i] + " is read differently";
            if (! readTheSame (own.rotation[i], other.rotation[i])) return std::string ("its rotation ") + "xyz"[i] + " is read differently";
        }
        if (! readTheSame (own.valid, other.valid)) return "its \"valid\" is read differently";
        for (const auto& theirs : other.inputs)
        {
            const auto isSame = [&] (const InputReport& mine) {
                return mine.id == theirs.id && readTheSame (mine.sequence, theirs.sequence) && readTheSame (mine.timestamp, theirs.timestamp);
            };
            if (std::ranges::none_of (own.inputs, isSame)) return "the sequence number or the timestamp of its reports is read differently";
        }
        for (const auto& report : own.outputs)
            for (const auto& field : report.fields)
                if (const auto axis = axisOf (field.name); ! readTheSame (axis, axis)) return "its axis " + quote (axis) + " is read differently";
        for (const auto& theirs : other.alarms)
        {
            const auto isSame = [&] (const Alarm& mine) {
                return mine.is == theirs.is && mine.while_driven <= theirs.while_driven && readTheSame (mine.field, theirs.field);
            };
            if (std::ranges::none_of (own.alarms, isSame)) return "it lacks the shipped profile's alarm on " + quote (theirs.field);
        }
        return {};
    }

    std::string in (const OutputReport& report) const
    {
        const auto same = std::ranges::find_if (other.outputs, [&] (const auto& r) { return haveSameFrame (report, r); });
        if (same == other.outputs.end()) return "its report " + quote (report.name) + " differs in its id, kind, constants, counter or checksum";
        if (report.stream && ! (same->stream && haveSameSamples (*report.stream, *same->stream)))
            return "its report " + quote (report.name) + " has a different stream";
        for (const auto& field : report.fields)
            if (auto difference = in (field, *same); ! difference.empty()) return difference;
        return {};
    }

    std::string in (const OutputField& field, const OutputReport& report) const
    {
        const auto name = field.name.empty() ? "its enable field" : quote (field.name);
        const auto same = std::ranges::find_if (report.fields, [&] (const OutputField& f) { return f.source == field.source && f.bits == field.bits; });
        if (same == report.fields.end()) return name + " uses different bits";
        if (field.source != OutputField::Source::effort) return {};
        if (field.encoding != same->encoding || field.unit != same->unit) return name + " has a different scale, offset, unit, log2 or table";
        if (! (field.min >= same->min && field.max <= same->max)) return name + " has a lower min or a higher max";
        const auto mine = partOf (own, field.name), theirs = partOf (other, same->name);
        return mine == theirs ? std::string() : name + " is " + mine + " instead of " + theirs;
    }

    const Profile& own;
    const Profile& other;
};
}   // namespace

std::string driveDifference (const Profile& own, const Profile& other) { return Difference (own, other).all(); }

}   // namespace tactus::host::hid
