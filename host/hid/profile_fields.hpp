// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/fields.hpp>
#include <host/hid/profile.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

/// Fields, with the kinds of values that only profiles have. What is wrong gets a message and the value of nothing.
class ProfileFields : public Fields
{
public:
    ProfileFields (const Json& what, std::string where, Messages&);

    bool flag (std::string_view key, bool otherwise = false);

    /// "0x0ce6", or a number.
    std::optional<int> id (std::string_view key, int max);
    std::vector<std::uint16_t> ids (std::string_view key);   ///< one, or a list

    Bytes hex (std::string_view key);
    std::vector<std::string> texts (std::string_view key);
    std::vector<double> numbers (std::string_view key);

    /// A name of a field, button, effort or report: lower case letters, digits and _, a letter first.
    std::string name (std::string_view key);
    std::array<std::string, 3> threeNames (std::string_view key);   ///< null is none

    /// A number with any unit: its value in SI, and the unit if it has one.
    struct Scale
    {
        double value = 0.0;
        std::string unit;
    };
    Scale scale (std::string_view key, double otherwise);

    /// Each entry of a list of objects.
    void each (std::string_view key, const std::function<void (ProfileFields&)>&);

    /// An object within; nothing is called if it is not there.
    void within (std::string_view key, const std::function<void (ProfileFields&)>&);

    const Json& json() const noexcept { return self; }
    const std::string& where() const noexcept { return place; }
    Messages& list() noexcept { return all; }

private:
    const Json* listOf (std::string_view key, std::string_view what);

    const Json& self;
    std::string place;
    Messages& all;
};

}   // namespace tactus::host::hid
