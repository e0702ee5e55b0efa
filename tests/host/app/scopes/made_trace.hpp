// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/scopes/trace_window.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

inline std::shared_ptr<Trace> emptyTrace (const std::string& name, double rate = 1000.0, Quantity q = Quantity::force, const std::string& unit = "N")
{
    return std::make_shared<Trace> (Tap { .name = name, .quantity = q, .unit = unit }, rate);
}

/// A trace with one value per tick, starting at a given tick.
inline std::shared_ptr<Trace> traceOf (const std::vector<double>& values, std::uint64_t first = 0, double rate = 1000.0, const std::string& name = "a.force")
{
    auto t = emptyTrace (name, rate);
    for (std::size_t i = 0; i < values.size(); ++i)
        t->add (first + i, values[i]);
    return t;
}

}   // namespace tactus::host
