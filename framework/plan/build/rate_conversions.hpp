// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/rules/signal_kind.hpp>
#include <tactus/plan/steps/running_section.hpp>
#include <tactus/plan/swap/plan_diff.hpp>

#include <span>

namespace tactus::plan
{

/// One component of a wire or feed, on its way through the sections.
struct ConvertedValue
{
    int wire, component;   ///< feeds are numbered after the wires
    SignalKind carries;
    int step = 0;   ///< number of sections entered or left so far; counted by RateConversions
};

/// Connects wires into and out of the running sections of a plan under construction.
class RateConversions
{
public:
    RateConversions (const Flat&, const PlanDiff&, PlanParts&, std::span<RunningSection>);

    /// The address at which `around` reads a value of the section `from`.
    const double* leave (const double* value, int from, int around, ConvertedValue&);

    /// The address at which the section `to` reads a value of `around`.
    const double* enter (const double* value, int around, int to, ConvertedValue&);

private:
    const double* convert (const double* value, int section, bool enters, ConvertedValue&);

    const Flat& flat;
    const PlanDiff& diff;
    PlanParts& plan;
    std::span<RunningSection> sections;
};

}   // namespace tactus::plan
