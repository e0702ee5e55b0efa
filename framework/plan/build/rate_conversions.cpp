// SPDX-License-Identifier: MIT
#include "rate_conversions.hpp"

namespace tactus::plan
{

namespace
{
/// The conversion that a wire needs when it enters or leaves a section; nullopt if the value can be read directly. That is so
/// for steps that enter a `times` section, and for values that leave a section and are held until it runs again.
std::optional<Conversion::Kind> kindOf (const Section& section, bool enters, SignalKind carries)
{
    const bool rests = section.kind == Section::Kind::every;
    if (carries == SignalKind::hits) return enters == rests ? Conversion::Kind::gather : Conversion::Kind::pulse;
    if (rests && enters) return Conversion::Kind::latch;
    const bool straight = carries == SignalKind::signal && (rests ? section.linear : enters);
    return straight ? std::optional (Conversion::Kind::line) : std::nullopt;
}
}   // namespace

RateConversions::RateConversions (const Flat& f, const PlanDiff& d, PlanParts& p, std::span<RunningSection> all) : flat (f), diff (d), plan (p), sections (all)
{
}

const double* RateConversions::leave (const double* value, int from, int around, ConvertedValue& t)
{
    const auto left = flat.sectionsBetween (around, from);
    for (auto s = left.rbegin(); s != left.rend(); ++s)
        value = convert (value, *s, false, t);
    return value;
}

const double* RateConversions::enter (const double* value, int around, int to, ConvertedValue& t)
{
    for (const int s : flat.sectionsBetween (around, to))
        value = convert (value, s, true, t);
    return value;
}

const double* RateConversions::convert (const double* value, int section, bool enters, ConvertedValue& t)
{
    const int step = t.step++;
    const auto kind = kindOf (flat.section (section), enters, t.carries);
    if (! kind) return value;

    const Conversion conversion { *kind, flat.section (section).factor, enters };
    auto converter = diff.rateConverterOf (t.wire, t.component, step, conversion, plan.takeover);
    sections[at (section)].linksOf (*kind).push_back ({ value, converter.get() });
    const double* out = &converter->out;
    plan.rate_converters.push_back ({ t.wire, t.component, step, conversion, std::move (converter) });
    return out;
}

}   // namespace tactus::plan
