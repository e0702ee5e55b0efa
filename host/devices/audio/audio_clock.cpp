// SPDX-License-Identifier: MIT
#include "audio_clock.hpp"

#include <algorithm>
#include <cfenv>
#include <thread>

namespace tactus::host::audio
{
void AudioClock::block (int frames, double card_rate_hz) noexcept
{
    last_block_s.store (frames / card_rate_hz, std::memory_order_relaxed);
    blocks.fetch_add (1, std::memory_order_release);
    if (! seize()) return;
    std::fenv_t before;
    std::feholdexcept (&before);
    std::fesetenv (FE_DFL_ENV);   // the sound system may have changed it
    by_timer.store (false, std::memory_order_relaxed);
    // Rounding errors can make a whole tick look like slightly less: a block of 64 frames at 48 kHz holds 1.333… ticks of
    // 1 kHz, so three blocks hold four.
    constexpr double rounding = 1e-6;
    for (owed += frames * rate_hz / card_rate_hz; owed >= 1.0 - rounding; owed -= 1.0)
        if (! ticked->tick (0.0))
        {
            over.store (true, std::memory_order_release);
            std::fesetenv (&before);
            return;   // leaves `ticking` set: there are no further ticks
        }
    std::fesetenv (&before);
    release();
}

void AudioClock::drive (Ticked& what) noexcept
{
    const auto period = toDuration (1.0 / rate_hz);
    constexpr std::chrono::milliseconds look { 5 };
    ticked = &what;
    release();
    auto seen = blocks.load (std::memory_order_acquire);
    auto last = Clock::now();
    while (! over.load (std::memory_order_acquire))
    {
        std::this_thread::sleep_for (look);
        const auto silence = toDuration (std::max (longest_silence_s, longest_silence_blocks * last_block_s.load (std::memory_order_relaxed)));
        const auto now = Clock::now();
        if (const auto n = blocks.load (std::memory_order_acquire); n != seen)
        {
            seen = n;
            last = now;
            continue;
        }
        if (now - last < silence || ! seize()) continue;

        by_timer.store (true, std::memory_order_relaxed);
        auto due = now;
        bool goes_on = true;
        while (goes_on && blocks.load (std::memory_order_acquire) == seen)
        {
            timed.fetch_add (1, std::memory_order_relaxed);
            goes_on = what.tick (std::max (0.0, std::chrono::duration<double> (Clock::now() - due).count()));
            due = std::max (due + period, Clock::now());   // missed ticks are skipped
            std::this_thread::sleep_until (due);
        }
        if (! goes_on) return;   // leaves `ticking` set: there are no further ticks
        seen = blocks.load (std::memory_order_acquire);
        last = Clock::now();
        owed = 0.0;
        release();
    }
}

}   // namespace tactus::host::audio
