// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_model.hpp"

namespace tactus::host
{

bool holdsProbes (const ScopeSpec& s) { return s.kind == ScopeKind::time || s.kind == ScopeKind::spectrum || s.kind == ScopeKind::spectrogram; }

bool ScopeModel::shows (const std::string& port) const
{
    return std::ranges::any_of (scopes, [&] (const auto& s) { return holdsProbes (*s) && std::ranges::count (s->ports, port) > 0; });
}

bool ScopeModel::probe (const std::string& port)
{
    ScopeSpec* to = nullptr;
    for (const auto& s : scopes)
        if (holdsProbes (*s) && (s.get() == active || (to == nullptr && s->kind == ScopeKind::time))) to = s.get();
    if (to == nullptr)
    {
        scopes.push_back (std::make_unique<ScopeSpec>());
        to = scopes.back().get();
    }
    if (std::erase (to->ports, port) > 0) return false;
    to->addPort (port);
    return true;
}

std::vector<std::string> portsOf (const ScopeSpec& s, const std::vector<std::string>& energies)
{
    switch (s.kind)
    {
    case ScopeKind::time:
    case ScopeKind::spectrum:
    case ScopeKind::spectrogram:
        return s.ports;
    case ScopeKind::over:
    {
        std::vector<std::string> all;
        for (const auto& p : { s.x, s.y, s.state })
            if (! p.empty()) all.push_back (p);
        return all;
    }
    case ScopeKind::energy:
    {
        auto all = energies;
        for (const auto& p : { s.x, s.y })
            if (! p.empty()) all.push_back (p);
        return all;
    }
    case ScopeKind::tool:
        break;
    }
    if (s.node.empty()) return {};
    std::vector<std::string> all;
    for (const char* port : { ".position", ".deflection", ".force", ".state", ".d_max", ".static_ratio" })
        all.push_back (s.node + port);
    if (s.has_normal) all.push_back (s.node + ".normal");
    return all;
}

void click (std::vector<Cursor>& cursors, const Cursor& c)
{
    if (cursors.size() >= 2)
        cursors.clear();
    else if (! cursors.empty() && cursors.front().lane != c.lane)
        cursors = { c };   // a difference between two units is meaningless
    else
        cursors.push_back (c);
}

const Extent& AutoRange::update (const Extent& seen)
{
    if (seen.isEmpty())
    {
        if (range.isEmpty()) range = { -1.0, 1.0 };
        return range;
    }
    const auto wanted = widened (seen, air);
    const bool moves = seen.size() > 0.0;
    if (range.isEmpty() || (is_guess && moves))
    {
        is_guess = ! moves;
        return range = wanted;
    }

    since_calm.include (wanted);
    if (since_calm.size() > much_less * range.size() || wanted.low < range.low || wanted.high > range.high)
    {
        calm = 0;
        since_calm = {};
    }
    else if (++calm > updates_to_wait)
    {
        range = since_calm;
        calm = 0;
        since_calm = {};
    }
    if (wanted.low < range.low) range.low = wanted.low;
    if (wanted.high > range.high) range.high = wanted.high;
    return range;
}

}   // namespace tactus::host
