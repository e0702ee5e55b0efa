// SPDX-License-Identifier: MIT
#include "taps.hpp"

#include <string>
#include <utility>

namespace tactus::plan
{

void Taps::add (const Outside::Read& read)
{
    const auto& [name, port] = read;
    if (! port)
    {
        addTap (name, Quantity::any, "", &Storage::zero, 0);
        return;
    }
    const auto& row = flat.sheet (*port);
    const bool every_entry = row.list && port->index < 0, every_component = row.width == 3 && port->component < 0;
    const int first_entry = every_entry ? 0 : port->index, last_entry = every_entry ? flat.node (*port).list_size - 1 : port->index;
    const int first_component = every_component ? 0 : port->component, last_component = every_component ? 2 : port->component;
    for (int i = first_entry; i <= last_entry; ++i)
    {
        const auto entry = every_entry ? name + "[" + std::to_string (i) + "]" : name;
        for (int c = first_component; c <= last_component; ++c)
        {
            const PortRef one { port->node, port->role, port->port, i, c };
            addTap (every_component ? entry + "." + "xyz"[c] : entry, units (one).quantity, units.symbol (one), valueOf (one), flat.node (one).section);
        }
    }
}

void Taps::addTap (const std::string& name, Quantity quantity, std::string symbol, const double* value, int section)
{
    if (! names.insert (name).second) return;
    taps.push_back ({ name, quantity, std::move (symbol), value });
    const double speed = flat.rests (section) ? 1.0 : flat.speed (section);
    if (speed == 1.0) return;
    auto& samples = storage.samples.emplace_back (static_cast<std::size_t> (speed));
    storage.sections[at (section)].samples.push_back ({ value, samples.data(), samples.size() });
    taps.back().per_tick = static_cast<int> (samples.size());
    taps.back().samples = samples.data();
}

}   // namespace tactus::plan
