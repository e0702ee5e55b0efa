// SPDX-License-Identifier: MIT
#include "plan.hpp"

#include <tactus/plan/build/storage.hpp>

#include <cmath>
#include <cstring>

namespace tactus
{

namespace
{
/// The values of a param in the node, and the knobs that turn them.
void serializeParam (StateArchive& archive, const plan::Instance& instance, const PortSheet& row, std::size_t first_knob, int slots)
{
    auto* place = static_cast<std::byte*> (instance.knobs->type.paramsOf (instance.node.get())) + row.offset;
    for (std::size_t k = 0; k < at (slots); ++k)
    {
        auto& knob = instance.knobs->all[first_knob + k];
        archive (knob.value, knob.to, knob.left);
        if (row.choices.empty())
            archive (reinterpret_cast<double*> (place)[k]);
        else
        {
            int chosen = 0;
            std::memcpy (&chosen, place, sizeof chosen);
            archive.index (chosen, row.choices.size());
            std::memcpy (place, &chosen, sizeof chosen);
        }
    }
}

void serializeNode (StateArchive& archive, const plan::FlatNode& n, const plan::Instance& instance)
{
    archive.enter ("node", n.path);
    if (auto* node = instance.node.get())
    {
        if (auto* knobs = instance.knobs.get())
        {
            for (std::size_t p = 0, first = 0; p < n.type->params.size(); first += plan::Knobs::roomOf (n.type->params[p++]))
                serializeParam (archive, instance, n.type->params[p], first, n.slots (n.type->params[p]));
            for (auto& pulse : knobs->pulses)
                archive (pulse.pending);
            if (archive.restores() && n.type->update) n.type->update (node);
        }
        if (n.type->serialize)
            n.type->serialize (node, archive);
        else
            archive.refuse ("has a state that cannot be saved: its type " + std::string (n.type->info.id) + " does not say what it is");
    }
    for (const auto& row : n.type->outputs)
        for (std::size_t k = 0; k < at (n.slots (row)); ++k)
            archive (*instance.output (row.offset + k * sizeof (double)));
}
}   // namespace

void Plan::serialize (StateArchive& archive)
{
    archive.enter ("graph", {});
    archive.expect (parts.flat.nodes.size());
    archive.expect (parts.instances.size());   // none are left after forgetGraph()
    archive.expect (parts.lines.size());
    archive.expect (parts.rate_converters.size());
    archive.expect (parts.feeds.size());
    if (parts.flat.nodes.size() != parts.instances.size() || parts.storage.empty()) archive.refuse ("has been forgotten");
    if (archive.isRefused()) return;

    archive (parts.number);
    for (double& feed : parts.feeds)
        archive (feed);
    for (std::size_t i = 0; i < parts.instances.size(); ++i)
        serializeNode (archive, parts.flat.nodes[i], parts.instances[i]);

    archive.enter ("graph", {});
    for (const auto& line : parts.lines)
    {
        archive (line.line->samples, line.line->out);
        archive.index (line.line->now, line.line->samples.size());
    }
    for (const auto& use : parts.rate_converters)
        archive (use.converter->out, use.converter->gathered, use.converter->before, use.converter->newest, use.converter->begun);

    auto& storage = *static_cast<plan::Storage*> (parts.storage.front().get());
    for (auto& sum : storage.sums)
        archive (sum.out);
    for (auto& strike : storage.strikes)
        archive (strike.out);
    for (auto& section : storage.sections)
        archive (section.number);
    for (auto& samples : storage.samples)
        archive (samples);
    parts.ramps.serialize (archive);
}

}   // namespace tactus
