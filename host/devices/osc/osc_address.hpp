// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tactus::host
{

/// The address at which to listen for OSC messages, and the only other machine that gets answers.
struct OscListen
{
    static constexpr const char* loopback = "127.0.0.1";

    std::string address = loopback;   ///< address of a network interface; 0.0.0.0: all of them
    int port = 0;                     ///< 0: any free port
    std::string answered {};          ///< the only other machine that gets answers; "": none

    /// True if only programs on this machine can send.
    bool isLoopback() const noexcept { return address.starts_with ("127."); }
};

/// True for four numbers from 0 to 255 separated by dots. (IPv6 is not supported.)
bool isAddress (std::string_view) noexcept;

/// Parses "7770" or "192.168.1.5:7770". Empty for anything else.
std::optional<OscListen> readListen (std::string_view) noexcept;

/// A warning if other machines can send; empty on loopback.
std::string warningOf (const OscListen&);

}   // namespace tactus::host
