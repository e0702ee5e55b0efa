// SPDX-License-Identifier: MIT
#pragma once

#include "dots.hpp"

#include <optional>
#include <string_view>

namespace tactus::host
{

/// The settings that the person asks for.
struct VestSettings
{
    Dots dots;
    double rate_hz = 50.0;   ///< the most messages per second

    /// Reads the keys of a description: "rate", and those of Dots, for the map in vest.json. Id: dots/wrong.
    static Result<VestSettings> read (const Json& description);
};

/// True if a vest is among the devices that bHaptics Player says it has, or if it does not say. Empty if the message is not JSON.
std::optional<bool> hasVest (std::string_view message);

}   // namespace tactus::host
