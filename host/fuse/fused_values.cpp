// SPDX-License-Identifier: MIT
#include "fused_values.hpp"

#include <host/generate/walk/address_map.hpp>

#include <tactus/kit/vec3.hpp>

namespace tactus::host
{

FusedValues::FusedValues (const Plan& p) : plan (p)
{
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& instance = plan.instances()[i];
        if (instance.node) by_node.emplace (instance.node.get(), i);
        const auto size = plan.flat().nodes[i].type->outputs_size;
        if (instance.lanes != nullptr)   // its outputs are among those of others
            for (std::size_t offset = 0; offset < size; offset += sizeof (double))
                changing.insert (instance.output (offset));
        else if (size > 0)
            by_outputs.emplace (bytes (instance.outputs), i);
        if (const auto& type = *plan.flat().nodes[i].type; instance.node && type.params_size > 0)
            by_params.emplace (bytes (type.paramsOf (instance.node.get())), i);
    }
    findChanging (plan.records());
    findChanging (plan.settled());
    for (const auto& tap : plan.taps())
        need (tap.value);
}

bool FusedValues::isStranger (const Record& r) const
{
    for (const auto step : { &plan::Strike::step, &plan::DelayLine::read, &plan::DelayLine::write, &plan::RunningSection::every, &plan::RunningSection::times,
                             &plan::DrivenNode::step, &plan::Bypass::step, &plan::LaneStep::step })
        if (r.step == step) return false;
    bool is_sum = false;
    plan::eachSum (r, [&is_sum] (const plan::Sum&) { is_sum = true; });
    const auto node = by_node.find (r.self);
    if (is_sum || node == by_node.end()) return ! is_sum;
    const auto& type = *plan.flat().nodes[node->second].type;
    return r.step != type.tick && r.step != type.peek;
}

void FusedValues::findChanging (std::span<const Record> records)
{
    for (const auto& r : records)
    {
        has_unknown = has_unknown || isStranger (r);
        plan::eachSum (r, [this] (const plan::Sum& sum) { changing.insert (&sum.out); });
        if (r.step == &plan::Strike::step) changing.insert (&static_cast<plan::Strike*> (r.self)->out);
        if (r.step == &plan::DelayLine::read) changing.insert (&static_cast<plan::DelayLine*> (r.self)->line->out);
        if (r.step != &plan::RunningSection::every && r.step != &plan::RunningSection::times) continue;
        const auto& section = *static_cast<plan::RunningSection*> (r.self);
        for (const auto* links : { &section.latches, &section.gathers, &section.lines, &section.pulses })
            for (const auto& link : *links)
                changing.insert (&link.converter->out);
        findChanging (section.records);
    }
}

std::string FusedValues::number (const void* object)
{
    const auto [at, is_new] = by_object.try_emplace (object, all.size());
    if (is_new) all.push_back (const_cast<void*> (object));
    return std::to_string (at->second);
}

std::string FusedValues::numbers (std::initializer_list<const void*> objects)
{
    const auto first = all.size();
    for (const auto* object : objects)
        all.push_back (const_cast<void*> (object));
    return std::to_string (first);
}

std::optional<FusedValues::Output> FusedValues::outputAt (const double* value) const
{
    const auto found = lastBefore (by_outputs, value);
    if (found == by_outputs.end()) return std::nullopt;
    const auto& type = *plan.flat().nodes[found->second].type;
    const auto offset = static_cast<std::size_t> (bytes (value) - found->first);
    if (offset >= type.outputs_size) return std::nullopt;
    for (const auto& row : type.outputs)
    {
        const auto size = sizeof (double) * at (row.list ? list_capacity * row.width : row.width);
        if (offset < row.offset || offset >= row.offset + size) continue;
        return Output { found->second, &row, static_cast<int> ((offset - row.offset) / sizeof (double)) };
    }
    return std::nullopt;
}

/// True for defaults of inputs, which nothing ever writes.
bool FusedValues::isConstant (const double* value) const
{
    if (has_unknown || changing.contains (value)) return false;
    if (const auto feeds = plan.feeds(); value >= feeds.data() && value < feeds.data() + feeds.size()) return false;
    if (const auto found = lastBefore (by_outputs, value); found != by_outputs.end())
        if (static_cast<std::size_t> (bytes (value) - found->first) < plan.flat().nodes[found->second].type->outputs_size) return false;
    if (const auto found = lastBefore (by_params, value); found != by_params.end())
        if (static_cast<std::size_t> (bytes (value) - found->first) < plan.flat().nodes[found->second].type->params_size) return false;
    return isFinite (*value);   // checked last: the checks above exclude the values that the tick thread writes
}

/// The variable that has a value, if one is in scope.
std::optional<FusedValues::Place> FusedValues::variableOf (const double* value) const
{
    const auto output = outputAt (value);
    for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope)
    {
        if (const auto known = scope->values.find (value); known != scope->values.end()) return Place { Place::Kind::variable, known->second };
        if (! output) continue;
        if (const auto known = scope->outputs.find (output->instance); known != scope->outputs.end())
            return Place { Place::Kind::member, known->second, output->sheet, output->slot };
    }
    return std::nullopt;
}

bool FusedValues::isInSight (const double* value) const { return variableOf (value).has_value(); }

FusedValues::Place FusedValues::find (const double* value)
{
    if (auto variable = variableOf (value)) return std::move (*variable);
    if (isConstant (value)) return { Place::Kind::constant };
    need (value);
    return {};
}

void FusedValues::need (const double* value)
{
    needed.insert (value);
    if (const auto found = lastBefore (by_outputs, value); found != by_outputs.end())
        if (static_cast<std::size_t> (bytes (value) - found->first) < plan.flat().nodes[found->second].type->outputs_size) needed_nodes.insert (found->second);
}

bool FusedValues::settled()
{
    const bool is_settled = needed.size() == needed_before;
    needed_before = needed.size();
    if (is_settled) return true;
    scopes.assign (1, {});
    all.clear();
    by_object.clear();
    return false;
}

}   // namespace tactus::host
