// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{
namespace
{
constexpr double reserve_s = 0.02;   // a gap is more audible than 10 ms more delay

std::unique_ptr<audio::OutStream> makeStream (double tick_rate)
{
    return std::make_unique<audio::OutStream> (audio::StreamSetup { .lanes = 1, .tick_side_hz = tick_rate, .reserve_s = reserve_s });
}
}   // namespace

Sound::Sound (audio::CardSystem& cards) : stream (makeStream (tick_rate)), keeper (cards, *this) {}

Result<> Sound::start()
{
    if (isOn()) return {};
    auto opened = open();
    on = opened.has_value();
    if (! opened) keeper.close();
    return opened;
}

/// Opens the card in stereo, or in mono if it has only one channel.
Result<> Sound::open()
{
    auto opened = keeper.open ({}, channels, 0);
    if (! opened && opened.error().id == "audio/channel") opened = keeper.open ({}, 1, 0);
    return opened;
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
    on = open().has_value();
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
    for (int i = 0; i < frames; ++i)
        out[0][i] = std::tanh (out[0][i]);
    for (int c = 1; c < outs; ++c)
        std::copy_n (out[0], frames, out[c]);
}

}   // namespace tactus::host
