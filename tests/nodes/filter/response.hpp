// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

/// The measured frequency response of a filter node at rest: the spectrum of its impulse response.
class Response
{
public:
    template <typename N>
    explicit Response (N node, int ticks = 20'000)
    {
        for (int k = 0; k < ticks; ++k)
            impulse.push_back (node.tick ({ .in = k == 0 ? 1.0 : 0.0 }).out);
    }

    /// At a frequency in cycles per tick, up to 0.5.
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

/// The analogue frequency s, in units of the cutoff, that the bilinear transform (prewarped at the cutoff) maps to a
/// digital frequency. Both arguments are in cycles per tick.
inline std::complex<double> bilinear (double turns, double cutoff)
{
    return { 0.0, std::tan (std::numbers::pi * turns) / std::tan (std::numbers::pi * cutoff) };
}
