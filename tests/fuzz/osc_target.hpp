// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/osc/read_packet.hpp>

#include <cstdlib>
#include <string_view>

namespace tactus::fuzz
{

/// Reads the bytes as an OSC packet. It must have no more messages than its bytes can hold, and be the same when it is read again. Aborts otherwise.
inline void tryOsc (std::string_view bytes)
{
    constexpr std::size_t shortest_message = 8;
    const auto packet = host::readPacket (bytes), again = host::readPacket (bytes);
    if (packet.messages.size() > bytes.size() / shortest_message + 1) std::abort();
    if (packet.right != again.right || packet.messages.size() != again.messages.size()) std::abort();
    for (const auto& message : packet.messages)
        if (static_cast<std::size_t> (message.size()) > bytes.size()) std::abort();
}

}   // namespace tactus::fuzz
