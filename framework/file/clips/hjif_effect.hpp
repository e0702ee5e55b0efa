// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/clip.hpp>

#include <string_view>
#include <vector>

namespace tactus::readers
{

/// An effect of MPEG HJIF, and how it sounds. Source: Effect::EvaluateVectorial and EvaluateKeyframes of the reference software
/// (MPEGGroup/HapticReferenceSoftware, source/Types):
///
///     value (t) = A (t) base (phase + integral_0^t f)    from the start of the effect to its last keyframe
///
/// A and f are straight between their keyframes, and held before the first and after the last. Without keyframes, A is 1 and f is 0.
struct HjifEffect
{
    enum class Base
    {
        sine,
        square,
        triangle,
        saw_up,
        saw_down
    };

    double timescale = 1000.0;          ///< ticks per second
    double start = 0.0, length = 0.0;   ///< ticks; the start may be negative: what is before 0 is not played
    double phase = 0.0;                 ///< cycles
    Base base = Base::sine;
    std::vector<ClipPoint> amplitude {}, hertz {};   ///< times in ticks from the start of the effect; -1 to 1, and Hz

    double seconds (double ticks) const { return (start + ticks) / timescale; }   ///< the time in the clip

    /// A part in which amplitude and frequency are straight. Times are those of the clip.
    struct Stretch
    {
        double from, to, a, b, hertz, hertz_end, cycles;   // cycles: phase at `from`
    };
    std::vector<Stretch> stretches() const;

    /// True if a tone of a clip can be this effect: a sine that sounds, of at least 0.1 Hz, whose amplitude is never negative.
    bool isTone() const;
    bool isSilent() const;   ///< true if it is 0 throughout, as a sine without a frequency is

    /// The effect as the points of a wave: exact at its corners and steps, and off by at most 0.15 % of its amplitude between them.
    std::vector<ClipPoint> wave() const;
};

/// True for the positions of an effect that may be negative numbers of 16 bits: MPEG's own decoder writes -2 as 65534.
inline bool mayBeNegative (double ticks) { return ticks >= 65536.0 - 64.0 && ticks < 65536.0; }

enum class HjifCurve
{
    linear,
    cubic,   ///< a smooth step from keyframe to keyframe
    akima
};

/// A curve through the keyframes in straight pieces, 16 from keyframe to keyframe, at times of the clip. The first value is held from the start of the
/// effect on.
std::vector<ClipPoint> curveOf (const HjifEffect&, HjifCurve);

}   // namespace tactus::readers
