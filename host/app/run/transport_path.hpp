// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/run/device/path.hpp>

#include <atomic>
#include <memory>

namespace tactus::host
{

/// A path with a transport: pause, seek and slow motion while a hand follows it. The position never jumps: after a seek it catches up like
/// a critically damped spring, and a change of speed takes a moment. A gesture goes round; a recording pauses at its end.
class TransportPath final : public Path
{
public:
    static constexpr double least_speed = 0.1, most_speed = 2.0;

    explicit TransportPath (std::shared_ptr<const Path> p)
        : path (std::move (p)), repeats (dynamic_cast<const GesturePath*> (path.get()) != nullptr), now (path->at (0.0))
    {
    }

    // [any thread]
    void play (bool on) noexcept
    {
        auto unasked = none;
        if (on && ! repeats && reported >= path->duration()) wanted.compare_exchange_strong (unasked, 0.0);   // again from its beginning
        plays = on;
    }
    bool isPlaying() const noexcept { return plays; }
    void setSpeed (double factor) noexcept { speed = factor; }
    void seek (double to_s) noexcept { wanted = to_s; }
    double position() const noexcept { return reported; }   ///< time since the start of the current loop, in s

    double duration() const noexcept override { return path->duration(); }

    /// Call with increasing times. [tick thread]
    Point at (double t) const noexcept override
    {
        const double dt = t - last;
        last = t;
        if (! (dt > 0.0)) return now;

        const double pace_wanted = plays ? speed.load (std::memory_order_relaxed) : 0.0;
        pace = pace_wanted + (pace - pace_wanted) * math::exp (-pace_rate * dt);
        if (const double to = wanted.exchange (none, std::memory_order_relaxed); to >= 0.0)
        {
            const auto before = path->at (place), after = path->at (to);
            offset.position += before.position - after.position;
            offset.velocity += pace * (before.velocity - after.velocity);
            place = to;
        }
        const double length = path->duration(), was = place;
        place += pace * dt;
        if (! repeats && place >= length)
        {
            place = length;
            if (was < length) plays = false;
        }
        const Vec3 b = offset.velocity + catch_up_rate * offset.position;
        const double decay = math::exp (-catch_up_rate * dt);
        offset.position = decay * (offset.position + b * dt);
        offset.velocity = decay * b - catch_up_rate * offset.position;

        const auto on_path = path->at (place);
        now.position = on_path.position + offset.position;
        now.velocity = pace * on_path.velocity + offset.velocity;
        reported.store (repeats && length > 0.0 ? math::fmod (place, length) : place, std::memory_order_relaxed);
        return now;
    }

private:
    static constexpr double none = -1.0;
    static constexpr double pace_rate = 20.0, catch_up_rate = 12.0;   // 1/s

    std::shared_ptr<const Path> path;
    const bool repeats;
    mutable std::atomic<bool> plays = true;
    std::atomic<double> speed = 1.0;
    mutable std::atomic<double> wanted = none, reported = 0.0;

    // [tick thread]
    mutable Point now, offset;
    mutable double last = 0.0, place = 0.0, pace = 1.0;
};

}   // namespace tactus::host
