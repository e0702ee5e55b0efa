// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{
namespace
{
constexpr double reserve_s = 0.02;   // for ears, which mind a gap more than they mind 10 ms

std::unique_ptr<audio::OutStream> makeStream (double tick_rate) { return std::make_unique<audio::OutStream> (audio::StreamSetup { .lanes = 1, .tick_side_hz = tick_rate, .reserve_s = reserve_s }); }
}   // namespace

Sound::Sound (audio::CardSystem& cards) : stream (makeStream (tick_rate)), keeper (cards, *this) {}

std::optional<Message> Sound::start()
{
    if (isOn()) return std::nullopt;
    auto trouble = open();
    on = ! trouble;
    if (trouble) keeper.close();
    return trouble;
}

/// In stereo if the card has it.
std::optional<Message> Sound::open()
{
    auto trouble = keeper.open ({}, 2, 0);
    if (trouble && trouble->id == "audio/channel") trouble = keeper.open ({}, 1, 0);
    return trouble;
}

void Sound::stop()
{
    on = false;
    keeper.close();
}

void Sound::setTickRate (double hz)
{
    if (hz == tick_rate) return;
    keeper.close();
    tick_rate = hz;
    high_pass = { lowest_hz, hz };
    stream = makeStream (hz);
    if (! isOn()) return;
    on = ! open();
    if (! on) keeper.close();
}

void Sound::push (double newton) noexcept
{
    if (! isOn()) return;
    const auto sample = static_cast<float> (high_pass (std::isfinite (newton) ? newton / newton_at_full_scale : 0.0));
    stream->push ({ &sample, 1 });
}

void Sound::begin (const audio::OpenedFormat& card)
{
    longest_block = card.block;
    stream->prepare ({ card.rate_hz, card.block });
}

void Sound::block (const float* const*, int, float* const* out, int outs, int frames) noexcept
{
    if (outs == 0) return;
    for (int from = 0; from < frames; from += longest_block)
        stream->render ({ out[0] + from, static_cast<std::size_t> (std::min (longest_block, frames - from)) });
    const float gain = volume.load (std::memory_order_relaxed);
    for (int i = 0; i < frames; ++i)
        out[0][i] = std::tanh (gain * out[0][i]);
    for (int c = 1; c < outs; ++c)
        std::copy_n (out[0], frames, out[c]);
}

}   // namespace tactus::host
