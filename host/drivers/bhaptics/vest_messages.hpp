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

/// Whether a vest is among the devices that bHaptics Player says it has; true if it does not say. None if the message is not JSON.
std::optional<bool> hasVest (std::string_view message);

}   // namespace tactus::host
