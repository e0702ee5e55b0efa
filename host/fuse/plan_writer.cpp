// SPDX-License-Identifier: MIT
#include "plan_writer.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host
{

PlanWriter::PlanWriter (const Plan& plan, const FusedCode::Classes& m) : values (plan), more (m) {}

const PlanWriter::Known* PlanWriter::knownOf (const void* node) const
{
    const auto found = known.find (node);
    return found != known.end() ? &found->second : nullptr;
}

void PlanWriter::findKnown()
{
    auto classes = more;
    const auto& plan = values.plan;
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& type = *plan.flat().nodes[i].type;
        const auto& node = plan.instances()[i].node;
        if (! node || ! plan.flat().nodes[i].runs() || type.owner || ! type.origin.empty() || plan.instances()[i].lanes != nullptr) continue;
        const auto [entry, is_new] = classes.try_emplace (std::string (type.info.id));
        if (is_new) entry->second = classOf (type.info.id);
        const auto& [name, header] = entry->second;
        if (name.empty() || ! has (header)) continue;
        known.emplace (node.get(), Known { i, name, header });
        ++uses[header];
    }
}

FusedCode PlanWriter::write()
{
    findKnown();
    do
        writeOnce();
    while (! values.settled());

    std::vector<const Known*> all;
    for (const auto& [node, n] : known)
        all.push_back (&n);
    std::ranges::sort (all, {}, &Known::instance);
    made.headers.insert (FusedCode::parts);
    for (const auto* n : all)
        made.headers.insert (n->header);
    made.text = end (all);
    made.objects = values.objects();
    return std::move (made);
}

void PlanWriter::writeOnce()
{
    made = {};
    parts = 0;
    begin();
    startPart();
    records (values.plan.records(), false);
    endPart();
}

void PlanWriter::startPart()
{
    in_part = 0;
    ++parts;
    beginPart();
}

void PlanWriter::records (std::span<const Record> all, bool is_inner)
{
    for (const auto& r : all)
    {
        if (! is_inner && in_part++ == records_in_part)
        {
            endPart();
            values.closeScope();
            values.openScope();
            startPart();
        }
        if (fuse (r, is_inner))
            ++made.fused;
        else
        {
            ++made.called;
            needSources (r);
            call (r);
        }
    }
}

bool PlanWriter::fuse (const Record& r, bool is_inner)
{
    bool is_sum = false;
    plan::eachSum (r, [&] (const plan::Sum& s) {
        is_sum = true;
        sum (s, is_inner);
    });
    if (is_sum) return true;
    if (r.step == &plan::Strike::step)
        strike (*static_cast<plan::Strike*> (r.self), is_inner);
    else if (r.step == &plan::DelayLine::read)
        readDelay (*static_cast<plan::DelayLine*> (r.self)->line);
    else if (r.step == &plan::DelayLine::write)
        writeDelay (static_cast<plan::DelayLine*> (r.self)->from, *static_cast<plan::DelayLine*> (r.self)->line);
    else if (r.step == &plan::RunningSection::every)
        every (*static_cast<plan::RunningSection*> (r.self));
    else if (r.step == &plan::RunningSection::times)
        times (*static_cast<plan::RunningSection*> (r.self));
    else if (r.step == &plan::DrivenNode::step)
    {
        const auto& d = *static_cast<plan::DrivenNode*> (r.self);
        const auto* n = knownOf (d.node);
        if (n == nullptr || (d.type->peek && d.faulted.empty())) return false;
        driven (*n, r, is_inner);
    }
    else
        return fuseNode (r, is_inner);
    return true;
}

bool PlanWriter::fuseNode (const Record& r, bool is_inner)
{
    const auto* n = knownOf (r.self);
    if (n == nullptr) return false;
    const auto& type = *flatOf (*n).type;
    if (type.peek && r.step == type.peek)
        peek (*n, is_inner);
    else if (r.step == type.tick)
        node (*n, r, is_inner);
    else
        return false;
    return true;
}

/// Notes that all that a record reads must be in memory.
void PlanWriter::needSources (const Record& r)
{
    const auto& plan = values.plan;
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        if (plan.instances()[i].sources != r.sources) continue;   // a node without inputs has the same sources as the next one
        const auto& flat = plan.flat().nodes[i];
        std::size_t slot = 0;
        for (const auto& row : flat.type->inputs)
            for (int k = 0; k < flat.slots (row); ++k, ++slot)
                if (! flat.muted) values.need (r.sources[slot]);
    }
    if (r.step == &plan::LaneStep::step)
    {
        const auto& wiring = static_cast<plan::LaneStep*> (r.self)->wiring;
        for (const auto* sources : wiring.sources)
            for (std::size_t i = 0; i < wiring.inputs; ++i)
                values.need (sources[i]);
    }
    if (r.step != &plan::DrivenNode::step) return;
    for (const auto& drive : static_cast<plan::DrivenNode*> (r.self)->drives)
        for (const auto* from : { drive.replace, drive.add })
            if (from != nullptr) values.need (from);
}

}   // namespace tactus::host
