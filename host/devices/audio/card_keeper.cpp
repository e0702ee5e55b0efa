// SPDX-License-Identifier: MIT
#include "card_keeper.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host::audio
{

Result<> CardKeeper::open (const CardRequest& what, int outs, int ins)
{
    close();
    wanted = what;
    outputs = outs;
    inputs = ins;
    is_wanted = true;
    last_attempt = tryAgain (Clock::now());
    return last_attempt;
}

void CardKeeper::close()
{
    is_wanted = false;
    before = xruns();
    card.reset();
}

Result<> CardKeeper::tryAgain (Clock::time_point now)
{
    tried = last = now;
    const auto began = Clock::now();
    auto result = system.open (wanted, outputs, inputs, *this);
    pause = std::max<Clock::duration> (retry_after, rarity * (Clock::now() - began));
    if (! result) return std::move (result).error();
    card = std::move (*result);
    seen = blocks();
    return {};
}

void CardKeeper::poll (Clock::time_point now)
{
    if (! is_wanted) return;
    if (card != nullptr)
    {
        if (const auto n = blocks(); n != seen)
        {
            seen = n;
            last = now;
        }
        if (now - last < gone_after) return;
        before = xruns();
        card.reset();
        ++gone;
        tried = now;
    }
    else if (now - tried >= pause)
        last_attempt = tryAgain (now);
}

void CardKeeper::begin (const OpenedFormat& format)
{
    opened = format;
    user.begin (format);
}

void CardKeeper::block (const float* const* in, int ins, float* const* out, int outs, int frames) noexcept
{
    user.block (in, ins, out, outs, frames);
    count.fetch_add (1, std::memory_order_release);
}

}   // namespace tactus::host::audio
