// SPDX-License-Identifier: MIT
#include "plan_walk.hpp"

#include <utility>

namespace tactus::host
{

void PlanWalk::write()
{
    do
    {
        parts = 0;
        count = called = 0;
        begin();
        startPart();
        walk();
        endPart();
    } while (! isFinal());
}

void PlanWalk::startPart()
{
    in_part = 0;
    ++parts;
    beginPart();
}

void PlanWalk::records (std::span<const Record> all)
{
    for (const auto& r : all)
    {
        if (! is_inner && in_part++ == records_in_part)
        {
            endPart();
            startPart();
        }
        ++count;
        record (r);
    }
}

void PlanWalk::record (const Record& r)
{
    const auto node = [&] (const auto&) {
        const auto* n = find (r.self);
        if (n != nullptr && r.step == type (*n).tick)
        {
            title (*n);
            tick (*n, inputs (*n, r.sources, {}), {}, {});
        }
        else if (n != nullptr && r.step == type (*n).peek)
            peek (*n);
        else
            callOnly (r);
    };
    visitRecord (r, Cases { node,
                            [this] (const plan::Sum& s) { sum (s); },
                            [this] (const plan::Strike& s) { strike (s); },
                            [this] (const DelayRead& d) { readDelay (*d.line); },
                            [this] (const DelayWrite& d) { writeDelay (*d.line, d.from); },
                            [&] (const plan::Bypass& b) { bypass (b, r); },
                            [&] (const plan::DrivenNode& d) {
                                const auto* n = find (d.node);
                                n != nullptr ? driven (*n, d, r.sources) : callOnly (r);
                            },
                            [this] (const SectionStep& s) {
                                section (s, [&] { s.kind == plan::Section::Kind::every ? every (s.running) : times (s.running); });
                            } });
}

void PlanWalk::callOnly (const Record& r)
{
    ++called;
    call (r);
}

void PlanWalk::driven (const PlanNode& n, const plan::DrivenNode& d, const double* const* sources)
{
    title (n);
    const auto wires = drives (n);
    for (const auto& one : d.drives)
        drive (n, wires, one);
    if (d.type->update) updateIfMoved (n, wires);
    const auto fault = faultOf (wires);
    const auto all = inputs (n, sources, fault);
    const auto params = d.params.empty() ? Text {} : stored (n, d);
    tick (n, all, params, d.faulted.empty() ? fault : Text {});
}

void PlanWalk::each (Action action, const std::vector<plan::ConversionLink>& links, const Text& part)
{
    for (const auto& link : links)
        convert (action, link, part);
}

void PlanWalk::inside (const plan::RunningSection& s)
{
    const auto around = std::exchange (is_inner, true);
    records (s.records);
    is_inner = around;
}

void PlanWalk::follow (const plan::RunningSection& s, const Text& steps)
{
    if (! s.lines.empty()) each (Action::follow, s.lines, partOf (steps, s.factor));
}

void PlanWalk::every (const plan::RunningSection& s)
{
    each (Action::gather, s.gathers);
    const auto first = [&] {
        each (Action::latch, s.latches);
        each (Action::deliver, s.gathers);
        inside (s);
        each (Action::head, s.lines);
        each (Action::latch, s.pulses);
    };
    const auto others = [&] { each (Action::silence, s.pulses); };
    follow (s, onPhase (s, first, s.pulses.empty() ? Body {} : others));
}

void PlanWalk::times (const plan::RunningSection& s)
{
    each (Action::head, s.lines);
    each (Action::latch, s.pulses);
    repeat (s, [&] (const Turn& turn) {
        follow (s, turn.next);
        if (! s.pulses.empty()) onSecond (turn, [&] { each (Action::silence, s.pulses); });
        inside (s);
        each (Action::gather, s.gathers);
        for (const auto& tap : s.samples)
            sample (turn, tap);
    });
    each (Action::deliver, s.gathers);
}

}   // namespace tactus::host
