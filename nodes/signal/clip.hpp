// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/clip_score.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::nodes
{

/// A haptic clip: the drawn or recorded effect of a game, an app or a phone, with envelopes and transients.
///
///     value     = gain sum over tracks  A (t) sin (2 pi integral_0^t f)  +  transients
///     amplitude = gain sum over tracks  A (t)                            +  transients
///     f         = lowest + sharpness (t) (highest - lowest)
///
/// t is the time in the clip, and A and the sharpness are straight between their points (framework/kit/signal/clip_score.hpp). `drive` says
/// where t comes from:
///
///     start     a hit, or a gate that opens, plays the clip from its beginning at `speed`
///     run       the clip plays from the first tick on, as with the transport of a recorder
///     time      t is the input `time`, so another node scrubs
///     position  t = duration position / length: the clip lies along a path as a texture, and sounds only while the hand moves
///
/// Source: amplitude and frequency envelopes with transients are those of Meta's .haptic format, and of Apple's AHAP (continuous and
/// transient events). Own definition.
///
/// Good to know
///  - The clip is a file: .haptic, .ahap, .hjif, a clip of Tactus (.json), a recording (.wav), or a table of clip rows (.csv). See
///    docs/clips.md.
///  - Clips count from 0 to 1. `gain` is what 1 means on the device, in its unit, N or m/s2. lowest and highest are the frequencies that
///    the device renders well; 0 takes those of the clip. A slower or faster clip has lower or higher tones.
///  - A hit plays the clip once, and a hit while it plays starts it again. With full_speed, its amplitude is in proportion to the
///    speed of the hit. A gate plays as long as it is open; only then does `repeat` loop repeat it.
///  - A leap in t (a start while it plays, a loop, a stop, a jump of the hand) would be a step in the value. The difference fades
///    within 2 ms instead, so nothing clicks. A start from silence needs no fade, because tones and transients begin at 0.
///  - Nothing at or above 0.45 of the rate sounds: put the node into a section with `times`, or it loses the upper tones. Where
///    the hand or a high speed makes a tone faster than a quarter of the rate, it fades.
///  - With `position`, a hand at rest feels a constant value. Multiply by contact.window to be silent out of contact.
///  - For a device that takes amplitude and frequency, such as a phone, wire these outputs to it. The frequency is that of the
///    strongest track or transient.
///  - At rest, without a hit and with the gate at 0, a tick costs about as much as signal.constant.
struct SignalClip
{
    enum class Drive
    {
        start,
        run,
        time,
        position
    };

    enum class Repeat
    {
        once,
        loop
    };

    static constexpr std::string_view drive_names[] { "start", "run", "time", "position" };
    static constexpr std::string_view repeat_names[] { "once", "loop" };

    struct Inputs
    {
        double hit = 0.0;
        double gate = 0.0;
        double time = 0.0;
        double position = 0.0;
    };

    struct Params
    {
        double gain = 1.0;
        double speed = 1.0;
        double length = 0.1;
        double full_speed = 0.0;
        Drive drive = Drive::start;
        Repeat repeat = Repeat::once;
    };

    struct Settings
    {
        Sheet clip {};
        int channel = 0;
        int track = 0;
        double lowest = 0.0;
        double highest = 0.0;
        double transient_lowest = 0.0;
        double transient_highest = 0.0;
    };

    struct Outputs
    {
        double value = 0.0;
        double amplitude = 0.0;
        double frequency = 0.0;
    };

    static constexpr Info info {
        .id = "signal.clip",
        .name = "Clip",
        .summary = "Plays a haptic clip: in time, or along a path.",
        .source = "definition; Meta .haptic 1 and Apple AHAP",
        .keywords = "ahap pattern player sample",
    };

    static constexpr std::tuple ports {
        input (&Inputs::hit, "hit", unit::hit, "plays the clip once"),
        input (&Inputs::gate, "gate", unit::gain, "plays the clip while above 0.5"),
        input (&Inputs::time, "time", unit::second, "time in the clip, if driven by time"),
        input (&Inputs::position, "position", unit::metre, "place along the path, if driven by position"),
        param (&Params::gain, "gain", any_unit, "the value at amplitude 1", { .usual = { 0, 4 } }),
        param (&Params::speed, "speed", unit::gain, "seconds of the clip per second", { .hard = { 0, 16 }, .usual = { 0.25, 4 } }),
        param (&Params::length, "length", unit::metre, "length of the path that the clip covers", { .hard = { 1e-6, 1e3 }, .usual = { 0.01, 1 } }),
        param (&Params::full_speed, "full_speed", unit::speed, "speed of a hit that plays at full amplitude; 0: every hit does",
               { .hard = { 0, inf }, .usual = { 0, 1 } }),
        choice (&Params::drive, "drive", drive_names, "what moves the clip"),
        choice (&Params::repeat, "repeat", repeat_names, "whether the clip starts again at its end"),
        setting (&Settings::clip, "clip", unit::count, "the clip; without one it is silent"),
        setting (&Settings::channel, "channel", unit::count, "the channel to play; 0: all, added up", { .hard = { 0, most_clip_channels }, .usual = { 0, 8 } }),
        setting (&Settings::track, "track", unit::count, "the track to play; 0: all", { .hard = { 0, most_clip_tracks }, .usual = { 0, 8 } }),
        setting (&Settings::lowest, "lowest", unit::hertz, "frequency at sharpness 0; 0: that of the clip", { .hard = { 0, 1e5 }, .usual = { 0, 200 } }),
        setting (&Settings::highest, "highest", unit::hertz, "frequency at sharpness 1; 0: that of the clip", { .hard = { 0, 1e5 }, .usual = { 0, 500 } }),
        setting (&Settings::transient_lowest, "transient_lowest", unit::hertz, "frequency of a transient at sharpness 0; 0: that of the clip",
                 { .hard = { 0, 1e5 }, .usual = { 0, 200 } }),
        setting (&Settings::transient_highest, "transient_highest", unit::hertz, "frequency of a transient at sharpness 1; 0: that of the clip",
                 { .hard = { 0, 1e5 }, .usual = { 0, 500 } }),
        output (&Outputs::value, "value", sameAs ("gain"), "the signal"),
        output (&Outputs::amplitude, "amplitude", sameAs ("gain"), "its envelope"),
        output (&Outputs::frequency, "frequency", unit::hertz, "frequency of its strongest part, 0 in silence"),
    };

    Params params;
    Settings settings;

    Cost cost() const
    {
        const double rows = settings.clip.grid ? settings.clip.grid->rows : 0.0;
        return { .work = 60.0 * rows, .memory = 100.0 * rows };
    }

    std::string problem() const;

    void prepare (const Setup& setup)
    {
        rate = setup.rate_hz;
        fade_per_tick = 1.0 / std::max (1.0, fade_s * rate);
        calming = math::exp (-1.0 / (calm_s * rate));
        score = std::make_shared<const ClipScore> (calibrated(), settings.channel, settings.track);
        cursors.assign (score->size(), {});
        wanted_drive = Drive::start;
        state = {};
        update();
    }

    void update() noexcept
    {
        if (params.drive != wanted_drive)
        {
            state.playing = params.drive == Drive::run;
            state.open = state.known = false;
            state.level = 1.0;
            state.way = 0.0;
            goTo (0.0);
            wanted_drive = params.drive;
        }
        busy = needsWork() ? 1u : 0u;
    }

    /// The clip continues at the same time. If it is another clip, the difference fades.
    void adopt (const SignalClip& old) noexcept
    {
        wanted_drive = old.wanted_drive;
        state = old.state;
        if (! sameSound (settings, old.settings)) state.leaps = true;
        update();
    }

    Claims claims() const { return { .amplitude = std::abs (params.gain) * ClipScore { calibrated(), settings.channel, settings.track }.peak() }; }

    Outputs tick (const Inputs& in) noexcept
    {
        // At rest, this is all that is computed. Comparing bits is cheaper than comparing numbers; -0 and NaN just take the slow path.
        if ((math::wordOf (in.hit) | math::wordOf (in.gate) | busy) == 0) [[likely]]
            return {};
        return play (in.hit, in.gate, in.time, in.position);
    }

    void serialize (auto& archive) { archive (busy, wanted_drive, state); }

private:
    static constexpr double fade_s = 2e-3, calm_s = 20e-3;

    /// The state that lasts from tick to tick.
    struct State
    {
        double t = 0.0;                   // time in the clip, s
        double base = 0.0, speed = 1.0;   // t = base + speed ticks / rate: rounding does not add up
        std::uint64_t ticks = 0;
        double level = 1.0;                                    // amplitude of the current start
        double step = 0.0;                                     // time in the clip per tick by which fast tones are faded, s
        double way = 0.0;                                      // distance from the time before, unless it was a leap, s
        double value = 0.0, before = 0.0, amplitude = 0.0;     // the latest outputs, for a gain of 1; before: the value before that
        double missing_value = 0.0, missing_amplitude = 0.0;   // what a leap left to fade
        double fade = 0.0;                                     // 1 at a leap, 0 after it
        double most = 0.0;                                     // neither the old nor the new clip exceeds this while it fades
        bool playing = false, open = false;                    // open: the gate
        bool leaps = false;                                    // before the next sample
        bool guessed = false;                                  // the latest value is a guess, because it followed a leap
        bool known = false, leapt = false;                     // the previous time or position; whether it was a leap
    };

    [[gnu::cold]] Outputs play (double hit, double gate, double time, double position) noexcept;
    void begin (double level) noexcept;
    void follow (double t) noexcept;
    bool isLeap (double way) const noexcept;
    void advance() noexcept;
    Outputs sample() noexcept;
    void rest() noexcept;

    bool isFollowing() const noexcept { return wanted_drive == Drive::time || wanted_drive == Drive::position; }
    bool needsWork() const noexcept { return state.playing || state.open || state.fade > 0.0 || state.leaps || isFollowing(); }

    void goTo (double t) noexcept
    {
        state.t = state.base = t;
        state.ticks = 0;
        state.leaps = true;
    }

    static bool sameSound (const Settings& a, const Settings& b) noexcept
    {
        return a.clip.grid == b.clip.grid && a.channel == b.channel && a.track == b.track && a.lowest == b.lowest && a.highest == b.highest
               && a.transient_lowest == b.transient_lowest && a.transient_highest == b.transient_highest;
    }

    Clip calibrated() const;

    double rate = 1.0, fade_per_tick = 1.0, calming = 0.0;
    std::uint64_t busy = 0;   // 0 at rest
    Drive wanted_drive = Drive::start;
    State state;
    std::shared_ptr<const ClipScore> score = std::make_shared<const ClipScore>();
    std::vector<ClipScore::Cursor> cursors;
};

//==============================================================================
// Implementation below.

inline std::string SignalClip::problem() const
{
    if (! settings.clip.grid) return {};
    const auto read = clipOf (*settings.clip.grid);
    if (! read.problem.empty()) return read.problem;
    const auto& tracks = read.clip.tracks;
    if (at (settings.track) > tracks.size())
        return "the clip has no track " + std::to_string (settings.track) + "; its tracks are 1 to " + std::to_string (tracks.size());
    const auto isOn = [&] (const ClipTrack& t) { return t.channel == settings.channel; };
    if (settings.channel > 0 && std::ranges::none_of (tracks, isOn)) return "the clip has no track on channel " + std::to_string (settings.channel);
    return problemOf (calibrated());
}

/// The clip with the frequencies of the device.
inline Clip SignalClip::calibrated() const
{
    Clip clip = settings.clip.grid ? clipOf (*settings.clip.grid).clip : Clip {};
    const auto take = [] (double& mine, double own) {
        if (own > 0.0) mine = own;
    };
    take (clip.voice.lowest, settings.lowest);
    take (clip.voice.highest, settings.highest);
    take (clip.voice.tap_lowest, settings.transient_lowest);
    take (clip.voice.tap_highest, settings.transient_highest);
    return clip;
}

inline void SignalClip::begin (double level) noexcept
{
    goTo (0.0);
    state.playing = true;
    state.level = level;
}

/// True if this distance from the previous time is a leap. Another node moves evenly, so its leap is a distance unlike the one before. A
/// hand is measured in quanta, so its leap is a distance much longer than usual, or one that mutes a tone at once. `slower`: of all
/// tones up to the fastest, it is the one that is silent from this distance on that loses most.
inline bool SignalClip::isLeap (double way) const noexcept
{
    constexpr double sudden = 8.0, small = 0.02, quieter = 0.1;
    if (wanted_drive == Drive::time) return std::abs (way - state.way) * score->fastest() > small;
    const double cycles = std::abs (way) * score->fastest(), usual = state.step * score->fastest();
    const double slower = std::min (1.0, ClipScore::silent / cycles);
    return (cycles > sudden * usual && cycles > small) || ClipScore::audible (slower * cycles) < ClipScore::audible (slower * usual) - quieter;
}

/// Moves to a time that another node or the hand gives.
inline void SignalClip::follow (double t) noexcept
{
    const double duration = score->duration();
    if (! isFinite (t)) t = -1.0;   // a place far beyond the path
    double way = state.known ? t - state.t : 0.0;
    if (params.repeat == Repeat::loop && duration > 0.0)
    {
        t -= duration * std::floor (t / duration);
        way = state.known ? t - state.t : 0.0;
        way -= duration * std::round (way / duration);   // the shorter way around
        state.leaps = state.leaps || std::abs (t - state.t) > 0.5 * duration;
    }
    const bool inside = t >= 0.0 && t < duration;
    // A single leap fades. A second one is a fast hand, whose tones are too fast for the rate.
    const bool leapt = isLeap (way), alone = leapt && ! state.leapt;
    if (! alone) state.way = way;
    const double step = alone ? 0.0 : std::abs (way);
    if (leapt || inside != state.playing) state.leaps = true;
    state.leapt = leapt;
    state.step = step > state.step ? step : step + (state.step - step) * calming;
    state.t = t;
    state.playing = inside;
    state.known = true;
}

/// Moves on to the next sample, at the end of a tick.
inline void SignalClip::advance() noexcept
{
    if (params.speed != state.speed)
    {
        state.base = state.t;
        state.ticks = 0;
        state.speed = params.speed;
    }
    ++state.ticks;
    state.t = state.base + state.speed * static_cast<double> (state.ticks) / rate;
    const double duration = score->duration();
    if (state.t < duration) return;
    const bool loops = params.repeat == Repeat::loop && (wanted_drive == Drive::run || state.open);
    state.playing = loops && duration > 0.0;
    goTo (state.playing ? state.t - duration * std::floor (state.t / duration) : 0.0);
}

/// The clip at the current time, with what remains of a leap. What would have come without the leap is guessed from the last two
/// values, so a clip whose end fits its beginning loops without a trace. After a guess, the value stays, or many leaps would be a ramp.
inline SignalClip::Outputs SignalClip::sample() noexcept
{
    ClipMoment now;
    if (state.playing) now = (*score) (state.t, state.step, cursors.data());
    now.value *= state.level;
    now.amplitude *= state.level;
    if (state.leaps)
    {
        state.missing_value = (state.guessed ? state.value : 2.0 * state.value - state.before) - now.value;
        state.missing_amplitude = state.amplitude > 0.0 ? state.amplitude - now.amplitude : 0.0;
        state.fade = state.missing_value != 0.0 || state.missing_amplitude != 0.0 ? 1.0 : 0.0;
        state.most = std::max ({ score->peak(), std::abs (state.value), state.amplitude });
    }
    state.guessed = std::exchange (state.leaps, false);
    if (state.fade > 0.0)
    {
        const double weight = state.fade * state.fade * (3.0 - 2.0 * state.fade);
        now.value = std::clamp (now.value + weight * state.missing_value, -state.most, state.most);
        now.amplitude = std::clamp (now.amplitude + weight * state.missing_amplitude, 0.0, state.most);
        state.fade = std::max (0.0, state.fade - fade_per_tick);
    }
    state.before = state.value;
    state.value = now.value;
    state.amplitude = now.amplitude;
    return { .value = finiteOrZero (params.gain * now.value), .amplitude = finiteOrZero (params.gain * now.amplitude), .frequency = now.frequency };
}

inline SignalClip::Outputs SignalClip::play (double hit, double gate, double time, double position) noexcept
{
    if (! isFinite (hit, gate, time, position))
    {
        state = {};
        state.playing = wanted_drive == Drive::run;
        rest();
        return {};
    }

    const double duration = score->duration();
    if (! isFollowing()) state.step = params.speed / rate;
    if (wanted_drive == Drive::time)
        follow (time);
    else if (wanted_drive == Drive::position)
        follow (duration * (position / params.length));
    else if (wanted_drive == Drive::start)
    {
        const bool open = gate > 0.5;
        if (hit > 0.0)
            begin (params.full_speed > 0.0 ? std::min (1.0, hit / params.full_speed) : 1.0);
        else if (open && ! state.open)
            begin (1.0);
        else if (! open && state.open)
        {
            state.playing = false;
            state.leaps = true;
        }
        state.open = open;
    }

    const auto out = sample();
    if (state.playing && ! isFollowing()) advance();
    rest();
    return out;
}

/// Decides whether the next ticks can be skipped.
inline void SignalClip::rest() noexcept
{
    busy = needsWork() ? 1u : 0u;
    if (busy == 0) state.value = state.before = state.amplitude = 0.0;
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalClip);
