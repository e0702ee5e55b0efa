// SPDX-License-Identifier: MIT
#include "deadbeat_loop.hpp"
#include "sampled_loop.hpp"
#include "spectral_radius.hpp"

#include <tactus/kit/signal/held_step.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tactus::check
{

namespace
{
using Eigen::Index;

constexpr double smoothing_s = 10e-3;   // over which the node smooths its estimate of the hand

/// Node and device, as deviations from their rest. Depths and forces are positive into the wall.
class Loop
{
public:
    Loop (const DeadbeatPlan& p, const DeviceNumbers& device, std::size_t late, double period_s)
        : plan (p), delay (late), step (p.mass, p.damping, period_s), learns (-std::expm1 (-period_s / smoothing_s)),
          motion (heldMotion (device, period_s, {})), device_state (Eigen::VectorXd::Zero (motion.rows())), sent (std::max (plan.delay + 2, delay + 1), 0.0)
    {
        // The mass that the node assumes, in a continuous wall, under a force of the hand: over two ticks.
        DeviceNumbers assumed;
        assumed.mass.emplace();
        assumed.mass->value = p.mass;
        assumed.damping.emplace();
        assumed.damping->value = p.damping;
        in_wall = heldMotion (assumed, 2.0 * period_s, { .stiffness = p.stiffness });
    }

    Index size() const { return device_state.size() + 3 + static_cast<Index> (sent.size()); }

    /// The state after two ticks.
    Eigen::VectorXd after (const Eigen::VectorXd& state)
    {
        device_state = state.head (device_state.size());
        auto next = state.data() + device_state.size();
        depths[0] = *next++;
        depths[1] = *next++;
        push = *next++;
        std::copy_n (next, sent.size(), sent.begin());
        const auto forces = planned (observed());
        give (forces.first);
        observed();
        give (forces.second);
        Eigen::VectorXd all (size());
        all << device_state, depths[0], depths[1], push, Eigen::Map<const Eigen::VectorXd> (sent.data(), static_cast<Index> (sent.size()));
        return all;
    }

private:
    DeadbeatPlan plan;
    std::size_t delay;
    HeldStep step;
    double learns;
    Eigen::MatrixXd motion, in_wall;
    Eigen::VectorXd device_state;
    std::vector<double> sent;   // the last outputs, the newest first
    double depths[2] {};        // at the last tick and the one before
    double push = 0.0;          // the estimate of the hand

    double speedAt (double from, double to, double force) const
    {
        const double start = (to - from - step.x_per_f * force) / step.x_per_v;
        return start + step.v_loss * start + step.v_per_f * force;
    }

    /// Corrects the estimate of the hand, and returns the estimate of the speed.
    double observed()
    {
        const double now = device_state[0], held = sent[plan.delay], before = sent[plan.delay + 1];
        double expected = depths[0], v = speedAt (depths[1], depths[0], before + push);
        step (expected, v, held + push);
        push += (now - expected) / (step.x_per_f + step.x_per_v * step.v_per_f - (1.0 + step.v_loss) * step.x_per_f) * learns;
        const double speed = speedAt (depths[0], now, held + push);
        depths[1] = depths[0];
        depths[0] = now;
        return speed;
    }

    std::pair<double, double> planned (double v) const
    {
        double e = depths[0];
        for (std::size_t i = plan.delay; i-- > 0;)
            step (e, v, sent[i] + push);
        const Eigen::Vector2d wanted = in_wall * Eigen::Vector3d (e, v, push);
        for (int i = 0; i < 2; ++i)
            step (e, v, push);
        const double de = wanted[0] - e, dv = wanted[1] - v, keeps = 1.0 + step.v_loss, first = step.x_per_f + step.x_per_v * step.v_per_f;
        const double force = (de - dv * step.x_per_f / step.v_per_f) / (first - keeps * step.x_per_f);
        return { force, dv / step.v_per_f - keeps * force };
    }

    void give (double force)
    {
        std::copy_backward (sent.begin(), sent.end() - 1, sent.end());
        sent[0] = force;
        Eigen::VectorXd with_force (device_state.size() + 1);
        with_force << device_state, sent[delay];
        device_state = motion * with_force;
    }
};
}   // namespace

std::optional<double> deadbeatRadius (const DeadbeatPlan& plan, const DeviceNumbers& device, std::size_t delay_ticks, double period_s)
{
    if (! device.mass || ! device.damping || ! (plan.mass > 0.0)) return std::nullopt;
    Loop loop (plan, device, delay_ticks, period_s);
    Eigen::MatrixXd all (loop.size(), loop.size());
    for (Index i = 0; i < loop.size(); ++i)
        all.col (i) = loop.after (Eigen::VectorXd::Unit (loop.size(), i));
    if (! all.allFinite()) return std::nullopt;
    return std::sqrt (spectralRadius (all));
}

}   // namespace tactus::check
