// SPDX-License-Identifier: MIT
#pragma once

#include "carries.hpp"
#include "running_section.hpp"
#include "succession.hpp"

#include <span>

namespace tactus::plan
{

/// One component of a wire, or of a feed, on its way through the sections.
struct Traveller
{
    int wire, component;   ///< feeds are counted after the wires
    Carries carries;
    int step = 0;   ///< how many sections it has entered or left; Crossings counts
};

/// Leads wires in and out of the running sections of a plan that is being built.
class Crossings
{
public:
    Crossings (const Flat&, const Succession&, Plan&, std::span<RunningSection>);

    /// Where a value that stands in the section `from` is found in `around`.
    const double* leave (const double* value, int from, int around, Traveller&);

    /// Where a value that stands in `around` is found in the section `to`.
    const double* enter (const double* value, int around, int to, Traveller&);

private:
    const double* pass (const double* value, int section, bool enters, Traveller&);

    const Flat& flat;
    const Succession& succession;
    Plan& plan;
    std::span<RunningSection> sections;
};

}   // namespace tactus::plan
