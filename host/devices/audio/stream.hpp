// SPDX-License-Identifier: MIT
#pragma once

#include "resampler.hpp"
#include "servo.hpp"

#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus::host::audio
{

/// The relation between the ticks of a run and the blocks of a sound card.
enum class Clocks
{
    apart,   ///< independent clocks: the ratio is estimated and followed
    one      ///< blocks tick the run: no drift
};

/// State of a stream.
struct StreamReport
{
    double difference = 0.0;       ///< relative difference of the card clock to the tick clock, as learned
    double error_s = 0.0;          ///< deviation of the queue's length from its target, in s
    double latency_s = 0.0;        ///< from tick to card, or back, without the card's own latency
    std::uint64_t underruns = 0;   ///< number of times the queue ran empty and the sound faded out; counted when the sound resumes,
                                   ///< because the queue always runs empty at the end of a stream
    std::uint64_t overruns = 0;    ///< number of times the queue was far too long and part of it was skipped
    std::uint64_t flows = 0;       ///< 1 while there is sound
};

/// Parameters of a stream in either direction.
struct StreamSetup
{
    int lanes = 1;
    double tick_side_hz = 0.0;   ///< frames per second on the tick side
    double reserve_s = 0.01;     ///< how late a tick or a block may be without causing a gap, in s
};

struct CardFormat
{
    double rate_hz = 0.0;
    int block = 0;   ///< largest number of frames in a block
    Clocks clocks = Clocks::apart;
};

/// Carries samples from the ticks to a sound card. If none arrive in time, the sound fades out; once enough are waiting, it
/// fades in again.
class OutStream
{
public:
    static constexpr double fade_out_s = 0.003;

    /// Requires that Resampler::canDo is true for its rate and the card's.
    explicit OutStream (const StreamSetup&);

    /// Prepares for a card that is about to start. [main thread, while no block is requested]
    void prepare (const CardFormat&) noexcept;

    /// Adds a frame; it is dropped while no card plays. [tick thread]
    void push (std::span<const float> frame) noexcept { fifo.push (frame); }

    /// Renders the next samples, interleaved; at most one block. [audio thread]
    void render (std::span<float> frames) noexcept;

    StreamReport report() const noexcept { return published.load(); }   // [any thread]
    int lanes() const noexcept { return setup.lanes; }

private:
    void begin (double waiting) noexcept;
    int pull (float* out, int wanted, double ratio) noexcept;
    void fadeIn (float* out, int frames) noexcept;
    void fadeOut (float* out, int frames) noexcept;

    const StreamSetup setup;
    SpscRing<float> fifo;
    Resampler resampler;
    Servo servo;
    CardFormat card;
    bool copies = false;   // true: copies samples without resampling, because ticks and card share clock and rate
    double aim = 0.0;      // target number of waiting frames when a block is requested

    // [audio thread]
    double at = 0.0;   // position of the next frame to play, in frames pushed into the ring since the start
    bool flows = false, is_dry = false;
    int faded = 0;             // how many frames of the fade in or out have passed
    std::vector<float> last;   // one sample per lane
    StreamReport now;
    Snapshot<StreamReport> published;
};

/// Carries samples from a sound card to the ticks, one frame per tick.
class InStream
{
public:
    explicit InStream (const StreamSetup&);

    void prepare (const CardFormat&);   // [main thread, while no block is delivered]

    /// Takes input samples, interleaved; at most one block. [audio thread]
    void take (std::span<const float> frames) noexcept;

    /// The next frame. If none is waiting, the last one fades to zero within 3 ms. [tick thread]
    std::span<const float> pop() noexcept;

    StreamReport report() const noexcept { return published.load(); }   // [any thread]
    int lanes() const noexcept { return setup.lanes; }

private:
    const StreamSetup setup;
    SpscRing<float> fifo;
    Resampler resampler;
    Servo servo;
    CardFormat card;
    bool copies = false;
    std::atomic<double> aim = 0.0;   // target number of waiting frames after a block has arrived
    std::vector<float> made;         // room for the resampled frames of a block

    // [audio thread]
    double ahead = 0.0;   // frames that are due by the ratio but not yet output by the resampler
    StreamReport now;
    Snapshot<StreamReport> published;

    // [tick thread]
    bool flows = false, is_dry = false;
    std::vector<float> frame;
    std::vector<float> last;
    int faded = 0;   // how many ticks of the fade in or out have passed
    std::atomic<std::uint64_t> dry = 0, skipped = 0;
    std::atomic<bool> heard = false;
};

}   // namespace tactus::host::audio
