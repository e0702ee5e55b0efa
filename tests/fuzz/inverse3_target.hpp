// SPDX-License-Identifier: MIT
#pragma once

#include <host/drivers/haply/inverse3_messages.hpp>

#include <tactus/text/json_text.hpp>

#include <cstdlib>
#include <string_view>

namespace tactus::fuzz
{

/// Reads the text as the first message of Haply's service, as a later one, and as a description. Either it has its problem, or the state is made of numbers.
/// Aborts otherwise.
inline void tryInverse3 (std::string_view text)
{
    for (const auto* grip : { "", "wireless", "wired" })
    {
        host::Inverse3Messages messages;
        if (! messages.configure ({ { "grip", grip } }).empty()) std::abort();
        if (! messages.readInventory (text).empty()) continue;
        host::Inverse3State state;
        if (messages.read (text, state).empty() && ! (isFinite (state.position.sum()) && isFinite (state.rotation.sum()) && state.buttons < 16u)) std::abort();
        for (const auto& command : { messages.push ({ 1e-300, -2.0, 1e300 }), messages.probe() })
            if (! readJson (command).messages.empty()) std::abort();
    }
    host::Inverse3Messages described;
    static_cast<void> (described.configure (readJson (text).root));
    if (! readJson (described.push ({ 0.0, 0.0, 0.0 })).messages.empty()) std::abort();
}

}   // namespace tactus::fuzz
