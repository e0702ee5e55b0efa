// SPDX-License-Identifier: MIT
#include "resample_file.hpp"

#include <samplerate.h>

#include <algorithm>
#include <cmath>

namespace tactus::host::audio
{

std::vector<float> resampled (std::vector<float> samples, double from_hz, double to_hz)
{
    constexpr double most = 200.0;   // libsamplerate changes a rate by a factor of at most 256 at once
    while (from_hz != to_hz && ! samples.empty())
    {
        const double ratio = std::clamp (to_hz / from_hz, 1.0 / most, most);
        const bool is_last = ratio * from_hz == to_hz || ratio == to_hz / from_hz;
        std::vector<float> made (static_cast<std::size_t> (std::ceil (static_cast<double> (samples.size()) * ratio)) + 1);
        SRC_DATA data {};
        data.data_in = samples.data();
        data.data_out = made.data();
        data.input_frames = static_cast<long> (samples.size());
        data.output_frames = static_cast<long> (made.size());
        data.src_ratio = ratio;
        if (src_simple (&data, SRC_SINC_BEST_QUALITY, 1) != 0) return {};   // cannot fail with valid ratios
        made.resize (static_cast<std::size_t> (data.output_frames_gen));
        samples = std::move (made);
        from_hz = is_last ? to_hz : ratio * from_hz;
    }
    return samples;
}

}   // namespace tactus::host::audio
