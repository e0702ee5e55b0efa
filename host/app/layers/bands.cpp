// SPDX-License-Identifier: GPL-3.0-or-later
#include "bands.hpp"

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace tactus::host
{

double Bands::edge (int i) noexcept { return lowest_hz * std::pow (highest_hz / lowest_hz, static_cast<double> (i) / count); }

Bands bandsOf (std::span<const double> samples, double rate_hz)
{
    Bands bands;
    const auto size = samples.size();
    if (size < 4 || ! (rate_hz > 0.0)) return bands;

    std::vector<double> windowed (size);
    double weight = 0.0;
    for (std::size_t i = 0; i < size; ++i)
    {
        const double w = 0.5 - 0.5 * std::cos (2.0 * std::numbers::pi * static_cast<double> (i) / static_cast<double> (size));
        windowed[i] = std::isfinite (samples[i]) ? w * samples[i] : 0.0;
        weight += w * w;
    }
    std::vector<std::complex<double>> spectrum;
    Eigen::FFT<double> fft;
    fft.SetFlag (Eigen::FFT<double>::HalfSpectrum);
    fft.fwd (spectrum, windowed);

    const double step = rate_hz / static_cast<double> (size);
    for (std::size_t k = 1; k < spectrum.size(); ++k)
    {
        const double power = (2 * k == size ? 1.0 : 2.0) * std::norm (spectrum[k]) / (static_cast<double> (size) * weight);
        // A line covers all frequencies up to halfway to its neighbours, because low bands are narrower than the spacing of the lines.
        const double low = (static_cast<double> (k) - 0.5) * step, high = low + step;
        for (int b = 0; b < Bands::count; ++b)
            if (const double shared = std::min (high, Bands::edge (b + 1)) - std::max (low, Bands::edge (b)); shared > 0.0)
                bands.power[static_cast<std::size_t> (b)] += power * shared / step;
    }
    return bands;
}

}   // namespace tactus::host
