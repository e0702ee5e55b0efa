// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/run/log/stretch.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// A stem as one signal that a vibrating actuator can play, through a high-pass of the second order: its only channel, or, of a vector, the component in
/// the direction in which what is left moves most. A force that is held would be a buzz. Samples that are not finite become 0.
struct OneSignal
{
    static constexpr double cutoff_hz = 8.0;

    std::vector<float> samples {};
    std::string channel {};   ///< "desk.in[0]", or "along 0 0 1"
    double peak = 0.0;
    double overshoot = 0.0;    ///< the peak over that before the high-pass: above 1 where a held force is reversed at once
    bool lacks_held = false;   ///< the high-pass has left out a part that matters
};

OneSignal oneSignalOf (std::vector<std::vector<float>> channels, const std::vector<std::string>& names, double rate_hz, bool loops);

/// A stretch of a take as a clip can play it: a force, of one component or three, becomes one signal, as a stem does. `losses` receives what is left out.
Stretch playableStretch (Stretch, Messages& losses);

/// The text of a clip file. Amplitude 1 is `full_scale`. `losses` receives what the format cannot hold. Ids: those of readers::writeClip.
Result<std::string> clipTextOf (const OneSignal&, double rate_hz, double full_scale, const std::string& description, const std::string& format,
                                Messages& losses);

}   // namespace tactus::host
