// SPDX-License-Identifier: MIT
#include "resampler.hpp"

#include <samplerate.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace tactus::host::audio
{

struct Resampler::State
{
    explicit State (int lanes) : handle (src_new (SRC_SINC_FASTEST, lanes, nullptr))
    {
        if (handle == nullptr) throw std::bad_alloc {};
    }
    ~State() { src_delete (handle); }
    State (const State&) = delete;
    State& operator= (const State&) = delete;

    SRC_STATE* handle;
};

Resampler::Resampler (int lanes) : state (std::make_unique<State> (lanes)) {}
Resampler::~Resampler() = default;
Resampler::Resampler (Resampler&&) noexcept = default;
Resampler& Resampler::operator= (Resampler&&) noexcept = default;

bool Resampler::canDo (double ratio) noexcept { return src_is_valid_ratio (ratio) != 0; }

double Resampler::lookAhead (double ratio) noexcept
{
    constexpr double half_sinc = 2464.0 / 128.0;   // half the length of the filter, in frames of the lower rate: src/fastest_coeffs.h, libsamplerate 0.2.2
    return std::ceil (half_sinc / std::min (1.0, ratio)) + 2.0;
}

void Resampler::reset() noexcept { src_reset (state->handle); }

Resampler::Step Resampler::process (const float* in, int in_frames, float* out, int out_frames, double ratio) noexcept
{
    SRC_DATA data {};
    data.data_in = in;
    data.data_out = out;
    data.input_frames = in_frames;
    data.output_frames = out_frames;
    data.src_ratio = ratio;
    if (src_process (state->handle, &data) != 0) return {};
    return { static_cast<int> (data.input_frames_used), static_cast<int> (data.output_frames_gen) };
}

}   // namespace tactus::host::audio
