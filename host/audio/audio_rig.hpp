// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "audio_clock.hpp"
#include "audio_device.hpp"
#include "card_capture.hpp"
#include "card_keeper.hpp"
#include "port_mixer.hpp"
#include "stream.hpp"

#include <framework/engine.hpp>

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host::audio
{

/// How the sound of a run is doing.
struct AudioStatus
{
    bool is_open = false;
    OpenedFormat card {};         ///< the latest
    StreamReport out {}, in {};   ///< the worst of all that are played; what is heard
    double ratio = 1.0;           ///< of the card's clock to that of the ticks, as learned
    std::uint64_t blocks = 0, xruns = 0, late_blocks = 0, departures = 0;
    std::uint64_t clipped = 0;       ///< samples beyond full scale
    std::uint64_t not_numbers = 0;   ///< samples of routes that were none
    bool by_timer = false;           ///< the card was to tick, and a timer does
    std::uint64_t ticks_by_timer = 0;
    std::string trouble {};   ///< why the card cannot be taken again
};

/// All that a run plays and hears: the ports that are routed to channels, the roles with the driver "audio", one card, and what
/// keeps their clocks together. Its life: made; roles are opened; begin; ticks with before and after around each; end.
class AudioRig final : private CardUser
{
public:
    /// The system outlives this. [main thread]
    explicit AudioRig (AudioSettings, CardSystem& = soundCards());
    ~AudioRig() override { end(); }

    /// Other settings, before any role is opened. [main thread]
    void choose (AudioSettings s) { wanted = std::move (s); }

    /// Blocks are to tick the run: before begin. Then it is the clock of the run. [main thread]
    AudioClock& tickBy (double tick_rate_hz);

    AudioClock* clock() noexcept { return own_clock.get(); }   ///< null if something else ticks [main thread]

    /// A device for a role, before begin; null with a message afterwards, until the next run (audio/late). It outlives the
    /// ticks, and this outlives it. [main thread]
    std::unique_ptr<AudioDevice> open (AudioRole, Messages&);

    /// A card by name, as parseCard has it, unless one is named already: then it has to be the same (audio/two_cards). Before
    /// begin. [main thread]
    std::optional<Message> nameCard (const std::string&);

    const AudioSettings& settings() const noexcept { return wanted; }
    bool isNeeded() const noexcept { return ! wanted.routes.empty() || ! devices.empty() || own_clock != nullptr; }

    /// The ports to tap (CompileOptions::records). [main thread]
    std::vector<std::string> ports() const;

    /// Opens the card. The plan is compiled with those ports; an engine, if given, has the emergency stop. Says what is wrong:
    /// audio/port, audio/unit, audio/rate, and those of CardSystem::open. Where only the card is at fault it is looked for
    /// from now on, as one that went away. [main thread, before ticking]
    Messages begin (const Plan&, double tick_rate_hz, const Engine* = nullptr);

    /// In place of begin, where nothing is needed: no role is opened from now on. [main thread]
    void seal() noexcept { has_begun = true; }

    /// Of what the card is given, from now on to the end. After begin. Ids as of CardCapture. [main thread]
    std::optional<Error> captureTo (const std::filesystem::path&);

    void before() noexcept;                          // each tick, before the devices are read [tick thread]
    void after (const Plan&, bool halts) noexcept;   // each tick, after they were written [tick thread]

    /// To be called many times a second. Returns what went wrong with the capture, once: also audio/capture_rate, where
    /// the card came back at another rate. [main thread]
    std::optional<Error> attend (CardKeeper::Clock::time_point now = CardKeeper::Clock::now());

    /// Closes the card, and the capture. Returns what went wrong with that. When nothing ticks any more. [main thread]
    std::optional<Error> end();

    AudioStatus status() const;   // [main thread]

private:
    /// All that has so many samples a tick.
    struct Lanes
    {
        Lanes (int n, std::vector<int> all, double tick_hz, double reserve_s)
            : per_tick (n), channels (std::move (all)), stream ({ .lanes = static_cast<int> (channels.size()), .tick_side_hz = n * tick_hz, .reserve_s = reserve_s }), frame (channels.size())
        {
        }

        int per_tick;
        std::vector<int> channels;   // from 0, by lane
        OutStream stream;
        std::vector<float> frame, block;
    };

    void begin (const OpenedFormat&) override;
    void block (const float* const* in, int ins, float* const* out, int outs, int frames) noexcept override;
    void play (const float* const* in, int ins, float* const* out, int outs, int from, int frames) noexcept;
    void limit (float* samples, int frames) noexcept;
    void letDryOut() const;
    void makeStreams (const std::vector<Route>&, const std::vector<int>& per_tick);

    AudioSettings wanted;
    std::unique_ptr<AudioClock> own_clock;
    std::vector<AudioDevice*> devices;
    double tick_hz = 0.0;
    const Engine* engine = nullptr;
    bool has_begun = false;

    std::unique_ptr<PortMixer> mixer;
    std::vector<std::unique_ptr<Lanes>> lanes;
    std::vector<int> heard_channels;   // from 0, by lane
    std::unique_ptr<InStream> heard;
    std::vector<float> heard_block;
    OpenedFormat format;
    bool fits = false;   // the card's rate can be made of the ticks'

    // Of the tick thread.
    std::array<double, most_channels> channels {};
    std::array<float, most_channels> inputs {};
    std::uint64_t blocks_seen = 0, ticks_without = 0;
    std::atomic<std::uint64_t> ticks_of_silence = 0;
    std::atomic<bool> plays = false;

    std::atomic<std::uint64_t> clipped = 0, late_blocks = 0;
    std::chrono::steady_clock::time_point last_block {};   // of the audio thread
    std::unique_ptr<CardCapture> capture;
    double capture_rate = 0.0;            // Hz
    std::optional<Error> capture_ended;   // and nobody has been told
    std::atomic<CardCapture*> captures = nullptr;
    CardSystem& cards;
    CardKeeper keeper;   // last: its card calls this
};

/// For a status line: what is worth knowing now, "" if nothing runs.
std::string statusOf (const AudioStatus&);

/// At the end: card, rates, clocks, and what went wrong.
std::string accountOf (const AudioStatus&);

}   // namespace tactus::host::audio
