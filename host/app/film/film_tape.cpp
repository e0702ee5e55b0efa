// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_tape.hpp"

#include <algorithm>

namespace tactus::host
{

void FilmTape::note (std::uint64_t tick, const Vec3& position, const Vec3& force) noexcept
{
    if (is_watched.load (std::memory_order_relaxed)) ring.push (std::array { FilmTick { tick, position, force } });
}

void FilmTape::begin (double hz)
{
    ring.drain ([] (std::span<const FilmTick>) {});
    forget();
    rate_hz = hz;
}

void FilmTape::forget()
{
    ticks.clear();
    states.clear();
}

void FilmTape::collect()
{
    ring.drain ([this] (std::span<const FilmTick> one) {
        if (! ticks.empty() && one.front().tick <= ticks.back().tick) forget();
        ticks.push_back (one.front());
    });
    if (ticks.empty()) return;
    const auto most = static_cast<std::uint64_t> (kept_s * rate_hz), first = end() - std::min (end(), most);
    while (ticks.front().tick < first)
        ticks.pop_front();
    while (states.size() > 1 && states[1].tick <= first)
        states.pop_front();
}

void FilmTape::add (const scene::Scene& stage, std::uint64_t version, const scene::SceneState& now, const scene::Camera& camera)
{
    if (ticks.empty()) return;
    if (const auto apart = static_cast<std::uint64_t> (rate_hz / states_per_second); ! states.empty() && end() < states.back().tick + apart) return;
    if (std::exchange (stage_version, version) != version || ! stage_now) stage_now = std::make_shared<const scene::Scene> (stage);
    states.push_back ({ end(), stage_now, now, camera });
}

Film FilmTape::last (double seconds) const
{
    const auto wanted = static_cast<std::uint64_t> (seconds * rate_hz);
    return since (end() - std::min (end(), wanted));
}

double FilmTape::secondsSince (std::uint64_t first) const
{
    const auto from = std::ranges::lower_bound (ticks, first, {}, &FilmTick::tick);
    return from == ticks.end() ? 0.0 : static_cast<double> (end() - from->tick) / rate_hz;
}

Film FilmTape::since (std::uint64_t first) const
{
    Film film { .rate_hz = rate_hz };
    const auto from = std::ranges::lower_bound (ticks, first, {}, &FilmTick::tick);
    film.ticks.assign (from, ticks.end());
    auto state = std::ranges::upper_bound (states, first, {}, &FilmState::tick);
    if (state != states.begin()) --state;   // what is shown when the film begins
    film.states.assign (state, states.end());
    return film;
}

}   // namespace tactus::host
