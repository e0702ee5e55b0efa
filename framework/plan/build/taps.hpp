// SPDX-License-Identifier: MIT
#pragma once

#include "build.hpp"
#include "storage.hpp"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace tactus::plan
{

/// Makes the taps of a plan under construction: one for each component that is recorded.
class Taps
{
public:
    /// `valueOf` returns the address of one component of a port.
    Taps (const Flat& f, const PortUnits& u, Storage& s, std::vector<Tap>& t, std::function<const double*(const PortRef&)> v)
        : flat (f), units (u), storage (s), taps (t), valueOf (std::move (v))
    {
    }

    /// Adds a tap for each component of the port, and for each entry if the port is an array. A port of a placeholder gets one tap.
    void add (const Outside::Read&);

private:
    /// Does nothing if there is a tap with this name already.
    void addTap (const std::string& name, Quantity, std::string symbol, const double* value, int section);

    const Flat& flat;
    const PortUnits& units;
    Storage& storage;
    std::vector<Tap>& taps;
    std::function<const double*(const PortRef&)> valueOf;
    std::set<std::string> names;
};

}   // namespace tactus::plan
