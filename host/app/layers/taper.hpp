// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace tactus::host
{

/// The taper of a fader: maps its position, from 0 to 1, to a gain. Silence is at the bottom, 1 at three quarters, and the largest gain
/// at the top. It follows a power law, so that most of the travel covers gains within 20 dB of 1.
struct Taper
{
    static constexpr double unity = 0.75, most = 2.0;

    static double gain (double position) noexcept { return most * std::pow (std::clamp (position, 0.0, 1.0), exponent()); }
    static double position (double gain) noexcept { return gain > 0.0 ? std::min (1.0, std::pow (gain / most, 1.0 / exponent())) : 0.0; }

private:
    static double exponent() noexcept { return std::log (1.0 / most) / std::log (unity); }
};

}   // namespace tactus::host
