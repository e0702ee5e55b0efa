// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace tactus::host::audio
{

/// Converts from one sample rate to another by a ratio that may change from block to block; changes are smoothed. Uses
/// libsamplerate with its shortest sinc (flat to 80 % of the lower band, 97 dB signal-to-noise ratio). Does not shift the
/// sound in time: its latency is its look-ahead. Handles several interleaved lanes.
class Resampler
{
public:
    /// Throws std::bad_alloc. [main thread]
    explicit Resampler (int lanes);
    ~Resampler();
    Resampler (Resampler&&) noexcept;
    Resampler& operator= (Resampler&&) noexcept;

    /// True for the ratios (output to input) that it supports: 1/256 to 256.
    static bool canDo (double ratio) noexcept;

    /// The number of input frames that it needs ahead of its output.
    static double lookAhead (double ratio) noexcept;

    struct Step
    {
        int used = 0, made = 0;   ///< frames
    };

    // These allocate nothing. [one thread at a time]
    void reset() noexcept;
    Step process (const float* in, int in_frames, float* out, int out_frames, double ratio) noexcept;

private:
    struct State;
    std::unique_ptr<State> state;
};

}   // namespace tactus::host::audio
