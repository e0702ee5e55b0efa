// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_file.hpp"

#include <array>
#include <cmath>
#include <string_view>

namespace tactus::host
{

namespace
{
constexpr std::array<std::string_view, 6> kind_names { "time", "over", "spectrum", "spectrogram", "energy", "tool" };   // in the order of ScopeKind
constexpr std::array<std::string_view, 3> edge_names { "off", "rising", "falling" };
constexpr std::size_t most_scopes_read = 8, most_ports_read = 16;
constexpr double least_share_read = 0.1, most_share_read = 10.0;

constexpr std::array<std::pair<const char*, std::string ScopeSpec::*>, 4> texts {
    { { "x", &ScopeSpec::x }, { "y", &ScopeSpec::y }, { "state", &ScopeSpec::state }, { "node", &ScopeSpec::node } }
};
constexpr std::array<std::pair<const char*, bool ScopeSpec::*>, 2> switches {
    { { "normal", &ScopeSpec::has_normal }, { "decibels", &ScopeSpec::in_decibels } }
};

std::string textIn (const Json& json, const char* key)
{
    const auto found = json.find (key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

double numberIn (const Json& json, const char* key, double fallback, double least, double most)
{
    const auto found = json.find (key);
    if (found == json.end() || ! found->is_number() || ! std::isfinite (found->get<double>())) return fallback;
    return std::clamp (found->get<double>(), least, most);
}

template <std::size_t N>
std::size_t indexIn (const std::array<std::string_view, N>& names, const Json& json, const char* key)
{
    return static_cast<std::size_t> (std::ranges::find (names, textIn (json, key)) - names.begin());
}

std::optional<ScopeSpec> readScope (const Json& json)
{
    if (! json.is_object()) return std::nullopt;
    const auto kind = indexIn (kind_names, json, "kind");
    if (kind == kind_names.size()) return std::nullopt;
    ScopeSpec s;
    s.kind = static_cast<ScopeKind> (kind);
    if (const auto ports = json.find ("ports"); ports != json.end() && ports->is_array())
        for (const auto& port : *ports)
            if (port.is_string() && s.ports.size() < most_ports_read) s.ports.push_back (port.get<std::string>());
    for (const auto& [key, member] : texts)
        s.*member = textIn (json, key);
    for (const auto& [key, member] : switches)
        if (const auto found = json.find (key); found != json.end() && found->is_boolean()) s.*member = found->get<bool>();
    s.component = static_cast<int> (numberIn (json, "component", s.component, -1, 2));
    s.seconds = numberIn (json, "seconds", s.seconds, ScopeSpec::least_s, ScopeSpec::most_s);
    s.up_to_hz = numberIn (json, "up_to_hz", s.up_to_hz, 0.0, 1e6);
    s.share = numberIn (json, "share", s.share, least_share_read, most_share_read);
    if (const auto edge = indexIn (edge_names, json, "edge"); edge < edge_names.size()) s.trigger.edge = static_cast<ScopeTrigger::Edge> (edge);
    s.trigger.level = numberIn (json, "level", 0.0, -1e9, 1e9);
    return s;
}
}   // namespace

Json writeScopes (const std::vector<ScopeSpec>& scopes)
{
    auto all = Json::array();
    for (const auto& s : scopes)
    {
        auto json = Json::object();
        json["kind"] = std::string (kind_names[static_cast<std::size_t> (s.kind)]);
        if (! s.ports.empty())
        {
            auto ports = Json::array();
            for (const auto& port : s.ports)
                ports.push_back (Json (port));
            json["ports"] = std::move (ports);
        }
        for (const auto& [key, member] : texts)
            if (! (s.*member).empty()) json[key] = s.*member;
        for (const auto& [key, member] : switches)
            json[key] = s.*member;
        json["component"] = s.component;
        json["seconds"] = s.seconds;
        json["up_to_hz"] = s.up_to_hz;
        json["share"] = s.share;
        json["edge"] = std::string (edge_names[static_cast<std::size_t> (s.trigger.edge)]);
        json["level"] = s.trigger.level;
        all.push_back (std::move (json));
    }
    return all;
}

std::optional<std::vector<ScopeSpec>> readScopes (const Json& ui)
{
    if (! ui.is_object()) return std::nullopt;
    const auto list = ui.find ("scopes");
    if (list == ui.end() || ! list->is_array()) return std::nullopt;
    std::vector<ScopeSpec> all;
    for (const auto& json : *list)
        if (auto s = readScope (json); s && all.size() < most_scopes_read) all.push_back (std::move (*s));
    return all;
}

}   // namespace tactus::host
