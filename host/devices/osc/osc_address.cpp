// SPDX-License-Identifier: MIT
#include "osc_address.hpp"

#include <charconv>

namespace tactus::host
{

namespace
{
/// Parses an entire string as an unsigned number.
std::optional<int> wholeNumber (std::string_view text, int most) noexcept
{
    int n = 0;
    const auto [end, error] = std::from_chars (text.data(), text.data() + text.size(), n);
    if (error != std::errc {} || end != text.data() + text.size() || text.starts_with ('-') || n > most) return {};
    return n;
}
}   // namespace

bool isAddress (std::string_view text) noexcept
{
    int parts = 0;
    for (;; ++parts)
    {
        const auto dot = text.find ('.');
        if (const auto part = text.substr (0, dot); part.size() > 3 || ! wholeNumber (part, 255)) return false;
        if (dot == text.npos) return parts == 3;
        text.remove_prefix (dot + 1);
    }
}

std::optional<OscListen> readListen (std::string_view text) noexcept
{
    OscListen listen;
    if (const auto colon = text.find (':'); colon != text.npos)
    {
        if (! isAddress (text.substr (0, colon))) return {};
        listen.address = text.substr (0, colon);
        text.remove_prefix (colon + 1);
    }
    const auto port = wholeNumber (text, 65535);
    if (! port) return {};
    listen.port = *port;
    return listen;
}

std::string warningOf (const OscListen& listen)
{
    if (listen.isLoopback()) return {};
    return "any machine that can reach " + listen.address + " may set parameters, trigger hits and stop the run, but cannot change the limits of the guards. "
           + (listen.answered.empty() ? "Only this machine gets answers" : "This machine and " + listen.answered + " get answers");
}

}   // namespace tactus::host
