// SPDX-License-Identifier: GPL-3.0-or-later
#include "problem_location.hpp"

#include <host/app/model/patch.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <cstdlib>

namespace tactus::host
{

std::vector<std::string> pointerParts (const std::string& pointer)
{
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < pointer.size();)
    {
        const auto end = std::min (pointer.find ('/', at + 1), pointer.size());
        auto& part = parts.emplace_back();
        for (std::size_t i = at + 1; i < end; ++i)
        {
            const bool escaped = pointer[i] == '~' && i + 1 < end;
            if (escaped) ++i;
            const char unescaped = pointer[i] == '1' ? '/' : '~';
            part += escaped ? unescaped : pointer[i];
        }
        at = end;
    }
    return parts;
}

ProblemLocation locationOf (const graph::Graph& g, const Message& m)
{
    ProblemLocation location;
    auto parts = pointerParts (m.where);
    if (parts.size() > 2 && parts[0] == "graphs")
    {
        location.patch = parts[1];
        parts.erase (parts.begin(), parts.begin() + 2);
    }
    const auto* patch = findPatch (g, location.patch);
    if (patch == nullptr || ! m.file.empty() || parts.size() < 2) return location;
    if (parts[0] == "devices") location.role = parts[1];
    if (parts[0] == "nodes")
        if (const auto* node = patch->find (parts[1]))
        {
            location.id = node->id;
            location.node = node->name;
            if (parts.size() > 3 && parts[2] == "params") location.param = parts[3];
            if (parts.size() > 3 && parts[2] == "settings") location.setting = parts[3];
            for (std::size_t i = 4; i < parts.size() && ! location.setting.empty(); ++i)
                location.within += "/" + pointerPart (parts[i]);
        }
    if (parts[0] == "wires" && ! parts[1].empty() && std::ranges::all_of (parts[1], [] (char c) { return c >= '0' && c <= '9'; }))
        if (const auto i = std::strtoull (parts[1].c_str(), nullptr, 10); i < patch->wires.size()) location.id = patch->wires[i].id;
    return location;
}

}   // namespace tactus::host
