// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

namespace tactus::host::audio
{

/// From one sample rate to another, by a ratio that may change from block to block and is then moved smoothly: libsamplerate
/// with its shortest sinc (flat to 80 % of the lower band, 97 dB of noise). Makes no sound earlier or later than it was:
/// what it delays is what it has to see ahead. Several lanes at a time, their samples side by side.
class Resampler
{
public:
    /// Throws std::bad_alloc. [main thread]
    explicit Resampler (int lanes);
    ~Resampler();
    Resampler (Resampler&&) noexcept;
    Resampler& operator= (Resampler&&) noexcept;

    /// Ratios of the rates, out to in, that it can do: 1/256 to 256.
    static bool canDo (double ratio) noexcept;

    /// How many frames of the input it sees ahead of what it makes.
    static double lookAhead (double ratio) noexcept;

    struct Step
    {
        int used = 0, made = 0;   ///< frames
    };

    // Allocate nothing. [one thread at a time]
    void reset() noexcept;
    Step process (const float* in, int in_frames, float* out, int out_frames, double ratio) noexcept;

private:
    struct State;
    std::unique_ptr<State> state;
};

}   // namespace tactus::host::audio
