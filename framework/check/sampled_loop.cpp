// SPDX-License-Identifier: MIT
#include "sampled_loop.hpp"
#include "spectral_radius.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
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

std::size_t ticksLate (const DeviceNumbers& n) { return n.delay ? static_cast<std::size_t> (n.delay->value) : 0; }

/// Turns the axes of a device so that they do not influence each other, if there are such axes.
void align (std::vector<LoopMatrix>& pulses, std::span<const DeviceNumbers* const> axes)
{
    if (axes.size() < 2 || pulses.empty() || std::ranges::any_of (axes, [&] (const auto* a) { return a != axes.front(); })) return;
    constexpr double matters = 1e-7;   // relative
    LoopMatrix mixed = LoopMatrix::Zero (pulses.front().rows(), pulses.front().cols());
    double most = 0.0, share = 1.0;
    for (const auto& p : pulses)
    {
        mixed += share * (p + p.transpose());
        share *= 0.618;   // any shares that do not cancel
        most = std::max (most, p.norm());
    }
    const Eigen::SelfAdjointEigenSolver<LoopMatrix> parts (mixed);
    const LoopMatrix& turn = parts.eigenvectors();
    std::vector<LoopMatrix> turned;
    for (const auto& p : pulses)
    {
        LoopMatrix t = turn.transpose() * p * turn;
        const LoopMatrix own = t.diagonal().asDiagonal();
        if ((t - own).norm() > matters * most) return;
        turned.push_back (own);
    }
    pulses = std::move (turned);
}

/// The groups of axes that influence each other.
std::vector<std::vector<std::size_t>> groupsOf (const std::vector<LoopMatrix>& pulses, std::size_t axes)
{
    constexpr double matters = 1e-9;   // relative
    double most = 0.0;
    for (const auto& p : pulses)
        most = std::max (most, p.norm());
    const auto are = [&] (std::size_t i, std::size_t j) {
        return std::ranges::any_of (pulses, [&] (const LoopMatrix& p) {
            const auto a = static_cast<Index> (i), b = static_cast<Index> (j);
            return std::max (std::abs (p (a, b)), std::abs (p (b, a))) > matters * most;
        });
    };
    std::vector<std::vector<std::size_t>> groups;
    std::vector<bool> done (axes, false);
    for (std::size_t first = 0; first < axes; ++first)
    {
        if (done[first]) continue;
        done[first] = true;
        auto& group = groups.emplace_back (1, first);
        for (std::size_t i = 0; i < group.size(); ++i)
            for (std::size_t j = 0; j < axes; ++j)
                if (! done[j] && are (group[i], j))
                {
                    done[j] = true;
                    group.push_back (j);
                }
    }
    return groups;
}

std::vector<LoopMatrix> partOf (const std::vector<LoopMatrix>& pulses, const std::vector<std::size_t>& group)
{
    std::vector<LoopMatrix> part;
    for (const auto& p : pulses)
    {
        auto& own = part.emplace_back (static_cast<Index> (group.size()), static_cast<Index> (group.size()));
        for (std::size_t i = 0; i < group.size(); ++i)
            for (std::size_t j = 0; j < group.size(); ++j)
                own (static_cast<Index> (i), static_cast<Index> (j)) = p (static_cast<Index> (group[i]), static_cast<Index> (group[j]));
    }
    return part;
}

std::optional<double> radiusOfGroup (const std::vector<LoopMatrix>&, std::span<const DeviceNumbers* const>, double period_s, const HeldHand&);

std::optional<double> radiusOf (std::vector<LoopMatrix> pulses, std::span<const DeviceNumbers* const> axes, double period_s, const HeldHand& hand)
{
    align (pulses, axes);
    double most = 0.0;
    constexpr double rounding = 1e-6;   // relative
    double largest = 0.0;
    for (const auto& p : pulses)
        largest = std::max (largest, p.norm());
    const auto isHeld = [&] (const std::vector<LoopMatrix>& part) {
        return std::ranges::any_of (part, [&] (const LoopMatrix& p) { return p.norm() > rounding * largest; });
    };
    const bool is_any = isHeld (pulses);
    for (const auto& group : groupsOf (pulses, axes.size()))
    {
        if (is_any && ! isHeld (partOf (pulses, group))) continue;   // an axis that nothing holds slows down
        std::vector<const DeviceNumbers*> its;
        for (const auto i : group)
            its.push_back (axes[i]);
        const auto radius = radiusOfGroup (partOf (pulses, group), its, period_s, hand);
        if (! radius) return std::nullopt;
        most = std::max (most, *radius);
    }
    return most;
}

std::optional<double> radiusOfGroup (const std::vector<LoopMatrix>& pulses, std::span<const DeviceNumbers* const> axes, double period_s, const HeldHand& hand)
{
    std::size_t latest = 0;
    std::vector<LoopMatrix> ticks;
    std::vector<Index> first { 0 };   // the first state of each axis
    for (std::size_t i = 0; i < axes.size(); ++i)
    {
        if (! axes[i]->mass || ! axes[i]->damping) return std::nullopt;
        latest = std::max (latest, ticksLate (*axes[i]));
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
                loop.block (first[i], past (j, k + ticksLate (*axes[i])), states, 1) -=
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

double turnOf (const Jacobian& settled) noexcept
{
    const double all = settled.norm();
    return all > 0.0 ? 0.5 * (settled - settled.transpose()).norm() / all : 0.0;
}

std::optional<double> passivityLoad (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, std::span<const double> weights,
                                     double period_s)
{
    if (response.empty()) return std::nullopt;
    auto pulses = pulsesOf (response.size(), [&] (std::size_t k) { return LoopMatrix (0.5 * (response[k] + response[k].transpose())); });
    align (pulses, axes);
    const auto groups = groupsOf (pulses, axes.size());
    double most = 0.0;
    for (const auto& group : groups)
    {
        const auto part = partOf (pulses, group);
        if (std::ranges::none_of (part, [] (const LoopMatrix& p) { return p.norm() > 0.0; })) continue;
        const auto size = static_cast<Index> (group.size());
        const auto at = [&] (double angle) {
            Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero (size, size);
            for (std::size_t k = 0; k < part.size(); ++k)
                h += std::polar (1.0, -angle * static_cast<double> (k)) * part[k];
            const double half = std::sin (0.5 * angle);
            for (Index i = 0; i < size; ++i)
            {
                const auto& device = *axes[group[static_cast<std::size_t> (i)]];
                h.row (i) *= std::polar (1.0, -angle * static_cast<double> (ticksLate (device))) * (1.0 - std::polar (1.0, -angle)) * 0.5 * period_s
                             / (2.0 * half * half);
            }
            const auto scale = [&] (Index i) { return std::sqrt (weights[group[static_cast<std::size_t> (i)]]); };
            if (size == 1) return h (0, 0).real() * scale (0) * scale (0);
            for (Index i = 0; i < size; ++i)
                for (Index j = 0; j < size; ++j)
                    h (i, j) *= scale (i) * scale (j);
            const Eigen::MatrixXcd both = 0.5 * (h + h.adjoint());
            return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> (both, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
        };
        std::size_t latest = 0;
        for (const auto i : group)
            latest = std::max (latest, ticksLate (*axes[i]));
        const auto steps = std::min<std::size_t> (512, 24 + 8 * (part.size() + latest));
        const double step = std::numbers::pi / static_cast<double> (steps);
        double best = 0.01, value = at (best);
        for (std::size_t i = 1; i <= steps; ++i)
            if (const double now = at (step * static_cast<double> (i)); now > value)
            {
                value = now;
                best = step * static_cast<double> (i);
            }
        // The maximum between the neighbours of the best angle.
        double low = std::max (0.01, best - step), high = std::min (std::numbers::pi, best + step);
        constexpr double golden = 0.6180339887498949;
        for (int i = 0; i < 20; ++i)
        {
            const double a = high - golden * (high - low), b = low + golden * (high - low);
            const double left = at (a), right = at (b);
            value = std::max ({ value, left, right });
            (left < right ? low : high) = left < right ? a : b;
        }
        most = std::max (most, value);
    }
    return most;
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

namespace
{
std::vector<double> along (const Eigen::Vector3d& d, std::span<const Jacobian> response)
{
    std::vector<double> all;
    for (const auto& m : response)
        all.push_back (d.dot (Eigen::Matrix3d (m) * d));
    return all;
}
}   // namespace

double NodeResponse::mayGrow (const DeviceNumbers& device, double period_s) const
{
    return roomToGrow ([&] (double factor) {
        auto larger = response;
        for (double& v : larger)
            v *= factor;
        return comesToRest (larger, device, period_s);
    });
}

double NodeResponse::passivityLoad (const DeviceNumbers& device, double period_s) const
{
    std::vector<Jacobian> all;
    for (const double v : response)
        all.emplace_back (Jacobian::Constant (1, 1, v));
    const DeviceNumbers* const axis = &device;
    constexpr std::array<double, 1> whole { 1.0 };
    return check::passivityLoad (all, { &axis, 1 }, whole, period_s).value_or (0.0);
}

std::vector<NodeResponse> nodeResponses (const Slope& slope, std::span<const Jacobian> response)
{
    constexpr double faint = 1e-2, parallel = 0.9;   // of the steepest response; cosine
    std::vector<NodeResponse> all;
    if (response.empty()) return all;
    std::vector<std::size_t> nodes (slope.pulls.size());
    std::iota (nodes.begin(), nodes.end(), std::size_t { 0 });
    std::ranges::stable_sort (nodes, std::ranges::greater {}, [&] (std::size_t n) { return slope.by_node[n]; });
    std::vector<Eigen::Vector3d> taken;
    for (const auto n : nodes)
    {
        if (! (slope.by_node[n] > faint * slope.by_node[nodes.front()])) break;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts (slope.pulls[n]);
        for (int i = 2; i >= 0 && parts.eigenvalues()[i] > faint * parts.eigenvalues()[2]; --i)
        {
            const Eigen::Vector3d d = parts.eigenvectors().col (i);
            if (std::ranges::any_of (taken, [&] (const auto& t) { return std::abs (t.dot (d)) > parallel; })) continue;
            taken.push_back (d);
            all.push_back ({ n, along (d, response), { d.x(), d.y(), d.z() } });
        }
    }
    return all;
}

std::vector<NodeLoop> nodeLoops (const Slope& slope, std::span<const Jacobian> response, const DeviceNumbers& device, double period_s)
{
    std::vector<NodeLoop> all;
    if (! device.mass || ! device.damping) return all;
    for (auto& one : nodeResponses (slope, response))
    {
        const double may_grow = one.mayGrow (device, period_s);
        const auto known = std::ranges::find (all, one.node, [] (const NodeLoop& loop) { return loop.along.node; });
        if (known == all.end())
            all.push_back ({ std::move (one), may_grow });
        else if (may_grow < known->may_grow)
            *known = { std::move (one), may_grow };
    }
    std::ranges::stable_sort (all, {}, &NodeLoop::may_grow);
    return all;
}

}   // namespace tactus::check
