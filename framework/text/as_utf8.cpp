// SPDX-License-Identifier: MIT
#include "as_utf8.hpp"

#include <cstdint>

namespace tactus
{

namespace
{
enum class Order
{
    none,
    little,
    big
};

Order orderOf (std::string_view bytes)
{
    if (bytes.size() < 4 || bytes.size() % 2 != 0) return Order::none;
    if (bytes.starts_with ("\xff\xfe")) return Order::little;
    if (bytes.starts_with ("\xfe\xff")) return Order::big;
    const auto isZero = [&] (std::size_t i) { return bytes[i] == '\0'; };
    if (! isZero (0) && isZero (1) && ! isZero (2) && isZero (3)) return Order::little;
    if (isZero (0) && ! isZero (1) && isZero (2) && ! isZero (3)) return Order::big;
    return Order::none;
}

void append (std::string& out, std::uint32_t code)
{
    const auto byte = [&] (std::uint32_t v) { out += static_cast<char> (static_cast<unsigned char> (v)); };
    if (code < 0x80u) return byte (code);
    if (code < 0x800u)
        byte (0xc0u | code >> 6u);
    else if (code < 0x10000u)
    {
        byte (0xe0u | code >> 12u);
        byte (0x80u | (code >> 6u & 0x3fu));
    }
    else
    {
        byte (0xf0u | code >> 18u);
        byte (0x80u | (code >> 12u & 0x3fu));
        byte (0x80u | (code >> 6u & 0x3fu));
    }
    byte (0x80u | (code & 0x3fu));
}
}   // namespace

std::string asUtf8 (std::string_view bytes)
{
    const auto order = orderOf (bytes);
    if (order == Order::none) return std::string (bytes);
    const auto unit = [&] (std::size_t i) {
        const auto a = static_cast<unsigned char> (bytes[i]), b = static_cast<unsigned char> (bytes[i + 1]);
        return static_cast<std::uint32_t> (order == Order::little ? a | b << 8 : a << 8 | b);
    };
    constexpr std::uint32_t unknown = 0xfffd, mark = 0xfeff;
    std::string out;
    out.reserve (bytes.size() / 2);
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    {
        const auto first = unit (i);
        const bool is_high = first >= 0xd800u && first < 0xdc00u, is_low = first >= 0xdc00u && first < 0xe000u;
        if (i == 0 && first == mark) continue;
        if (is_high && i + 3 < bytes.size())
            if (const auto second = unit (i + 2); second >= 0xdc00u && second < 0xe000u)
            {
                append (out, 0x10000u + ((first - 0xd800u) << 10u) + (second - 0xdc00u));
                i += 2;
                continue;
            }
        append (out, is_high || is_low ? unknown : first);
    }
    return out;
}

}   // namespace tactus
