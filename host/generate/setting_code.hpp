// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "code.hpp"

#include <tactus/node/setting.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// Writes settings of nodes as C++. Large tables become constant arrays; `data` collects their definitions.
class SettingCode
{
public:
    /// The arrays are in this namespace.
    explicit SettingCode (std::string space_) : space (std::move (space_)) {}

    /// The setting as an expression that can be assigned to the member of the node. Arrays get names that begin with `name`.
    std::string of (const SettingSheet&, const SettingValue&, const std::string& name);

    const std::string& data() const noexcept { return arrays; }
    bool usesData() const noexcept { return ! arrays.empty(); }

private:
    std::string numbers (std::span<const double>, const std::string& name);
    std::string array (const std::string& type, const std::string& name, const std::vector<std::string>& values);
    std::string numberArray (std::span<const double>, const std::string& name);
    std::string curve (const Curve&, const std::string& name);
    std::string law (const Law&, const std::string& name);
    std::string lawData (const Law&, const std::string& name);
    std::string record (const SettingSheet&, const Values&, const std::string& name);
    std::string records (const SettingSheet&, const Records&, const std::string& name);
    std::string signal (const Signal*, const std::string& name);
    std::string grid (const Grid*, const std::string& name);
    std::string surface (const Surface*, const std::string& name);
    std::string curves (const Surface&, const std::string& name);
    std::string ratios (const Surface&, const std::string& name);

    const std::string space;
    Names names;
    std::string arrays;
};

}   // namespace tactus::host
