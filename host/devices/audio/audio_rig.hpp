// SPDX-License-Identifier: MIT
#pragma once

#include "audio_clock.hpp"
#include "audio_device.hpp"
#include "card_capture.hpp"
#include "card_keeper.hpp"
#include "port_mixer.hpp"
#include "stream.hpp"

#include <host/devices/live/run_sound.hpp>
#include <tactus/run/clock/passed_time.hpp>
#include <tactus/text/result.hpp>

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host::audio
{

/// State of a run's sound.
struct AudioStatus
{
    bool is_open = false;
    OpenedFormat card {};         ///< the latest format
    StreamReport out {}, in {};   ///< out: the worst of all output streams
    double ratio = 1.0;           ///< estimated rate of the card's clock relative to the tick clock
    std::uint64_t blocks = 0, xruns = 0, late_blocks = 0, departures = 0;
    std::uint64_t clipped = 0;       ///< samples beyond full scale
    std::uint64_t not_numbers = 0;   ///< samples of routes that were not numbers
    bool by_timer = false;           ///< the card should tick the run, but a timer does so
    std::uint64_t ticks_by_timer = 0;
    std::string trouble {};   ///< why the card cannot be reopened
};

/// Everything that a run plays and records: the ports routed to channels, the roles with the driver "audio", one card, and
/// the streams that keep the clocks in step. Life cycle: construct; open roles; begin; on each tick before() and after();
/// end.
class AudioRig final : public RunSound, private CardUser
{
public:
    /// The card system must outlive the rig. [main thread]
    explicit AudioRig (AudioSettings, CardSystem& = soundCards());
    ~AudioRig() override { static_cast<void> (end()); }

    /// Replaces the settings, before any role is opened. [main thread]
    void choose (AudioSettings s) { wanted = std::move (s); }

    /// Makes the blocks tick the run. Call before begin(). Returns the clock of the run. [main thread]
    AudioClock& tickBy (double tick_rate_hz) override;

    AudioClock* clock() const noexcept override { return own_clock.get(); }   ///< null if another clock ticks the run [main thread]

    /// Opens the device of a role, before begin(). After begin() it returns null with a message (audio/late), until the next
    /// run. The device must outlive the ticks, and the rig must outlive the device. [main thread]
    std::unique_ptr<AudioDevice> open (AudioRole, Messages&);

    /// Opens the device that a description names, as openAudio does. If the description names no channels, it gets those that the nodes of the role
    /// use. [main thread]
    MadeDevice open (const Json& description, const std::string& role, const Plan&) override;

    /// Selects a card by name (see parseCard). If one has already been selected, it must be the same one (audio/two_cards). Call
    /// before begin(). [main thread]
    Result<> nameCard (const std::string&);

    const AudioSettings& settings() const noexcept { return wanted; }
    bool isNeeded() const noexcept override { return ! wanted.routes.empty() || ! devices.empty() || own_clock != nullptr; }

    /// The ports of all routes. [main thread]
    std::vector<std::string> ports() const override;

    /// True for a route marked `if_there`, and for all routes of a lenient rig. [main thread]
    bool isOptional (const std::string& port) const override;
    void setLenient (bool l) noexcept { lenient = l; }

    /// Opens the card. The roles must have their limits (Engine::attach), and the plan must be compiled with the ports of the
    /// routes. The engine, if given, provides the emergency stop. Ids: audio/port, audio/unit, audio/rate, and those of
    /// CardSystem::open. If only opening the card fails, it is retried, like a card that went away. [main thread, before ticking]
    Messages begin (const Plan&, double tick_rate_hz, const Engine* = nullptr) override;

    /// Call this instead of begin() if isNeeded() is false: no role can be opened from now on. [main thread]
    void seal() noexcept override { has_begun = true; }

    /// Records the card's output to a file until the end. Call after begin(). Ids: see CardCapture. [main thread]
    Result<> captureTo (const std::filesystem::path&);

    void before() noexcept;                          // on each tick, before the devices are read [tick thread]
    void after (const Plan&, bool halts) noexcept;   // on each tick, after the devices are written [tick thread]
    void before (Plan&, std::uint64_t) noexcept override { before(); }
    void after (const Plan& plan, std::uint64_t, bool halts) noexcept override { after (plan, halts); }

    /// Call this many times a second. Returns an error of the capture once, including audio/capture_rate if the card came
    /// back at a different rate. [main thread]
    Result<> poll (CardKeeper::Clock::time_point now);
    Result<> poll() override { return poll (CardKeeper::Clock::now()); }

    /// Closes the card and the capture. Returns an error of the capture. Call this when the run no longer ticks. [main thread]
    Result<> end() override;

    /// True if a role with a max_signal plays on one of the first `count` channels. Call after begin(). [main thread]
    bool limitsFirst (int count) const noexcept;

    AudioStatus status() const;   // [main thread]

private:
    /// The stream that carries all channels with the same number of samples per tick.
    struct Lanes
    {
        Lanes (int n, std::vector<int> all, double tick_hz, double reserve_s)
            : per_tick (n), channels (std::move (all)),
              stream ({ .lanes = static_cast<int> (channels.size()), .tick_side_hz = n * tick_hz, .reserve_s = reserve_s }), frame (channels.size())
        {
        }

        int per_tick;
        std::vector<int> channels;   // by lane: the card's channel, counted from 0
        OutStream stream;
        std::vector<float> frame, block;
    };

    void begin (const OpenedFormat&) override;
    void block (const float* const* in, int ins, float* const* out, int outs, int frames) noexcept override;
    void play (const float* const* in, int ins, float* const* out, int outs, int from, int frames) noexcept;
    void clip (float* samples, int frames) noexcept;
    void playRest() const;
    Messages chooseRoutes (const Plan&, std::vector<Route>& played, std::vector<int>& per_tick) const;
    void makeStreams (const std::vector<Route>&, const std::vector<int>& per_tick);
    Result<> openCard (const std::vector<Route>&);

    AudioSettings wanted;
    std::unique_ptr<AudioClock> own_clock;
    std::vector<AudioDevice*> devices;
    double tick_hz = 0.0;
    const Engine* engine = nullptr;
    bool has_begun = false, lenient = false;

    std::unique_ptr<PortMixer> mixer;
    std::vector<std::unique_ptr<Lanes>> lanes;
    std::vector<int> heard_channels;   // by lane of `heard`: the card's channel, counted from 0
    std::unique_ptr<InStream> heard;
    std::vector<float> heard_block;
    OpenedFormat format;
    bool fits = false;   // true if the tick rate can be resampled to the card's rate

    // [tick thread]
    std::array<double, most_channels> channels {};
    std::array<float, most_channels> inputs {};
    std::uint64_t blocks_seen = 0, ticks_without = 0;
    std::atomic<std::uint64_t> ticks_of_silence = 0;
    std::atomic<bool> plays = false;

    std::array<ChannelLimit, most_channels> limits {};   // by channel of the card   [audio thread, while a card is open]
    std::atomic<std::uint64_t> clipped = 0, late_blocks = 0;
    std::chrono::steady_clock::time_point last_block {};   // [audio thread]
    PassedTime passed_time { 0.0 };                        // from block to block [audio thread]
    std::unique_ptr<CardCapture> capture;
    double capture_rate = 0.0;   // rate at which `capture` records, in Hz
    Result<> capture_result;     // result of a capture that has ended, until poll() returns it
    std::atomic<CardCapture*> captures = nullptr;
    CardSystem& cards;
    CardKeeper keeper;   // declared last: its card calls the functions of this object
};

/// Text for a status line; "" if no card is open.
std::string statusOf (const AudioStatus&);

/// Summary at the end of a run: card, rates, clocks, errors.
std::string accountOf (const AudioStatus&);

}   // namespace tactus::host::audio
