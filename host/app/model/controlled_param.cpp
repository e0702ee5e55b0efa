// SPDX-License-Identifier: GPL-3.0-or-later
#include "controlled_param.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/inside.hpp>
#include <tactus/plan/values.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tactus::host
{

const graph::Control* findControl (const graph::Graph& g, const std::string& id)
{
    const auto at = std::ranges::find (g.controls, id, &graph::Control::id);
    return at == g.controls.end() ? nullptr : &*at;
}

namespace
{
double si (const Json& written)
{
    const auto read = plan::readNumber (written);
    return read ? read->value : 0.0;
}

/// `wanted`, with a number after `separator` if a control already has it as this member.
std::string freed (const graph::Graph& g, const std::string& wanted, std::string graph::Control::*member, char separator)
{
    auto free = wanted;
    for (int i = 2; std::ranges::find (g.controls, free, member) != g.controls.end(); ++i)
        free = wanted + separator + std::to_string (i);
    return free;
}

/// A control without targets, with an id and a name of its own.
graph::Control freshControl (const graph::Graph& g, const std::string& id, const std::string& name)
{
    graph::Control c;
    c.id = freed (g, id, &graph::Control::id, '_');
    c.name = freed (g, name, &graph::Control::name, ' ');
    return c;
}

/// Turns "drag.break_away" into "Break away".
std::string titleOf (const std::string& path)
{
    auto title = path.substr (path.rfind ('.') + 1);
    title = title.substr (0, title.find ('['));
    std::ranges::replace (title, '_', ' ');
    if (! title.empty()) title[0] = static_cast<char> (std::toupper (static_cast<unsigned char> (title[0])));
    return title;
}

/// The path of the parameter that this one exposes, however deep; the same path if it exposes none.
std::string innermostPath (const graph::Graph& g, const std::string& path)
{
    const auto end = graph::parseEndpoint (path);
    return end ? graph::toText (graph::innermost (g, g.root, *end, &graph::Expose::params)) : path;
}

ControlledParam controlled (const graph::Control& c, const graph::Control::Target& t)
{
    const double low = si (t.low), high = si (t.high);
    return { c.id, c.name.empty() ? c.id : c.name, t.path, low, high, low + c.value * (high - low), t.low.is_string() ? t.low : t.high };
}
}   // namespace

std::optional<ControlledParam> controlOf (const graph::Graph& g, const std::string& path)
{
    for (const auto& c : g.controls)
        for (const auto& t : c.to)
            if (t.path == path) return controlled (c, t);
    const auto inside = innermostPath (g, path);
    for (const auto& c : g.controls)
        for (const auto& t : c.to)
            if (inside != path && innermostPath (g, t.path) == inside) return controlled (c, t);
    return std::nullopt;
}

std::optional<graph::Command> moveControlFor (const graph::Graph& g, const ControlledParam& param, double to_si)
{
    const auto* control = findControl (g, param.control);
    if (control == nullptr || param.low == param.high) return std::nullopt;
    const double at = (to_si - param.low) / (param.high - param.low);
    if (! (at > -1e-9 && at < 1.0 + 1e-9)) return std::nullopt;
    auto to = *control;
    to.value = std::clamp (std::round (at * 1e6) * 1e-6, 0.0, 1.0);
    return graph::ChangeControl { param.control, std::move (to) };
}

graph::Command newControlFor (const graph::Graph& g, const std::string& path, const Json& low, const Json& high, double now_si)
{
    const auto param = path.substr (path.rfind ('.') + 1);
    auto c = freshControl (g, param.substr (0, param.find ('[')), titleOf (path));
    const double a = si (low), b = si (high);
    c.value = a == b ? 0.5 : std::clamp ((now_si - a) / (b - a), 0.0, 1.0);
    c.to.push_back ({ path, low, high });
    return graph::AddControl { std::move (c) };
}

graph::Command newControl (const graph::Graph& g)
{
    return graph::AddControl { freshControl (g, "control", TRANS ("Control").toStdString()) };
}

}   // namespace tactus::host
