// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "resampler.hpp"
#include "sample_fifo.hpp"
#include "servo.hpp"

#include <host/runtime/snapshot.hpp>

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus::host::audio
{

/// How the ticks of a run and the blocks of a sound card stand to each other.
enum class Clocks
{
    apart,   ///< each has its own: the ratio is found and followed
    one      ///< blocks tick the run, so nothing drifts
};

/// How a stream is doing.
struct StreamReport
{
    double difference = 0.0;       ///< by how much the card is faster than the ticks, relative to what both say; what was learned
    double error_s = 0.0;          ///< by how much more waits than should
    double latency_s = 0.0;        ///< from tick to card, or back, without the card's own
    std::uint64_t underruns = 0;   ///< times that nothing waited and it faded out; counted when it is back, for all things end
    std::uint64_t overruns = 0;    ///< times that far too much did: some was left out
    std::uint64_t flows = 0;       ///< 1 while there is sound
};

/// What both directions have in common.
struct StreamSetup
{
    int lanes = 1;
    double tick_side_hz = 0.0;   ///< frames a second on the side of the ticks
    double reserve_s = 0.01;     ///< how late a tick or a block may be without a gap
};

struct CardFormat
{
    double rate_hz = 0.0;
    int block = 0;   ///< frames, at most
    Clocks clocks = Clocks::apart;
};

/// Samples from the ticks to a sound card. Where none come in time it fades out, and in again once enough wait.
class OutStream
{
public:
    static constexpr double fade_out_s = 0.003;

    /// There must be a Resampler::canDo from its rate to the card's.
    explicit OutStream (const StreamSetup&);

    /// For a card that is about to begin. [main thread, while no block is asked for]
    void prepare (const CardFormat&) noexcept;

    /// A frame. What comes while no card plays is lost. [tick thread]
    void push (std::span<const float> frame) noexcept { fifo.push (frame); }

    /// The next samples, side by side by lanes, at most a block. [audio thread]
    void render (std::span<float> frames) noexcept;

    StreamReport report() const noexcept { return published.load(); }   // [any thread]
    int lanes() const noexcept { return fifo.lanes(); }

private:
    void begin (double waiting) noexcept;
    int pull (float* out, int wanted, double ratio) noexcept;
    void fadeIn (float* out, int frames) noexcept;
    void fadeOut (float* out, int frames) noexcept;

    const StreamSetup setup;
    SampleFifo fifo;
    Resampler resampler;
    Servo servo;
    CardFormat card;
    bool copies = false;   // both sides have the same clock and rate
    double aim = 0.0;      // frames that should wait when a block is asked for

    // Of the audio thread.
    double at = 0.0;   // which frame is next, counted as the fifo counts
    bool flows = false, is_dry = false;
    int faded = 0;             // frames of the way in, or out
    std::vector<float> last;   // a sample a lane
    StreamReport now;
    Snapshot<StreamReport> published;
};

/// Samples from a sound card to the ticks, one frame a tick.
class InStream
{
public:
    explicit InStream (const StreamSetup&);

    void prepare (const CardFormat&);   // [main thread, while no block comes]

    /// What was heard, side by side by lanes, at most a block. [audio thread]
    void take (std::span<const float> frames) noexcept;

    /// The next frame. Where none waits the last one fades to zero, within 3 ms. [tick thread]
    std::span<const float> pop() noexcept;

    StreamReport report() const noexcept { return published.load(); }   // [any thread]
    int lanes() const noexcept { return fifo.lanes(); }

private:
    const StreamSetup setup;
    SampleFifo fifo;
    Resampler resampler;
    Servo servo;
    CardFormat card;
    bool copies = false;
    std::atomic<double> aim = 0.0;   // frames that should wait when a block has come
    std::vector<float> made;         // room for those of a block

    // Of the audio thread.
    double ahead = 0.0;   // made by the ratio, but not yet by the resampler: frames
    StreamReport now;
    Snapshot<StreamReport> published;

    // Of the tick thread.
    bool flows = false, is_dry = false;
    std::vector<float> frame;
    std::vector<float> last;
    int faded = 0;   // ticks of the way in, or out
    std::atomic<std::uint64_t> dry = 0, skipped = 0;
    std::atomic<bool> heard = false;
};

}   // namespace tactus::host::audio
