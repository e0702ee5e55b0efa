// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// A stem as one signal: its only channel, or the component of a vector in the direction in which it moves most.
struct OneSignal
{
    std::vector<float> samples {};
    std::string channel {};   ///< "desk.in[0]", or "along 0 0 1"
    double peak = 0.0;
};

OneSignal oneSignalOf (const std::vector<std::vector<float>>& channels, const std::vector<std::string>& names);

/// The text of a clip file. Amplitude 1 is `full_scale`. `losses` receives what the format cannot hold. Ids: those of readers::writeClip.
Result<std::string> clipTextOf (const OneSignal&, double rate_hz, double full_scale, const std::string& description, const std::string& format,
                                Messages& losses);

}   // namespace tactus::host
