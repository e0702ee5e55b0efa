// SPDX-License-Identifier: MIT
#include "stream.hpp"

#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tactus::host::audio
{
namespace
{
constexpr double fade_in_s = 0.005, fade_out_s = OutStream::fade_out_s;
constexpr double longest_backlog_s = 0.02;   // beyond the target and the reserve, in s; anything more is skipped rather than played late
constexpr double room_s = 0.5;
constexpr std::size_t room_frames = 512;

std::size_t roomOf (const StreamSetup& s) { return room_frames + static_cast<std::size_t> (s.tick_side_hz * (room_s + 2.0 * s.reserve_s)); }

/// Rises from 0 to 1 without a corner at either end.
float raised (double part) noexcept { return static_cast<float> (0.5 - 0.5 * math::cos (std::numbers::pi * std::clamp (part, 0.0, 1.0))); }
}   // namespace

OutStream::OutStream (const StreamSetup& s)
    : setup (s), fifo (roomOf (s), static_cast<std::size_t> (s.lanes)), resampler (s.lanes), last (static_cast<std::size_t> (s.lanes))
{
}

void OutStream::prepare (const CardFormat& format) noexcept
{
    if (format.clocks != card.clocks || format.rate_hz != card.rate_hz) servo.reset();
    card = format;
    copies = card.clocks == Clocks::one && card.rate_hz == setup.tick_side_hz;
    const double a_block = card.block * setup.tick_side_hz / card.rate_hz;
    const double ahead = copies ? 0.0 : Resampler::lookAhead (card.rate_hz / setup.tick_side_hz);
    aim = card.clocks == Clocks::one ? a_block + ahead + 1.0 : a_block + ahead + 1.0 + setup.reserve_s * setup.tick_side_hz;
    flows = false;
    std::ranges::fill (last, 0.0f);
    // Drops frames queued while there was no card; nothing else consumes frames before the card's first block.
    fifo.take (fifo.size());
}

/// Starts playback: skips frames until only the target number is waiting.
void OutStream::begin (double waiting) noexcept
{
    fifo.take (static_cast<std::size_t> (waiting - aim));
    at = static_cast<double> (fifo.removed());
    resampler.reset();
    servo.restart();
    flows = true;
    faded = 0;
    now.underruns += std::exchange (is_dry, false) ? 1 : 0;
}

int OutStream::pull (float* out, int wanted, double ratio) noexcept
{
    const int lanes = setup.lanes;
    int made = 0;
    while (made < wanted)
    {
        const auto in = fifo.front();
        const int there = static_cast<int> (in.size()) / lanes;
        Resampler::Step step;
        if (copies)
        {
            step.used = step.made = std::min (there, wanted - made);
            std::copy_n (in.data(), step.made * lanes, out + made * lanes);
        }
        else
            step = resampler.process (in.data(), there, out + made * lanes, wanted - made, ratio);
        fifo.take (static_cast<std::size_t> (step.used));
        made += step.made;
        if (step.used == 0 && step.made == 0) break;
    }
    return made;
}

void OutStream::render (std::span<float> frames) noexcept
{
    const int lanes = setup.lanes, wanted = static_cast<int> (frames.size()) / lanes;
    const double hz = setup.tick_side_hz;

    if (! flows && faded >= fade_out_s * card.rate_hz)
        if (const auto waiting = static_cast<double> (fifo.size()); waiting >= aim) begin (waiting);
    if (! flows)
    {
        fadeOut (frames.data(), wanted);
        now.flows = 0;
        published.store (now);
        return;
    }

    const double waits = static_cast<double> (fifo.pushed()) - at, error_s = (waits - aim) / hz;
    const double correction = card.clocks == Clocks::one ? 0.0 : servo (error_s, wanted / card.rate_hz);
    const int made = pull (frames.data(), wanted, card.rate_hz / hz / (1.0 + correction));
    at += wanted * hz / card.rate_hz * (1.0 + correction);
    fadeIn (frames.data(), made);
    if (made > 0) std::copy_n (frames.data() + (made - 1) * lanes, lanes, last.data());

    const bool late = error_s > setup.reserve_s + longest_backlog_s;
    if (made < wanted || late)
    {
        now.overruns += late ? 1 : 0;
        is_dry = ! late;
        flows = false;
        faded = 0;
        fadeOut (frames.data() + made * lanes, wanted - made);
    }
    now.difference = -servo.difference();
    now.error_s = card.clocks == Clocks::one ? 0.0 : servo.error();
    now.latency_s = aim / hz + now.error_s;
    now.flows = flows ? 1 : 0;
    published.store (now);
}

void OutStream::fadeIn (float* out, int frames) noexcept
{
    const double all = fade_in_s * card.rate_hz;
    for (int i = 0; i < frames && faded < all; ++i, ++faded)
        for (int lane = 0; lane < setup.lanes; ++lane)
            out[i * setup.lanes + lane] *= raised (faded / all);
}

/// Fades from the last sample to zero.
void OutStream::fadeOut (float* out, int frames) noexcept
{
    const double all = fade_out_s * card.rate_hz;
    for (int i = 0; i < frames; ++i, ++faded)
        for (int lane = 0; lane < setup.lanes; ++lane)
            out[i * setup.lanes + lane] = faded < all ? last[static_cast<std::size_t> (lane)] * raised (1.0 - (faded + 1) / all) : 0.0f;
}

//==============================================================================
InStream::InStream (const StreamSetup& s)
    : setup (s), fifo (roomOf (s), static_cast<std::size_t> (s.lanes)), resampler (s.lanes), frame (static_cast<std::size_t> (s.lanes)),
      last (static_cast<std::size_t> (s.lanes))
{
}

void InStream::prepare (const CardFormat& format)
{
    if (format.clocks != card.clocks || format.rate_hz != card.rate_hz) servo.reset();
    servo.restart();
    card = format;
    copies = card.clocks == Clocks::one && card.rate_hz == setup.tick_side_hz;
    const double a_block = card.block * setup.tick_side_hz / card.rate_hz;
    made.resize (static_cast<std::size_t> (setup.lanes) * static_cast<std::size_t> (std::ceil (a_block * (1.0 + Servo::most)) + 2.0));
    aim = a_block + 1.0 + (card.clocks == Clocks::one ? 0.0 : setup.reserve_s * setup.tick_side_hz);
    ahead = 0.0;
    heard = false;
    resampler.reset();
}

void InStream::take (std::span<const float> frames) noexcept
{
    const int lanes = setup.lanes, count = static_cast<int> (frames.size()) / lanes;
    const double hz = setup.tick_side_hz;
    const double waits = static_cast<double> (fifo.size()) + ahead;
    const double a_block = count * hz / card.rate_hz, error_s = (waits + a_block - aim.load (std::memory_order_relaxed)) / hz;
    const bool runs = card.clocks == Clocks::apart && heard.load (std::memory_order_relaxed);
    const double correction = runs ? servo (error_s, count / card.rate_hz) : 0.0;
    const double ratio = hz / card.rate_hz * (1.0 - correction);
    const auto put = [&] (const float* samples, int n) {
        for (int i = 0; i < n; ++i)
            if (! fifo.push ({ samples + i * lanes, static_cast<std::size_t> (lanes) })) break;
    };
    const auto before = fifo.pushed();
    if (copies)
        put (frames.data(), count);
    else
        for (int used = 0; used < count;)
        {
            const auto step = resampler.process (frames.data() + used * lanes, count - used, made.data(), static_cast<int> (made.size()) / lanes, ratio);
            put (made.data(), step.made);
            used += step.used;
            if (step.used == 0 && step.made == 0) break;
        }
    // Samples that the resampler still holds back are counted: they come with the next blocks. While no tick
    // takes samples, the ring may be full, so nothing is counted.
    ahead = heard.load (std::memory_order_relaxed) ? ahead + count * ratio - static_cast<double> (fifo.pushed() - before) : 0.0;
    now.difference = servo.difference();
    now.error_s = runs ? servo.error() : 0.0;
    now.latency_s = waits / hz + (copies ? 0.0 : Resampler::lookAhead (ratio) / card.rate_hz);
    now.underruns = dry.load (std::memory_order_relaxed);
    now.overruns = skipped.load (std::memory_order_relaxed);
    now.flows = heard.load (std::memory_order_relaxed) ? 1 : 0;
    published.store (now);
}

std::span<const float> InStream::pop() noexcept
{
    const double all = fade_out_s * setup.tick_side_hz, wanted = aim.load (std::memory_order_relaxed);
    const auto waiting = static_cast<double> (fifo.size());
    if (! flows && waiting >= wanted && wanted > 0.0)
    {
        fifo.take (static_cast<std::size_t> (waiting - wanted));
        flows = true;
        faded = 0;
        if (std::exchange (is_dry, false)) dry.fetch_add (1, std::memory_order_relaxed);
    }
    else if (flows && waiting > wanted + (setup.reserve_s + longest_backlog_s) * setup.tick_side_hz)
    {
        fifo.take (static_cast<std::size_t> (waiting - wanted));
        skipped.fetch_add (1, std::memory_order_relaxed);
    }
    if (flows && fifo.size() == 0)
    {
        flows = false;
        faded = 0;
        is_dry = true;
    }
    heard.store (flows, std::memory_order_relaxed);
    if (flows)
    {
        const auto next = fifo.front();
        const double in = fade_in_s * setup.tick_side_hz;
        const float part = faded < in ? raised (++faded / in) : 1.0f;
        std::ranges::transform (next.first (frame.size()), frame.begin(), [part] (float v) { return v * part; });
        std::ranges::copy (frame, last.begin());
        fifo.take (1);
        return frame;
    }
    const float part = faded < all ? raised (1.0 - (faded + 1) / all) : 0.0f;
    if (faded < all) ++faded;
    std::ranges::transform (last, frame.begin(), [part] (float v) { return v * part; });
    return frame;
}

}   // namespace tactus::host::audio
