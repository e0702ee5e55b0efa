// SPDX-License-Identifier: MIT
#include "sampled_loop.hpp"

#include <Eigen/Eigenvalues>

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

/// The forces that a position causes, tick by tick: the differences of the response, as far as they matter.
std::vector<double> pulsesOf (std::span<const double> response)
{
    constexpr double matters = 1e-6;   // relative
    std::vector<double> pulses;
    double most = 0.0, before = 0.0;
    for (const double now : response)
    {
        pulses.push_back (now - before);
        most = std::max (most, std::abs (now));
        before = now;
    }
    while (! pulses.empty() && std::abs (pulses.back()) <= matters * most)
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
    const int halvings = std::max (0, static_cast<int> (std::ceil (std::log2 (std::max (1e-300, m.lpNorm<Eigen::Infinity>() * static_cast<double> (m.rows()))))) + 2);
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
}   // namespace

std::span<const HeldHand> usualHands() noexcept
{
    static constexpr std::array hands { HeldHand {},
                                        HeldHand { 6e-3, 2.0, 200.0 },
                                        HeldHand { 6e-3, 4.0, 200.0 },
                                        HeldHand { 6e-3, 2.0, 800.0 },
                                        HeldHand { 6e-3, 4.0, 800.0 } };
    return hands;
}

std::optional<double> loopRadius (std::span<const double> response, const DeviceNumbers& numbers, double period_s, const HeldHand& hand)
{
    if (! numbers.mass || ! numbers.damping) return std::nullopt;
    const auto pulses = pulsesOf (response);
    const auto late = numbers.delay ? static_cast<std::size_t> (numbers.delay->value) : 0;
    if (pulses.size() + late > most_remembered) return std::nullopt;

    const Motion motion = motionOf (numbers, hand);
    const auto size = motion.a.rows();
    LoopMatrix held = LoopMatrix::Zero (size + 1, size + 1);   // the force is one more state, which does not change
    held.topLeftCorner (size, size) = motion.a * period_s;
    held.topRightCorner (size, 1) = motion.b * period_s;
    const LoopMatrix tick = exponential (held);

    // The state of the loop: that of the motion, and the positions at the ticks before.
    const auto remembered = static_cast<Index> (std::max<std::size_t> (pulses.size() + late, 1)) - 1;
    LoopMatrix loop = LoopMatrix::Zero (size + remembered, size + remembered);
    loop.topLeftCorner (size, size) = tick.topLeftCorner (size, size);
    for (std::size_t i = 0; i < pulses.size(); ++i)
    {
        const auto ago = static_cast<Index> (i + late);
        loop.block (0, ago == 0 ? 0 : size + ago - 1, size, 1) -= pulses[i] * tick.topRightCorner (size, 1);
    }
    if (remembered > 0) loop (size, 0) = 1.0;
    for (Index i = 1; i < remembered; ++i)
        loop (size + i, size + i - 1) = 1.0;
    if (! loop.allFinite()) return std::nullopt;
    return Eigen::EigenSolver<LoopMatrix> (loop, false).eigenvalues().cwiseAbs().maxCoeff();
}

std::optional<double> largestRadius (std::span<const double> response, const DeviceNumbers& numbers, double period_s)
{
    double most = 0.0;
    for (const auto& hand : usualHands())
    {
        const auto radius = loopRadius (response, numbers, period_s, hand);
        if (! radius) return std::nullopt;
        most = std::max (most, *radius);
    }
    return most;
}

}   // namespace tactus::check
