// SPDX-License-Identifier: MIT
#include "profile_difference.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{
namespace
{
/// A profile without what may differ from another one.
Profile comparable (Profile p, const Limits& theirs)
{
    for (auto* text : { &p.id, &p.name, &p.about, &p.replaces, &p.file })
        text->clear();
    p.match.clear();
    p.wires = {};
    p.sources.clear();
    p.samples.clear();
    const auto forgetChecks = [] (auto& reports) {
        for (auto& report : reports)
        {
            report.verified = false;
            report.why_not.clear();
        }
    };
    forgetChecks (p.inputs);
    forgetChecks (p.outputs);
    p.limits = tightest (p.limits, theirs);
    return p;
}

template <auto Member>
bool isSame (const Profile& a, const Profile& b)
{
    return a.*Member == b.*Member;
}

struct Key
{
    const char* name;
    bool (*isSame) (const Profile&, const Profile&);
};

// For the message only.
constexpr Key keys[] { { "init", isSame<&Profile::init> },
                       { "exit", isSame<&Profile::exit> },
                       { "inputs", isSame<&Profile::inputs> },
                       { "outputs", isSame<&Profile::outputs> },
                       { "position", isSame<&Profile::position> },
                       { "rotation", isSame<&Profile::rotation> },
                       { "pressure", isSame<&Profile::pressure> },
                       { "valid", isSame<&Profile::valid> },
                       { "alarms", isSame<&Profile::alarms> },
                       { "force", isSame<&Profile::force> },
                       { "torque", isSame<&Profile::torque> },
                       { "signals", isSame<&Profile::signals> },
                       { "axes", isSame<&Profile::axes> },
                       { "kinematics", isSame<&Profile::kinematics> },
                       { "limits", isSame<&Profile::limits> },
                       { "physics", isSame<&Profile::physics> },
                       { "rate", isSame<&Profile::rate> },
                       { "quirks", isSame<&Profile::quirks> } };
}   // namespace

Limits tightest (const Limits& a, const Limits& b)
{
    auto tight = a;
    tight.guard = tightest (a.guard, b.guard);
    tight.max_motor = std::min (a.max_motor, b.max_motor);
    tight.max_motor_slew = std::min (a.max_motor_slew, b.max_motor_slew);
    tight.still_travel = std::min (a.still_travel, b.still_travel);
    return tight;
}

std::string differenceOf (const Profile& own, const Profile& other)
{
    if (own.outputs.empty() && own.init.empty() && own.exit.empty()) return {};   // sends nothing, so there is no effort to limit
    const auto mine = comparable (own, other.limits), theirs = comparable (other, own.limits);
    if (mine == theirs) return {};
    std::string names;
    for (const auto& key : keys)
        if (! key.isSame (mine, theirs)) names += (names.empty() ? "\"" : ", \"") + std::string (key.name) + '"';
    return names.empty() ? "its content" : names;
}

}   // namespace tactus::host::hid
