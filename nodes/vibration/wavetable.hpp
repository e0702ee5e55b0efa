// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/recording.hpp>
#include <tactus/node/mode.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// A tap played back: the recording of a struck object, or its ring computed in advance.
///
///     value = gain sum over hits of v table (pitch t)      t since a hit of speed v; linear between samples
///     table[i] = sum_j a_j e^(-decay_j i/rate) sin (2 pi frequency_j i/rate),  the last one 0      from `modes`
///     table[i] = sample i of `channel`                                                             from `wav`
///
/// Each hit takes a voice and plays the table once. Between samples the error is at most max |y''| / (8 rate^2). The cost does
/// not depend on the number of modes. vibration.modal is exact, and can bend its decays.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 6; Okamura, Cutkosky & Dennerlein 2001. Playing
/// measured taps: Kuchenbecker, Fiene & Niemeyer 2006.
///
/// Good to know
///  - A recording is force per impact speed, in N s/m: the force of a hit at 1 m/s. It plays at its own rate, whatever the
///    graph's rate is.
///  - A recording that does not begin and end at 0 is bent to 0 over its first and last 2 ms, so that it never clicks.
///  - Nothing at or above half the tick rate sounds: such modes are left out, and a recording is low-passed, 6 dB down at
///    0.3 of the tick rate and 71 dB at 0.5 (Butterworth of order 8, forwards and backwards, so without delay). A mode at half
///    the table's rate or above aliases: give the table a rate of more than twice its frequency.
///  - Each octave of `pitch` above 1 has its own table with half the band. A hit chooses its table by the pitch at that moment,
///    so a pitch bent up while it sounds may alias.
///  - A hit gives 0 on its own tick, and 0 at the end of the table. A table that is too short for its slowest mode ends in a
///    step of size a e^(-decay length/rate).
///  - While all voices sound, a new hit is dropped; no voice is cut short.
///  - A recording replaces modes that are left at their default. When the table changes, sounding hits play the old table to
///    its end, unless it changes twice in that time.
///  - A hit whose speed is not positive or not finite is ignored. Each hit adds energy: keep it small compared with
///    the contact's own force.
struct Wavetable
{
    struct Table
    {
        std::vector<Mode> modes = std::vector<Mode> (1);
        double rate = 8000.0;
        int length = 2000;
        std::shared_ptr<const Signal> wav = nullptr;
        int channel = 1;

        static constexpr int longest = 1 << 20;

        static constexpr std::tuple fields {
            field (&Table::modes, "modes", unit::count, "the tones of the object"),
            field (&Table::rate, "rate", unit::hertz, "rate of the samples computed from the modes", { .hard = { 1, 1e6 }, .usual = { 1000, 48000 } }),
            field (&Table::length, "length", unit::count, "number of samples computed from the modes", { .hard = { 2, longest }, .usual = { 100, 48000 } }),
            field (&Table::wav, "wav", unit::count, "a recording instead of modes, in N s/m"),
            field (&Table::channel, "channel", unit::count, "channel of the recording, from 1", { .hard = { 1, 1024 }, .usual = { 1, 8 } }),
        };
    };

    struct Inputs
    {
        double hit = 0.0;
    };

    struct Params
    {
        double gain = 1.0;
        double pitch = 1.0;
    };

    struct Settings
    {
        Table table;
        int voices = 8;
    };

    struct Outputs
    {
        double value = 0.0;
    };

    static constexpr Info info {
        .id = "vibration.wavetable",
        .name = "Wavetable vibration",
        .summary = "A recorded or computed ring that each hit plays once.",
        .source = "Hayward 2007, section 6; Okamura et al. 2001",
        .keywords = "sample tap",
    };

    static constexpr std::tuple ports {
        input (&Inputs::hit, "hit", unit::hit, "impact speed v"),
        param (&Params::gain, "gain", unit::gain, "gain of the output", { .usual = { 0, 4 } }),
        param (&Params::pitch, "pitch", unit::gain, "playback speed of the table", { .hard = { 0.01, 8 }, .usual = { 0.25, 4 } }),
        setting (&Settings::table, "table", unit::count, "sound to play: modes, rate and length, or wav and channel"),
        setting (&Settings::voices, "voices", unit::count, "number of hits that can sound together", { .hard = { 1, 1000 }, .usual = { 1, 16 } }),
        output (&Outputs::value, "value", unit::newton, "force of the vibration"),
    };

    Params params;
    Settings settings;

    Cost cost() const;
    std::string problem() const;
    std::string warning (const Setup&) const;

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        table = make (setup.rate_hz);
        previous = {};
        voices.assign (at (settings.voices), {});
    }

    /// Hits that are still sounding keep the table they began with, up to the number of voices. Each keeps its index, because the
    /// order in which voices are added shows in the last bit of the sum.
    void adopt (const Wavetable& old) noexcept
    {
        previous = old.table;
        const auto takeOver = [&] (Voice voice, std::size_t preferred) {
            if (! voice.sounds || voice.table != old.table.get()) return;
            if (preferred < voices.size())
                voices[preferred] = voice;
            else
                start (voice);
        };
        for (std::size_t i = 0; i < old.voices.size(); ++i)
            takeOver (old.voices[i], i);
    }

    Outputs tick (const Inputs& in) noexcept
    {
        double sum = 0.0;
        for (Voice& voice : voices)
            if (voice.sounds) sum += advance (voice);

        if (in.hit > 0.0 && isFinite (in.hit)) start ({ .v = in.hit, .table = table.get(), .octave = octaveOf (params.pitch), .sounds = true });

        return { .value = finiteOrZero (params.gain * sum) };
    }

    /// A sound that an edit has replaced cannot be saved while it fades out: another run does not have it.
    void serialize (auto& archive)
    {
        archive.expect (voices.size());
        for (Voice& voice : voices)
        {
            if (voice.sounds && voice.table != table.get()) archive.refuse ("still plays a sound that an edit replaced; wait until it has ended");
            archive (voice.at, voice.v, voice.sounds);
            archive.index (voice.octave, octaves);
            if (! (voice.at >= 0.0)) archive.refuse ("plays a sound from before its beginning");
            if (archive.restores()) voice.table = table.get();
        }
    }

private:
    using Samples = std::vector<double>;

    static constexpr int octaves = 4;   // tables for a pitch up to 1, 2, 4 and 8

    struct Tables
    {
        double rate = 0.0;   // Hz
        std::array<Samples, octaves> of_octave;
    };

    struct Voice
    {
        double at = 0.0, v = 0.0;   // position in the table, in samples; speed of the hit, in m/s
        const Tables* table = nullptr;
        std::size_t octave = 0;
        bool sounds = false;
    };

    static std::size_t octaveOf (double pitch) noexcept
    {
        std::size_t octave = 0;
        while (pitch > double (1 << octave) && octave + 1 < octaves)
            ++octave;
        return octave;
    }

    double advance (Voice& voice) const noexcept
    {
        const Samples& samples = voice.table->of_octave[voice.octave];
        voice.at += params.pitch * dt * voice.table->rate;
        voice.sounds = voice.at < static_cast<double> (samples.size() - 1);
        if (! voice.sounds) return 0.0;
        const auto i = static_cast<std::size_t> (voice.at);
        return voice.v * std::lerp (samples[i], samples[i + 1], voice.at - static_cast<double> (i));
    }

    void start (const Voice& hit) noexcept
    {
        const auto free = std::ranges::find (voices, false, &Voice::sounds);
        if (free != voices.end()) *free = hit;
    }

    std::shared_ptr<const Tables> make (double tick_rate_hz) const;
    Samples ofModes (double below_hz) const;
    Samples ofRecording (double below_hz) const;

    double dt = 1.0 / Setup {}.rate_hz;   // s
    std::shared_ptr<const Tables> table, previous;
    std::vector<Voice> voices;
};

//==============================================================================
// Implementation below.

/// A sample is the sum of all modes, or comes from a filtered recording.
inline Cost Wavetable::cost() const
{
    constexpr double work_per_mode = 8.0, work_of_filter = 20.0;
    const Table& t = settings.table;
    double samples = t.length, work = work_per_mode * static_cast<double> (t.modes.size());
    if (t.wav)
    {
        samples = t.wav->channels.empty() ? 0.0 : static_cast<double> (t.wav->channels.front().size());
        work = work_of_filter;
    }
    samples *= octaves;
    return { .work = samples * work, .memory = 8.0 * samples + 40.0 * settings.voices };
}

inline std::string Wavetable::problem() const
{
    const Table& t = settings.table;
    if (! t.wav)
    {
        if (t.modes.empty()) return "the table needs modes or a recording (wav)";
        if (! (t.rate > 0.0) || ! isFinite (t.rate)) return "the table's rate must be above 0 Hz";
        if (t.length < 2 || t.length > Table::longest) return "the table needs a length from 2 to " + std::to_string (Table::longest) + " samples";
        for (const Mode& m : t.modes)
            if (! isFinite (m.frequency, m.decay, m.amplitude)) return "a mode of the table is not finite";
        return {};
    }

    if (t.modes != Table {}.modes && ! t.modes.empty()) return "the table has modes and a wav; give only one";
    const auto& channels = t.wav->channels;
    if (t.channel < 1 || at (t.channel) > channels.size())
        return "wav has no channel " + std::to_string (t.channel) + "; its channels are 1 to " + std::to_string (channels.size());
    if (! (t.wav->rate_hz > 0.0) || ! isFinite (t.wav->rate_hz)) return "the rate of wav must be above 0 Hz";
    const Samples& samples = channels[at (t.channel - 1)];
    if (samples.size() < 2 || samples.size() > at (Table::longest))
        return "wav needs from 2 to " + std::to_string (Table::longest) + " samples; it has " + std::to_string (samples.size());
    const auto finite = [] (double v) { return isFinite (v); };
    if (! std::ranges::all_of (samples, finite)) return "wav has a sample that is not finite";
    return {};
}

inline std::string Wavetable::warning (const Setup& setup) const
{
    const Table& t = settings.table;
    if (t.wav) return {};
    for (const Mode& m : t.modes)
        if (m.frequency >= 0.5 * t.rate && m.frequency < 0.5 * setup.rate_hz)
            return "the table's rate is too low for the mode at " + std::to_string (std::lround (m.frequency))
                   + " Hz, which will alias: raise the rate to more than twice that frequency";

    constexpr double unheard = 0.02;
    for (const Mode& m : t.modes)
        if (m.frequency < 0.5 * setup.rate_hz && m.decay > 0.0 && math::exp (-m.decay * t.length / t.rate) > unheard)
        {
            const auto enough = std::lround (std::ceil (-math::log (unheard) * t.rate / m.decay));
            return "the table ends while the mode at " + std::to_string (std::lround (m.frequency))
                   + " Hz still sounds, which clicks: set the length to at least " + std::to_string (enough);
        }
    return {};
}

inline std::shared_ptr<const Wavetable::Tables> Wavetable::make (double tick_rate_hz) const
{
    auto made = std::make_shared<Tables>();
    made->rate = settings.table.wav ? settings.table.wav->rate_hz : settings.table.rate;
    for (std::size_t octave = 0; octave < octaves; ++octave)
    {
        const double below_hz = 0.5 * tick_rate_hz / double (1 << octave);
        made->of_octave[octave] = settings.table.wav ? ofRecording (below_hz) : ofModes (below_hz);
    }
    return made;
}

inline Wavetable::Samples Wavetable::ofModes (double below_hz) const
{
    const Table& t = settings.table;
    Samples samples (at (t.length));
    for (const Mode& m : t.modes)
    {
        if (! (m.decay > 0.0 && m.frequency < below_hz)) continue;
        for (std::size_t i = 0; i < samples.size(); ++i)
        {
            const double time = static_cast<double> (i) / t.rate;
            samples[i] += m.amplitude * math::exp (-m.decay * time) * math::sin (2.0 * std::numbers::pi * m.frequency * time);
        }
    }
    samples.back() = 0.0;
    return samples;
}

inline Wavetable::Samples Wavetable::ofRecording (double below_hz) const
{
    const Signal& wav = *settings.table.wav;
    Samples samples = wav.channels[at (settings.table.channel - 1)];
    bendEndsToZero (samples, wav.rate_hz);
    if (below_hz < 0.5 * wav.rate_hz)
    {
        lowPassBothWays (samples, 0.6 * below_hz, wav.rate_hz);
        bendEndsToZero (samples, wav.rate_hz);
    }
    return samples;
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Wavetable);
