// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile.hpp>

#include <tactus/text/object_reader.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

/// An ObjectReader with the kinds of values that only profiles have. For a bad value it adds a message and returns a default.
class ProfileFields : public ObjectReader
{
public:
    ProfileFields (const Json& what, std::string where, Messages& list) : ObjectReader (what, std::move (where), list, "profile/") {}

    /// A number, written as "0x0ce6" or as a JSON number.
    std::optional<int> id (std::string_view key, int max);
    std::vector<std::uint16_t> ids (std::string_view key);   ///< one number, or a list of them

    Bytes hex (std::string_view key);

    /// The name of a field, button, effort or report: lower-case letters, digits and _, starting with a letter.
    std::string name (std::string_view key);
    std::array<std::string, 3> threeNames (std::string_view key);   ///< null in the list stands for a missing name

    /// A number with any unit. Returns its SI value, and its unit if it has one.
    struct Scale
    {
        double value = 0.0;
        std::string unit;
    };
    Scale scale (std::string_view key, double otherwise);

    /// Calls back for each entry of a list of objects.
    void each (std::string_view key, const std::function<void (ProfileFields&)>&);

    /// Calls back for an object within this one, if it exists.
    void within (std::string_view key, const std::function<void (ProfileFields&)>&);
};

}   // namespace tactus::host::hid
