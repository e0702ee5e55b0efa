// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/run/live_run.hpp>

#include <catch2/catch.hpp>

namespace tactus::host::test
{

/// Checks the force of each tick on the tape of a run whose guard lets 4 N through, and lets it rise for 50 ms: it steps nowhere. Where the tool jumps,
/// there is no force, and it rises along the ramp. Ticks that the tape has lost are not judged. Returns how often the tool has jumped.
inline std::size_t stepsChecked (LiveRun& run)
{
    constexpr double ramp_s = 0.05, strongest = 4.0;
    const auto film = run.film().last (60.0);
    const double dt = 1.0 / film.rate_hz;
    std::size_t jumps = 0;
    for (std::size_t i = 1; i < film.ticks.size(); ++i)
    {
        const auto &before = film.ticks[i - 1], &now = film.ticks[i];
        if (now.tick != before.tick + 1) continue;
        const bool has_jumped = (now.position - before.position).norm() > 1e-3;   // 4 m/s, at 4 kHz
        jumps += has_jumped ? 1 : 0;
        const double most = strongest * dt / ramp_s * (1.0 + 1e-9);
        if (has_jumped && (before.force.norm() > 0.0 || now.force.norm() > most)) FAIL ("a step of the force at tick " << now.tick);
        // It rises no faster than along the ramp, apart from what the hand does: at 2 N/mm and a speed far below 1 m/s.
        if (now.force.norm() - before.force.norm() > most + 2000.0 * dt * 0.5) FAIL ("the force rises in a step at tick " << now.tick);
    }
    return jumps;
}

}   // namespace tactus::host::test
