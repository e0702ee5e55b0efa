// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "look_at.hpp"

#include <span>

namespace tactus::host
{

/// What a signal is made of: a sine of amplitude A reads A at its frequency.
///
/// The samples stand under a Hann window, without their mean, and are padded with zeros to four times their number: then the
/// highest of a peak is at most 1.5 % lower than the sine that made it. The window spreads a sine over four times the inverse of its length.
struct Spectrum
{
    double step_hz = 1.0;
    std::vector<double> amplitude;   ///< at 0, step_hz, … up to half the rate
    double resolution_hz = 1.0;      ///< two sines closer than this are one peak

    double hz (std::size_t i) const noexcept { return static_cast<double> (i) * step_hz; }
};

Spectrum spectrumOf (std::span<const double> samples, double rate_hz);

struct Peak
{
    double hz = 0.0, amplitude = 0.0;
};

/// The highest peak from a frequency on, found between the lines by a parabola; nothing if all is flat.
std::optional<Peak> peakOf (const Spectrum&, double from_hz);

/// The latest samples of a trace, a gap holding what was before it.
struct LatestSamples
{
    std::vector<double> values;
    std::size_t missing = 0;
};
LatestSamples latestSamples (const Trace&, double seconds);

}   // namespace tactus::host
