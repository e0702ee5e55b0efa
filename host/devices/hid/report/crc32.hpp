// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace tactus::host::hid
{

/// CRC-32 of IEEE 802.3 (reflected, polynomial 0x04C11DB7): the CRC of "123456789" is 0xCBF43926. `before` is the CRC of the
/// preceding bytes.
inline std::uint32_t crc32 (std::span<const std::uint8_t> bytes, std::uint32_t before = 0) noexcept
{
    std::uint32_t crc = ~before;
    for (const auto byte : bytes)
    {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

}   // namespace tactus::host::hid
