// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "osc_address.hpp"

#include <CLI/CLI.hpp>

namespace tactus::host
{

/// For `--osc PORT|ADDRESS:PORT|off`.
inline CLI::Validator oscCheck()
{
    return { [] (std::string& text)
             { return text == "off" || readListen (text) ? std::string() : "'" + text + "' is neither a UDP port (0 to 65535) nor ADDRESS:PORT, as in 192.168.1.5:7770, nor off"; },
             "PORT|ADDRESS:PORT|off" };
}

/// For `--osc-answer ADDRESS`.
inline CLI::Validator addressCheck()
{
    return { [] (std::string& text)
             { return isAddress (text) ? std::string() : "'" + text + "' is no address, as in 192.168.1.7"; },
             "ADDRESS" };
}

}   // namespace tactus::host
