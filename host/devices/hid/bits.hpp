// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace tactus::host::hid
{

/// A mask as wide as the number.
inline std::uint64_t maskOf (const Bits& b) noexcept { return (std::uint64_t { 1 } << b.size) - 1; }

/// Visits the bytes that a number touches, at most five: first byte first, or last byte first if it is big-endian. Calls
/// back with the index of each byte and the shift of its bits.
template <typename Byte>
void eachByte (const Bits& b, Byte&& byte) noexcept
{
    const std::size_t first = b.at / 8, last = (b.end() - 1) / 8;
    for (std::size_t i = first; i <= last; ++i)
        byte (b.big_endian ? first + last - i : i, 8 * (i - first));
}

/// The raw bits, lowest first. The field must lie within the report.
inline std::uint32_t bitsAt (const Bits& b, std::span<const std::uint8_t> report) noexcept
{
    std::uint64_t all = 0;
    eachByte (b, [&] (std::size_t i, std::size_t shift) { all |= std::uint64_t { report[i] } << shift; });
    return static_cast<std::uint32_t> (all >> b.at % 8 & maskOf (b));
}

inline void putBits (const Bits& b, std::uint32_t raw, std::span<std::uint8_t> report) noexcept
{
    const auto mask = maskOf (b) << b.at % 8, value = std::uint64_t { raw } << b.at % 8 & mask;
    eachByte (b, [&] (std::size_t i, std::size_t shift) { report[i] = static_cast<std::uint8_t> ((report[i] & ~(mask >> shift)) | value >> shift); });
}

/// The number that the raw bits encode.
inline double numberOf (const Bits& b, std::uint32_t raw) noexcept
{
    if (b.is_float) return static_cast<double> (std::bit_cast<float> (raw));
    const bool negative = b.is_signed && (raw >> (b.size - 1) & 1u) != 0;
    return static_cast<double> (raw) - (negative ? static_cast<double> (std::uint64_t { 1 } << b.size) : 0.0);
}

/// The smallest and the largest number that the bits can hold.
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

/// Encodes a finite number: rounded, and clamped to what the bits can hold.
inline std::uint32_t rawOf (const Bits& b, double number) noexcept
{
    const double held = std::clamp (number, smallest (b), largest (b));
    if (b.is_float) return std::bit_cast<std::uint32_t> (static_cast<float> (held));
    return static_cast<std::uint32_t> (static_cast<std::int64_t> (std::floor (held + 0.5)));
}

}   // namespace tactus::host::hid
