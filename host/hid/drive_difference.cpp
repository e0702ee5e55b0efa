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
            for (const auto& step : own.*steps)
                if (! isStep (step, other.*steps)) return "its \"init\" or \"exit\" sends a report that the shipped one does not send";
        if (own.outputs.empty()) return {};
        if (own.kinematics != other.kinematics) return "its kinematics differ";
        if (own.axes != other.axes) return "its axes differ";
        for (const auto& report : own.outputs)
            if (auto difference = in (report); ! difference.empty()) return difference;
        return {};
    }

private:
    static bool isStep (const Step& step, const std::vector<Step>& list)
    {
        const auto isSame = [&] (const Step& s) { return s.kind == step.kind && s.bytes == step.bytes; };
        return step.kind == Step::Kind::get_feature || std::ranges::any_of (list, isSame);
    }

    std::string in (const OutputReport& report) const
    {
        const auto same = std::ranges::find_if (other.outputs, [&] (const auto& r) { return haveSameFrame (report, r); });
        if (same == other.outputs.end()) return "its report " + quote (report.name) + " differs in its id, kind, constants, counter or checksum";
        if (report.stream && ! (same->stream && haveSameSamples (*report.stream, *same->stream)))
            return "its report " + quote (report.name) + " has another stream";
        for (const auto& field : report.fields)
            if (auto difference = in (field, *same); ! difference.empty()) return difference;
        return {};
    }

    std::string in (const OutputField& field, const OutputReport& report) const
    {
        const auto name = field.name.empty() ? "its enable field" : quote (field.name);
        const auto same = std::ranges::find_if (report.fields, [&] (const OutputField& f) { return f.source == field.source && f.bits == field.bits; });
        if (same == report.fields.end()) return name + " has other bits";
        if (field.source != OutputField::Source::effort) return {};
        if (field.encoding != same->encoding || field.unit != same->unit) return name + " has another scale, offset, unit, log2 or table";
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
