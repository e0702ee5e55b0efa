// SPDX-License-Identifier: MIT
#include "hex.hpp"

#include <charconv>

namespace tactus::host::hid
{

std::optional<Bytes> bytesOf (std::string_view hex)
{
    Bytes bytes;
    const char* at = hex.data();
    const char* const end = at + hex.size();
    while (at != end)
    {
        if (*at == ' ')
        {
            ++at;
            continue;
        }

        std::uint8_t byte = 0;
        if (end - at < 2 || std::from_chars (at, at + 2, byte, 16).ptr != at + 2) return {};
        at += 2;

        std::size_t times = 1;
        if (at != end && *at == '*')
        {
            const auto [stop, failed] = std::from_chars (at + 1, end, times);
            if (failed != std::errc() || times == 0) return {};
            at = stop;
        }
        if (times > longest_report || bytes.size() + times > longest_report) return {};
        bytes.insert (bytes.end(), times, byte);
    }
    return bytes;
}

std::string hexOf (std::span<const std::uint8_t> bytes)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const auto byte : bytes)
    {
        if (! text.empty()) text += ' ';
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

}   // namespace tactus::host::hid
