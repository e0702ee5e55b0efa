// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/sources/code.hpp>

#include <tactus/node/setting.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// Writes settings of nodes as C++. Tables become constants; `data` collects their definitions.
class SettingCode
{
public:
    /// The constants are in this namespace.
    explicit SettingCode (std::string space_) : space (std::move (space_)) {}

    /// The setting as an expression that can be assigned to the member of the node. Constants get names that begin with `name`.
    std::string of (const SettingSheet&, const SettingValue&, const std::string& name);

    const std::string& data() const noexcept { return definitions; }
    bool usesData() const noexcept { return ! definitions.empty(); }

private:
    std::string constant (const std::string& type, const std::string& name, const std::string& value);

    /// A pointer to a constant of this type.
    std::string pointer (const std::string& type, const std::string& name, const std::string& value)
    {
        return "tactus::exported::pointerTo (" + constant (type, name, value) + ")";
    }

    std::string array (const std::string& type, const std::string& name, const std::vector<std::string>& values,
                       const std::string& view = "tactus::exported::over");
    std::string numbers (std::span<const double>, const std::string& name, const std::string& view = "tactus::exported::over");
    std::string curve (const Curve&, const std::string& name);
    std::string law (const Law&, const std::string& name);
    std::string record (const SettingSheet&, const Values&, const std::string& name);
    std::string records (const SettingSheet&, const Records&, const std::string& name);
    std::string signal (const Signal*, const std::string& name);
    std::string grid (const Grid*, const std::string& name);
    std::string mesh (const Mesh&, const std::string& name);
    std::string surface (const Surface*, const std::string& name);
    std::string curves (const Surface&, const std::string& name);
    std::string ratios (const Surface&, const std::string& name);
    std::string weights (const Surface&, const std::string& name);

    const std::string space;
    Names names;
    std::string definitions;
};

}   // namespace tactus::host
