// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tactus::host
{

/// An amplitude spectrum: a sine of amplitude A shows up as A at its frequency.
///
/// The mean is removed, and the samples are weighted by a Hann window and zero-padded to at least four times their number. The highest line
/// of a peak is then at most 1.5 % below the amplitude of the sine. The window spreads a sine over four times the inverse of its length.
struct Spectrum
{
    double step_hz = 1.0;
    std::vector<double> amplitude;   ///< at 0, step_hz, … up to half the rate
    double resolution_hz = 1.0;      ///< two sines closer than this merge into one peak

    double hz (std::size_t i) const noexcept { return static_cast<double> (i) * step_hz; }
};

/// `length`: of the Fourier transform, a power of two that is not below the number of samples; 0: four to eight times that number.
Spectrum spectrumOf (std::span<const double> samples, double rate_hz, std::size_t length = 0);

struct Peak
{
    double hz = 0.0, amplitude = 0.0;
};

/// The highest peak at or above a frequency, interpolated between lines by a parabola. Empty if there is no peak.
std::optional<Peak> peakOf (const Spectrum&, double from_hz);

}   // namespace tactus::host
