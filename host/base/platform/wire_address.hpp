// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/quote.hpp>
#include <tactus/text/result.hpp>

#include <charconv>
#include <string>
#include <system_error>
#include <utility>

namespace tactus::host
{

/// A host and a port, both written in numbers.
struct WireAddress
{
    std::string host, port;

    static Message refusal (const std::string& address, std::string why)
    {
        return Message::error ("device/wire", address, quote (address) + " is no address: " + std::move (why),
                               "write it in numbers, as 192.168.4.1:9750 or [fe80::1%eth0]:9750");
    }

    /// Splits "192.168.4.1:9750" or "[fe80::1%eth0]:9750". Whether the host is one is for the system to say. Id: device/wire.
    static Result<WireAddress> read (const std::string& address)
    {
        const auto colon = address.rfind (':');
        WireAddress made { address.substr (0, colon == address.npos ? 0 : colon), colon == address.npos ? std::string() : address.substr (colon + 1) };
        auto& host = made.host;
        const auto& port = made.port;
        if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr (1, host.size() - 2);
        if (host.empty() || port.empty()) return refusal (address, "it has no host, or no port");
        int number = 0;   // getaddrinfo would take 65537 for 1
        const auto [end, wrong] = std::from_chars (port.data(), port.data() + port.size(), number);
        const bool is_port = wrong == std::errc() && end == port.data() + port.size() && number >= 1 && number <= 65535;
        return is_port ? Result<WireAddress> (std::move (made)) : Result<WireAddress> (refusal (address, "its port must be a number from 1 to 65535"));
    }
};

}   // namespace tactus::host
