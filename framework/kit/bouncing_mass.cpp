// SPDX-License-Identifier: MIT
#include "bouncing_mass.hpp"
#include "math/math.hpp"
#include <tactus/kit/signal/held_step.hpp>

#include <algorithm>
#include <cmath>

namespace tactus
{
namespace
{
constexpr int steps = 16, most_steps = 64, halvings = 45;

/// e^(-b t) times cos (w t) and sin (w t)/w, with w^2 = `square`. For an overdamped spring, `square` is negative, and the functions
/// are cosh and sinh.
struct Swing
{
    Swing (double b, double square, double t) noexcept
    {
        const double z = square * t * t, w = std::sqrt (std::abs (square));
        const auto decays = [b, t] { return b != 0.0 ? math::exp (-b * t) : 1.0; };
        if (std::abs (z) < 1e-4)   // both formulas below lose digits here; the error of this series is below 1e-15
        {
            const double decay = decays();
            cosine = decay * (1.0 - z / 2.0 + z * z / 24.0);
            sine = decay * t * (1.0 - z / 6.0 + z * z / 120.0);
        }
        else if (square > 0.0)
        {
            const double decay = decays();
            const auto turn = math::sinCos (w * t);
            cosine = decay * turn.cosine;
            sine = decay * turn.sine / w;
        }
        else
        {
            const double slow = math::exp ((w - b) * t), fast = math::exp (-(w + b) * t);   // w <= b, so neither overflows
            cosine = 0.5 * (slow + fast);
            sine = 0.5 * (slow - fast) / w;
        }
    }

    double cosine, sine;
};
}   // namespace

BouncingMass::State BouncingMass::moved (State s, double time, bool in_spring) const noexcept
{
    if (! in_spring || stiffness == 0.0)
    {
        HeldStep (mass, damping, time) (s.depth, s.speed, force);
        return s;
    }
    const double b = 0.5 * damping / mass, square = stiffness / mass, rest = force / stiffness;
    const Swing swing (b, square - b * b, time);
    const double e = s.depth - rest, v = s.speed;
    return { .depth = rest + e * swing.cosine + (v + b * e) * swing.sine, .speed = v * swing.cosine - (b * v + square * e) * swing.sine };
}

/// True if the mass enters or leaves the spring on its way to `to`. Then `from` moves just beyond the surface, and `time` becomes the
/// time until then.
bool BouncingMass::leaves (State& from, State to, double& time, bool in_spring) const noexcept
{
    const auto isOut = [&] (State s) { return (s.depth > 0.0) != in_spring; };
    const double way = in_spring ? -1.0 : 1.0;   // towards the surface
    const bool crosses = isOut (to);
    if (! crosses && ! (way * from.speed > 0.0 && way * to.speed < 0.0)) return false;

    double before = 0.0, after = time;
    for (int i = 0; i < halvings; ++i)
    {
        const double middle = 0.5 * (before + after);
        const auto there = moved (from, middle, in_spring);
        const bool is_beyond = isOut (there) || (! crosses && way * there.speed < 0.0);
        (is_beyond ? after : before) = middle;
    }
    const auto there = moved (from, after, in_spring);
    if (! isOut (there)) return false;   // the mass turned back before the surface
    from = there;
    time = after;
    return true;
}

BouncingMass::Result BouncingMass::after (State s, double time) const noexcept
{
    const double furthest = s.depth + time * (std::max (s.speed, 0.0) + 0.5 * time * std::max (force, 0.0) / mass);
    if (furthest < 0.0) return { .state = moved (s, time, false), .touched = false };

    const double apart_step = time / steps, spring_step = std::min (apart_step, 0.5 * std::sqrt (mass / stiffness));   // at most a sixth of a bounce
    bool in_spring = s.depth > 0.0;
    Result result { .state = s, .touched = in_spring };
    double left = time;
    for (int i = 0; i < most_steps && left > 0.0; ++i)
    {
        double taken = std::min (in_spring ? spring_step : apart_step, left);
        const auto next = moved (s, taken, in_spring);
        if (leaves (s, next, taken, in_spring))
            in_spring = ! in_spring;
        else
            s = next;
        result.touched = result.touched || in_spring;
        left -= taken;
    }
    result.state = left > 0.0 ? moved (s, left, in_spring) : s;
    return result;
}

}   // namespace tactus
