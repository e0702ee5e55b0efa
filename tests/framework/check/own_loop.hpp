// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <vector>

/// A simulation of a sampled loop that shares no code with framework/check and with the simulated device: the verdicts of the check are compared with it.
/// Only the forces come from the graph itself.
namespace tactus::test::own
{

/// The mechanics of a device: a mass with viscous and dry friction that a motor pushes, and with a mode, a second mass on a spring, which the hand holds.
struct Mechanics
{
    double mass = 0.1, damping = 1.0, dry = 0.0, quantum = 0.0;   // kg, N s/m, N, m
    double mode_hz = 0.0, mode_ratio = 0.05, end_mass = 0.0;      // 0 Hz: rigid
    int delay = 0;                                                // ticks
    double brake = 0.0;                                           // N s/m; the largest
};

/// The numbers of a simulated device.
inline Mechanics mechanicsOf (const Simulation& s)
{
    return { .mass = s.mass,
             .damping = s.damping,
             .dry = s.coulomb,
             .quantum = s.quantum,
             .mode_hz = s.first_mode,
             .mode_ratio = s.first_mode_damping,
             .end_mass = s.end_mass,
             .delay = s.delay,
             .brake = s.brake };
}

/// A hand on the tool: a mass, a damper, and a spring to the place where the tool was put.
struct Grip
{
    double mass = 0.0, damping = 0.0, stiffness = 0.0;
};

/// One axis: positions and speeds of motor and end. Velocity Verlet with an implicit damper; dry friction takes at most the speed that there is.
struct Track
{
    double x = 0.0, v = 0.0, y = 0.0, w = 0.0;

    void advance (const Mechanics& m, const Grip& grip, double brake, double rest, double motor_force, double hand_force, double h)
    {
        if (m.mode_hz <= 0.0)
        {
            const double mass = m.mass + grip.mass, b = m.damping + grip.damping + brake;
            const double middle = x + 0.5 * h * v, force = motor_force + hand_force - grip.stiffness * (middle - rest);
            const double free = ((mass - 0.5 * h * b) * v + h * force) / (mass + 0.5 * h * b);
            v = slowed (free, h * m.dry / (mass + 0.5 * h * b));
            x = y = middle + 0.5 * h * v;
            w = v;
            return;
        }
        const double far = m.end_mass > 0.0 ? m.end_mass : 0.5 * m.mass, near = m.mass - far, turn = 6.283185307179586 * m.mode_hz;
        const double k = turn * turn * far, c = 2.0 * m.mode_ratio * turn * far, heavy = far + grip.mass;
        const double mx = x + 0.5 * h * v, my = y + 0.5 * h * w;
        const double fx = motor_force + k * (my - mx), fy = hand_force - k * (my - mx) - grip.stiffness * (my - rest);
        // (near + h/2 (B + c)) v1 - h/2 c w1 = r1,  -h/2 c v1 + (heavy + h/2 (c + c_h)) w1 = r2
        const double a = near + 0.5 * h * (m.damping + brake + c), d = heavy + 0.5 * h * (c + grip.damping), e = -0.5 * h * c;
        const double r1 = (near - 0.5 * h * (m.damping + brake + c)) * v + 0.5 * h * c * w + h * fx;
        const double r2 = (heavy - 0.5 * h * (c + grip.damping)) * w + 0.5 * h * c * v + h * fy;
        const double det = a * d - e * e;
        v = slowed ((d * r1 - e * r2) / det, h * m.dry * d / det);
        w = (r2 - e * v) / d;
        x = mx + 0.5 * h * v;
        y = my + 0.5 * h * w;
    }

    static double slowed (double v, double by) { return v > by ? v - by : v < -by ? v + by
                                                                                  : 0.0; }
};

/// A tool that a test puts somewhere.
struct Hand final : Device
{
    Reading now {};
    Effort got {};
    DeviceLayout has {};

    void prepare (double) override {}
    Reading read() noexcept override { return now; }
    void write (const Effort& e) noexcept override { got = e; }
    DeviceLayout layout() const override { return has; }
};

/// The movement of a tool in the last third of a trial, in m: its range, and its swing, the smaller of its largest rise and its largest fall.
/// A trial lasts 3 s, or 12, 48 or 192 s while the swing dies or grows, or the tool moves on.
struct Third
{
    double range = 0.0, swing = 0.0;
    double gone = 0.0;                       // range along an axis on which the graph, not the hand, drives it on at least half as far as in the second third
    double work = 0.0, push_work = 0.0;      // of the graph and of the constant force on the tool in the last third, in J
    double all_work = 0.0, all_push = 0.0;   // the same since the start, and the most that it was
    double most_work = 0.0, most_push = 0.0;
    bool is_far = false;
};

/// A graph with one role whose tool goes along a path to a place, waits there, and is let go.
class Loop
{
public:
    Loop (const graph::Graph& g, const Catalogue& nodes, const CompileOptions& options, const Mechanics& m, const std::string& role = "h") : mechanics (m)
    {
        hand.has.mechanics = { m.mass, m.damping };
        hand.has.brake = m.brake;
        auto plan = compile (g, nodes, options).plan;
        period = 1.0 / plan->rateHz();
        engine = std::make_unique<Engine> (std::move (plan));
        engine->attach (role, hand);
    }

    /// Follows positions, tick by tick, and stays at the last one.
    void follow (const std::vector<Vec3>& path)
    {
        for (const auto& p : path)
            put (p);
        for (int k = 0; k < 200; ++k)
            put (path.back());
    }

    Vec3 force() const { return hand.got.force; }

    /// Moves the tool to a place within one tick, and keeps it there: the force on each of the following ticks.
    std::vector<Vec3> stepTo (const Vec3& p, int ticks)
    {
        std::vector<Vec3> forces;
        for (int k = 0; k < ticks; ++k)
        {
            put (p);
            forces.push_back (force());
        }
        return forces;
    }

    /// Lets the tool go at a distance from the last place of the path, with a hand that pushes with a constant force.
    Third letGo (const Vec3& off, const Grip& grip, const Vec3& push)
    {
        const int fine = mechanics.mode_hz > 0.0 ? 20 : 8;
        const double h = period / fine;
        const Vec3 rest = hand.now.true_position;
        std::array<Track, 3> tracks;
        for (int i = 0; i < 3; ++i)
            tracks[std::size_t (i)].x = tracks[std::size_t (i)].y = rest[i] + off[i];
        std::deque<Effort> way (std::size_t (mechanics.delay), hand.got);
        auto ticks = static_cast<int> (3.0 / period);
        struct Edge
        {
            double low = 1e9, high = -1e9, rise = 0.0, fall = 0.0;

            void to (double z)
            {
                low = std::min (low, z);
                high = std::max (high, z);
                rise = std::max (rise, z - low);
                fall = std::max (fall, high - z);
            }
        };
        std::array<Edge, 3> second, third;
        Third found;
        std::array<double, 3> work {}, push_work {};
        const double least = std::max (1e-6, 2.0 * mechanics.quantum);
        int more = 3;   // times that it may run on
        const auto isOver = [&] {
            found.range = found.swing = found.gone = 0.0;
            bool changes = false;
            for (std::size_t i = 0; i < 3; ++i)
            {
                const double range = third[i].high - third[i].low, swing = std::min (third[i].rise, third[i].fall);
                const double swing_before = std::min (second[i].rise, second[i].fall);
                found.range = std::max (found.range, range);
                found.swing = std::max (found.swing, swing);
                if (range >= 0.5 * (second[i].high - second[i].low) && work[i] > std::max (0.0, push_work[i])) found.gone = std::max (found.gone, range);
                const double decay = 0.005 * period * ticks / 3.0;   // in a third; a swing may die as slowly as this
                changes = changes || (swing > 0.5 * least && (swing < (1.0 - decay) * swing_before || swing > 1.1 * swing_before));
            }
            if (! (found.work > std::max (0.0, found.push_work))) found.gone = 0.0;
            return ! changes && (found.gone <= least || found.swing > least);
        };
        for (int k = 0;; ++k)
        {
            if (k == ticks)
            {
                if (isOver() || more == 0) break;
                --more;
                ticks *= 4;
                second = third = {};
                work = push_work = {};
                found.work = found.push_work = 0.0;
            }
            Vec3 at, end;
            for (int i = 0; i < 3; ++i)
            {
                at[i] = tracks[std::size_t (i)].x;
                end[i] = tracks[std::size_t (i)].y;
                if (mechanics.quantum > 0.0) at[i] = mechanics.quantum * std::floor (at[i] / mechanics.quantum + 0.5);
            }
            hand.now.position = at;
            hand.now.true_position = end;
            engine->tick();
            way.push_back (hand.got);
            const auto due = way.front();
            way.pop_front();
            const double brake = std::clamp (due.brake, 0.0, mechanics.brake);
            for (int i = 0; i < 3; ++i)
            {
                auto& t = tracks[std::size_t (i)];
                const double before = t.x;
                for (int j = 0; j < fine; ++j)
                    t.advance (mechanics, grip, brake, rest[i], due.force[i], push[i], h);
                found.all_work += due.force[i] * (t.x - before);
                found.all_push += push[i] * (t.x - before);
                found.most_work = std::max (found.most_work, found.all_work);
                found.most_push = std::max (found.most_push, found.all_push);
                if (3 * k >= 2 * ticks)
                {
                    found.work += due.force[i] * (t.x - before);
                    found.push_work += push[i] * (t.x - before);
                    work[std::size_t (i)] += due.force[i] * (t.x - before);
                    push_work[std::size_t (i)] += push[i] * (t.x - before);
                }
                if (! (std::abs (t.x - rest[i]) < 1.0)) found.is_far = true;
                if (3 * k >= 2 * ticks)
                    third[std::size_t (i)].to (t.x);
                else if (3 * k >= ticks)
                    second[std::size_t (i)].to (t.x);
            }
            if (found.is_far) break;
        }
        for (int k = 0; k < 200; ++k)
            put (rest);
        return found;
    }

private:
    Mechanics mechanics;
    Hand hand {};
    double period = 1e-3;
    std::unique_ptr<Engine> engine;

    void put (const Vec3& p)
    {
        hand.now.position = p;
        if (mechanics.quantum > 0.0) hand.now.position = mechanics.quantum * (p / mechanics.quantum + Vec3::Constant (0.5)).array().floor().matrix();
        hand.now.true_position = p;
        engine->tick();
    }
};

}   // namespace tactus::test::own
