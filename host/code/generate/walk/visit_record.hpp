// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/plan.hpp>
#include <tactus/plan/steps/ops.hpp>
#include <tactus/plan/steps/running_section.hpp>

namespace tactus::host
{

/// Types that tell what a record does if the type of its object does not.
struct DelayRead : plan::DelayLine
{
};
struct DelayWrite : plan::DelayLine
{
};
struct SectionStep
{
    const plan::RunningSection& running;
    plan::Section::Kind kind;
};

/// Several functions as one that is overloaded.
template <typename... F>
struct Cases : F...
{
    using F::operator()...;
};
template <typename... F>
Cases (F...) -> Cases<F...>;

/// Calls `cases` with what a record does: each plan::Sum, or a plan::Strike, DelayRead, DelayWrite, SectionStep, plan::DrivenNode or
/// plan::Bypass. Calls it with the record if this is a node or unknown.
template <typename C>
void visitRecord (const Record& r, C&& cases)
{
    bool is_sum = false;
    plan::eachSum (r, [&] (const plan::Sum& sum) {
        is_sum = true;
        cases (sum);
    });
    if (is_sum) return;
    if (r.step == &plan::Strike::step)
        cases (*static_cast<const plan::Strike*> (r.self));
    else if (r.step == &plan::DelayLine::read)
        cases (DelayRead { *static_cast<const plan::DelayLine*> (r.self) });
    else if (r.step == &plan::DelayLine::write)
        cases (DelayWrite { *static_cast<const plan::DelayLine*> (r.self) });
    else if (r.step == &plan::RunningSection::every)
        cases (SectionStep { *static_cast<const plan::RunningSection*> (r.self), plan::Section::Kind::every });
    else if (r.step == &plan::RunningSection::times)
        cases (SectionStep { *static_cast<const plan::RunningSection*> (r.self), plan::Section::Kind::times });
    else if (r.step == &plan::DrivenNode::step)
        cases (*static_cast<const plan::DrivenNode*> (r.self));
    else if (r.step == &plan::Bypass::step)
        cases (*static_cast<const plan::Bypass*> (r.self));
    else
        cases (r);
}

}   // namespace tactus::host
