// SPDX-License-Identifier: MIT
#pragma once

#include "windowed_sinc.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace tactus
{

/// Reads a signal of one rate at another rate: one sample of the new rate per call, through a windowed sinc.
///
/// Flat up to 0.4 of the lower of the two rates; -60 dB from half of it upwards. The resampler delays by 18 samples of the slower
/// rate. At equal rates samples pass through bit for bit, without a delay.
class StreamResampler
{
public:
    /// `ratio`: old rate over new rate. Clears the memory. Call fill() before the first sample, unless passesThrough().
    /// [main thread]
    void prepare (double new_ratio)
    {
        ratio = new_ratio;
        kernel.clear();
        recent.clear();
        newest = 0;
        phase = 0.0;
        if (passesThrough()) return;

        constexpr double zeros = 16.2;   // 18 samples of the slower rate on either side
        constexpr std::size_t entries = 1 << 13;
        const double cutoff = 0.45 * std::min (1.0, 1.0 / ratio);   // in cycles per old sample
        reach = 0.5 * zeros / cutoff;
        for (std::size_t i = 0; i < entries; ++i)
        {
            const double r = static_cast<double> (i) / static_cast<double> (entries - 1);
            kernel.push_back (2.0 * cutoff * sinc (std::numbers::pi * zeros * r) * kaiser60 (r) / kaiser60 (0.0));
        }
        kernel.push_back (0.0);
        recent.resize (static_cast<std::size_t> (std::ceil (2.0 * reach)) + 1);
    }

    bool passesThrough() const noexcept { return ratio == 1.0; }

    /// Fills the memory, so that the signal starts as if it had been running for a long time. `next` gives the next old sample.
    template <typename Next>
    void fill (Next&& next)
    {
        for (double& sample : recent)
            sample = next();
        newest = recent.size() - 1;
    }

    /// The next new sample. Calls `next` for as many old samples as it needs. [tick thread]
    template <typename Next>
    double operator() (Next&& next) noexcept
    {
        if (passesThrough()) return next();

        for (phase += ratio; phase >= 1.0; phase -= 1.0)
        {
            newest = newest + 1 < recent.size() ? newest + 1 : 0;
            recent[newest] = next();
        }
        const double last = static_cast<double> (kernel.size() - 2);
        double sum = 0.0;
        std::size_t i = newest;
        for (double distance = phase; distance < 2.0 * reach; distance += 1.0)
        {
            sum += recent[i] * betweenEntries (kernel.data(), std::abs (distance - reach) / reach * last);
            i = i > 0 ? i - 1 : recent.size() - 1;
        }
        return sum;
    }

    /// Continues where another resampler stopped, if both have the same ratio. [tick thread]
    void adopt (const StreamResampler& old) noexcept
    {
        if (ratio != old.ratio) return;
        std::ranges::copy (old.recent, recent.begin());
        newest = old.newest;
        phase = old.phase;
    }

    void serialize (auto& archive)
    {
        archive (recent, phase);
        archive.index (newest, std::max (recent.size(), std::size_t { 1 }));
        if (! (phase >= 0.0 && phase < 1.0)) archive.refuse ("has a time that is not between two samples");   // the loops would not end, or leave the kernel
    }

private:
    double ratio = 1.0;           // old samples per new one
    double reach = 0.0;           // half the width of the kernel, in old samples
    std::vector<double> kernel;   // one half of the symmetric kernel, from its middle outwards
    std::vector<double> recent;   // ring of old samples
    std::size_t newest = 0;
    double phase = 0.0;   // time from the newest old sample to the new sample, in old samples
};

}   // namespace tactus
