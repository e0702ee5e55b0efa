// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/biquad.hpp>
#include <tactus/plan/plan.hpp>
#include <tactus/text/result.hpp>

#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// The direction in which a vector moves most, as a vector of length 1 whose largest component is positive. `components`: the samples of each. Empty if
/// a sum of squares or products is not finite.
std::vector<double> mainDirection (std::span<const std::vector<float>* const> components);

/// Makes a recording audible: a mono WAV for loudspeakers, 16 bits at 48 kHz. The recorded components are high-passed at 20 Hz, each vector is
/// projected onto the direction in which it moves most, everything is added, and the loudest sample becomes -3 dBFS. For measurements,
/// use the exact WAV of --out.
class Listening
{
public:
    /// Refuses names that do not end in .wav, and files that cannot be written.
    static Result<> check (const std::string& file);

    /// `per_tick`: samples of each tap in a tick.
    Listening (std::string file, const std::vector<Tap>&, double rate_hz, std::size_t per_tick);

    /// Adds the samples of a tick, as Recorder::note writes them.
    void frame (std::span<const double> values);

    /// Writes the file. Returns a warning if there is nothing to hear.
    Result<> write (Messages& warnings);

private:
    std::vector<float> mixed() const;

    std::string file;
    std::vector<std::vector<std::size_t>> vectors;   // numbers of the taps that are the components of one port
    double rate_hz;                                  // of the samples
    Biquad high_pass;
    std::vector<BiquadState> filters;
    std::vector<double> offsets;   // the first values
    std::vector<std::vector<float>> columns;
};

}   // namespace tactus::host
