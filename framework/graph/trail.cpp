// SPDX-License-Identifier: MIT
#include "trail.hpp"
#include "edit.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::graph
{

namespace
{
/// Adds what a command does to the wires of the graph itself. False if it does anything else that affects compiling.
struct Follow
{
    std::vector<Trail::WireStep>& wires;

    bool operator() (const AddWire& c) const { return c.patch.empty() && set (c.wire.id, c.wire); }
    bool operator() (const RemoveWire& c) const
    {
        if (c.patch.empty()) wires.push_back ({ c.wire, nullptr });
        return c.patch.empty();
    }
    bool operator() (const ChangeWire& c) const { return c.patch.empty() && set (c.wire, c.to); }
    bool operator() (const SetHeader& c) const { return ! c.rate_hz; }
    bool operator() (const SetNodeKey& c) const { return c.key == "ui"; }
    bool operator() (const Batch& c) const
    {
        return std::ranges::all_of (c.commands, [this] (const Command& one) { return std::visit (*this, one.edit); });
    }

    template <typename Other>
    bool operator() (const Other&) const
    {
        return false;
    }

private:
    bool set (Id id, Wire wire) const
    {
        wire.id = id;
        wires.push_back ({ id, std::make_shared<Wire> (std::move (wire)) });
        return true;
    }
};
}   // namespace

std::optional<std::vector<Trail::WireStep>> Trail::wiresSince (Id version) const
{
    const auto first = std::ranges::find (steps, version, &Step::before);
    if (first == steps.end()) return std::nullopt;
    std::vector<WireStep> wires;
    for (auto step = first; step != steps.end(); ++step)
        wires.insert (wires.end(), step->wires.begin(), step->wires.end());
    return wires;
}

void Trail::note (const Command& command)
{
    Step step { own_version };
    own_version = newId();
    if (! std::visit (Follow { step.wires }, command.edit))
    {
        steps.clear();
        return;
    }
    if (steps.size() == most) steps.erase (steps.begin());
    steps.push_back (std::move (step));
}

}   // namespace tactus::graph
