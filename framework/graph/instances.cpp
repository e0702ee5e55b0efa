// SPDX-License-Identifier: MIT
#include "instances.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace tactus::graph
{

namespace
{
/// The leading "[…]" of a string, with its brackets; empty if there is none.
std::string_view bracketed (std::string_view text) noexcept { return text.starts_with ('[') ? text.substr (0, text.find (']') + 1) : std::string_view {}; }
}   // namespace

std::optional<int> countOf (const Node& node) noexcept
{
    const auto count = node.extra.find ("count");
    if (count == node.extra.end()) return std::nullopt;
    const double n = count->is_number() ? count->get<double>() : 0.0;
    return n >= 1.0 && n <= most_instances && n == std::floor (n) ? static_cast<int> (n) : 0;
}

PathStep firstStep (std::string_view path) noexcept
{
    std::size_t end = 0, bracket = path.size();
    for (; end < path.size() && path[end] != '/'; ++end)
        if (path[end] == '[') bracket = std::min (bracket, end);
    bracket = std::min (bracket, end);
    PathStep step { .name = path.substr (0, bracket), .rest = path.substr (std::min (end + 1, path.size())) };
    if (bracket == end) return step;

    const auto number = path.substr (bracket + 1, end - bracket - 2);
    step.instance = PathStep::all;
    if (number != "*" && std::from_chars (number.data(), number.data() + number.size(), step.instance).ec != std::errc {})
        step.instance = std::numeric_limits<int>::max();
    return step;
}

int namedInstances (std::string_view path) noexcept
{
    int named = 0;
    path = path.substr (0, path.find ('.'));
    for (auto at = path.find ('['); at != std::string_view::npos; at = path.find ('[', at + 1))
        named += ! path.substr (at).starts_with ("[*]");
    return named;
}

std::optional<std::size_t> covers (std::string_view name, std::string_view text) noexcept
{
    const auto whole = text.size();
    while (! name.empty())
    {
        const bool name_over = name.front() == '/' || name.front() == '.';
        if (name.starts_with ("[*]") || name_over) text.remove_prefix (bracketed (text).size());
        if (name.starts_with ("[*]"))
        {
            name.remove_prefix (3);
            continue;
        }
        if (text.empty() || name.front() != text.front()) return std::nullopt;
        name.remove_prefix (1);
        text.remove_prefix (1);
    }
    return whole - text.size();
}

}   // namespace tactus::graph
