// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/scene/scene.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace tactus::host
{

/// The tool of the hand at a tick, and the force on it.
struct FilmTick
{
    std::uint64_t tick = 0;
    Vec3 position = Vec3::Zero(), force = Vec3::Zero();   ///< m, N
};

/// The content of a picture of the scene, and the position of the camera.
struct FilmState
{
    std::uint64_t tick = 0;
    std::shared_ptr<const scene::Scene> stage;
    scene::SceneState now;
    scene::Camera camera;
};

/// A stretch of a run, from which the pictures of a film, its sound and its table are made.
struct Film
{
    double rate_hz = 1.0;
    std::vector<FilmTick> ticks {};     ///< consecutive, except for those that were lost while the window was busy
    std::vector<FilmState> states {};   ///< the first one may be earlier than the first tick

    double seconds() const noexcept { return ticks.empty() ? 0.0 : static_cast<double> (ticks.back().tick + 1 - ticks.front().tick) / rate_hz; }
};

/// Keeps the last seconds of a run: its ticks, and the states of the scene, which are small. While it is not
/// watched, it costs a run one test per tick. [main thread]
class FilmTape
{
public:
    static constexpr double longest_s = 120.0;
    static constexpr double states_per_second = 30.0;   ///< at most

    void note (std::uint64_t tick, const Vec3& position, const Vec3& force) noexcept;   ///< [tick thread]

    void watch (bool w) noexcept { is_watched.store (w, std::memory_order_relaxed); }
    void begin (double rate_hz);                                                      ///< forgets everything; call while nothing ticks
    void keep (double seconds) noexcept { kept_s = std::min (seconds, longest_s); }   ///< how much to keep

    void collect();   ///< call many times a second

    /// Adds a state of the scene, as of the latest tick. `version` changes with the stage.
    void add (const scene::Scene& stage, std::uint64_t version, const scene::SceneState&, const scene::Camera&);

    std::uint64_t end() const noexcept { return ticks.empty() ? 0 : ticks.back().tick + 1; }   ///< one after the latest tick
    double rate() const noexcept { return rate_hz; }

    Film last (double seconds) const;              ///< the latest stretch of this length, or a shorter one
    Film since (std::uint64_t first_tick) const;   ///< the stretch that begins at a tick, or at the first one that was kept after it

    double secondsSince (std::uint64_t first_tick) const;   ///< the length of that stretch

private:
    static constexpr std::size_t ring_length = 8192;

    void forget();

    std::atomic<bool> is_watched = false;
    SpscRing<FilmTick> ring { ring_length };
    std::deque<FilmTick> ticks;
    std::deque<FilmState> states;
    std::shared_ptr<const scene::Scene> stage_now;
    std::uint64_t stage_version = 0;
    double rate_hz = 1.0, kept_s = 10.0;
};

}   // namespace tactus::host
