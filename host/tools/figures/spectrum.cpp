// SPDX-License-Identifier: MIT
#include "spectrum.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

namespace tactus::host
{

Spectrum spectrumOf (std::span<const double> samples, double rate_hz, std::size_t length)
{
    constexpr std::size_t padding = 4, fewest = 8;
    if (samples.size() < fewest) return {};
    if (length == 0) length = padding * std::bit_ceil (samples.size());

    // Removes the windowed mean, so that it does not leak into the lowest lines.
    const auto n = samples.size();
    std::vector<double> window (n), in (std::max (n, length), 0.0);
    double weight = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
        window[i] = 0.5 - 0.5 * std::cos (2.0 * std::numbers::pi * static_cast<double> (i) / static_cast<double> (n));
        weight += window[i];
        mean += window[i] * samples[i];
    }
    mean /= weight;
    for (std::size_t i = 0; i < n; ++i)
        in[i] = window[i] * (samples[i] - mean);

    thread_local Eigen::FFT<double> fft;   // keeps its tables
    fft.SetFlag (Eigen::FFT<double>::HalfSpectrum);
    std::vector<std::complex<double>> out;
    fft.fwd (out, in);

    Spectrum spectrum;
    spectrum.step_hz = rate_hz / static_cast<double> (in.size());
    spectrum.resolution_hz = 2.0 * rate_hz / static_cast<double> (n);
    spectrum.amplitude.reserve (out.size());
    for (const auto& line : out)
        spectrum.amplitude.push_back (2.0 * std::abs (line) / weight);
    return spectrum;
}

std::optional<Peak> peakOf (const Spectrum& s, double from_hz)
{
    const auto& a = s.amplitude;
    std::size_t highest = 0;
    for (auto i = static_cast<std::size_t> (std::max (1.0, std::ceil (from_hz / s.step_hz))); i + 1 < a.size(); ++i)
        if (a[i] > a[i - 1] && a[i] >= a[i + 1] && (highest == 0 || a[i] > a[highest])) highest = i;
    if (highest == 0 || a[highest - 1] <= 0.0 || a[highest + 1] <= 0.0) return std::nullopt;

    const double left = std::log (a[highest - 1]), middle = std::log (a[highest]), right = std::log (a[highest + 1]);
    const double bend = left - 2.0 * middle + right, offset = bend < 0.0 ? 0.5 * (left - right) / bend : 0.0;
    return Peak { (static_cast<double> (highest) + offset) * s.step_hz, std::exp (middle - 0.25 * (left - right) * offset) };
}

}   // namespace tactus::host
