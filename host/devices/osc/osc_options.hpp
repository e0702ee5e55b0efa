// SPDX-License-Identifier: MIT
#pragma once

#include "osc_address.hpp"

#include <host/base/command_line/command.hpp>

namespace tactus::host
{

/// Checks the value of `--osc PORT|ADDRESS:PORT|off`.
inline Check oscCheck()
{
    return { [] (const std::string& text) {
                if (text == "off" || readListen (text)) return std::string();
                return "'" + text + "' is not a UDP port (0 to 65535), an ADDRESS:PORT such as 192.168.1.5:7770, or off";
            },
             "PORT|ADDRESS:PORT|off" };
}

/// Checks the value of `--osc-answer ADDRESS`.
inline Check addressCheck()
{
    return { [] (const std::string& text) { return isAddress (text) ? std::string() : "'" + text + "' is not an IPv4 address such as 192.168.1.7"; },
             "ADDRESS" };
}

}   // namespace tactus::host
