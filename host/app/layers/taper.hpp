// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace tactus::host
{

/// Where the knob of a fader stands, from 0 to 1, and its gain: silence at the bottom, 1 at three quarters, the most at the
/// top. Between it goes as ears and fingers do, with most of its way for what lies within 20 dB of 1.
struct Taper
{
    static constexpr double unity = 0.75, most = 2.0;

    static double gain (double position) noexcept { return most * std::pow (std::clamp (position, 0.0, 1.0), exponent()); }
    static double position (double gain) noexcept { return gain > 0.0 ? std::min (1.0, std::pow (gain / most, 1.0 / exponent())) : 0.0; }

private:
    static double exponent() noexcept { return std::log (1.0 / most) / std::log (unity); }
};

}   // namespace tactus::host
