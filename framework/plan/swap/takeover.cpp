// SPDX-License-Identifier: MIT
#include "takeover.hpp"

#include <cstring>

namespace tactus::plan
{

void Takeover::carryOut (const std::vector<Instance>& instances, Ramps& ramps, const Ramps& before, Journal* journal) const noexcept
{
    for (const auto& [line, old] : relays)
        line->adopt (*old);
    for (const auto& [converter, old] : conversions)
        converter->adopt (*old);
    for (const auto& [to, from, bytes] : held)
        std::memcpy (to, from, bytes);

    for (const auto& [i, adopt, old] : successors)
    {
        const auto& instance = instances[i];
        if (instance.knobs)
        {
            for (std::size_t k = 0; k < instance.knobs->all.size(); ++k)
                if (! instance.isDriven (k)) instance.write (k, instance.knobs->all[k].value);
            if (const auto update = instance.knobs->type.update) update (instance.node.get());
        }
        if (adopt) adopt (instance.node.get(), old);
    }

    ramps.goOn (before);
    for (const auto& [i, old] : rebuilt)
        ramps.inherit (i, *old);
    for (const auto& [i, k] : releases)
    {
        auto& knob = instances[i].knobs->all[k];
        const double stored = knob.left > 0 ? knob.to : knob.value;
        knob.value = *instances[i].param (k);
        ramps.head (i, k, stored);
    }
    for (const auto& [i, k, value, at_once, turns] : changes)
    {
        auto& knob = instances[i].knobs->all[k];
        const bool turned_since = static_cast<std::int32_t> (knob.heeded - turns) > 0;
        if (turned_since)
        {
            if (journal) journal->outdone (i, k);
            continue;
        }
        knob.heeded = turns;
        ramps.head (i, k, value, at_once);
    }
}

}   // namespace tactus::plan
