// SPDX-License-Identifier: GPL-3.0-or-later
#include "law_shape.hpp"

#include <host/app/model/quantity_text.hpp>

#include <cmath>

namespace tactus::host
{

const std::vector<std::string>& lawKinds()
{
    static const std::vector<std::string> kinds { "none", "power", "exponential", "table", "dissipation" };
    return kinds;
}

std::string lawKindOf (const Json& law)
{
    if (law.is_object())
        for (const auto& kind : lawKinds())
            if (law.contains (kind)) return kind;
    return "none";
}

Json lawOfKind (const std::string& kind, const Law& before)
{
    constexpr double pressed = 1.0;   // the old and the new law agree at this force, in N
    double at = before.inverse (pressed), force = pressed;
    if (! std::isfinite (at) || ! (at > 0.0))
    {
        at = 1e-3;
        force = pressed;
    }
    const auto forceAt = [&] (double part) { return before && before.kind != Law::Kind::dissipation ? before (part * at) : part * force; };
    if (kind == "power") return { { "power", { rounded (force / at), 1 } } };
    if (kind == "exponential") return { { "exponential", { rounded (force / std::expm1 (1.0)), rounded (1.0 / at) } } };
    if (kind == "dissipation") return { { "dissipation", 1 } };
    if (kind != "table") return {};
    auto x = Json::array(), y = Json::array();
    for (const double part : { 0.0, 0.5, 1.0, 2.0 })
    {
        x.push_back (rounded (part * at));
        y.push_back (rounded (forceAt (part)));
    }
    return { { "table", { x, y } } };
}

}   // namespace tactus::host
