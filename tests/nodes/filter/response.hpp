// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

/// The frequency response of a filter node at rest, measured: the spectrum of its answer to an impulse.
class Response
{
public:
    template <typename N>
    explicit Response (N node, int ticks = 20'000)
    {
        for (int k = 0; k < ticks; ++k)
            impulse.push_back (node.tick ({ .in = k == 0 ? 1.0 : 0.0 }).out);
    }

    /// At a frequency in turns per tick, up to 0.5.
    std::complex<double> operator() (double turns) const
    {
        const auto z = std::polar (1.0, -2.0 * std::numbers::pi * turns);
        std::complex<double> sum = 0.0;
        for (auto at = impulse.rbegin(); at != impulse.rend(); ++at)
            sum = sum * z + *at;   // Horner
        return sum;
    }

private:
    std::vector<double> impulse;
};

/// Where the bilinear transform, prewarped at the cutoff, finds a digital frequency on the analogue axis: s in units
/// of the cutoff. Both in turns per tick.
inline std::complex<double> bilinear (double turns, double cutoff)
{
    return { 0.0, std::tan (std::numbers::pi * turns) / std::tan (std::numbers::pi * cutoff) };
}
