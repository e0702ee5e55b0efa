// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_plugin.h>

#include <tactus/kit/law.hpp>

namespace tactus::plugin
{

// The C interface numbers the kinds of laws as Law does.
static_assert (static_cast<int> (Law::Kind::power) == TACTUS_PLUGIN_LAW_POWER && static_cast<int> (Law::Kind::exponential) == TACTUS_PLUGIN_LAW_EXPONENTIAL
               && static_cast<int> (Law::Kind::table) == TACTUS_PLUGIN_LAW_TABLE && static_cast<int> (Law::Kind::dissipation) == TACTUS_PLUGIN_LAW_DISSIPATION);

/// A value of this kind; the other members are 0.
inline tactus_plugin_value valueOfKind (int kind) noexcept
{
    tactus_plugin_value v {};
    v.size = sizeof v;
    v.kind = kind;
    return v;
}

inline tactus_plugin_value numberValue (double number) noexcept
{
    auto v = valueOfKind (TACTUS_PLUGIN_NUMBER);
    v.a = number;
    return v;
}

/// The value points to the points of a table in the law, so the law must outlive it.
inline tactus_plugin_value lawValue (const Law& law) noexcept
{
    auto v = valueOfKind (TACTUS_PLUGIN_LAW);
    v.law = static_cast<int> (law.kind);
    v.a = law.a;
    v.b = law.b;
    v.x = law.table.x.data();
    v.y = law.table.y.data();
    v.count = law.table.x.size();
    return v;
}

/// The value points to the points of the curve, so the curve must outlive it.
inline tactus_plugin_value curveValue (const Curve& curve) noexcept
{
    auto v = valueOfKind (TACTUS_PLUGIN_CURVE);
    v.x = curve.x.data();
    v.y = curve.y.data();
    v.count = curve.x.size();
    return v;
}

inline Curve readCurve (const tactus_plugin_value& v) { return { { v.x, v.x + v.count }, { v.y, v.y + v.count } }; }

inline Law readLaw (const tactus_plugin_value& v) { return { static_cast<Law::Kind> (v.law), v.a, v.b, readCurve (v) }; }

}   // namespace tactus::plugin
