// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tactus::host
{

/// Where OSC messages are listened for, and who beside the programs of this machine gets answers.
struct OscListen
{
    static constexpr const char* loopback = "127.0.0.1";

    std::string address = loopback;   ///< of a network card; 0.0.0.0: all of them
    int port = 0;                     ///< 0: any that is free
    std::string answered {};          ///< the one other machine that gets answers; "": none

    /// True if nobody but the programs of this machine gets through.
    bool isLoopback() const noexcept { return address.starts_with ("127."); }
};

/// True of four numbers from 0 to 255 with dots between them. (IPv6 is not spoken.)
bool isAddress (std::string_view) noexcept;

/// "7770" or "192.168.1.5:7770"; nothing if it is neither.
std::optional<OscListen> readListen (std::string_view) noexcept;

/// What is to be said where others are let in: empty on loopback.
std::string warningOf (const OscListen&);

}   // namespace tactus::host
