// SPDX-License-Identifier: MIT
#include "fused_values.hpp"

#include <host/code/generate/walk/visit_record.hpp>

#include <tactus/kit/vec3.hpp>

namespace tactus::host
{

FusedValues::FusedValues (const Plan& p) : plan (p), addresses (p)
{
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& instance = plan.instances()[i];
        if (instance.node) by_node.emplace (instance.node.get(), i);
    }
    findChanging (plan.records());
    findChanging (plan.settled());
    for (const auto& tap : plan.taps())
        need (tap.value);
}

bool FusedValues::isNode (const Record& r) const
{
    const auto node = by_node.find (r.self);
    if (node == by_node.end()) return false;
    const auto& type = *plan.flat().nodes[node->second].type;
    return r.step == type.tick || r.step == type.peek;
}

void FusedValues::findChanging (std::span<const Record> records)
{
    const auto section = [this] (const SectionStep& s) {
        for (const auto* links : { &s.running.latches, &s.running.gathers, &s.running.lines, &s.running.pulses })
            for (const auto& link : *links)
                changing.insert (&link.converter->out);
        findChanging (s.running.records);
    };
    for (const auto& r : records)
        visitRecord (r, Cases { [] (const auto&) {}, section,
                                [this] (const plan::Sum& sum) { changing.insert (&sum.out); },
                                [this] (const plan::Strike& strike) { changing.insert (&strike.out); },
                                [this] (const DelayRead& delay) { changing.insert (&delay.line->out); },
                                [this] (const Record& other) { has_unknown = has_unknown || ! isNode (other); } });
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

/// True for defaults of inputs, which nothing ever writes.
bool FusedValues::isConstant (const double* value) const
{
    if (has_unknown || changing.contains (value)) return false;
    if (const auto feeds = plan.feeds(); value >= feeds.data() && value < feeds.data() + feeds.size()) return false;
    if (addresses.outputAt (value) || addresses.paramAt (value)) return false;
    return isFinite (*value);   // checked last: the checks above exclude the values that the tick thread writes
}

/// The variable that has a value, if one is in scope.
std::optional<FusedValues::Place> FusedValues::variableOf (const double* value) const
{
    const auto output = addresses.outputAt (value);
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
    if (const auto output = addresses.outputAt (value)) needed_nodes.insert (output->instance);
}

void FusedValues::need (const Record& r)
{
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        if (plan.instances()[i].sources != r.sources) continue;   // a node without inputs has the same sources as the next one
        const auto& flat = plan.flat().nodes[i];
        std::size_t slot = 0;
        for (const auto& row : flat.type->inputs)
            for (int k = 0; k < flat.slots (row); ++k, ++slot)
                if (! flat.muted) need (r.sources[slot]);
    }
    const auto driven = [this] (const plan::DrivenNode& node) {
        for (const auto& drive : node.drives)
            for (const auto* from : { drive.replace, drive.add })
                if (from != nullptr) need (from);
    };
    visitRecord (r, Cases { [] (const auto&) {}, driven });
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
