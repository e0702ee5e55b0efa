// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace tactus::host::hid
{

/// Where the i-th bit of a number stands: bytes in either order, the lowest bit of a byte first.
inline std::size_t placeOf (const Bits& b, std::size_t i) noexcept
{
    if (! b.big_endian) return b.at + i;
    const std::size_t byte = (b.size - 1 - i) / 8;
    return b.at + 8 * byte + i % 8;
}

/// The raw bits, the lowest first; the field has to lie within the report.
inline std::uint32_t bitsAt (const Bits& b, std::span<const std::uint8_t> report) noexcept
{
    std::uint32_t raw = 0;
    for (std::size_t i = 0; i < b.size; ++i)
    {
        const auto place = placeOf (b, i);
        raw |= static_cast<std::uint32_t> (report[place / 8] >> (place % 8) & 1u) << i;
    }
    return raw;
}

inline void putBits (const Bits& b, std::uint32_t raw, std::span<std::uint8_t> report) noexcept
{
    for (std::size_t i = 0; i < b.size; ++i)
    {
        const auto place = placeOf (b, i);
        const auto mask = static_cast<std::uint8_t> (1u << place % 8);
        auto& byte = report[place / 8];
        byte = static_cast<std::uint8_t> ((raw >> i & 1u) != 0 ? byte | mask : byte & ~mask);
    }
}

/// The number that the raw bits stand for.
inline double numberOf (const Bits& b, std::uint32_t raw) noexcept
{
    if (b.is_float) return static_cast<double> (std::bit_cast<float> (raw));
    const bool negative = b.is_signed && (raw >> (b.size - 1) & 1u) != 0;
    return static_cast<double> (raw) - (negative ? static_cast<double> (std::uint64_t { 1 } << b.size) : 0.0);
}

/// What the bits can hold.
inline double smallest (const Bits& b) noexcept
{
    if (b.is_float) return static_cast<double> (std::numeric_limits<float>::lowest());
    return b.is_signed ? -static_cast<double> (std::uint64_t { 1 } << (b.size - 1)) : 0.0;
}

inline double largest (const Bits& b) noexcept
{
    if (b.is_float) return static_cast<double> (std::numeric_limits<float>::max());
    return static_cast<double> (std::uint64_t { 1 } << (b.is_signed ? b.size - 1 : b.size)) - 1.0;
}

/// The bits of a number: rounded, and clamped to what they can hold. The number is finite.
inline std::uint32_t rawOf (const Bits& b, double number) noexcept
{
    const double held = std::clamp (number, smallest (b), largest (b));
    if (b.is_float) return std::bit_cast<std::uint32_t> (static_cast<float> (held));
    return static_cast<std::uint32_t> (static_cast<std::int64_t> (std::floor (held + 0.5)));
}

}   // namespace tactus::host::hid
