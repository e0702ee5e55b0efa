// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/audio/stream.hpp>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

namespace tactus::test
{

/// Ticks and blocks of a sound card in virtual time, each with its own clock.
struct TwoClocks
{
    double tick_hz = 1000.0, card_hz = 48000.0;
    int block = 64;
    double card_is_faster = 0.0;   ///< how much faster the card's clock is, relative to nominal
    double jitter_s = 0.0;         ///< how late a tick or a block may be

    /// Runs for this many seconds, continuing from the last call.
    void run (double seconds, const std::function<void()>& tick, const std::function<void()>& play)
    {
        end += seconds;
        for (;;)
        {
            const double next_tick = static_cast<double> (ticks) / tick_hz + late (tick_late);
            const double next_block = static_cast<double> (blocks) * block / (card_hz * (1.0 + card_is_faster)) + late (block_late);
            if (std::min (next_tick, next_block) >= end) return;
            if (next_tick <= next_block)
            {
                tick();
                ++ticks;
                tick_late = -1.0;
            }
            else
            {
                play();
                ++blocks;
                block_late = -1.0;
            }
        }
    }

    double late (double& kept)
    {
        if (kept < 0.0) kept = jitter_s > 0.0 ? std::uniform_real_distribution (0.0, jitter_s) (random) : 0.0;
        return kept;
    }

    std::int64_t ticks = 0, blocks = 0;
    double end = 0.0, tick_late = -1.0, block_late = -1.0;   // in s; how late the next tick and block are, negative if not decided yet
    std::mt19937 random { 1 };
};

}   // namespace tactus::test
