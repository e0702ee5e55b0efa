// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// A stem as one signal that a vibrating actuator can play: its only channel, or the component of a vector in the direction in which it moves most, without
/// the part that changes more slowly than about 10 times a second, such as the force of a wall that is held.
struct OneSignal
{
    std::vector<float> samples {};
    std::string channel {};   ///< "desk.in[0]", or "along 0 0 1"
    double peak = 0.0;
    double held = 0.0;   ///< the largest value of the slow part, which is left out
};

OneSignal oneSignalOf (const std::vector<std::vector<float>>& channels, const std::vector<std::string>& names, double rate_hz);

/// The text of a clip file. Amplitude 1 is `full_scale`. `losses` receives what the format cannot hold. Ids: those of readers::writeClip.
Result<std::string> clipTextOf (const OneSignal&, double rate_hz, double full_scale, const std::string& description, const std::string& format,
                                Messages& losses);

}   // namespace tactus::host
