// SPDX-License-Identifier: MIT
#include "crossings.hpp"

namespace tactus::plan
{

namespace
{
/// Nothing where the value may be read as it stands: a section that runs `times` a tick sees a state change with the
/// tick, and of what stands still in or behind a section nothing need be kept.
std::optional<Way::Kind> kindOf (const Section& section, bool enters, Carries carries)
{
    const bool rests = section.kind == Section::Kind::every;
    if (carries == Carries::hits) return enters == rests ? Way::Kind::gather : Way::Kind::pulse;
    if (rests && enters) return Way::Kind::latch;
    const bool straight = carries == Carries::signal && (rests ? section.linear : enters);
    return straight ? std::optional (Way::Kind::line) : std::nullopt;
}
}   // namespace

Crossings::Crossings (const Flat& f, const Succession& s, Plan& p, std::span<RunningSection> all) : flat (f), succession (s), plan (p), sections (all) {}

const double* Crossings::leave (const double* value, int from, int around, Traveller& t)
{
    const auto passed = flat.sectionsBetween (around, from);
    for (auto s = passed.rbegin(); s != passed.rend(); ++s)
        value = pass (value, *s, false, t);
    return value;
}

const double* Crossings::enter (const double* value, int around, int to, Traveller& t)
{
    for (const int s : flat.sectionsBetween (around, to))
        value = pass (value, s, true, t);
    return value;
}

const double* Crossings::pass (const double* value, int section, bool enters, Traveller& t)
{
    const int step = t.step++;
    const auto kind = kindOf (flat.section (section), enters, t.carries);
    if (! kind) return value;

    const Way way { *kind, flat.section (section).factor, enters };
    auto passage = succession.passageOf (t.wire, t.component, step, way, plan.takeover);
    auto& running = sections[static_cast<std::size_t> (section)];
    auto& list = *kind == Way::Kind::latch ? running.latches : *kind == Way::Kind::gather ? running.gathers
                                                           : *kind == Way::Kind::line     ? running.lines
                                                                                          : running.pulses;
    list.push_back ({ value, passage.get() });
    const double* out = &passage->out;
    plan.passages.push_back ({ t.wire, t.component, step, way, std::move (passage) });
    return out;
}

}   // namespace tactus::plan
