// SPDX-License-Identifier: MIT
#pragma once

#include <host/drivers/bhaptics/vest_messages.hpp>

#include <tactus/node/device.hpp>
#include <tactus/text/json_text.hpp>

#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::fuzz
{

/// Aborts unless this is a message for the Player, with intensities from 1 to 100.
inline void demandMessage (const std::string& text)
{
    const auto read = readJson (text);
    if (! read.messages.empty()) std::abort();
    const auto submitted = read.root.find ("Submit");
    if (submitted == read.root.end() || ! submitted->is_array()) std::abort();
    for (const auto& one : *submitted)
    {
        const auto frame = one.find ("Frame");
        if (frame == one.end()) continue;
        for (const auto& point : frame->at ("dotPoints"))
            if (const double i = point.at ("intensity").get<double>(); ! (i >= 1.0 && i <= 100.0)) std::abort();
    }
}

/// Reads the text as what the Player says, and as a description of a vest. Either the description has its problem, or whatever is shown on the vest makes
/// messages that can be read. Aborts otherwise.
inline void tryVest (std::string_view text)
{
    const auto read = readJson (text);
    if (host::hasVest (text).has_value() != read.messages.empty()) std::abort();
    auto vest = host::VestSettings::read (read.root);
    if (! vest)
    {
        if (vest.error().id.empty() || vest.error().text.empty()) std::abort();
        return;
    }
    auto& dots = vest->dots;
    if (! (vest->rate_hz >= 10.0 && vest->rate_hz <= 1000.0)) std::abort();
    if (dots.channels() < 1 || dots.channels() > static_cast<std::size_t> (Channels::most)) std::abort();
    constexpr double huge = std::numeric_limits<double>::max();
    for (const double amount : { 0.5, 1.0, huge, -huge, std::numeric_limits<double>::quiet_NaN() })
    {
        dots.take (std::vector<double> (dots.channels(), amount), { 0.0, amount, 0.0 });
        if (const auto message = dots.message(); ! message.empty()) demandMessage (message);
    }
    demandMessage (dots.silence());
    if (dots.isShowing() || ! dots.message().empty()) std::abort();
}

}   // namespace tactus::fuzz
