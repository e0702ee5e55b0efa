// SPDX-License-Identifier: MIT
#include "sampled_loop.hpp"
#include "spectral_radius.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace tactus::check
{

namespace
{
using Eigen::Index;
using LoopMatrix = Eigen::MatrixXd;

constexpr std::size_t most_remembered = 64;   // ticks of a response
constexpr std::size_t most_states = 64;       // of a loop of several axes: the time of a check grows with the third power

/// The forces that a position causes, tick by tick: the differences of the response, as far as they matter.
template <typename At>
std::vector<LoopMatrix> pulsesOf (std::size_t ticks, At&& at)
{
    constexpr double matters = 1e-6;   // relative
    std::vector<LoopMatrix> pulses;
    double most = 0.0;
    for (std::size_t k = 0; k < ticks; ++k)
    {
        const LoopMatrix now = at (k);
        most = std::max (most, now.norm());
        pulses.push_back (now);
        if (k > 0) pulses.back() -= LoopMatrix (at (k - 1));
    }
    while (! pulses.empty() && pulses.back().norm() <= matters * most)
        pulses.pop_back();
    return pulses;
}

/// The motion of device and hand: x' = A x + b f. x begins with the position of the sensor.
struct Motion
{
    LoopMatrix a;
    Eigen::VectorXd b;
};

Motion motionOf (const DeviceNumbers& n, const HeldHand& hand)
{
    const double mass = n.mass->value, damping = n.damping->value;
    if (! n.first_mode || ! std::isfinite (n.first_mode->value))
    {
        const double all = mass + hand.mass;
        Motion rigid { LoopMatrix::Zero (2, 2), Eigen::VectorXd::Zero (2) };
        rigid.a << 0.0, 1.0, -hand.stiffness / all, -(damping + hand.damping) / all;
        rigid.b << 0.0, 1.0 / all;
        return rigid;
    }
    constexpr double usual_ratio = 0.05;   // as a simulated device has it
    const double end = n.end_mass ? n.end_mass->value : 0.5 * mass, motor = mass - end, far = end + hand.mass;
    const double w = 2.0 * std::numbers::pi * n.first_mode->value;   // of the end, while the motor is held
    const double k = w * w * end, c = 2.0 * (n.first_mode_damping ? n.first_mode_damping->value : usual_ratio) * w * end;
    Motion bends { LoopMatrix::Zero (4, 4), Eigen::VectorXd::Zero (4) };   // motor: position, velocity; end: position, velocity
    bends.a << 0.0, 1.0, 0.0, 0.0,                                         //
        -k / motor, -(c + damping) / motor, k / motor, c / motor,          //
        0.0, 0.0, 0.0, 1.0,                                                //
        k / far, c / far, -(k + hand.stiffness) / far, -(c + hand.damping) / far;
    bends.b << 0.0, 1.0 / motor, 0.0, 0.0;
    return bends;
}

/// exp (m), by the Taylor series of a small part of m, squared again and again.
LoopMatrix exponential (const LoopMatrix& m)
{
    const int halvings =
        std::max (0, static_cast<int> (std::ceil (std::log2 (std::max (1e-300, m.lpNorm<Eigen::Infinity>() * static_cast<double> (m.rows()))))) + 2);
    const LoopMatrix part = m / std::exp2 (halvings);
    LoopMatrix sum = LoopMatrix::Identity (m.rows(), m.cols()), term = sum;
    for (int i = 1; i <= 16; ++i)
    {
        term = term * part / static_cast<double> (i);
        sum += term;
    }
    for (int i = 0; i < halvings; ++i)
        sum = (sum * sum).eval();
    return sum;
}

std::size_t delayOf (const DeviceNumbers& n) { return n.delay ? static_cast<std::size_t> (n.delay->value) : 0; }

std::optional<double> radiusOf (const std::vector<LoopMatrix>& pulses, std::span<const DeviceNumbers* const> axes, double period_s, const HeldHand& hand)
{
    std::size_t latest = 0;
    std::vector<LoopMatrix> ticks;
    std::vector<Index> first { 0 };   // the first state of each axis
    for (std::size_t i = 0; i < axes.size(); ++i)
    {
        if (! axes[i]->mass || ! axes[i]->damping) return std::nullopt;
        latest = std::max (latest, delayOf (*axes[i]));
        ticks.push_back (i > 0 && axes[i] == axes[i - 1] ? ticks.back() : LoopMatrix (heldMotion (*axes[i], period_s, hand)));
        first.push_back (first.back() + ticks.back().rows());
    }
    // The state of the loop: that of the motion, and the positions at the ticks before, axis by axis.
    const auto remembered = std::max<std::size_t> (pulses.size() + latest, 1) - 1, n = axes.size(), moving = static_cast<std::size_t> (first.back());
    if (remembered >= most_remembered || (n > 1 && moving + n * remembered > most_states)) return std::nullopt;
    const auto past = [&] (std::size_t axis, std::size_t ago) { return ago == 0 ? first[axis] : static_cast<Index> (moving + axis * remembered + ago - 1); };
    const auto size = static_cast<Index> (moving + n * remembered);
    LoopMatrix loop = LoopMatrix::Zero (size, size);
    for (std::size_t i = 0; i < n; ++i)
    {
        const auto states = ticks[i].rows();
        loop.block (first[i], first[i], states, states) = ticks[i].leftCols (states);
        for (std::size_t k = 0; k < pulses.size(); ++k)
            for (std::size_t j = 0; j < n; ++j)
                loop.block (first[i], past (j, k + delayOf (*axes[i])), states, 1) -=
                    pulses[k](static_cast<Index> (i), static_cast<Index> (j)) * ticks[i].rightCols (1);
        for (std::size_t ago = 1; ago <= remembered; ++ago)
            loop (past (i, ago), past (i, ago - 1)) = 1.0;
    }
    if (! loop.allFinite()) return std::nullopt;
    return spectralRadius (loop);
}
}   // namespace

Jacobian heldMotion (const DeviceNumbers& numbers, double period_s, const HeldHand& hand)
{
    const Motion motion = motionOf (numbers, hand);
    const auto size = motion.a.rows();
    LoopMatrix held = LoopMatrix::Zero (size + 1, size + 1);   // the force is one more state, which does not change
    held.topLeftCorner (size, size) = motion.a * period_s;
    held.topRightCorner (size, 1) = motion.b * period_s;
    return exponential (held).topRows (size);
}

std::span<const HeldHand> usualHands() noexcept
{
    static constexpr std::array hands { HeldHand {},
                                        HeldHand { 6e-3, 2.0, 200.0 },
                                        HeldHand { 6e-3, 4.0, 200.0 },
                                        HeldHand { 6e-3, 2.0, 800.0 },
                                        HeldHand { 6e-3, 4.0, 800.0 },
                                        HeldHand { 0.554, 6.45, 135.0 } };
    return hands;
}

std::optional<double> loopRadius (std::span<const double> response, const DeviceNumbers& numbers, double period_s, const HeldHand& hand)
{
    const auto pulses = pulsesOf (response.size(), [&] (std::size_t k) { return LoopMatrix::Constant (1, 1, response[k]); });
    const DeviceNumbers* const axis = &numbers;
    return radiusOf (pulses, { &axis, 1 }, period_s, hand);
}

std::optional<double> loopRadius (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, double period_s, const HeldHand& hand)
{
    const auto pulses = pulsesOf (response.size(), [&] (std::size_t k) -> const Jacobian& { return response[k]; });
    return radiusOf (pulses, axes, period_s, hand);
}

namespace
{
/// The largest of the radii with each of the usual hands.
template <typename RadiusWith>
std::optional<double> largest (RadiusWith&& radiusWith)
{
    double most = 0.0;
    for (const auto& hand : usualHands())
    {
        const std::optional<double> radius = radiusWith (hand);
        if (! radius) return std::nullopt;
        most = std::max (most, *radius);
    }
    return most;
}

template <typename RadiusWith>
bool allRest (RadiusWith&& radiusWith)
{
    return std::ranges::all_of (usualHands(), [&] (const HeldHand& hand) {
        const std::optional<double> radius = radiusWith (hand);
        return radius && *radius <= at_rest;
    });
}
}   // namespace

std::optional<double> largestRadius (std::span<const double> response, const DeviceNumbers& numbers, double period_s)
{
    return largest ([&] (const HeldHand& hand) { return loopRadius (response, numbers, period_s, hand); });
}

std::optional<double> largestRadius (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, double period_s)
{
    return largest ([&] (const HeldHand& hand) { return loopRadius (response, axes, period_s, hand); });
}

bool comesToRest (std::span<const double> response, const DeviceNumbers& numbers, double period_s)
{
    return allRest ([&] (const HeldHand& hand) { return loopRadius (response, numbers, period_s, hand); });
}

bool comesToRest (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, double period_s)
{
    return allRest ([&] (const HeldHand& hand) { return loopRadius (response, axes, period_s, hand); });
}

}   // namespace tactus::check
